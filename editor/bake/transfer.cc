#include "editor/bake/transfer.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "editor/bake/blockers.h"
#include "editor/bake/key_poses.h"
#include "editor/bake/posed_surface.h"
#include "editor/bake/receivers.h"
#include "editor/bake/transfer_packer.h"
#include "editor/bake/transfer_solver.h"
#include "shared/core/parallel.h"
#include "shared/human/skinning.h"

namespace lararium::bake {
namespace {

constexpr size_t kVerticesPerJob = 256;
// Share of the light of a uniform sky below which cloth touches cloth or the body.
constexpr float kClosed = 0.01f;
constexpr int kOpening = 3;  // Rings of vertices.

glm::mat3 Orthonormal(const glm::mat3& m) {
  const glm::vec3 x = glm::normalize(m[0]);
  const glm::vec3 y = glm::normalize(m[1] - glm::dot(m[1], x) * x);
  return {x, y, glm::cross(x, y)};
}

std::vector<glm::mat3> VertexRotations(const human::Human& human, std::span<const glm::mat4> skin) {
  std::vector<glm::mat3> rotations;
  for (const human::SkinnedMesh& mesh : human.meshes) {
    for (size_t v = 0; v < mesh.positions.size(); ++v) {
      glm::mat3 sum(0.0f);
      for (size_t i = 0; i < 4; ++i) {
        sum += mesh.weights[v][static_cast<int>(i)] * glm::mat3(skin[mesh.joints[v][i]]);
      }
      rotations.push_back(Orthonormal(sum));
    }
  }
  return rotations;
}

// Cloth moves differently from the key poses: a pocket that is closed in one of them may be
// open in the show, and its black would spread over the triangles around it. So its vertices
// take the light of their surroundings.
void OpenPockets(const TransferSites& sites, SolvedTransfer& solved) {
  for (size_t m = 0; m < sites.meshes.size(); ++m) {
    for (const size_t first : {sites.first[m], sites.first_back[m]}) {
      if (first == TransferSites::kNone) {
        continue;
      }
      const std::span<TransferVector> vectors =
          std::span(solved.vectors).subspan(first, sites.meshes[m].positions.size());
      std::vector<bool> closed;
      for (const TransferVector& vector : vectors) {
        const glm::vec3 share = ShareOfEvenLight(vector);
        closed.push_back(std::max({share.r, share.g, share.b}) < kClosed);
      }
      SpreadTransfer(sites.meshes[m].indices, kOpening, std::move(closed), vectors);
    }
  }
}

// Rotates the vectors of all fronts from the axes of the pose to those of the bind pose.
void TurnToBindPose(std::span<const glm::mat3> pose_from_bind, int count, SolvedTransfer& solved) {
  const size_t jobs = (pose_from_bind.size() + kVerticesPerJob - 1) / kVerticesPerJob;
  ParallelFor(jobs, [&](size_t job) {
    const size_t end = std::min((job + 1) * kVerticesPerJob, pose_from_bind.size());
    for (size_t vertex = job * kVerticesPerJob; vertex < end; ++vertex) {
      TurnTransfer(glm::transpose(pose_from_bind[vertex]), count, solved.vectors[vertex]);
    }
  });
}

}  // namespace

Result<human::LightTransfer> BakeTransfer(const human::Human& human,
                                          const TransferOptions& options,
                                          Progress& progress) {
  human::LightTransfer transfer;
  transfer.count = options.count;
  transfer.bounces = options.bounces;
  LARARIUM_ASSIGN_OR_RETURN(const PosableSurface posable, PosableSurface::Create(human));
  const std::vector<glm::mat4> still(human.skeleton.size(), glm::mat4(1.0f));
  const std::vector<SurfaceMesh> bind = posable.Pose(still);
  LARARIUM_ASSIGN_OR_RETURN(transfer.blockers,
                            FitBlockers(bind, StrongestJoints(human), options.blockers));
  transfer.key_poses =
      ChooseKeyPoses(std::shared_ptr<const human::Human>(std::shared_ptr<void>(), &human),
                     transfer.blockers, options.key_poses);
  PlaceReceivers(bind, human, options.receivers, transfer);
  TransferPacker packer(options.count);
  for (size_t k = 0; k < transfer.key_poses.size(); ++k) {
    progress.Report("light transfer",
                    static_cast<double>(k) / static_cast<double>(transfer.key_poses.size()));
    if (progress.Cancelled()) {
      return Status::Error(human.name, "baking was cancelled");
    }
    const std::vector<glm::mat4> skin = human::SkinOfPose(human.skeleton, transfer.key_poses[k]);
    const TransferSites sites(posable.Pose(skin));
    LARARIUM_ASSIGN_OR_RETURN(const RayScene rays, RaysAt(sites.meshes));
    SolvedTransfer solved =
        SolveTransfer(sites, rays, {options.count, options.rays, options.bounces});
    OpenPockets(sites, solved);
    TurnToBindPose(VertexRotations(human, skin), options.count, solved);
    packer.AddKeyPose(sites, solved);
  }
  packer.Pack(transfer.meshes);
  return transfer;
}

}  // namespace lararium::bake
