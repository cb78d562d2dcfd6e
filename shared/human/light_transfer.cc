#include "shared/human/light_transfer.h"

#include <algorithm>
#include <cmath>

#include "shared/human/finite.h"
#include "shared/human/human.h"

namespace lararium::human {
namespace {

bool IsCount(int count) { return count == 9 || count == 16 || count == 25 || count == 36; }

Status ValidateMesh(const LightTransfer& transfer,
                    const LightTransfer::Mesh& mesh,
                    size_t vertices,
                    const std::string& at) {
  const size_t vectors = transfer.key_poses.size() * vertices;
  if (mesh.receivers.size() != vertices || mesh.weights.size() != vertices ||
      mesh.scale.size() != vectors || (!mesh.backs.empty() && mesh.backs.size() != vertices) ||
      mesh.coefficients.size() != vectors * 3 * static_cast<size_t>(transfer.count)) {
    return Status::Error(at, "its light transfer does not fit its vertices");
  }
  for (size_t v = 0; v < vertices; ++v) {
    int sum = 0;
    for (size_t i = 0; i < 4; ++i) {
      sum += mesh.weights[v][i];
      if (mesh.receivers[v][i] >= transfer.receivers.size()) {
        return Status::Error(at, "a vertex names a light receiver that does not exist");
      }
    }
    if (sum != 255 || !std::is_sorted(mesh.weights[v].rbegin(), mesh.weights[v].rend())) {
      return Status::Error(at, "a vertex has invalid weights for its light receivers");
    }
  }
  const bool possible = std::all_of(mesh.scale.begin(), mesh.scale.end(), [](float scale) {
    return std::isfinite(scale) && scale >= 0.0f;
  });
  return possible ? Status() : Status::Error(at, "its light transfer has an invalid scale");
}

Status ValidateParts(const LightTransfer& transfer, size_t joint_count, const std::string& at) {
  for (const std::vector<JointTransform>& pose : transfer.key_poses) {
    if (pose.size() != joint_count || !std::all_of(pose.begin(), pose.end(), Valid)) {
      return Status::Error(at, "a key pose does not fit the skeleton");
    }
  }
  for (const LightTransfer::Blocker& blocker : transfer.blockers) {
    if (blocker.joint >= joint_count || !Finite(blocker.centre) || !std::isfinite(blocker.radius) ||
        blocker.radius < 0.0f) {
      return Status::Error(at, "a blocker has no joint or an invalid size");
    }
  }
  for (const LightTransfer::Receiver& receiver : transfer.receivers) {
    if (receiver.joint >= joint_count || !Finite(receiver.position)) {
      return Status::Error(at, "a receiver has no joint or an invalid position");
    }
  }
  return Status();
}

}  // namespace

Status LightTransfer::Validate(const std::vector<Surface>& surfaces,
                               size_t joint_count,
                               const std::string& where) const {
  if (empty()) {
    return Status();
  }
  const std::string at = where + ": light transfer";
  if (!IsCount(count) || bounces < 0 || key_poses.empty() || key_poses.size() > kMaxKeyPoses ||
      blockers.size() > kMaxBlockers || receivers.empty() || receivers.size() > kMaxReceivers ||
      meshes.size() != surfaces.size()) {
    return Status::Error(at, "its counts are not valid");
  }
  LARARIUM_RETURN_IF_ERROR(ValidateParts(*this, joint_count, at));
  for (size_t i = 0; i < meshes.size(); ++i) {
    LARARIUM_RETURN_IF_ERROR(ValidateMesh(*this, meshes[i], surfaces[i].vertices,
                                          where + ": part '" + surfaces[i].name + "'"));
  }
  return Status();
}

Status LightTransfer::Validate(const std::vector<SkinnedMesh>& skinned,
                               size_t joint_count,
                               const std::string& where) const {
  std::vector<Surface> surfaces;
  for (const SkinnedMesh& mesh : skinned) {
    surfaces.push_back({mesh.name, mesh.positions.size()});
  }
  return Validate(surfaces, joint_count, where);
}

}  // namespace lararium::human
