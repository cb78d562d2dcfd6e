#include "editor/bake/transfer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "editor/bake/blockers.h"
#include "editor/bake/directions.h"
#include "editor/bake/key_poses.h"
#include "editor/bake/posed_surface.h"
#include "editor/bake/receivers.h"
#include "shared/core/parallel.h"
#include "shared/core/random.h"
#include "shared/human/skinning.h"
#include "shared/light/spherical_harmonics.h"
#include "shared/light/transfer.h"

namespace lararium::bake {
namespace {

constexpr int kMaxCount = light::kShCount;
constexpr float kNear = 2e-4f;  // metres: where a ray leaves the surface that it starts from
constexpr size_t kVerticesPerJob = 64;

// One coefficient vector for each channel, [channel][coefficient].
using Vector = std::array<float, 3 * kMaxCount>;

// All vertices of all meshes in one row.
struct Posed {
  std::vector<SurfaceMesh> meshes;
  std::vector<size_t> first;  // vertex of each mesh
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec3> albedo;
  std::vector<glm::mat3> pose_from_bind;  // rotation of each vertex

  explicit Posed(std::vector<SurfaceMesh> posed) : meshes(std::move(posed)) {
    for (const SurfaceMesh& mesh : meshes) {
      first.push_back(positions.size());
      positions.insert(positions.end(), mesh.positions.begin(), mesh.positions.end());
      normals.insert(normals.end(), mesh.normals.begin(), mesh.normals.end());
      for (uint32_t v = 0; v < mesh.positions.size(); ++v) {
        albedo.push_back(mesh.AlbedoAt(v));
      }
    }
  }
};

// What a ray from a vertex met: the corners of a triangle and their weights.
struct Meeting {
  std::array<uint32_t, 3> corners = {};
  std::array<float, 3> weights = {};
};

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

// Transfer of one key pose, in the pose's own axes until it is turned back.
class PoseBaker {
 public:
  PoseBaker(const Posed& posed, const RayScene& rays, const TransferOptions& options)
      : posed_(posed),
        rays_(rays),
        options_(options),
        result_(posed.positions.size()),
        meetings_(options.bounces > 0 ? posed.positions.size() : 0) {}

  void Run() {
    ForVertices([this](size_t vertex) { GatherDirect(vertex); });
    std::vector<Vector> arriving = result_;
    for (int bounce = 0; bounce < options_.bounces; ++bounce) {
      std::vector<Vector> next(arriving.size());
      ForVertices([&](size_t vertex) { next[vertex] = GatherReflected(vertex, arriving); });
      ForVertices([&](size_t vertex) {
        for (size_t i = 0; i < next[vertex].size(); ++i) {
          result_[vertex][i] += next[vertex][i];
        }
      });
      arriving = std::move(next);
    }
    ForVertices([this](size_t vertex) { TurnToBindPose(vertex); });
  }

  const std::vector<Vector>& result() const { return result_; }

 private:
  template <typename Body>
  void ForVertices(const Body& body) const {
    const size_t jobs = (posed_.positions.size() + kVerticesPerJob - 1) / kVerticesPerJob;
    ParallelFor(jobs, [&](size_t job) {
      const size_t end = std::min((job + 1) * kVerticesPerJob, posed_.positions.size());
      for (size_t vertex = job * kVerticesPerJob; vertex < end; ++vertex) {
        body(vertex);
      }
    });
  }

  // Shadowed direct light, the same for all channels.
  void GatherDirect(size_t vertex) {
    Random random(1, vertex);
    const uint32_t mask_x = random.Next();
    const uint32_t mask_y = random.Next();
    const glm::vec3& normal = posed_.normals[vertex];
    std::array<float, kMaxCount> sum = {};
    std::array<float, kMaxCount> basis;
    const std::span<float> used(basis.data(), static_cast<size_t>(options_.count));
    for (int ray = 0; ray < options_.rays; ++ray) {
      const glm::vec3 direction = AroundNormal(
          normal, CosineDirection(SobolPoint(static_cast<uint32_t>(ray), mask_x, mask_y)));
      if (const auto hit = rays_.Trace(posed_.positions[vertex], direction, kNear)) {
        Keep(vertex, direction, *hit);
        continue;
      }
      light::EvaluateShBasis(direction, used);
      for (size_t i = 0; i < used.size(); ++i) {
        sum[i] += used[i];
      }
    }
    // The directions' density is cosine / pi.
    const float each = std::numbers::pi_v<float> / static_cast<float>(options_.rays);
    for (size_t i = 0; i < used.size(); ++i) {
      for (size_t channel = 0; channel < 3; ++channel) {
        result_[vertex][channel * kMaxCount + i] = each * sum[i];
      }
    }
  }

  // For interreflection; the back of a surface reflects nothing.
  void Keep(size_t vertex, const glm::vec3& direction, const RayHit& hit) {
    if (options_.bounces == 0 || glm::dot(hit.face, direction) > 0.0f) {
      return;
    }
    Meeting meeting;
    const SurfaceMesh& mesh = posed_.meshes[hit.mesh];
    for (size_t corner = 0; corner < 3; ++corner) {
      meeting.corners[corner] =
          static_cast<uint32_t>(posed_.first[hit.mesh] + mesh.indices[3 * hit.triangle + corner]);
      meeting.weights[corner] = hit.barycentric[static_cast<int>(corner)];
    }
    meetings_[vertex].push_back(meeting);
  }

  // What arrives from the surfaces that its rays met, given what arrives there.
  Vector GatherReflected(size_t vertex, const std::vector<Vector>& arriving) const {
    Vector sum = {};
    const auto count = static_cast<size_t>(options_.count);
    for (const Meeting& meeting : meetings_[vertex]) {
      for (size_t corner = 0; corner < 3; ++corner) {
        const uint32_t other = meeting.corners[corner];
        for (size_t channel = 0; channel < 3; ++channel) {
          // Radiance albedo / pi, a density of cosine / pi: pi cancels.
          const float share = meeting.weights[corner] *
                              posed_.albedo[other][static_cast<int>(channel)] /
                              static_cast<float>(options_.rays);
          const float* from = &arriving[other][channel * kMaxCount];
          float* to = &sum[channel * kMaxCount];
          for (size_t i = 0; i < count; ++i) {
            to[i] += share * from[i];
          }
        }
      }
    }
    return sum;
  }

  void TurnToBindPose(size_t vertex) {
    const light::ShRotation turn(glm::transpose(posed_.pose_from_bind[vertex]));
    const auto count = static_cast<size_t>(options_.count);
    std::array<float, kMaxCount> turned = {};
    for (size_t channel = 0; channel < 3; ++channel) {
      const std::span<float> values(&result_[vertex][channel * kMaxCount], count);
      turn.Apply(values, std::span(turned).first(count));
      std::copy_n(turned.begin(), count, values.begin());
    }
  }

  const Posed& posed_;
  const RayScene& rays_;
  const TransferOptions& options_;
  std::vector<Vector> result_;
  std::vector<std::vector<Meeting>> meetings_;
};

// Vectors of one mesh: [key pose][vertex][channel][coefficient].
using MeshVectors = std::vector<float>;

void Append(const Posed& posed,
            const std::vector<Vector>& vectors,
            size_t count,
            std::vector<MeshVectors>& meshes) {
  for (size_t m = 0; m < posed.meshes.size(); ++m) {
    for (size_t v = 0; v < posed.meshes[m].positions.size(); ++v) {
      const Vector& vector = vectors[posed.first[m] + v];
      for (size_t channel = 0; channel < 3; ++channel) {
        const float* from = &vector[channel * kMaxCount];
        meshes[m].insert(meshes[m].end(), from, from + count);
      }
    }
  }
}

// As the file keeps it: without the padding that run time has.
void Quantise(const MeshVectors& vectors,
              const human::LightTransfer& transfer,
              human::LightTransfer::Mesh& mesh) {
  light::Transfer packed =
      light::QuantiseTransfer(vectors, transfer.count, transfer.key_poses.size());
  const auto count = static_cast<size_t>(transfer.count);
  for (size_t begin = 0; begin < packed.values.size(); begin += packed.padded_count()) {
    const auto first = packed.values.begin() + static_cast<ptrdiff_t>(begin);
    mesh.coefficients.insert(mesh.coefficients.end(), first, first + static_cast<ptrdiff_t>(count));
  }
  mesh.scale = std::move(packed.scale);
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
  std::vector<MeshVectors> vectors(human.meshes.size());
  for (size_t k = 0; k < transfer.key_poses.size(); ++k) {
    progress.Report("light transfer",
                    static_cast<double>(k) / static_cast<double>(transfer.key_poses.size()));
    if (progress.Cancelled()) {
      return Status::Error(human.name, "baking was cancelled");
    }
    const std::vector<glm::mat4> skin = human::SkinOfPose(human.skeleton, transfer.key_poses[k]);
    Posed posed(posable.Pose(skin));
    posed.pose_from_bind = VertexRotations(human, skin);
    LARARIUM_ASSIGN_OR_RETURN(const RayScene rays, RaysAt(posed.meshes));
    PoseBaker baker(posed, rays, options);
    baker.Run();
    Append(posed, baker.result(), static_cast<size_t>(options.count), vectors);
  }
  for (size_t m = 0; m < vectors.size(); ++m) {
    Quantise(vectors[m], transfer, transfer.meshes[m]);
  }
  return transfer;
}

}  // namespace lararium::bake
