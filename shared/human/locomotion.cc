#include "shared/human/locomotion.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "shared/human/gait.h"
#include "shared/human/turns.h"

namespace lararium::human {
namespace {

using Foot = Locomotion::Foot;
using Footprint = Locomotion::Footprint;

constexpr float kToeOut = 0.12f;        // radians; 7 degrees (Murray et al., 1964)
constexpr float kStagger = 0.020f;      // share of the leg length; our value
constexpr float kStandingTurn = 0.11f;  // radians; our value
// Half the distance between the lines of the ankles while walking, as a share of the leg length
// (Murray et al., 1964: 8 cm between the middles of the heels; ours is wider for comfort), and the
// least distance between the feet.
constexpr float kHalfStepWidth = 0.068f;
constexpr float kLeastWidth = 0.09f;

struct RootPose {
  glm::vec3 position;
  float heading;

  glm::vec3 Stage(const glm::vec3& actor) const { return position + TurnY(heading) * actor; }
};

Footprint Mix(const Footprint& a, const Footprint& b, float t) {
  return {glm::mix(a.position, b.position, t), MixAngles(a.heading, b.heading, t),
          glm::mix(a.slope_pitch, b.slope_pitch, t), glm::mix(a.slope_roll, b.slope_roll, t)};
}

// Smooth minimum of two angles.
float SmoothMin(float a, float b) {
  constexpr float kWidth = 0.5f;  // radians
  const float near = std::max(1.0f - std::abs(a - b) / kWidth, 0.0f);
  return std::min(a, b) - 0.25f * kWidth * near * near;
}

// Computes one tick of one walking body.
class Walker {
 public:
  Walker(const BodyRig& body, const FloorHeight& floor, float seconds, Locomotion& state)
      : body_(body), floor_(floor), seconds_(seconds), state_(state) {
    speed_ = glm::length(glm::vec2(state.velocity.x, state.velocity.z));
    stride_ = StrideAt(speed_, Forwardness(), state.turn_rate, body.leg_length(), state.style);
  }

  void Place() {
    state_.velocity = state_.acceleration = glm::vec3(0.0f);
    state_.turn_rate = state_.amount = 0.0f;
    state_.stepping = false;
    state_.settled = 1.0f;
    state_.placed = true;
    for (const int side : {kRight, kLeft}) {
      FootOf(side) = Foot();
      FootOf(side).print = NeutralPrint(side, Root(), 0.0f);
      Stand(side);
    }
  }

  void Update() {
    UpdateAmount();
    AdvanceClock();
    for (const int side : {kRight, kLeft}) {
      UpdateFoot(side);
    }
  }

 private:
  Foot& FootOf(int side) const { return state_.feet[static_cast<size_t>(side)]; }
  const BodyRig::Leg& Leg(int side) const { return body_.legs[static_cast<size_t>(side)]; }
  RootPose Root() const { return {state_.position, state_.heading}; }

  // Returns the phase of the leg's own stride, 0..1.
  float OwnPhase(int side) const {
    const double phase = state_.phase + (side == kRight ? 0.0 : 0.5);
    return static_cast<float>(phase - std::floor(phase));
  }
  bool Moving() const { return speed_ > 0.07f * std::sqrt(body_.leg_length()); }
  bool Swinging() const { return !state_.feet[0].planted || !state_.feet[1].planted; }

  // Similarity to forward walking, 0..1: feet swing flat when walking sideways or backwards.
  float Forwardness() const {
    if (speed_ < 1e-3f) {
      return 1.0f;
    }
    const glm::vec3 ahead = TurnY(state_.heading) * glm::vec3(0.0f, 0.0f, -1.0f);
    return std::max(glm::dot(ahead, state_.velocity) / speed_, 0.0f);
  }

  // Speed to the right, m/s.
  float SidewardSpeed() const {
    return glm::dot(state_.velocity, TurnY(state_.heading) * glm::vec3(1.0f, 0.0f, 0.0f));
  }

  void UpdateAmount() {
    state_.amount += Approach(seconds_, 0.12f) * (stride_.amount - state_.amount);
  }

  // ---- Prints ----

  float FloorAt(const glm::vec3& at) const {
    return floor_ ? floor_(at.x, at.z) : state_.position.y;
  }

  // Returns the print of a flat foot whose ankle is above this position.
  Footprint PrintAt(const glm::vec3& at, float heading, int side) const {
    Footprint print;
    print.heading = heading;
    print.position = glm::vec3(at.x, FloorAt(at), at.z);
    if (floor_) {
      constexpr float kSteepest = 0.45f;
      const float length = Leg(side).heel.z - Leg(side).ball.z;
      const glm::quat turn = TurnY(heading);
      const glm::vec3 ahead = turn * glm::vec3(0.0f, 0.0f, -0.5f * length);
      const glm::vec3 right = turn * glm::vec3(0.25f * length, 0.0f, 0.0f);
      const float rise = FloorAt(at + ahead) - FloorAt(at - ahead);
      const float tilt = FloorAt(at + right) - FloorAt(at - right);
      print.slope_pitch = std::clamp(std::atan2(rise, length), -kSteepest, kSteepest);
      print.slope_roll = std::clamp(std::atan2(tilt, 0.5f * length), -kSteepest, kSteepest);
    }
    return print;
  }

  float HalfWidth(float amount) const {
    const float walking = kHalfStepWidth * body_.leg_length() * state_.style.step_width;
    const float standing = std::max(0.55f * body_.hip_width * state_.style.step_width, walking);
    return glm::mix(standing, walking, std::min(2.0f * amount, 1.0f));
  }

  // Returns the print of a foot that stands below a root.
  Footprint NeutralPrint(int side, const RootPose& root, float amount) const {
    const float back = body_.rest[static_cast<size_t>(Leg(side).ankle)].position.z;
    // A standing person has one foot ahead and the other turned out.
    const float staggered = std::max(1.0f - 2.0f * amount, 0.0f) * state_.style.stagger;
    const float ahead = SideSign(side) * staggered * kStagger * body_.leg_length();
    const float toe_out = kToeOut + std::max(-SideSign(side) * staggered, 0.0f) * kStandingTurn;
    const glm::vec3 offset(SideSign(side) * HalfWidth(amount), 0.0f, back - ahead);
    return PrintAt(root.Stage(offset), root.heading - SideSign(side) * toe_out, side);
  }

  // Predicted displacement at the present acceleration, at most until the body stops. Half of the
  // acceleration is used, because people do not keep it up for long.
  glm::vec3 Travel(float seconds) const {
    const glm::vec3 acceleration = 0.5f * state_.acceleration;
    const float along = glm::dot(acceleration, state_.velocity);
    if (along >= 0.0f) {
      const float time = std::min(seconds, 0.5f);
      return seconds * state_.velocity + 0.5f * time * time * acceleration;
    }
    const float stops = speed_ * speed_ / -along;
    const float time = std::min(seconds, stops);
    return time * state_.velocity + 0.5f * time * time * acceleration;
  }

  // Predicted root if the present motion continues.
  RootPose Foretell(float seconds) const {
    constexpr float kFurthest = 0.8f;  // radians; the limit of a foot's inward turn
    const float turn = std::clamp(state_.turn_rate * seconds, -kFurthest, kFurthest);
    const glm::vec3 way = TurnY(0.5f * state_.turn_rate * seconds) * Travel(seconds);
    return {state_.position + way, state_.heading + turn};
  }

  // Print at which the swinging foot will land: the root is above it at the middle of its stance.
  Footprint Goal(int side) {
    const Foot& foot = FootOf(side);
    const float swing_seconds = (1.0f - foot.lift_phase) / stride_.per_second;
    const float stance_seconds = stride_.stance_share / stride_.per_second;
    const RootPose root =
        Foretell((1.0f - foot.swing) * swing_seconds + stride_.ahead_share * stance_seconds);
    const Footprint goal = NeutralPrint(side, root, state_.amount);
    const glm::vec3 at = KeepApart(side, WithinReach(goal.position + Opening(side), root));
    return PrintAt(at, goal.heading, side);
  }

  // Sideways walking opens and closes the feet: the leading foot goes further, the other less far.
  glm::vec3 Opening(int side) const {
    const float sideward = SidewardSpeed();
    const float quarter = 0.25f * std::abs(sideward) / stride_.per_second;
    return TurnY(state_.heading) * glm::vec3(SideSign(side) * quarter, 0.0f, 0.0f);
  }

  glm::vec3 WithinReach(const glm::vec3& goal, const RootPose& root) const {
    const float most = 0.6f * body_.leg_length();
    glm::vec3 way = goal - root.position;
    way.y = 0.0f;
    const float length = glm::length(way);
    return length > most ? root.position + most / length * way : goal;
  }

  // Keeps the goal from crossing the other foot.
  glm::vec3 KeepApart(int side, glm::vec3 goal) const {
    const Foot& other = state_.feet[static_cast<size_t>(1 - side)];
    const glm::vec3 right = TurnY(state_.heading) * glm::vec3(1.0f, 0.0f, 0.0f);
    const float apart = SideSign(side) * glm::dot(goal - other.print.position, right);
    const float least = kLeastWidth * body_.leg_length();
    // Feet that are far apart along the path may be in one line.
    const float along = glm::length(Across(goal - other.print.position, right));
    const float needed = least * (1.0f - glm::smoothstep(0.2f, 0.5f, along / body_.leg_length()));
    return goal + SideSign(side) * std::max(needed - apart, 0.0f) * right;
  }

  // ---- The clock ----

  // Distance of a foot from its neutral print; above 1 the foot should step.
  float Misplacement(int side) const {
    const Footprint& print = state_.feet[static_cast<size_t>(side)].print;
    const Footprint neutral = NeutralPrint(side, Root(), 0.0f);
    const glm::vec3 way = print.position - neutral.position;
    const float aside = glm::length(glm::vec2(way.x, way.z)) / body_.leg_length();
    const float turned = std::abs(std::remainder(print.heading - neutral.heading, 2.0f * kPiF));
    // A standing person tolerates more than one who is moving.
    const bool turns = std::abs(state_.turn_rate) > 0.3f;
    const float leeway = state_.stepping || turns ? 1.0f : 1.8f;
    return std::max(aside / (0.055f * leeway), turned / (0.20f * leeway));
  }

  bool WantsStep(int side) const { return Moving() || Misplacement(side) > 1.0f; }

  void AdvanceClock() {
    const bool wanted = WantsStep(kRight) || WantsStep(kLeft);
    if (!state_.stepping && wanted) {
      Begin();
    }
    state_.stepping = wanted || Swinging();
    const float settled = state_.stepping ? 0.0f : 1.0f;
    state_.settled +=
        Approach(seconds_, state_.stepping ? 0.2f : 0.9f) * (settled - state_.settled);
    if (state_.stepping) {
      state_.phase += static_cast<double>(stride_.per_second) * seconds_;
    }
  }

  // Sets the phase so that one foot may leave the floor at once.
  void Begin() {
    const int first = FirstFoot();
    const double offset = first == kRight ? 0.0 : 0.5;
    state_.phase = std::floor(state_.phase) + stride_.stance_share - offset;
  }

  int FirstFoot() const {
    if (!Moving()) {
      return Misplacement(kRight) >= Misplacement(kLeft) ? kRight : kLeft;
    }
    const auto behind = [&](int side) {
      return -glm::dot(state_.feet[static_cast<size_t>(side)].print.position - state_.position,
                       state_.velocity);
    };
    const float difference = (behind(kRight) - behind(kLeft)) / speed_;
    if (std::abs(difference) > 0.03f) {
      return difference > 0.0f ? kRight : kLeft;
    }
    return state_.turn_rate > 0.1f ? kLeft : kRight;
  }

  // ---- Feet ----

  void UpdateFoot(int side) {
    Foot& foot = FootOf(side);
    const glm::vec3 before = foot.ankle;
    const float phase = OwnPhase(side);
    const bool other_stands = FootOf(1 - side).planted;
    if (foot.planted && state_.stepping && other_stands && MayLeave(side, phase)) {
      Lift(foot, std::max(phase - stride_.per_second * seconds_, 0.5f));
    }
    if (foot.planted) {
      UpdateStance(side, phase);
    } else if (phase < 0.5f && phase < foot.lift_phase) {
      Land(side);
    } else {
      UpdateSwing(side, phase);
    }
    foot.velocity = (foot.ankle - before) / seconds_;
  }

  bool MayLeave(int side, float phase) const {
    // A foot that is left far behind steps early.
    constexpr float kFarBehind = 1.25f;  // radians of heel rise
    const bool due = phase >= stride_.stance_share;
    const bool early = phase >= 0.5f && HeelRise(side) > kFarBehind;
    return (due || early) && phase < 0.95f && WantsStep(side);
  }

  static void Lift(Foot& foot, float phase) {
    foot.planted = false;
    foot.lift_phase = phase;
    foot.swing = 0.0f;
    foot.lifted_from = foot.goal = foot.print;
    foot.lifted_ankle = foot.ankle;
    foot.lifted_velocity = foot.velocity;
    foot.lifted_pitch = foot.pitch;
  }

  void Land(int side) {
    Foot& foot = FootOf(side);
    foot.planted = true;
    foot.swing = 0.0f;
    foot.print = foot.goal;
    UpdateStance(side, OwnPhase(side));
  }

  void UpdateStance(int side, float phase) {
    Foot& foot = FootOf(side);
    const float stance = phase / stride_.stance_share;
    const float usual = stance < 1.0f ? state_.amount * StancePitch(stance) : 0.0f;
    const float goal = SmoothMin(usual, -HeelRise(side));
    constexpr float kFastest = 11.0f;  // rad/s
    foot.pitch += std::clamp(goal - foot.pitch, -kFastest * seconds_, kFastest * seconds_);
    Stand(side);
  }

  // Angle by which the heel of the foot left behind must rise for its leg to reach it; negative
  // while the leg has reach left.
  float HeelRise(int side) const {
    constexpr float kLowest = -1.0f, kHighest = 1.35f;  // radians
    const BodyRig::Leg& leg = Leg(side);
    const glm::vec3 hip = Root().Stage(body_.rest[static_cast<size_t>(leg.hip)].position);
    const Footprint& print = FootOf(side).print;
    const glm::vec3 way = hip - print.position;
    const glm::vec3 ahead = TurnY(print.heading) * glm::vec3(0.0f, 0.0f, -1.0f);
    if (glm::dot(way, ahead) <= 0.0f) {
      return kLowest;
    }
    const float length = 0.995f * (leg.upper_length + leg.lower_length);
    const float drop = body_.leg_length() * (0.02f + 0.055f * std::min(state_.amount, 1.25f));
    const float height = way.y - drop - leg.ankle_height;
    const float reached = std::sqrt(std::max(length * length - height * height, 0.0f));
    const float usual = 0.03f * body_.leg_length();  // The gait's own roll covers this.
    const float missing = glm::length(glm::vec2(way.x, way.z)) - reached - usual;
    return std::clamp(missing / (1.5f * -leg.ball.z), kLowest, kHighest);
  }

  // Sets the ankle of a planted foot; the toes stay on the floor while the heel is up.
  void Stand(int side) {
    Foot& foot = FootOf(side);
    foot.ankle = AnkleOver(side, foot.print, foot.pitch);
    foot.toe_bend = std::max(-foot.pitch, 0.0f);
  }

  // The foot rolls over its heel while the toes are up, and over its ball while they are down.
  glm::vec3 AnkleOver(int side, const Footprint& print, float pitch) const {
    const BodyRig::Leg& leg = Leg(side);
    const glm::vec3 pivot = pitch > 0.0f ? leg.heel : leg.ball;
    const glm::vec3 rolled =
        TurnX(pitch) * (glm::vec3(0.0f, leg.ankle_height, 0.0f) - pivot) + pivot;
    const glm::quat slope = TurnX(print.slope_pitch) * TurnZ(print.slope_roll);
    return print.position + TurnY(print.heading) * (slope * rolled);
  }

  void UpdateSwing(int side, float phase) {
    Foot& foot = FootOf(side);
    constexpr float kDecided = 0.85f;  // Share of the swing after which the goal is fixed.
    if (foot.swing < kDecided) {
      // Smooths the goal, because feet do not follow every change at once.
      const float share = foot.swing > 0.0f ? Approach(seconds_, 0.06f) : 1.0f;
      foot.goal = Mix(foot.goal, Goal(side), share);
    }
    foot.swing = std::clamp((phase - foot.lift_phase) / (1.0f - foot.lift_phase), 0.0f, 1.0f);
    const SwingPoint point = SwingAt(foot.swing);
    const float turned = glm::smoothstep(0.0f, 1.0f, foot.swing);
    const float landing = state_.amount * StancePitch(0.0f);
    foot.pitch = glm::mix(foot.lifted_pitch, landing, point.pitch);
    const float straightened = 1.0f - glm::smoothstep(0.0f, 0.4f, foot.swing);
    foot.toe_bend = straightened * std::max(-foot.lifted_pitch, 0.0f);
    const Footprint& from = foot.lifted_from;
    foot.print.position = glm::mix(from.position, foot.goal.position, point.progress);
    foot.print.heading = MixAngles(from.heading, foot.goal.heading, turned);
    foot.print.slope_pitch = glm::mix(from.slope_pitch, foot.goal.slope_pitch, turned);
    foot.print.slope_roll = glm::mix(from.slope_roll, foot.goal.slope_roll, turned);
    foot.ankle = SwingAnkle(side, foot);
  }

  // The ankle's path in swing. It starts with the velocity of the foot's roll-off and ends with the
  // velocity of its landing.
  glm::vec3 SwingAnkle(int side, const Foot& foot) const {
    constexpr float kStep = 0.02f;
    const float s = foot.swing, left = 1.0f - foot.swing;
    const float seconds = (1.0f - foot.lift_phase) / stride_.per_second;
    const glm::vec3 begins = (SwingPath(side, foot, kStep) - SwingPath(side, foot, 0.0f)) / kStep;
    const glm::vec3 ends =
        (SwingPath(side, foot, 1.0f) - SwingPath(side, foot, 1.0f - kStep)) / kStep;
    return SwingPath(side, foot, s) +
           s * left * left * left * left * (seconds * foot.lifted_velocity - begins) +
           left * s * s * s * s * (ends - seconds * LandingVelocity(side, foot.goal));
  }

  // Velocity of the ankle when the foot begins to roll over its heel.
  glm::vec3 LandingVelocity(int side, const Footprint& print) const {
    constexpr float kStep = 0.02f;  // share of the stance
    const float seconds = kStep * stride_.stance_share / stride_.per_second;
    return (AnkleOver(side, print, state_.amount * StancePitch(kStep)) -
            AnkleOver(side, print, state_.amount * StancePitch(0.0f))) /
           seconds;
  }

  glm::vec3 SwingPath(int side, const Foot& foot, float swing) const {
    const SwingPoint point = SwingAt(swing);
    const glm::vec3 to = AnkleOver(side, foot.goal, state_.amount * StancePitch(0.0f));
    glm::vec3 ankle = glm::mix(foot.lifted_ankle, to, point.progress);
    ankle.y = glm::mix(foot.lifted_ankle.y, to.y, swing) +
              body_.leg_length() * Rise(swing, point.height) + StepRise(foot, swing);
    return ankle;
  }

  // Height above the straight path in leg lengths, for a wide or a small step.
  float Rise(float swing, float height) const {
    const float wide = std::min(state_.amount, 1.0f);
    const float bump = std::pow(std::sin(kPiF * swing), 2.0f);
    return state_.style.lift * (wide * height + glm::mix(0.045f, 0.022f, wide) * bump);
  }

  // Raises the foot for a step up or down, so that it lands from above.
  static float StepRise(const Foot& foot, float swing) {
    const float step = std::abs(foot.goal.position.y - foot.lifted_from.position.y);
    return 0.6f * step * std::sin(kPiF * swing);
  }

  const BodyRig& body_;
  const FloorHeight& floor_;
  float seconds_;
  Locomotion& state_;
  float speed_ = 0.0f;
  Stride stride_;
};

// Measures velocity and turn rate, smoothed over a few ticks, because the motion of the root may be
// jerky.
void MeasureMotion(const glm::vec3& position, float heading, float seconds, Locomotion& state) {
  const glm::vec3 velocity = (position - state.position) / seconds;
  const float rate = std::remainder(heading - state.heading, 2.0f * kPiF) / seconds;
  const float share = Approach(seconds, 0.07f);
  const glm::vec3 before = state.velocity;
  state.velocity += share * (velocity - state.velocity);
  state.turn_rate += share * (rate - state.turn_rate);
  const glm::vec3 acceleration = (state.velocity - before) / seconds;
  state.acceleration += Approach(seconds, 0.15f) * (acceleration - state.acceleration);
}

Foot Mix(const Foot& a, const Foot& b, float t) {
  Foot mixed = b;
  mixed.print = Mix(a.print, b.print, t);
  mixed.ankle = glm::mix(a.ankle, b.ankle, t);
  mixed.pitch = glm::mix(a.pitch, b.pitch, t);
  mixed.toe_bend = glm::mix(a.toe_bend, b.toe_bend, t);
  return mixed;
}

}  // namespace

void UpdateLocomotion(const LocomotionModel& model,
                      const glm::vec3& position,
                      float heading,
                      float seconds,
                      const FloorHeight& floor,
                      Locomotion& state) {
  const bool jumps = !state.placed || glm::distance(position, state.position) > kTeleport;
  if (!jumps && seconds > 0.0f) {
    MeasureMotion(position, heading, seconds, state);
  }
  state.position = position;
  state.heading = heading;
  if (!model.body.walks()) {
    state.placed = true;
    return;
  }
  Walker walker(model.body, floor, seconds, state);
  if (jumps) {
    walker.Place();
  } else if (seconds > 0.0f) {
    walker.Update();
  }
}

Locomotion Interpolate(const Locomotion& previous, const Locomotion& current, float alpha) {
  if (!previous.placed || glm::distance(previous.position, current.position) > kTeleport) {
    return current;
  }
  Locomotion mixed = current;
  mixed.position = glm::mix(previous.position, current.position, alpha);
  mixed.heading = MixAngles(previous.heading, current.heading, alpha);
  mixed.velocity = glm::mix(previous.velocity, current.velocity, alpha);
  mixed.acceleration = glm::mix(previous.acceleration, current.acceleration, alpha);
  mixed.turn_rate = glm::mix(previous.turn_rate, current.turn_rate, alpha);
  mixed.amount = glm::mix(previous.amount, current.amount, alpha);
  mixed.settled = glm::mix(previous.settled, current.settled, alpha);
  if (std::abs(current.phase - previous.phase) < 0.1) {
    mixed.phase = glm::mix(previous.phase, current.phase, static_cast<double>(alpha));
  }
  for (size_t side = 0; side < 2; ++side) {
    mixed.feet[side] = Mix(previous.feet[side], current.feet[side], alpha);
  }
  return mixed;
}

}  // namespace lararium::human
