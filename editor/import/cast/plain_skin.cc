#include "editor/import/cast/plain_skin.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>

#include "editor/import/cast/plain_skeleton.h"
#include "shared/core/units.h"

namespace lararium::import {
namespace {

JointShares Mix(const JointShares& a, const JointShares& b, float share_of_b) {
  JointShares mixed;
  for (const auto& [joint, weight] : a) {
    mixed.emplace_back(joint, weight * (1.0f - share_of_b));
  }
  for (const auto& [joint, weight] : b) {
    mixed.emplace_back(joint, weight * share_of_b);
  }
  return mixed;
}

}  // namespace

size_t MirroredJoint(const human::Skeleton& skeleton, size_t joint) {
  const std::string& name = skeleton.names[joint];
  return name.starts_with("r_") ? IndexOfJoint(skeleton, "l_" + name.substr(2)) : joint;
}

// Each joint of a chain takes over from the previous one at the bend between them, so that only
// neighbours share a vertex.
JointShares PlainSkin::ChainShares(const glm::vec3& p, const std::vector<Link>& chain) {
  JointShares weights;
  float remaining = 1.0f;
  for (size_t i = chain.size(); i-- > 1;) {
    const Link& link = chain[i];
    const float share = glm::smoothstep(-link.half_width, link.half_width,
                                        glm::dot(p - link.position, link.direction));
    weights.emplace_back(link.joint, remaining * share);
    remaining *= 1.0f - share;
  }
  weights.emplace_back(chain.front().joint, remaining);
  return weights;
}

PlainSkin::PlainSkin(const human::Skeleton& skeleton) : skeleton_(skeleton) {
  const glm::vec3 up(0.0f, 1.0f, 0.0f), down(0.0f, -1.0f, 0.0f);
  spine_ = {Joint("sacroiliac", up, 0.0f), Joint("vl5", up, 0.06f),  Joint("vt10", up, 0.08f),
            Joint("vt4", up, 0.08f),       Joint("vc4", up, 0.035f), HeadLink()};
  leg_ = {Joint("sacroiliac", down, 0.0f), Joint("r_hip", down, 0.06f),
          Joint("r_knee", down, 0.045f), Joint("r_ankle", {0.0f, -0.8f, -0.6f}, 0.030f),
          Joint("r_midtarsal", {0.0f, 0.0f, -1.0f}, 0.025f)};
  const glm::vec3 upper = Direction("r_shoulder", "r_elbow");
  const glm::vec3 fore = Direction("r_elbow", "r_wrist");
  arm_ = {Joint("r_sternoclavicular", upper, 0.0f), Joint("r_shoulder", upper, 0.05f),
          Joint("r_elbow", glm::normalize(upper + fore), 0.035f), Joint("r_wrist", fore, 0.022f),
          Joint("r_middle1", fore, 0.012f)};
  thumb_ = skeleton.Find("r_thumb1").value();
  for (size_t i = 0; i < 6; ++i) {
    skirt_[i] = IndexOfJoint(skeleton, kSkirtJoints[i]);
  }
}

JointShares PlainSkin::Spine(const glm::vec3& p) const { return ChainShares(p, spine_); }
JointShares PlainSkin::Leg(const glm::vec3& p) const { return ChainShares(p, leg_); }

JointShares PlainSkin::Cloth(const glm::vec3& p) const {
  const JointShares trunk = Mix(Spine(p), Skirt(p), glm::smoothstep(0.94f, 0.80f, p.y));
  const glm::vec3 q = FoldX(p);
  const JointShares sleeve =
      p.x >= 0.0f ? ChainShares(q, arm_) : MirrorJoints(ChainShares(q, arm_));
  // A plane through the armpit, inclined like the space between arm and trunk.
  const float beyond =
      glm::dot(q - glm::vec3(0.172f, 1.36f, 0.0f), glm::vec3(0.985f, 0.174f, 0.0f));
  const float share = glm::smoothstep(-0.055f, 0.035f, beyond) * glm::smoothstep(1.02f, 1.10f, p.y);
  return Mix(trunk, sleeve, share);
}

JointShares PlainSkin::MirrorJoints(JointShares weights) const {
  for (auto& [joint, weight] : weights) {
    joint = MirroredJoint(skeleton_, joint);
  }
  return weights;
}

PlainSkin::Link PlainSkin::Joint(const char* name,
                                 const glm::vec3& direction,
                                 float half_width) const {
  return {IndexOfJoint(skeleton_, name), RestPosition(skeleton_, name), glm::normalize(direction),
          half_width};
}

// The head ends at the inclined edge of the jaw.
PlainSkin::Link PlainSkin::HeadLink() const {
  return {IndexOfJoint(skeleton_, "skullbase"),
          {0.0f, 1.530f, 0.0f},
          glm::normalize(glm::vec3(0.0f, 0.86f, -0.50f)),
          0.030f};
}

glm::vec3 PlainSkin::Direction(const char* from, const char* to) const {
  return glm::normalize(RestPosition(skeleton_, to) - RestPosition(skeleton_, from));
}

// Divides the weight between the two panels on either side of the vertex.
JointShares PlainSkin::Skirt(const glm::vec3& p) const {
  const float around = std::atan2(p.x, -p.z);  // 0 in front, positive to the right
  const float panel = (around < 0.0f ? around + 2.0f * kPiF : around) / (kPiF / 3.0f) - 0.5f;
  const float floor = std::floor(panel);
  const size_t first = static_cast<size_t>(static_cast<int>(floor) + 6) % 6;
  const float share = glm::smoothstep(0.0f, 1.0f, panel - floor);
  return {{skirt_[first], 1.0f - share}, {skirt_[(first + 1) % 6], share}};
}

JointShares PlainSkin::Arm(const glm::vec3& p, const PlainArm& arm) const {
  const JointShares limb = ChainShares(p, arm_);
  const glm::vec3 q = arm.InHand(p);
  // The side of the thumb of a line from its root to the cleft beside the index finger.
  const float thumb_side = q.z - (0.028f + 0.25f * (q.y - 0.02f));
  const float share = glm::smoothstep(-0.004f, 0.012f, thumb_side) *
                      glm::smoothstep(0.005f, 0.035f, q.y) *
                      (1.0f - glm::smoothstep(0.098f, 0.112f, q.y));
  return Mix(limb, {{thumb_, 1.0f}}, share);
}

}  // namespace lararium::import
