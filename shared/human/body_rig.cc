#include "shared/human/body_rig.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <string>

namespace lararium::human {
namespace {

JointFrame Below(const JointFrame& parent, const JointTransform& joint) {
  return {parent.rotation * joint.rotation, parent * joint.translation, parent.scale * joint.scale};
}

JointIndex FindJoint(const Skeleton& skeleton, const std::string& name) {
  const auto found = skeleton.Find(name);
  return found.has_value() ? static_cast<JointIndex>(*found) : kNoJoint;
}

JointIndex FindJoint(const Skeleton& skeleton, int side, const std::string& name) {
  return FindJoint(skeleton, (side == kRight ? "r_" : "l_") + name);
}

JointIndex Parent(const Skeleton& skeleton, JointIndex joint) {
  return skeleton.parents[static_cast<size_t>(joint)];
}

// The joints from `joint` up to `ancestor` (excluded), in the order from ancestor to joint. Empty
// if `ancestor` is not an ancestor.
std::vector<JointIndex> Chain(const Skeleton& skeleton, JointIndex ancestor, JointIndex joint) {
  std::vector<JointIndex> chain;
  for (; joint != ancestor; joint = Parent(skeleton, joint)) {
    if (joint == kNoJoint) {
      return {};
    }
    chain.insert(chain.begin(), joint);
  }
  return chain;
}

bool IsBelow(const Skeleton& skeleton, JointIndex ancestor, JointIndex joint) {
  while (joint != kNoJoint && joint != ancestor) {
    joint = Parent(skeleton, joint);
  }
  return joint == ancestor;
}

std::vector<JointIndex> Children(const Skeleton& skeleton, JointIndex parent) {
  std::vector<JointIndex> children;
  for (size_t i = 0; i < skeleton.size(); ++i) {
    if (skeleton.parents[i] == parent) {
      children.push_back(static_cast<JointIndex>(i));
    }
  }
  return children;
}

class BodyFinder {
 public:
  explicit BodyFinder(const Skeleton& skeleton) : skeleton_(skeleton) {
    body_.rest.resize(skeleton.size());
    for (size_t i = 0; i < skeleton.size(); ++i) {
      const int16_t parent = skeleton.parents[i];
      const JointFrame above = parent == Skeleton::kNoParent ? JointFrame() : Rest(parent);
      body_.rest[i] = Below(above, skeleton.rest[i]);
    }
  }

  BodyRig Find() {
    for (const int side : {kRight, kLeft}) {
      FindArm(side);
      FindLeg(side);
      FindFingers(side);
      body_.eyes[static_cast<size_t>(side)] = FindJoint(skeleton_, side, "eyeball_joint");
    }
    FindTrunk();
    MeasureHips();
    return std::move(body_);
  }

 private:
  const JointFrame& Rest(JointIndex joint) const { return body_.rest[static_cast<size_t>(joint)]; }
  float RestDistance(JointIndex a, JointIndex b) const {
    return glm::distance(Rest(a).position, Rest(b).position);
  }

  void FindArm(int side) {
    BodyRig::Arm& arm = body_.arms[static_cast<size_t>(side)];
    arm.clavicle = FindJoint(skeleton_, side, "sternoclavicular");
    if (arm.clavicle == kNoJoint) {
      arm.clavicle = FindJoint(skeleton_, side, "acromioclavicular");
    }
    arm.shoulder = FindJoint(skeleton_, side, "shoulder");
    arm.elbow = FindJoint(skeleton_, side, "elbow");
    arm.wrist = FindJoint(skeleton_, side, "wrist");
    if (arm.whole() && IsBelow(skeleton_, arm.shoulder, arm.elbow) &&
        IsBelow(skeleton_, arm.elbow, arm.wrist)) {
      arm.upper_length = RestDistance(arm.shoulder, arm.elbow);
      arm.lower_length = RestDistance(arm.elbow, arm.wrist);
      arm.forearm_twist = Chain(skeleton_, arm.elbow, arm.wrist);
      arm.forearm_twist.pop_back();  // Removes the wrist.
    }
    if (arm.upper_length < 1e-3f || arm.lower_length < 1e-3f) {
      arm.elbow = kNoJoint;  // The arm is incomplete.
    }
    if (arm.clavicle != kNoJoint && !IsBelow(skeleton_, arm.clavicle, arm.shoulder)) {
      arm.clavicle = kNoJoint;
    }
  }

  void FindLeg(int side) {
    BodyRig::Leg& leg = body_.legs[static_cast<size_t>(side)];
    leg.hip = FindJoint(skeleton_, side, "hip");
    leg.knee = FindJoint(skeleton_, side, "knee");
    leg.ankle = FindJoint(skeleton_, side, "ankle");
    if (leg.whole() && IsBelow(skeleton_, leg.hip, leg.knee) &&
        IsBelow(skeleton_, leg.knee, leg.ankle)) {
      leg.upper_length = RestDistance(leg.hip, leg.knee);
      leg.lower_length = RestDistance(leg.knee, leg.ankle);
    }
    if (leg.upper_length < 1e-3f || leg.lower_length < 1e-3f) {
      leg.knee = kNoJoint;  // The leg is incomplete.
      return;
    }
    FindToes(side, leg);
    MeasureFoot(leg);
  }

  // Finds one joint at the ball of the foot, or the joints of all toes.
  void FindToes(int side, BodyRig::Leg& leg) const {
    const JointIndex middle = FindJoint(skeleton_, side, "midtarsal");
    if (middle == kNoJoint || !IsBelow(skeleton_, leg.ankle, middle)) {
      leg.toes = Children(skeleton_, leg.ankle);
      return;
    }
    leg.toes = Children(skeleton_, middle);
    if (leg.toes.size() < 2) {
      leg.toes = {middle};
    }
  }

  // The heel is behind the ankle by 0.28 of the distance from ankle to ball. We chose the value
  // from real feet and from the characters that we had.
  void MeasureFoot(BodyRig::Leg& leg) const {
    const glm::vec3 ankle = Rest(leg.ankle).position;
    glm::vec3 ball(0.0f);
    for (const JointIndex toe : leg.toes) {
      ball += Rest(toe).position / static_cast<float>(leg.toes.size());
    }
    glm::vec3 forward = ball - ankle;
    forward.y = 0.0f;
    if (leg.toes.empty() || glm::length(forward) < 0.01f) {
      leg.toes.clear();
      forward = glm::vec3(0.0f, 0.0f, -0.3f * leg.lower_length);
    }
    const float length = glm::length(forward);
    leg.ankle_height = ankle.y;
    leg.ball = glm::vec3(0.0f, leg.toes.empty() ? 0.0f : ball.y, -length);
    leg.heel = glm::vec3(0.0f, 0.0f, 0.28f * length);
    leg.toe_out = std::atan2(-forward.x, -forward.z);
  }

  void FindFingers(int side) {
    constexpr const char* kNames[BodyRig::kFingers] = {"thumb", "index", "middle", "ring", "pinky"};
    for (int finger = 0; finger < BodyRig::kFingers; ++finger) {
      auto& joints = body_.fingers[static_cast<size_t>(side)][static_cast<size_t>(finger)].joints;
      for (size_t i = 0; i < joints.size(); ++i) {
        joints[i] = FindJoint(skeleton_, side, kNames[finger] + std::to_string(i + 1));
      }
    }
  }

  void FindTrunk() {
    body_.head = FindJoint(skeleton_, "skullbase");
    body_.jaw = FindJoint(skeleton_, "temporomandibular");
    body_.root = FindJoint(skeleton_, "humanoid_root");
    if (body_.root == kNoJoint) {
      body_.root = FindJoint(skeleton_, "sacroiliac");
    }
    if (body_.root == kNoJoint) {
      return;
    }
    const JointIndex top = body_.head != kNoJoint ? body_.head : ArmRoot();
    if (top == kNoJoint) {
      return;
    }
    const std::vector<JointIndex> chain = Chain(skeleton_, body_.root, top);
    const JointIndex arm = ArmRoot();
    // The chest is the highest joint of the chain that bears the arms.
    auto chest =
        arm == kNoJoint ? chain.begin() + static_cast<long>(chain.size() / 2) : chain.begin();
    for (auto joint = chain.begin(); joint != chain.end(); ++joint) {
      if (arm != kNoJoint && IsBelow(skeleton_, *joint, arm)) {
        chest = joint + 1;
      }
    }
    body_.spine.assign(chain.begin(), chest);
    body_.neck.assign(chest, chain.end());
  }

  JointIndex ArmRoot() const {
    for (const BodyRig::Arm& arm : body_.arms) {
      if (arm.clavicle != kNoJoint || arm.shoulder != kNoJoint) {
        return arm.clavicle != kNoJoint ? arm.clavicle : arm.shoulder;
      }
    }
    return kNoJoint;
  }

  void MeasureHips() {
    const BodyRig::Leg& right = body_.legs[kRight];
    const BodyRig::Leg& left = body_.legs[kLeft];
    if (!right.whole() || !left.whole()) {
      return;
    }
    const bool hangs = body_.root != kNoJoint && IsBelow(skeleton_, body_.root, right.hip) &&
                       IsBelow(skeleton_, body_.root, left.hip);
    const float height = 0.5f * (Rest(right.hip).position.y + Rest(left.hip).position.y);
    if (!hangs || !(height > 0.0f)) {
      body_.root = kNoJoint;  // No pelvis bears the legs above the ground: the body cannot walk.
      return;
    }
    body_.hip_height = height;
    body_.hip_width = RestDistance(right.hip, left.hip);
  }

  const Skeleton& skeleton_;
  BodyRig body_;
};

}  // namespace

JointFrame ActorFromJoint(const Skeleton& skeleton,
                          std::span<const JointTransform> pose,
                          JointIndex joint) {
  JointFrame frame;
  for (; joint != kNoJoint; joint = skeleton.parents[static_cast<size_t>(joint)]) {
    const JointTransform& step = pose[static_cast<size_t>(joint)];
    frame.position = step.translation + step.rotation * (step.scale * frame.position);
    frame.rotation = step.rotation * frame.rotation;
    frame.scale *= step.scale;
  }
  return frame;
}

void SetActorRotation(const Skeleton& skeleton,
                      JointIndex joint,
                      const glm::quat& actor_from_joint,
                      std::span<JointTransform> pose) {
  const JointIndex parent = skeleton.parents[static_cast<size_t>(joint)];
  const glm::quat above = ActorFromJoint(skeleton, pose, parent).rotation;
  pose[static_cast<size_t>(joint)].rotation =
      glm::normalize(glm::conjugate(above) * actor_from_joint);
}

void SetActorPosition(const Skeleton& skeleton,
                      JointIndex joint,
                      const glm::vec3& position,
                      std::span<JointTransform> pose) {
  const JointIndex parent = skeleton.parents[static_cast<size_t>(joint)];
  const JointFrame above = ActorFromJoint(skeleton, pose, parent);
  pose[static_cast<size_t>(joint)].translation =
      (glm::conjugate(above.rotation) * (position - above.position)) / above.scale;
}

void TurnInActor(const Skeleton& skeleton,
                 JointIndex joint,
                 const glm::quat& turn,
                 std::span<JointTransform> pose) {
  const JointIndex parent = skeleton.parents[static_cast<size_t>(joint)];
  const glm::quat above = ActorFromJoint(skeleton, pose, parent).rotation;
  glm::quat& rotation = pose[static_cast<size_t>(joint)].rotation;
  rotation = glm::normalize(glm::conjugate(above) * turn * above * rotation);
}

BodyRig MakeBodyRig(const Skeleton& skeleton) { return BodyFinder(skeleton).Find(); }

}  // namespace lararium::human
