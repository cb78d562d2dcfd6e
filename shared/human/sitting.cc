#include "shared/human/sitting.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "shared/human/human.h"
#include "shared/human/turns.h"
#include "shared/human/two_bone_ik.h"

namespace lararium::human {
namespace {

constexpr glm::vec3 kSeatUp(0.0f, 1.0f, 0.0f);
constexpr glm::vec3 kSeatForward(0.0f, 0.0f, -1.0f);

constexpr float kMostLean = 0.72f;      // radians; largest lean of the chest during the motion
constexpr float kPelvisBack = 0.20f;    // radians by which the pelvis rolls back on a seat
constexpr float kShankBack = 0.22f;     // radians: feet stand a little behind the knees
constexpr float kHangingShank = 0.12f;  // radians by which the shanks of hanging feet lean back
constexpr float kHangingFoot = 0.40f;   // radians by which the toes of hanging feet point down
constexpr float kHandOnThigh = 0.62f;   // share of the way from hip to knee

// Goes from 0 to 1 between two moments, at rest at both (minimum jerk).
float SeatBetween(float begin, float end, float u) {
  const float t = std::clamp((u - begin) / (end - begin), 0.0f, 1.0f);
  return t * t * t * (10.0f + t * (6.0f * t - 15.0f));
}

// Phases of the motion at a share of standing up: 0 sits, 1 stands.
struct Phases {
  float lean;     // lean of the trunk, 0..1
  float back;     // backward roll of the pelvis, 0..1
  float forward;  // Progress of the hips from the seat to above the feet, horizontally.
  float up;       // Progress of the hips, vertically.
  float hands;    // share of the hands' pose on the thighs
  float feet;     // progress from hanging to standing feet
};

Phases PhasesAt(const Sitting& sitting) {
  const float u = 1.0f - sitting.amount;
  Phases at;
  at.lean = SeatBetween(0.0f, 0.40f, u) - SeatBetween(0.40f, 0.95f, u);
  at.back = 1.0f - SeatBetween(0.0f, 0.35f, u);
  at.forward = SeatBetween(0.24f, 0.84f, u);
  at.up = SeatBetween(0.30f, 0.98f, u);
  at.hands = 1.0f - SeatBetween(0.34f, 0.76f, u);
  at.feet = SeatBetween(0.10f, 0.55f, u);
  return at;
}

float LowerLeg(const BodyRig& body) {
  return 0.5f * (body.legs[0].lower_length + body.legs[1].lower_length);
}
float Thigh(const BodyRig& body) {
  return 0.5f * (body.legs[0].upper_length + body.legs[1].upper_length);
}
float AnkleHeight(const BodyRig& body) {
  return 0.5f * (body.legs[0].ankle_height + body.legs[1].ankle_height);
}

// How freely the feet hang: 0 stands flat, 1 hangs freely. Before they hang, the thighs slope by
// about 15 degrees.
float Hanging(const SittingModel& model, float seat_height) {
  const BodyRig& body = model.body;
  const float hips = seat_height + model.seat_to_hips;
  const float highest = AnkleHeight(body) + LowerLeg(body) + 0.26f * Thigh(body);
  return glm::smoothstep(0.0f, 0.07f * body.leg_length(), hips - highest);
}

// Midpoint of the hip joints at rest.
glm::vec3 RestHips(const BodyRig& body) {
  return 0.5f * (body.rest[static_cast<size_t>(body.legs[0].hip)].position +
                 body.rest[static_cast<size_t>(body.legs[1].hip)].position);
}

class SeatedPose {
 public:
  SeatedPose(const SittingModel& model,
             const ReachModel& reach,
             const Skeleton& skeleton,
             const Sitting& sitting,
             std::span<JointTransform> pose)
      : model_(model),
        body_(model.body),
        reach_(reach),
        skeleton_(skeleton),
        sitting_(sitting),
        pose_(pose),
        at_(PhasesAt(sitting)) {
    for (size_t side = 0; side < 2; ++side) {
      ankles_[side] = ActorFromJoint(skeleton, pose, body_.legs[side].ankle);
    }
  }

  void Apply() {
    const glm::vec3 standing = Hips();
    TurnTrunk();
    MoveHips(standing);
    for (const int side : {kRight, kLeft}) {
      SetLeg(side);
    }
    for (const int side : {kRight, kLeft}) {
      LayHandOnThigh(side);
    }
  }

 private:
  const BodyRig::Leg& Leg(int side) const { return body_.legs[static_cast<size_t>(side)]; }
  glm::vec3 Position(JointIndex joint) const {
    return ActorFromJoint(skeleton_, pose_, joint).position;
  }
  glm::vec3 Hips() const { return 0.5f * (Position(Leg(0).hip) + Position(Leg(1).hip)); }

  // Pelvis, chest and head lean by different angles, which the joints between them share.
  void TurnTrunk() {
    const float pelvis = 0.62f * kMostLean * at_.lean - kPelvisBack * at_.back;
    const float chest = kMostLean * at_.lean;
    const float head = 0.40f * kMostLean * at_.lean;
    Lean(body_.root, pelvis);
    LeanChain(body_.spine, chest - pelvis);
    LeanChain(body_.neck, head - chest);
    for (const BodyRig::Arm& arm : body_.arms) {
      if (arm.whole()) {
        Lean(arm.shoulder, -0.85f * chest);  // Keeps the arms hanging.
      }
    }
  }

  // Leans a joint forward.
  void Lean(JointIndex joint, float angle) { TurnInActor(skeleton_, joint, TurnX(-angle), pose_); }

  void LeanChain(const std::vector<JointIndex>& chain, float angle) {
    for (const JointIndex joint : chain) {
      Lean(joint, angle / static_cast<float>(chain.size()));
    }
  }

  void MoveHips(const glm::vec3& standing) {
    const glm::vec3 seated = sitting_.seat + model_.seat_to_hips * kSeatUp;
    const glm::vec3 goal(glm::mix(seated.x, standing.x, at_.forward),
                         glm::mix(seated.y, standing.y, at_.up),
                         glm::mix(seated.z, standing.z, at_.forward));
    SetActorPosition(skeleton_, body_.root, Position(body_.root) + goal - Hips(), pose_);
  }

  void SetLeg(int side) {
    const BodyRig::Leg& leg = Leg(side);
    JointFrame ankle = ankles_[static_cast<size_t>(side)];
    const float hangs = (1.0f - at_.feet) * Hanging(model_, sitting_.seat.y);
    if (hangs > 0.0f) {
      const glm::vec3 shank = TurnX(-kHangingShank) * glm::vec3(0.0f, -leg.lower_length, 0.0f);
      const glm::vec3 hanging = Position(leg.hip) + 0.99f * leg.upper_length * kSeatForward + shank;
      ankle.position = glm::mix(ankle.position, hanging, hangs);
      ankle.rotation = TurnX(-hangs * kHangingFoot) * ankle.rotation;
    }
    BringFoot(skeleton_, body_, side, ankle, pose_);
  }

  // Lays the hand on the thigh, palm down, fingers along the thigh and a little inward.
  void LayHandOnThigh(int side) {
    if (!body_.arms[static_cast<size_t>(side)].whole() || at_.hands <= 0.0f) {
      return;
    }
    const glm::vec3 hip = Position(Leg(side).hip), knee = Position(Leg(side).knee);
    const glm::vec3 along = Direction(knee - hip, kSeatForward);
    const glm::vec3 back = Direction(Across(kSeatUp, along), kSeatUp);
    const glm::vec3 fingers = TurnBy(SideSign(side) * 0.45f * back) * along;
    Reach reach;
    reach.to.position = glm::mix(hip, knee, kHandOnThigh) + model_.thigh_radius * back;
    reach.to.rotation = glm::quat_cast(glm::mat3(glm::cross(back, -fingers), back, -fingers));
    reach.from = reach.to;
    reach.to_weight = at_.hands;
    ApplyReach(reach_, skeleton_, reach, side, pose_);
  }

  const SittingModel& model_;
  const BodyRig& body_;
  const ReachModel& reach_;
  const Skeleton& skeleton_;
  const Sitting& sitting_;
  std::span<JointTransform> pose_;
  Phases at_;
  std::array<JointFrame, 2> ankles_;
};

}  // namespace

float SittingSeconds(const BodyRig& body, float cadence) {
  constexpr float kGrownLeg = 0.9f;  // metres
  const float size = std::sqrt(std::max(body.leg_length(), 0.3f) / kGrownLeg);
  return 1.9f * size / std::clamp(cadence, 0.5f, 2.0f);
}

void SitDown(Sitting& sitting, const glm::vec3& actor_from_seat, float seconds) {
  sitting.seat = actor_from_seat;
  sitting.seconds = std::max(seconds, 1e-3f);
  sitting.down = true;
}

void StandUp(Sitting& sitting, float seconds) {
  sitting.seconds = std::max(seconds, 1e-3f);
  sitting.down = false;
}

void UpdateSitting(Sitting& sitting, float seconds) {
  const float step = (sitting.down ? seconds : -seconds) / sitting.seconds;
  sitting.amount = std::clamp(sitting.amount + step, 0.0f, 1.0f);
}

Sitting Interpolate(const Sitting& previous, const Sitting& current, float alpha) {
  Sitting mixed = current;
  if (previous.seat == current.seat) {
    mixed.amount = glm::mix(previous.amount, current.amount, alpha);
  }
  return mixed;
}

SittingModel MakeSittingModel(const Human& human, const BodyRig& body) {
  SittingModel model;
  model.body = body;
  if (!body.walks()) {
    return model;
  }
  // Default radii for adults from the thigh's length; capsules give better values.
  float at_hip = 0.21f * Thigh(body), at_knee = 0.14f * Thigh(body);
  for (const BodyCapsule& capsule : human.capsules) {
    if (capsule.joint == static_cast<uint32_t>(body.legs[kRight].hip)) {
      at_hip = capsule.radius_a;
      at_knee = capsule.radius_b;
    }
  }
  constexpr float kPressed = 0.88f;  // Soft tissue is compressed on a seat.
  model.seat_to_hips = kPressed * at_hip;
  model.thigh_radius = glm::mix(at_hip, at_knee, kHandOnThigh) + 0.025f;  // margin for clothes
  return model;
}

float StandBeforeSeat(const SittingModel& model, float seat_height, float front) {
  const BodyRig& body = model.body;
  if (!body.walks()) {
    return front;
  }
  const float hips = seat_height + model.seat_to_hips;
  const float knees = AnkleHeight(body) + LowerLeg(body) * std::cos(kShankBack);
  const float rise = std::clamp(hips - knees, -0.9f * Thigh(body), 0.9f * Thigh(body));
  const float thigh = std::sqrt(Thigh(body) * Thigh(body) - rise * rise);
  const float ankles = thigh - LowerLeg(body) * std::sin(kShankBack);
  const float heels = front + 0.6f * (body.legs[0].heel.z + body.legs[1].heel.z) + 0.02f;
  // Distance from the ankles to the root that stands above them.
  const float behind = 0.5f * (body.rest[static_cast<size_t>(body.legs[0].ankle)].position.z +
                               body.rest[static_cast<size_t>(body.legs[1].ankle)].position.z);
  return std::max(ankles, std::min(heels, 0.9f * Thigh(body))) + behind;
}

float ForwardOnSeat(const SittingModel& model, float front) {
  return model.body.walks() ? std::max(front - 0.8f * Thigh(model.body), 0.0f) : 0.0f;
}

glm::vec3 HipsShift(const SittingModel& model, const Sitting& sitting) {
  if (sitting.amount <= 0.0f || !model.body.walks()) {
    return glm::vec3(0.0f);
  }
  const Phases at = PhasesAt(sitting);
  const glm::vec3 way = sitting.seat + model.seat_to_hips * kSeatUp - RestHips(model.body);
  return glm::vec3(1.0f - at.forward, 1.0f - at.up, 1.0f - at.forward) * way;
}

float SeatedShare(const Sitting& sitting) {
  return sitting.amount <= 0.0f ? 0.0f : 1.0f - PhasesAt(sitting).up;
}

void ApplySitting(const SittingModel& model,
                  const ReachModel& reach,
                  const Skeleton& skeleton,
                  const Sitting& sitting,
                  std::span<JointTransform> pose) {
  if (sitting.amount > 0.0f && model.body.walks()) {
    SeatedPose(model, reach, skeleton, sitting, pose).Apply();
  }
}

}  // namespace lararium::human
