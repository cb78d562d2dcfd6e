#include "editor/import/cast/cast_capsules.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <string>

#include "editor/import/cast/joint_lookup.h"

namespace lararium::import {
namespace {

// A limb from one joint to another, measured on the vertices that its joint and the joints in
// `with` move.
struct Limb {
  std::string joint;
  std::string end;
  std::vector<std::string> with;
};

std::vector<Limb> Limbs() {
  std::vector<Limb> limbs = {{"vc7", "skullbase", {"vc4", "vc2"}}};
  for (const std::string side : {"l_", "r_"}) {
    limbs.push_back(
        {side + "sternoclavicular", side + "shoulder", {"vt1", side + "acromioclavicular"}});
    limbs.push_back({side + "shoulder", side + "elbow", {}});
    limbs.push_back({side + "elbow", side + "wrist", {}});
    limbs.push_back({side + "wrist",
                     side + "middle3",
                     {side + "index0", side + "middle0", side + "ring0", side + "pinky0",
                      side + "middle1", side + "ring1", side + "middle2", side + "ring2"}});
    limbs.push_back({side + "hip", side + "knee", {}});
    limbs.push_back({side + "knee", side + "ankle", {}});
    limbs.push_back({side + "ankle", side + "midtarsal", {}});
  }
  return limbs;
}

// A slice across the trunk, at a share of the distance from one joint up to another.
struct Slice {
  const char* joint;
  const char* from;
  const char* to;
  float share;
};
constexpr Slice kSlices[] = {
    {"sacroiliac", "l_hip", "vl5", 0.0f}, {"sacroiliac", "l_hip", "vl5", 1.0f},
    {"vl1", "vl1", "vt10", 0.3f},         {"vt10", "vt10", "vt4", 0.1f},
    {"vt10", "vt10", "vt4", 0.7f},        {"vt4", "vt4", "vt1", 0.4f},
    {"vt1", "vt4", "vt1", 0.95f},
};

constexpr const char* kTrunkJoints[] = {"sacroiliac", "humanoid_root", "vl5",   "vl1",  "vt10",
                                        "vt4",        "vt1",           "l_hip", "r_hip"};
constexpr float kSliceHalfHeight = 0.02f;  // metres
constexpr float kMostSliceRadius = 0.10f;  // metres

struct Box {
  glm::vec3 low{1e9f};
  glm::vec3 high{-1e9f};

  void Add(const glm::vec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  bool empty() const { return low.x > high.x; }
};

class CapsuleMaker {
 public:
  CapsuleMaker(const human::Skeleton& skeleton, const human::SkinnedMesh& skin)
      : skeleton_(skeleton), skin_(skin) {}

  std::vector<human::BodyCapsule> Make() {
    for (const Limb& limb : Limbs()) {
      AddLimb(limb);
    }
    for (const Slice& slice : kSlices) {
      AddSlice(slice);
    }
    AddHead();
    return std::move(capsules_);
  }

 private:
  glm::vec3 Place(const std::string& joint) const { return RestPosition(skeleton_, joint); }

  float WeightOf(size_t vertex, std::span<const size_t> joints) const {
    float weight = 0.0f;
    for (int k = 0; k < 4; ++k) {
      if (std::find(joints.begin(), joints.end(), skin_.joints[vertex][k]) != joints.end()) {
        weight += skin_.weights[vertex][k];
      }
    }
    return weight;
  }

  void Add(const std::string& joint,
           const glm::vec3& a,
           const glm::vec3& b,
           float radius_a,
           float radius_b) {
    human::BodyCapsule capsule;
    capsule.joint = static_cast<uint32_t>(IndexOfJoint(skeleton_, joint));
    const glm::vec3 origin = Place(joint);
    capsule.a = a - origin;
    capsule.b = b - origin;
    capsule.radius_a = std::max(radius_a, 0.01f);
    capsule.radius_b = std::max(radius_b, 0.01f);
    capsules_.push_back(capsule);
  }

  // The axis is the middle of the flesh at both ends. That is not the line between the joints:
  // the calf is behind its bone.
  void AddLimb(const Limb& limb) {
    std::vector<size_t> joints = {IndexOfJoint(skeleton_, limb.joint)};
    for (const std::string& name : limb.with) {
      joints.push_back(IndexOfJoint(skeleton_, name));
    }
    const glm::vec3 from = Place(limb.joint);
    const glm::vec3 to = Place(limb.end);
    const End near = MeasureEnd(joints, from, to, 0.05f, 0.35f);
    const End far = MeasureEnd(joints, from, to, 0.65f, 0.95f);
    Add(limb.joint, from + near.shift, to + far.shift, near.radius, far.radius);
  }

  struct End {
    glm::vec3 shift{0.0f};
    float radius = 0.03f;
  };

  // Measures the vertices between two shares of the distance from one joint to the next.
  End MeasureEnd(std::span<const size_t> joints,
                 const glm::vec3& from,
                 const glm::vec3& to,
                 float first,
                 float last) const {
    const glm::vec3 axis = to - from;
    const float squared = glm::dot(axis, axis);
    std::vector<glm::vec3> across;
    Box box;
    for (size_t v = 0; v < skin_.positions.size(); ++v) {
      const glm::vec3 offset = skin_.positions[v] - from;
      const float share = glm::dot(offset, axis) / squared;
      if (share >= first && share <= last && WeightOf(v, joints) > 0.5f) {
        across.push_back(offset - share * axis);
        box.Add(across.back());
      }
    }
    End end;
    if (across.empty()) {
      return end;
    }
    end.shift = 0.5f * (box.low + box.high);
    float sum = 0.0f;
    for (const glm::vec3& p : across) {
      sum += glm::distance(p, end.shift);
    }
    end.radius = sum / static_cast<float>(across.size());
    return end;
  }

  bool IsOfTrunk(size_t vertex) const {
    std::vector<size_t> joints;
    for (const char* joint : kTrunkJoints) {
      joints.push_back(IndexOfJoint(skeleton_, joint));
    }
    return WeightOf(vertex, joints) > 0.6f;
  }

  void AddSlice(const Slice& slice) {
    const float height = glm::mix(Place(slice.from).y, Place(slice.to).y, slice.share);
    Box box;
    for (size_t v = 0; v < skin_.positions.size(); ++v) {
      if (std::abs(skin_.positions[v].y - height) < kSliceHalfHeight && IsOfTrunk(v)) {
        box.Add(skin_.positions[v]);
      }
    }
    if (box.empty()) {
      return;
    }
    // Thick capsules bulge up and down, so a stout trunk gets one in front and one behind.
    const glm::vec3 size = box.high - box.low;
    const float radius = std::min(0.5f * std::min(size.x, size.z), kMostSliceRadius);
    const glm::vec3 along(0.5f * size.x - radius, 0.0f, 0.0f);
    const float x = 0.5f * (box.low.x + box.high.x);
    const auto add_at = [&](float z) {
      const glm::vec3 middle(x, height, z);
      Add(slice.joint, middle - along, middle + along, radius, radius);
    };
    if (size.z < 2.0f * radius + 0.02f) {
      add_at(0.5f * (box.low.z + box.high.z));
      return;
    }
    add_at(box.low.z + radius);
    add_at(box.high.z - radius);
  }

  // The skull above the eyes, and the face from the eyes down to the chin.
  void AddHead() {
    const size_t skull[] = {IndexOfJoint(skeleton_, "skullbase")};
    const size_t jaw[] = {IndexOfJoint(skeleton_, "temporomandibular")};
    const float eyes = 0.5f * (Place("l_eyeball_joint").y + Place("r_eyeball_joint").y);
    Box cranium;
    Box chin;
    for (size_t v = 0; v < skin_.positions.size(); ++v) {
      if (skin_.positions[v].y > eyes && WeightOf(v, skull) > 0.5f) {
        cranium.Add(skin_.positions[v]);
      } else if (WeightOf(v, jaw) > 0.5f) {
        chin.Add(skin_.positions[v]);
      }
    }
    if (cranium.empty() || chin.empty()) {
      return;
    }
    const float radius = 0.5f * (cranium.high.x - cranium.low.x);
    const float y = cranium.high.y - radius;
    Add("skullbase", {0.0f, y, cranium.low.z + radius}, {0.0f, y, cranium.high.z - radius}, radius,
        radius);
    const float face = 0.7f * radius;
    Add("skullbase", {0.0f, eyes, cranium.low.z + face},
        {0.0f, chin.low.y + 0.6f * face, chin.low.z + 0.6f * face}, face, 0.6f * face);
  }

  const human::Skeleton& skeleton_;
  const human::SkinnedMesh& skin_;
  std::vector<human::BodyCapsule> capsules_;
};

}  // namespace

std::vector<human::BodyCapsule> MeasureCapsules(const human::Skeleton& skeleton,
                                                const human::SkinnedMesh& skin) {
  return CapsuleMaker(skeleton, skin).Make();
}

}  // namespace lararium::import
