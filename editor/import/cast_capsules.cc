#include "editor/import/cast_capsules.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>
#include <string>

#include "editor/import/plain_skeleton.h"

namespace lararium::import {
namespace {

// A limb from one joint to another, measured on the vertices that its joint moves most.
struct Limb {
  const char* joint;
  const char* end;
};
constexpr Limb kMiddleLimbs[] = {{"vc7", "skullbase"}};
constexpr Limb kLimbs[] = {{"shoulder", "elbow"}, {"elbow", "wrist"}, {"wrist", "middle2"},
                           {"hip", "knee"},       {"knee", "ankle"},  {"ankle", "midtarsal"}};

// A slice across the trunk: at a share of the way from one joint up to another.
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

constexpr float kSliceHalfHeight = 0.02f;  // metres

class CapsuleMaker {
 public:
  CapsuleMaker(const human::Skeleton& skeleton, const human::SkinnedMesh& skin)
      : skeleton_(skeleton), skin_(skin) {}

  std::vector<human::BodyCapsule> Make() {
    for (const Limb& limb : kMiddleLimbs) {
      AddLimb(limb.joint, limb.end);
    }
    for (const char* side : {"l_", "r_"}) {
      for (const Limb& limb : kLimbs) {
        AddLimb(side + std::string(limb.joint), side + std::string(limb.end));
      }
    }
    for (const Slice& slice : kSlices) {
      AddSlice(slice);
    }
    AddHead();
    return std::move(capsules_);
  }

 private:
  glm::vec3 Place(const std::string& joint) const { return RestPosition(skeleton_, joint); }

  float WeightOf(size_t vertex, size_t joint) const {
    float weight = 0.0f;
    for (int k = 0; k < 4; ++k) {
      weight += skin_.joints[vertex][k] == joint ? skin_.weights[vertex][k] : 0.0f;
    }
    return weight;
  }

  void Add(const std::string& joint,
           const glm::vec3& a,
           const glm::vec3& b,
           float radius_a,
           float radius_b) {
    human::BodyCapsule capsule;
    capsule.joint = static_cast<uint32_t>(JointIndex(skeleton_, joint));
    const glm::vec3 origin = Place(joint);
    capsule.a = a - origin;
    capsule.b = b - origin;
    capsule.radius_a = std::max(radius_a, 0.01f);
    capsule.radius_b = std::max(radius_b, 0.01f);
    capsules_.push_back(capsule);
  }

  // The axis runs through the middle of the flesh at both ends, which is not where the
  // joints are: the shin lies behind its bone.
  void AddLimb(const std::string& joint, const std::string& end) {
    const size_t index = JointIndex(skeleton_, joint);
    const glm::vec3 from = Place(joint);
    const glm::vec3 to = Place(end);
    const End near = MeasureEnd(index, from, to, 0.05f, 0.35f);
    const End far = MeasureEnd(index, from, to, 0.65f, 0.95f);
    Add(joint, from + near.shift, to + far.shift, near.radius, far.radius);
  }

  struct End {
    glm::vec3 shift{0.0f};
    float radius = 0.03f;
  };

  // Of the vertices between two shares of the way from one joint to the next.
  End MeasureEnd(
      size_t joint, const glm::vec3& from, const glm::vec3& to, float first, float last) const {
    const glm::vec3 axis = to - from;
    const float squared = glm::dot(axis, axis);
    std::vector<glm::vec3> across;
    glm::vec3 low(1e9f);
    glm::vec3 high(-1e9f);
    for (size_t v = 0; v < skin_.positions.size(); ++v) {
      const glm::vec3 offset = skin_.positions[v] - from;
      const float share = glm::dot(offset, axis) / squared;
      if (share >= first && share <= last && WeightOf(v, joint) > 0.5f) {
        across.push_back(offset - share * axis);
        low = glm::min(low, across.back());
        high = glm::max(high, across.back());
      }
    }
    End end;
    if (across.empty()) {
      return end;
    }
    end.shift = 0.5f * (low + high);
    float sum = 0.0f;
    for (const glm::vec3& p : across) {
      sum += glm::distance(p, end.shift);
    }
    end.radius = sum / static_cast<float>(across.size());
    return end;
  }

  bool IsOfTrunk(size_t vertex) const {
    float weight = 0.0f;
    for (const char* joint :
         {"sacroiliac", "humanoid_root", "vl5", "vl1", "vt10", "vt4", "vt1", "l_hip", "r_hip"}) {
      weight += WeightOf(vertex, JointIndex(skeleton_, joint));
    }
    return weight > 0.6f;
  }

  void AddSlice(const Slice& slice) {
    const float height = glm::mix(Place(slice.from).y, Place(slice.to).y, slice.share);
    glm::vec3 low(1e9f);
    glm::vec3 high(-1e9f);
    for (size_t v = 0; v < skin_.positions.size(); ++v) {
      const glm::vec3& p = skin_.positions[v];
      if (std::abs(p.y - height) < kSliceHalfHeight && IsOfTrunk(v)) {
        low = glm::min(low, p);
        high = glm::max(high, p);
      }
    }
    if (low.x > high.x) {
      return;
    }
    const glm::vec3 size = high - low;
    const float radius = 0.5f * std::min(size.x, size.z);
    const glm::vec3 middle(0.5f * (low.x + high.x), height, 0.5f * (low.z + high.z));
    const glm::vec3 along = size.x > size.z ? glm::vec3(0.5f * size.x - radius, 0.0f, 0.0f)
                                            : glm::vec3(0.0f, 0.0f, 0.5f * size.z - radius);
    Add(slice.joint, middle - along, middle + along, radius, radius);
  }

  // The skull behind and above the face.
  void AddHead() {
    const size_t joint = JointIndex(skeleton_, "skullbase");
    const float eyes = 0.5f * (Place("l_eyeball_joint").y + Place("r_eyeball_joint").y);
    glm::vec3 low(1e9f);
    glm::vec3 high(-1e9f);
    for (size_t v = 0; v < skin_.positions.size(); ++v) {
      if (skin_.positions[v].y > eyes && WeightOf(v, joint) > 0.5f) {
        low = glm::min(low, skin_.positions[v]);
        high = glm::max(high, skin_.positions[v]);
      }
    }
    if (low.x > high.x) {
      return;
    }
    const float radius = 0.5f * (high.x - low.x);  // ears stand off: half of them counts
    const float y = high.y - radius;
    Add("skullbase", {0.0f, y, low.z + radius}, {0.0f, y, high.z - radius}, radius, radius);
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
