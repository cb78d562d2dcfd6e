#include "editor/bake/prop_transfer.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <utility>
#include <vector>

#include "editor/bake/posed_surface.h"
#include "editor/bake/receivers.h"
#include "editor/bake/refine.h"
#include "editor/bake/transfer_packer.h"
#include "editor/bake/transfer_solver.h"
#include "shared/stage/object.h"

namespace lararium::bake {
namespace {

using stage::ObjectModel;
using stage::Pose;

// A vertex is buried if at least this share of its rays hits the inside of an object. It is not
// visible, but its value would be interpolated over the triangles around it.
constexpr float kBuried = 0.5f;
constexpr int kSpreading = 8;  // passes

// State of the prop at a key pose.
struct KeyPose {
  std::vector<Pose> object_from_part;
  uint32_t shown = 0;  // bit i: part i
};

// For each mesh in the list of all meshes, its part.
std::vector<uint32_t> PartsOfMeshes(const stage::Prop& prop) {
  std::vector<uint32_t> parts;
  for (uint32_t part = 0; part < prop.parts.size(); ++part) {
    parts.insert(parts.end(), prop.parts[part].meshes.size(), part);
  }
  return parts;
}

KeyPose PoseOf(const ObjectModel& model, const stage::ObjectState& state) {
  const size_t count = model.prop().parts.size();
  std::vector<glm::mat4> object_from_part(count);
  std::vector<uint8_t> shown(count);
  stage::ComputeParts(model, state, {}, object_from_part, shown);
  KeyPose pose;
  for (size_t part = 0; part < count; ++part) {
    pose.object_from_part.push_back(
        stage::ObjectFromPart(model, state.joints, static_cast<int>(part)));
    pose.shown |= static_cast<uint32_t>(shown[part]) << part;
  }
  return pose;
}

std::vector<KeyPose> FindKeyPoses(const ObjectModel& model) {
  stage::ObjectState rest;
  const std::vector<stage::ObjectJoint>& joints = model.use().joints;
  for (size_t i = 0; i < joints.size(); ++i) {
    rest.joints[i] = joints[i].rest;
  }
  std::vector<KeyPose> poses;
  const auto add = [&](const KeyPose& pose) {
    if (poses.size() < human::LightTransfer::kMaxKeyPoses) {
      poses.push_back(pose);
    }
  };
  for (size_t i = 0; i < model.use().states.size(); ++i) {
    stage::ObjectState state = rest;
    state.state = static_cast<int>(i);
    const KeyPose pose = PoseOf(model, state);
    if (std::none_of(poses.begin(), poses.end(),
                     [&](const KeyPose& other) { return other.shown == pose.shown; })) {
      add(pose);
    }
  }
  for (size_t i = 0; i < joints.size(); ++i) {
    stage::ObjectState state = rest;
    const bool to_upper = joints[i].upper - joints[i].rest > joints[i].rest - joints[i].lower;
    state.joints[i] = to_upper ? joints[i].upper : joints[i].lower;
    add(PoseOf(model, state));
  }
  return poses;
}

class PropBaker {
 public:
  PropBaker(const stage::Prop& prop,
            std::vector<SurfaceMesh> surfaces,
            const PropTransferOptions& options)
      : options_(options), parts_(PartsOfMeshes(prop)), surfaces_(std::move(surfaces)) {
    for (const stage::PropPart& part : prop.parts) {
      for (const stage::PropMesh& mesh : part.meshes) {
        // A flame blocks no light.
        solid_.push_back(mesh.emission == glm::vec3(0.0f));
      }
    }
  }

  Status Add(const KeyPose& pose) {
    std::vector<SurfaceMesh> placed;
    for (size_t m = 0; m < surfaces_.size(); ++m) {
      placed.push_back(Moved(stage::ToMatrix(pose.object_from_part[parts_[m]]), surfaces_[m]));
    }
    std::vector<SurfaceMesh> there = placed;
    for (size_t m = 0; m < there.size(); ++m) {
      if ((pose.shown >> parts_[m] & 1u) == 0 || !solid_[m]) {
        there[m].indices.clear();
      }
    }
    TransferSites sites(std::move(placed));
    Result<RayScene> rays = RaysAt(there);
    LARARIUM_RETURN_IF_ERROR(rays.status());
    SolvedTransfer solved =
        SolveTransfer(sites, *rays, {options_.count, options_.rays, options_.bounces});
    SpreadOverBuried(sites, solved);
    for (size_t m = 0; m < surfaces_.size(); ++m) {
      const glm::mat3 part_from_object =
          glm::mat3_cast(glm::conjugate(pose.object_from_part[parts_[m]].rotation));
      for (size_t v = 0; v < surfaces_[m].positions.size(); ++v) {
        TurnTransfer(part_from_object, options_.count, solved.vectors[sites.first[m] + v]);
      }
    }
    shown_.push_back(pose.shown);
    sites_.push_back(std::move(sites));
    solved_.push_back(std::move(solved));
    return Status();
  }

  void Pack(std::vector<human::LightTransfer::Mesh>& meshes) {
    for (size_t m = 0; m < surfaces_.size(); ++m) {
      CopyWhereHidden(m);
    }
    TransferPacker packer(options_.count);
    for (size_t k = 0; k < solved_.size(); ++k) {
      packer.AddKeyPose(sites_[k], solved_[k]);
    }
    packer.Pack(meshes);
  }

 private:
  // Gives buried vertices the mean of their neighbours that are not buried.
  void SpreadOverBuried(const TransferSites& sites, SolvedTransfer& solved) const {
    for (size_t m = 0; m < surfaces_.size(); ++m) {
      const size_t count = surfaces_[m].positions.size();
      for (const size_t first : {sites.first[m], sites.first_back[m]}) {
        if (first != TransferSites::kNone) {
          std::vector<bool> buried;
          for (size_t v = 0; v < count; ++v) {
            buried.push_back(solved.inside[first + v] >= kBuried);
          }
          SpreadTransfer(surfaces_[m].indices, kSpreading, std::move(buried),
                         std::span(solved.vectors).subspan(first, count));
        }
      }
    }
  }

  // A mesh that is hidden at a key pose takes the light of the first pose that shows it.
  void CopyWhereHidden(size_t mesh) {
    const auto is_there = [&](uint32_t shown) { return (shown >> parts_[mesh] & 1u) != 0; };
    const auto found = std::find_if(shown_.begin(), shown_.end(), is_there);
    if (found == shown_.end()) {
      return;
    }
    const auto from = static_cast<size_t>(found - shown_.begin());
    const size_t count = surfaces_[mesh].positions.size();
    for (size_t k = 0; k < shown_.size(); ++k) {
      if (is_there(shown_[k])) {
        continue;
      }
      for (const size_t first : {sites_[k].first[mesh], sites_[k].first_back[mesh]}) {
        if (first != TransferSites::kNone) {
          std::copy_n(solved_[from].vectors.begin() + static_cast<ptrdiff_t>(first), count,
                      solved_[k].vectors.begin() + static_cast<ptrdiff_t>(first));
        }
      }
    }
  }

  const PropTransferOptions& options_;
  std::vector<uint32_t> parts_;  // Indexed by mesh.
  std::vector<bool> solid_;      // Indexed by mesh.
  std::vector<SurfaceMesh> surfaces_;
  std::vector<uint32_t> shown_;  // Indexed by key pose.
  std::vector<TransferSites> sites_;
  std::vector<SolvedTransfer> solved_;
};

double AreaOf(std::span<const SurfaceMesh> surfaces) {
  double area = 0.0;
  for (const SurfaceMesh& surface : surfaces) {
    for (size_t t = 0; t + 2 < surface.indices.size(); t += 3) {
      const glm::vec3& a = surface.positions[surface.indices[t]];
      const glm::vec3 ab = surface.positions[surface.indices[t + 1]] - a;
      const glm::vec3 ac = surface.positions[surface.indices[t + 2]] - a;
      area += 0.5 * double{glm::length(glm::cross(ab, ac))};
    }
  }
  return area;
}

}  // namespace

Result<stage::Prop> BakePropTransfer(const ObjectModel& model, const PropTransferOptions& options) {
  stage::Prop prop = model.prop();
  for (stage::PropPart& part : prop.parts) {
    for (stage::PropMesh& mesh : part.meshes) {
      RefineMesh(options.longest_edge, options.most_vertices, mesh);
    }
  }
  prop.light = {};
  prop.light_shown.clear();
  LARARIUM_ASSIGN_OR_RETURN(std::vector<SurfaceMesh> surfaces, SurfacesOf(prop));
  const double area = AreaOf(surfaces);
  if (area <= 0.0) {
    return prop;  // The prop has no surface.
  }
  prop.light.count = options.count;
  prop.light.bounces = options.bounces;
  const std::vector<KeyPose> poses = FindKeyPoses(model);
  std::vector<SurfaceMesh> at_rest;
  const std::vector<uint32_t> parts = PartsOfMeshes(prop);
  for (size_t m = 0; m < surfaces.size(); ++m) {
    at_rest.push_back(
        Moved(stage::ToMatrix(poses.front().object_from_part[parts[m]]), surfaces[m]));
  }
  const auto wanted = static_cast<size_t>(std::ceil(area / double{options.receiver_area}));
  PlacePropReceivers(at_rest, parts,
                     std::clamp(wanted, 2 * prop.parts.size(),
                                std::max(options.most_receivers, 2 * prop.parts.size())),
                     prop.light);
  for (human::LightTransfer::Receiver& receiver : prop.light.receivers) {
    receiver.position =
        poses.front().object_from_part[receiver.joint].Inverse() * receiver.position;
  }
  PropBaker baker(prop, std::move(surfaces), options);
  for (const KeyPose& pose : poses) {
    LARARIUM_RETURN_IF_ERROR(baker.Add(pose));
    std::vector<human::JointTransform>& joints = prop.light.key_poses.emplace_back();
    for (const Pose& part : pose.object_from_part) {
      joints.push_back({part.rotation, part.position});
    }
    prop.light_shown.push_back(pose.shown);
  }
  baker.Pack(prop.light.meshes);
  return prop;
}

}  // namespace lararium::bake
