#include "shared/human/reach.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "shared/human/palm.h"
#include "shared/human/turns.h"
#include "shared/human/two_bone_ik.h"

namespace lararium::human {
namespace {

constexpr glm::vec3 kUp(0.0f, 1.0f, 0.0f);

// Moves one hand to a goal.
class Reacher {
 public:
  Reacher(const ReachModel& model,
          const Skeleton& skeleton,
          int side,
          std::span<JointTransform> pose)
      : body_(model.body),
        arm_(body_.arms[static_cast<size_t>(side)]),
        wrist_from_grip_(model.wrist_from_grip[static_cast<size_t>(side)]),
        skeleton_(skeleton),
        side_(side),
        pose_(pose) {}

  float Length() const { return arm_.upper_length + arm_.lower_length; }
  glm::vec3 Position(JointIndex joint) const {
    return ActorFromJoint(skeleton_, pose_, joint).position;
  }

  GripFrame ActorFromWrist(const GripFrame& actor_from_grip) const {
    const glm::quat rotation = actor_from_grip.rotation * glm::conjugate(wrist_from_grip_.rotation);
    const glm::vec3 scale = ActorFromJoint(skeleton_, pose_, arm_.wrist).scale;
    return {actor_from_grip.position - rotation * (scale * wrist_from_grip_.position), rotation};
  }

  GripFrame ActorFromPalm() const {
    const JointFrame wrist = ActorFromJoint(skeleton_, pose_, arm_.wrist);
    return {wrist * wrist_from_grip_.position, wrist.rotation * wrist_from_grip_.rotation};
  }

  // Vector from the shoulder to the wrist on its way to a goal.
  glm::vec3 Way(const ReachGoal& goal) const {
    const GripFrame palm = Mix(ActorFromPalm(), goal.actor_from_grip, goal.weight);
    return ActorFromWrist(palm).position - Position(arm_.shoulder);
  }

  void Bring(const ReachGoal& goal) {
    const GripFrame from = ActorFromPalm();
    GripFrame palm = Mix(from, goal.actor_from_grip, goal.weight);
    // The path is a slight arc around the body.
    const float way = glm::distance(from.position, goal.actor_from_grip.position);
    palm.position.z -= 0.12f * way * std::sin(kPiF * goal.weight);
    const GripFrame wrist = ActorFromWrist(palm);
    const glm::vec3 elbow_way = ElbowWay();
    RaiseShoulder(wrist.position, goal.weight);
    TwoBoneIk ik;
    ik.upper = arm_.shoulder;
    ik.lower = arm_.elbow;
    ik.end = arm_.wrist;
    ik.target = wrist.position;
    ik.pole = glm::mix(elbow_way, NaturalElbow(wrist.position), goal.weight);
    ik.hinge = RestHinge();
    ik.Solve(skeleton_, body_, pose_);
    SetActorRotation(skeleton_, arm_.wrist, wrist.rotation, pose_);
    ShareTwist(goal.weight);
    SetActorRotation(skeleton_, arm_.wrist, wrist.rotation, pose_);
  }

 private:
  const JointFrame& Rest(JointIndex joint) const { return body_.rest[static_cast<size_t>(joint)]; }
  glm::quat Turned(JointIndex joint) const {
    return ActorFromJoint(skeleton_, pose_, joint).rotation * glm::conjugate(Rest(joint).rotation);
  }

  // At rest elbows point backwards.
  glm::vec3 RestHinge() const {
    const glm::vec3 upper = Rest(arm_.elbow).position - Rest(arm_.shoulder).position;
    return glm::cross(glm::vec3(0.0f, 0.0f, 1.0f), -upper);
  }

  // Direction of the elbow from the line between shoulder and wrist; from the arm's hinge if the
  // arm is straight.
  glm::vec3 ElbowWay() const {
    const glm::vec3 shoulder = Position(arm_.shoulder), elbow = Position(arm_.elbow);
    const glm::vec3 line = Direction(Position(arm_.wrist) - shoulder, -kUp);
    const glm::vec3 hinge = Turned(arm_.shoulder) * RestHinge();
    const glm::vec3 straight = glm::cross(line, Direction(hinge, kUp));
    return Direction(Across(elbow - shoulder, line) / Length() - 0.02f * straight, straight);
  }

  // Elbows hang down and out; when the hand is high, they point out.
  glm::vec3 NaturalElbow(const glm::vec3& wrist) const {
    const glm::vec3 way = (wrist - Position(arm_.shoulder)) / Length();
    const float high = glm::smoothstep(-0.2f, 0.6f, way.y);
    const glm::vec3 out(SideSign(side_), 0.0f, 0.0f);
    const glm::quat chest = body_.chest() == kNoJoint ? kNoTurn : Turned(body_.chest());
    const glm::vec3 back(0.0f, 0.0f, 1.0f);
    return Direction(chest * ((0.45f + 0.4f * high) * out + 0.45f * (1.0f - high) * back) - kUp,
                     -kUp);
  }

  // The clavicle turns by up to 20 degrees towards a distant goal.
  void RaiseShoulder(const glm::vec3& wrist, float weight) {
    if (arm_.clavicle == kNoJoint) {
      return;
    }
    const glm::vec3 at = Position(arm_.clavicle);
    const glm::vec3 shoulder = Position(arm_.shoulder);
    const float stretch = glm::distance(wrist, shoulder) / Length();
    const float high = glm::smoothstep(0.0f, 0.7f, (wrist.y - shoulder.y) / Length());
    const float angle =
        0.35f * weight * std::max(glm::smoothstep(0.80f, 1.08f, stretch), 0.8f * high);
    const glm::vec3 axis = glm::cross(shoulder - at, wrist - at);
    if (angle > 0.0f && glm::length(axis) > 1e-6f) {
      TurnInActor(skeleton_, arm_.clavicle, TurnBy(angle * glm::normalize(axis)), pose_);
    }
  }

  // Distributes the hand's twist along the forearm, in which radius and ulna rotate about each
  // other.
  void ShareTwist(float weight) {
    const glm::vec3 along = glm::normalize(Rest(arm_.wrist).position - Rest(arm_.elbow).position);
    const glm::quat hand = glm::conjugate(Turned(arm_.elbow)) * Turned(arm_.wrist);
    const float twist = weight * TwistAngle(hand, along);
    const float elbow_share = arm_.forearm_twist.empty() ? 0.35f : 0.15f;
    TwistBy(arm_.elbow, elbow_share * twist);
    for (const JointIndex joint : arm_.forearm_twist) {
      TwistBy(joint, 0.5f * twist / static_cast<float>(arm_.forearm_twist.size()));
    }
  }

  // Twists about the line to the wrist, which stays in place.
  void TwistBy(JointIndex joint, float angle) {
    const glm::vec3 axis = Direction(Position(arm_.wrist) - Position(joint), kUp);
    TurnInActor(skeleton_, joint, glm::angleAxis(angle, axis), pose_);
  }

  const BodyRig& body_;
  const BodyRig::Arm& arm_;
  const GripFrame& wrist_from_grip_;
  const Skeleton& skeleton_;
  int side_;
  std::span<JointTransform> pose_;
};

// Share of an arm's length beyond which the trunk helps.
constexpr float kComfortable = 0.92f;
// Share of an arm's length that the arm reaches exactly.
constexpr float kWithinReach = 0.99f;

// Bends the trunk in hips and spine over feet that stay in place, so that the shoulders come
// nearer.
class TrunkHelp {
 public:
  TrunkHelp(const BodyRig& body,
            const Skeleton& skeleton,
            float seated,
            std::span<JointTransform> pose)
      : body_(body), skeleton_(skeleton), pose_(pose), seated_(seated) {
    hips_share_ = body.walks() ? 0.4f : 0.0f;
    if (body.walks()) {
      pivot_ = hips_share_ * Position(body.root);
      for (size_t side = 0; side < 2; ++side) {
        ankles_[side] = ActorFromJoint(skeleton, pose, body.legs[side].ankle);
      }
    }
    spine_share_ =
        (1.0f - hips_share_) / static_cast<float>(std::max<size_t>(body.spine.size(), 1));
    for (const JointIndex joint : body.spine) {
      pivot_ += spine_share_ * Position(joint);
    }
  }

  // Rotation of the chest, as a vector in radians, that brings a shoulder near enough to its wrist,
  // within the limits of the back.
  glm::vec3 Towards(const glm::vec3& wrist, const glm::vec3& shoulder, float arm_length) const {
    constexpr float kMost = 1.15f;  // radians
    constexpr int kRounds = 4;
    glm::quat turn = kNoTurn;
    for (int round = 0; round < kRounds && !body_.spine.empty(); ++round) {
      const glm::vec3 lever = turn * (shoulder - pivot_);
      const glm::vec3 way = wrist - (pivot_ + lever);
      const float missing = glm::length(way) - kComfortable * arm_length;
      const glm::vec3 axis = glm::cross(lever, way);
      const float sine = glm::length(axis) / std::max(glm::length(lever) * glm::length(way), 1e-6f);
      if (missing <= 0.0f || sine < 1e-3f) {
        break;
      }
      const float angle = missing / (glm::length(lever) * std::max(sine, 0.35f));
      turn = TurnBy(std::min(angle, 0.5f) * glm::normalize(axis)) * turn;
      const float whole = 2.0f * std::acos(std::min(std::abs(turn.w), 1.0f));
      turn = Share(turn, std::min(1.0f, kMost / std::max(whole, 1e-6f)));
    }
    return RotationVector(turn);
  }

  // The hips go back as the chest goes forward, so that the body keeps its balance.
  void Turn(const glm::vec3& turn) {
    const glm::quat share = TurnBy(spine_share_ * turn);
    for (const JointIndex joint : body_.spine) {
      TurnInActor(skeleton_, joint, share, pose_);
    }
    if (body_.walks()) {
      const glm::vec3 hips = Hips();
      TurnInActor(skeleton_, body_.root, TurnBy(hips_share_ * turn), pose_);
      glm::vec3 back = 0.14f * body_.leg_length() * glm::cross(turn, kUp);
      back.y = 0.0f;
      MoveRoot(glm::mix(-back, hips - Hips(), seated_));
    }
  }

  // Covers the distance that trunk and arm cannot: the hips go down and over the feet as far as
  // knees and balance allow, and the trunk bends for the rest. `way` leads from the shoulder to the
  // required wrist position; `missing` is its excess length.
  void ComeNearer(const glm::vec3& shoulder, const glm::vec3& way, float missing) {
    const glm::vec3 wanted = missing * Direction(way, -kUp);
    const glm::vec3 before = moved_;
    moved_ = WithinBalance(moved_ + (1.0f - seated_) * wanted);
    MoveRoot(moved_ - before);
    const float left = missing - std::max(glm::dot(moved_ - before, Direction(way, -kUp)), 0.0f);
    const JointIndex waist = body_.spine.empty() ? kNoJoint : body_.spine.front();
    if (waist == kNoJoint || left <= 0.0f) {
      return;
    }
    constexpr float kMost = 0.6f;  // radians
    const glm::vec3 lever = shoulder - Position(waist);
    const glm::vec3 axis = Direction(glm::cross(lever, way), glm::vec3(-1.0f, 0.0f, 0.0f));
    const float angle = std::min(left / std::max(glm::length(lever), 0.1f), kMost - bent_);
    if (angle > 0.0f) {
      bent_ += angle;
      const glm::quat share = TurnBy(angle / static_cast<float>(body_.spine.size()) * axis);
      for (const JointIndex joint : body_.spine) {
        TurnInActor(skeleton_, joint, share, pose_);
      }
    }
  }

  // Distance by which the pelvis must go down for an arm to reach.
  static float MissingDrop(const glm::vec3& wrist, const glm::vec3& shoulder, float arm_length) {
    const float length = 0.97f * arm_length;
    const float across = glm::length(glm::vec2(wrist.x - shoulder.x, wrist.z - shoulder.z));
    const float rise = std::sqrt(std::max(length * length - across * across, 0.0f));
    const float helps = 1.0f - glm::smoothstep(0.95f, 1.1f, across / length);
    return helps * std::max(shoulder.y - wrist.y - rise, 0.0f);
  }

  void MoveRoot(const glm::vec3& way) {
    if (body_.walks()) {
      SetActorPosition(skeleton_, body_.root, Position(body_.root) + way, pose_);
    }
  }

  // Returns the feet to their positions before the trunk moved.
  void KeepFeet() {
    for (const int side : {kRight, kLeft}) {
      if (body_.walks()) {
        BringFoot(skeleton_, body_, side, ankles_[static_cast<size_t>(side)], pose_);
      }
    }
  }

 private:
  glm::vec3 Position(JointIndex joint) const {
    return ActorFromJoint(skeleton_, pose_, joint).position;
  }
  glm::vec3 Hips() const {
    return 0.5f * (Position(body_.legs[0].hip) + Position(body_.legs[1].hip));
  }

  // Limits the hips so that the heels stay on the floor: not lower than a deep knee bend, and not
  // further aside than the feet.
  glm::vec3 WithinBalance(const glm::vec3& moved) const {
    const float lowest = -0.42f * body_.leg_length();
    const float furthest = 0.16f * body_.leg_length();
    glm::vec3 within(moved.x, std::clamp(moved.y, lowest, 0.02f * body_.leg_length()), moved.z);
    const float aside = glm::length(glm::vec2(within.x, within.z));
    const float share = std::min(1.0f, furthest / std::max(aside, 1e-6f));
    within.x *= share;
    within.z *= share;
    return within;
  }

  static glm::vec3 RotationVector(const glm::quat& turn) {
    const glm::quat q = ShorterArc(turn);
    const glm::vec3 axis(q.x, q.y, q.z);
    const float sine = glm::length(axis);
    return sine > 1e-6f ? 2.0f * std::atan2(sine, q.w) / sine * axis : glm::vec3(0.0f);
  }

  const BodyRig& body_;
  const Skeleton& skeleton_;
  std::span<JointTransform> pose_;
  float seated_ = 0.0f;
  glm::vec3 pivot_ = glm::vec3(0.0f);
  float hips_share_ = 0.0f, spine_share_ = 0.0f;
  glm::vec3 moved_ = glm::vec3(0.0f);  // displacement by ComeNearer()
  float bent_ = 0.0f;
  std::array<JointFrame, 2> ankles_;
};

// Bends the trunk for both hands.
class ReachPosture {
 public:
  ReachPosture(const ReachModel& model,
               const Skeleton& skeleton,
               const std::array<Reach, 2>& reaches,
               float seated,
               std::span<JointTransform> pose)
      : model_(model),
        skeleton_(skeleton),
        pose_(pose),
        seated_(seated),
        trunk_(model.body, skeleton, seated, pose) {
    for (const int side : {kRight, kLeft}) {
      const bool whole = Arm(side).whole();
      goals_[static_cast<size_t>(side)] =
          whole ? Goal(reaches[static_cast<size_t>(side)]) : ReachGoal();
    }
  }

  void Apply() {
    const glm::vec3 turn = ChestTurn();
    if (glm::length(turn) > 1e-5f) {
      trunk_.Turn(turn);
      LetArmsHang(turn);
    }
    const float drop = (1.0f - seated_) * Drop();
    if (drop > 0.0f) {
      trunk_.MoveRoot(-drop * kUp);
    }
    const bool came = ComeNearer();
    if (glm::length(turn) > 1e-5f || drop > 0.0f || came) {
      trunk_.KeepFeet();
    }
  }

 private:
  const BodyRig::Arm& Arm(int side) const { return model_.body.arms[static_cast<size_t>(side)]; }
  const ReachGoal& GoalOf(int side) const { return goals_[static_cast<size_t>(side)]; }

  // Repeats until both arms reach or there is no more progress. Returns true if anything moved.
  bool ComeNearer() {
    constexpr int kRounds = 12;
    bool moved = false;
    for (int round = 0; round < kRounds; ++round) {
      float most = 0.0f;
      for (const int side : {kRight, kLeft}) {
        if (GoalOf(side).weight <= 0.0f) {
          continue;
        }
        const Reacher reacher(model_, skeleton_, side, pose_);
        const glm::vec3 way = reacher.Way(GoalOf(side));
        const float slack = 0.03f * (1.0f - GoalOf(side).weight);  // Hanging arms may be straight.
        const float missing = glm::length(way) - (kWithinReach + slack) * reacher.Length();
        if (missing > 0.0f) {
          most = std::max(most, missing);
          trunk_.ComeNearer(reacher.Position(Arm(side).shoulder), way, missing);
        }
      }
      if (most < 1e-4f) {
        break;
      }
      moved = true;
    }
    return moved;
  }

  glm::vec3 ChestTurn() const {
    constexpr float kMost = 1.25f;
    glm::vec3 turn(0.0f);
    for (const int side : {kRight, kLeft}) {
      if (GoalOf(side).weight > 0.0f) {
        const Reacher reacher(model_, skeleton_, side, pose_);
        turn += GoalOf(side).weight * trunk_.Towards(Wrist(reacher, side),
                                                     reacher.Position(Arm(side).shoulder),
                                                     reacher.Length());
      }
    }
    return turn * std::min(1.0f, kMost / std::max(glm::length(turn), 1e-6f));
  }

  float Drop() const {
    float drop = 0.0f;
    for (const int side : {kRight, kLeft}) {
      if (GoalOf(side).weight > 0.0f) {
        const Reacher reacher(model_, skeleton_, side, pose_);
        drop = std::max(
            drop, GoalOf(side).weight * TrunkHelp::MissingDrop(Wrist(reacher, side),
                                                               reacher.Position(Arm(side).shoulder),
                                                               reacher.Length()));
      }
    }
    return std::min(drop, 0.6f * model_.body.leg_length());
  }

  glm::vec3 Wrist(const Reacher& reacher, int side) const {
    return reacher.ActorFromWrist(GoalOf(side).actor_from_grip).position;
  }

  // An arm without a grip does not turn with the chest.
  void LetArmsHang(const glm::vec3& turn) {
    for (const int side : {kRight, kLeft}) {
      if (Arm(side).whole()) {
        const float free = 0.8f * (1.0f - GoalOf(side).weight);
        TurnInActor(skeleton_, Arm(side).shoulder, TurnBy(-free * turn), pose_);
      }
    }
  }

  const ReachModel& model_;
  const Skeleton& skeleton_;
  std::span<JointTransform> pose_;
  float seated_;
  TrunkHelp trunk_;
  std::array<ReachGoal, 2> goals_;
};

float MinimumJerk(float t) { return t * t * t * (10.0f + t * (6.0f * t - 15.0f)); }

void Begin(Reach& reach, float to_weight, float seconds) {
  const ReachGoal now = Goal(reach);
  reach.from = now.actor_from_grip;
  reach.from_weight = now.weight;
  reach.to_weight = to_weight;
  reach.time = 0.0f;
  reach.duration = std::max(seconds, 0.0f);
}

}  // namespace

GripFrame Mix(const GripFrame& a, const GripFrame& b, float weight) {
  return {glm::mix(a.position, b.position, weight), glm::slerp(a.rotation, b.rotation, weight)};
}

void StartReach(Reach& reach, const GripFrame& actor_from_grip, float seconds) {
  Begin(reach, 1.0f, seconds);
  reach.to = actor_from_grip;
}

void MoveGrip(Reach& reach, const GripFrame& actor_from_grip) {
  if (reach.to_weight > 0.0f) {
    reach.to = actor_from_grip;
  }
}

void EndReach(Reach& reach, float seconds) {
  Begin(reach, 0.0f, seconds);
  reach.to = reach.from;
}

void UpdateReach(Reach& reach, float seconds) {
  reach.time = std::min(reach.time + seconds, reach.duration);
}

Reach Interpolate(const Reach& previous, const Reach& current, float alpha) {
  const bool continues = previous.from == current.from && previous.to_weight == current.to_weight &&
                         previous.time <= current.time;
  if (!continues) {
    return current;
  }
  Reach mixed = current;
  mixed.to = Mix(previous.to, current.to, alpha);
  mixed.time = glm::mix(previous.time, current.time, alpha);
  return mixed;
}

float Progress(const Reach& reach) {
  return reach.duration > 0.0f ? MinimumJerk(reach.time / reach.duration) : 1.0f;
}

// The hand is a blend of the body's pose, `from` and `to`, with shares that sum to 1.
ReachGoal Goal(const Reach& reach) {
  const float progress = Progress(reach);
  const float from = reach.from_weight * (1.0f - progress);
  const float to = reach.to_weight * progress;
  ReachGoal goal;
  goal.weight = std::min(from + to, 1.0f);
  goal.actor_from_grip =
      Mix(reach.from, reach.to, goal.weight > 0.0f ? to / (from + to) : progress);
  return goal;
}

float ReachSeconds(float metres) {
  // The peak speed of a comfortable motion is about 1.2 m/s, 1.9 times the mean (minimum jerk).
  return std::clamp(0.35f + metres / 0.8f, 0.45f, 1.6f);
}

ReachModel MakeReachModel(const BodyRig& body) {
  ReachModel model;
  model.body = body;
  for (const int side : {kRight, kLeft}) {
    const size_t s = static_cast<size_t>(side);
    if (!body.arms[s].whole()) {
      continue;
    }
    const Palm palm = FindPalm(body, side);
    const JointFrame& wrist = body.rest[static_cast<size_t>(body.arms[s].wrist)];
    const glm::vec3 right = side == kRight ? -palm.thumb : palm.thumb;
    const glm::quat rotation = glm::quat_cast(glm::mat3(right, palm.back, -palm.along));
    // The middle of the palm's surface, from typical proportions of hands.
    const glm::vec3 middle = palm.length * (0.70f * palm.along - 0.24f * palm.back);
    model.wrist_from_grip[s] = {(glm::conjugate(wrist.rotation) * middle) / wrist.scale,
                                glm::conjugate(wrist.rotation) * rotation};
  }
  return model;
}

GripFrame ActorFromPalm(const ReachModel& model,
                        const Skeleton& skeleton,
                        std::span<const JointTransform> pose,
                        int side) {
  const size_t s = static_cast<size_t>(side);
  if (!model.body.arms[s].whole()) {
    return {};
  }
  const JointFrame wrist = ActorFromJoint(skeleton, pose, model.body.arms[s].wrist);
  return {wrist * model.wrist_from_grip[s].position,
          wrist.rotation * model.wrist_from_grip[s].rotation};
}

void ApplyReachPosture(const ReachModel& model,
                       const Skeleton& skeleton,
                       const std::array<Reach, 2>& reaches,
                       float seated,
                       std::span<JointTransform> pose) {
  ReachPosture(model, skeleton, reaches, seated, pose).Apply();
}

void ApplyReach(const ReachModel& model,
                const Skeleton& skeleton,
                const Reach& reach,
                int side,
                std::span<JointTransform> pose) {
  const ReachGoal goal = Goal(reach);
  if (goal.weight > 0.0f && model.body.arms[static_cast<size_t>(side)].whole()) {
    Reacher(model, skeleton, side, pose).Bring(goal);
  }
}

}  // namespace lararium::human
