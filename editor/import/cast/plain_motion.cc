#include "editor/import/cast/plain_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <string>

#include "editor/import/cast/plain_skeleton.h"
#include "shared/core/units.h"

namespace lararium::import {
namespace {
constexpr float kKeysPerSecond = 30.0f;
constexpr int kRightSide = 0, kLeft = 1;

glm::quat TurnX(float angle) { return glm::angleAxis(angle, glm::vec3(1, 0, 0)); }
glm::quat TurnY(float angle) { return glm::angleAxis(angle, glm::vec3(0, 1, 0)); }
glm::quat TurnZ(float angle) { return glm::angleAxis(angle, glm::vec3(0, 0, 1)); }
// +1 to the right, -1 to the left.
float SideSign(int side) { return side == kRightSide ? 1.0f : -1.0f; }
std::string SideName(int side, const char* joint) {
  return (side == kRightSide ? "r_" : "l_") + std::string(joint);
}

// ---- From a posture to a pose ----

// The posture that a clip defines; the legs follow from the pelvis and the feet. Rotations turn
// segments from their rest orientation in the actor frame, those of the arms in the frame of
// the thorax.
struct Posture {
  struct Arm {
    glm::quat upper, fore;
    float finger_curl = 0.25f;
  };
  struct Foot {
    glm::vec3 ankle;
    glm::quat rotation;
    glm::quat toes;
  };
  glm::vec3 pelvis_position = glm::vec3(0.0f);  // Position of humanoid_root.
  glm::quat pelvis = TurnX(0), thorax = TurnX(0), head = TurnX(0);
  float shoulder_lift = 0.0f;
  std::array<Arm, 2> arms;
  std::array<Foot, 2> feet;
};

// An arm that hangs beside the trunk, swung forwards, with a bent elbow.
Posture::Arm HangingArm(int side, float swing, float elbow) {
  constexpr float kUpperInwards = 0.40f, kForeInwards = 0.38f;
  return {TurnX(swing) * TurnZ(-SideSign(side) * kUpperInwards),
          TurnX(swing + elbow) * TurnZ(-SideSign(side) * kForeInwards)};
}

// The rotation that takes the rest direction of a hinged segment to `direction`, and the x axis
// of the actor to the hinge.
glm::quat HingeRotation(const glm::vec3& rest, const glm::vec3& direction, const glm::vec3& hinge) {
  const auto basis = [](const glm::vec3& along, const glm::vec3& x) {
    const glm::vec3 a = glm::normalize(along);
    const glm::vec3 h = glm::normalize(x - glm::dot(x, a) * a);
    return glm::mat3(h, a, glm::cross(h, a));
  };
  return glm::quat_cast(basis(direction, hinge) *
                        glm::transpose(basis(rest, glm::vec3(1.0f, 0.0f, 0.0f))));
}

class PoseMaker {
 public:
  explicit PoseMaker(const human::Skeleton& skeleton)
      : skeleton_(skeleton), rotations_(skeleton.size()), pose_(skeleton.rest) {}

  glm::vec3 Rest(const std::string& joint) const { return RestPosition(skeleton_, joint); }
  float LegLength() const {
    return glm::distance(Rest("r_hip"), Rest("r_knee")) +
           glm::distance(Rest("r_knee"), Rest("r_ankle"));
  }
  glm::vec3 HipPosition(const Posture& posture, int side) const {
    return posture.pelvis_position +
           posture.pelvis * (Rest(SideName(side, "hip")) - Rest("humanoid_root"));
  }

  std::vector<human::JointTransform> Make(const Posture& posture) {
    std::fill(rotations_.begin(), rotations_.end(), glm::quat(1, 0, 0, 0));
    SetTrunk(posture);
    std::array<float, 2> thigh_angles;
    for (const int side : {kRightSide, kLeft}) {
      SetArm(posture, side);
      thigh_angles[side] = SetLeg(posture, side);
    }
    SetSkirt(posture.pelvis, thigh_angles);
    for (size_t i = 0; i < skeleton_.size(); ++i) {
      const int16_t parent = skeleton_.parents[i];
      pose_[i].rotation = parent == human::Skeleton::kNoParent
                              ? rotations_[i]
                              : glm::normalize(glm::inverse(rotations_[parent]) * rotations_[i]);
    }
    pose_[IndexOfJoint(skeleton_, "humanoid_root")].translation = posture.pelvis_position;
    return pose_;
  }

 private:
  void Set(const std::string& joint, const glm::quat& rotation) {
    rotations_[IndexOfJoint(skeleton_, joint)] = rotation;
  }

  void SetTrunk(const Posture& posture) {
    Set("humanoid_root", posture.pelvis);
    Set("sacroiliac", posture.pelvis);
    Set("vl5", glm::slerp(posture.pelvis, posture.thorax, 0.35f));
    Set("vt10", glm::slerp(posture.pelvis, posture.thorax, 0.75f));
    Set("vt4", posture.thorax);
    Set("vc4", glm::slerp(posture.thorax, posture.head, 0.5f));
    Set("skullbase", posture.head);
  }

  void SetArm(const Posture& posture, int side) {
    const Posture::Arm& arm = posture.arms[side];
    const float sign = SideSign(side);
    const glm::quat fore = posture.thorax * arm.fore;
    Set(SideName(side, "sternoclavicular"), posture.thorax * TurnZ(sign * posture.shoulder_lift));
    Set(SideName(side, "shoulder"), posture.thorax * arm.upper);
    Set(SideName(side, "elbow"), fore);
    Set(SideName(side, "wrist"), fore);
    Set(SideName(side, "thumb1"), fore);
    Set(SideName(side, "middle1"), fore * TurnZ(-sign * arm.finger_curl));
  }

  // Two-segment inverse kinematics with the knee forwards. Returns the angle by which the thigh
  // is raised forwards relative to the pelvis.
  float SetLeg(const Posture& posture, int side) {
    const Posture::Foot& foot = posture.feet[side];
    const glm::vec3 hip_rest = Rest(SideName(side, "hip"));
    const glm::vec3 knee_rest = Rest(SideName(side, "knee"));
    const glm::vec3 ankle_rest = Rest(SideName(side, "ankle"));
    const float thigh = glm::distance(hip_rest, knee_rest);
    const float shank = glm::distance(knee_rest, ankle_rest);
    const glm::vec3 hip = HipPosition(posture, side);
    const glm::vec3 reach = foot.ankle - hip;
    const float distance = std::min(glm::length(reach), 0.9995f * (thigh + shank));
    const glm::vec3 direction = glm::normalize(reach);
    const float along = (thigh * thigh - shank * shank + distance * distance) / (2.0f * distance);
    const float bulge = std::sqrt(std::max(thigh * thigh - along * along, 0.0f));
    const glm::vec3 forward = posture.pelvis * glm::vec3(0.0f, 0.0f, -1.0f);
    const glm::vec3 pole = glm::normalize(forward - glm::dot(forward, direction) * direction);
    const glm::vec3 knee = hip + along * direction + bulge * pole;
    const glm::vec3 hinge = glm::cross(pole, -direction);
    Set(SideName(side, "hip"), HingeRotation(knee_rest - hip_rest, knee - hip, hinge));
    Set(SideName(side, "knee"),
        HingeRotation(ankle_rest - knee_rest, hip + distance * direction - knee, hinge));
    Set(SideName(side, "ankle"), foot.rotation);
    Set(SideName(side, "midtarsal"), foot.toes);
    const glm::vec3 thigh_in_pelvis = glm::inverse(posture.pelvis) * (knee - hip);
    return std::atan2(-thigh_in_pelvis.z, -thigh_in_pelvis.y);
  }

  // The cloth hangs, except where a thigh pushes it outwards.
  void SetSkirt(const glm::quat& pelvis, const std::array<float, 2>& thigh_angles) {
    const float mean = 0.5f * (thigh_angles[0] + thigh_angles[1]);
    const auto larger = [](float a, float b) {
      constexpr float kSoftness = 0.08f;  // radians
      return 0.5f * (a + b + std::sqrt((a - b) * (a - b) + kSoftness * kSoftness));
    };
    std::array<float, 2> front, back;
    for (const int side : {kRightSide, kLeft}) {
      front[side] = larger(larger(thigh_angles[side], mean), 0.0f);
      back[side] = -larger(larger(-thigh_angles[side], -mean), 0.0f);
    }
    const float angles[6] = {
        front[kRightSide], 0.5f * (front[kRightSide] + back[kRightSide]), back[kRightSide],
        back[kLeft],       0.5f * (front[kLeft] + back[kLeft]),           front[kLeft]};
    for (int i = 0; i < 6; ++i) {
      Set(kSkirtJoints[i], pelvis * TurnX(angles[i]));
    }
  }

  const human::Skeleton& skeleton_;
  std::vector<glm::quat> rotations_;  // actor_from_joint.
  std::vector<human::JointTransform> pose_;
};

human::Clip MakeClip(const human::Skeleton& skeleton,
                     const std::string& name,
                     float duration,
                     bool loops,
                     const std::function<Posture(float time)>& posture) {
  human::Clip clip;
  clip.name = name;
  clip.duration = duration;
  clip.loops = loops;
  clip.keys_per_second = kKeysPerSecond;
  PoseMaker maker(skeleton);
  const int intervals = static_cast<int>(std::lround(duration * kKeysPerSecond));
  for (int key = 0; key <= intervals; ++key) {
    const int source = loops ? key % intervals : key;
    const auto pose = maker.Make(posture(static_cast<float>(source) / kKeysPerSecond));
    clip.keys.insert(clip.keys.end(), pose.begin(), pose.end());
  }
  return clip;
}

// ---- Walking ----

// The forward inclination of the thigh and the flexion of knee and ankle over a stride that
// begins with the contact of the heel, in degrees at every 5 %. They were set by hand to the
// landmarks of normal gait (peaks and zero crossings by phase, as in Perry & Burnfield, "Gait
// Analysis: Normal and Pathological Function", 2010), and are not the tabulated means of a
// study.
constexpr int kGaitSamples = 20;
using GaitCurve = std::array<float, kGaitSamples>;
constexpr GaitCurve kThighInclination = {20,  20,  18.5f, 14, 8,  2,  -3.5f, -9, -14, -18,
                                         -20, -18, -10,   1,  11, 18, 23,    25, 24,  22};
constexpr GaitCurve kKneeFlexion = {4,  11, 16, 18, 16, 13, 10, 8,  7,  8,
                                    12, 23, 38, 53, 61, 61, 52, 37, 19, 6};
constexpr GaitCurve kAnkleFlexion = {0, -5, -3,  1,   4,   6,  7.5f, 9, 10, 9,
                                     4, -5, -15, -18, -13, -6, -2,   0, 0,  0};
constexpr float kStrideSeconds = 1.1f;
constexpr float kClearance = 0.042f;  // Height by which the swinging foot is raised, metres.
constexpr float kToeOff = 0.61f;      // Share of the stride at which the foot leaves the floor.

// Interpolates the curve at a phase (any real number, period 1) by Catmull-Rom splines;
// radians.
float GaitAngle(const GaitCurve& curve, float phase) {
  const float position = (phase - std::floor(phase)) * kGaitSamples;
  const int first = static_cast<int>(position) % kGaitSamples;
  const float t = position - std::floor(position);
  const auto value = [&](int i) { return curve[(first + i + kGaitSamples) % kGaitSamples]; };
  const float a = value(-1), b = value(0), c = value(1), d = value(2);
  const float degrees =
      b + 0.5f * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
  return glm::radians(degrees);
}

class Walk {
 public:
  explicit Walk(const human::Skeleton& skeleton) : maker_(skeleton) {
    FitStride();
    FitHeight();
  }

  float stride() const { return stride_; }

  Posture At(float time) const {
    const float phase = time / kStrideSeconds;
    const float turn = 2.0f * kPiF * phase;
    Posture posture = Pelvis(phase);
    const float twist = 0.065f * std::cos(turn);
    posture.thorax = TurnY(-twist) * TurnX(-0.045f) * TurnZ(0.015f * std::cos(turn));
    posture.head = TurnY(-0.2f * twist) * TurnX(-0.03f + 0.01f * std::cos(2.0f * turn));
    for (const int side : {kRightSide, kLeft}) {
      const float own = phase + (side == kRightSide ? 0.0f : 0.5f);
      posture.feet[side] = FootAt(own, side, Hip(posture, side));
      const float swing = -std::cos(2.0f * kPiF * own);
      posture.arms[side] = HangingArm(side, -0.07f + 0.34f * swing,
                                      0.30f + 0.17f * std::cos(2.0f * kPiF * (own - 0.55f)));
    }
    return posture;
  }

 private:
  struct Planar {
    float forward, up;
  };

  Posture Pelvis(float phase) const {
    const float turn = 2.0f * kPiF * phase;
    Posture posture;
    posture.pelvis_position = maker_.Rest("humanoid_root");
    posture.pelvis_position.x += 0.018f * std::cos(turn - 2.0f * kPiF * 0.3f);
    posture.pelvis_position.y = height_ + 0.010f * std::cos(2.0f * (turn - 2.0f * kPiF * 0.25f));
    posture.pelvis =
        TurnY(0.075f * std::cos(turn)) * TurnZ(0.055f * std::cos(turn - 0.9f)) * TurnX(-0.03f);
    return posture;
  }

  glm::vec3 Hip(const Posture& posture, int side) const {
    return maker_.HipPosition(posture, side);
  }

  // Toes up is positive. Small angles are removed, so that the foot stands flat.
  static float FootPitch(float phase) {
    const float pitch = GaitAngle(kThighInclination, phase) - GaitAngle(kKneeFlexion, phase) +
                        GaitAngle(kAnkleFlexion, phase);
    return pitch * glm::smoothstep(glm::radians(4.0f), glm::radians(14.0f), std::abs(pitch));
  }

  // Position of the ankle below the hip from the joint angles alone.
  Planar AnkleFromAngles(float phase) const {
    const float thigh = glm::distance(maker_.Rest("r_hip"), maker_.Rest("r_knee"));
    const float shank = glm::distance(maker_.Rest("r_knee"), maker_.Rest("r_ankle"));
    const float a = GaitAngle(kThighInclination, phase);
    const float b = a - GaitAngle(kKneeFlexion, phase);
    return {thigh * std::sin(a) + shank * std::sin(b), -thigh * std::cos(a) - shank * std::cos(b)};
  }

  // Movement of the ankle when the planted foot rolls: over the heel while the toes are up,
  // over the ball while the heel is up.
  Planar Rocker(float pitch) const {
    const glm::vec3 ankle = maker_.Rest("r_ankle");
    const glm::vec3 heel(ankle.x, 0.0f, 0.060f);
    const glm::vec3 pivot = pitch > 0.0f ? heel : maker_.Rest("r_midtarsal");
    const glm::vec3 moved = TurnX(pitch) * (ankle - pivot) + pivot - ankle;
    return {-moved.z, moved.y};
  }

  // The flat foot moves backwards uniformly while it stands. The line that fits the angles best
  // gives the stride and the position where the foot lands.
  void FitStride() {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (float phase = 0.03f; phase < 0.58f; phase += 0.01f) {
      const double forward = AnkleFromAngles(phase).forward - Rocker(FootPitch(phase)).forward;
      n += 1, x += phase, y += forward, xx += phase * phase, xy += phase * forward;
    }
    const double slope = (n * xy - x * y) / (n * xx - x * x);
    stride_ = static_cast<float>(-slope);
    landing_ = static_cast<float>((y - slope * x) / n);
  }

  // Raises the pelvis as high as almost straight legs allow.
  void FitHeight() {
    const float length = 0.9985f * maker_.LegLength();
    height_ = 0.0f;
    float highest = 10.0f;
    for (float phase = 0.0f; phase < kToeOff; phase += 0.01f) {
      const glm::vec3 hip = Hip(Pelvis(phase), kRightSide);
      const glm::vec3 ankle = Standing(phase, kRightSide);
      const float across = ankle.x - hip.x, along = ankle.z - hip.z;
      const float rise = std::sqrt(length * length - across * across - along * along);
      highest = std::min(highest, ankle.y + rise - hip.y);
    }
    height_ = highest;
  }

  static float Lateral(int side) { return 0.066f * SideSign(side); }

  // The ankle of a foot on the floor; `phase` may exceed the stance.
  glm::vec3 Standing(float phase, int side) const {
    const Planar roll = Rocker(FootPitch(phase));
    return {Lateral(side), maker_.Rest("r_ankle").y + roll.up,
            -(landing_ - stride_ * phase + roll.forward)};
  }

  // In swing the joint angles give the path, which is moved so that it leaves the floor and
  // lands where the stance ends and begins.
  glm::vec3 Swinging(float phase, int side, const glm::vec3& hip) const {
    const auto free = [&](float at, const glm::vec3& from) {
      const Planar ankle = AnkleFromAngles(at);
      return glm::vec3(Lateral(side), from.y + ankle.up, from.z - ankle.forward);
    };
    const float leave = kToeOff + (side == kRightSide ? 0.0f : 0.5f);
    const float land = side == kRightSide ? 0.0f : 0.5f;
    const glm::vec3 at_leave = Standing(kToeOff, side) - free(kToeOff, Hip(Pelvis(leave), side));
    const glm::vec3 at_land = Standing(0.0f, side) - free(0.0f, Hip(Pelvis(land), side));
    const float t = (phase - kToeOff) / (1.0f - kToeOff);
    return free(phase, hip) + glm::mix(at_leave, at_land, glm::smoothstep(0.0f, 1.0f, t)) +
           glm::vec3(0.0f, kClearance * std::pow(std::sin(kPiF * t), 2.0f), 0.0f);
  }

  Posture::Foot FootAt(float own_phase, int side, const glm::vec3& hip) const {
    const float phase = own_phase - std::floor(own_phase);
    const float pitch = FootPitch(phase);
    const glm::quat turned_out = TurnY(-0.09f * SideSign(side));
    Posture::Foot foot;
    foot.ankle = phase < kToeOff ? Standing(phase, side) : Swinging(phase, side, hip);
    foot.rotation = turned_out * TurnX(pitch);
    // The toes stay on the floor until they leave it, then straighten.
    const float bend = std::min(pitch, 0.0f) * (1.0f - glm::smoothstep(kToeOff, 0.78f, phase));
    foot.toes = foot.rotation * TurnX(-bend);
    return foot;
  }

  PoseMaker maker_;
  float stride_ = 0.0f;   // metres
  float landing_ = 0.0f;  // Metres by which the ankle of the flat foot lands before the hip.
  float height_ = 0.0f;   // Height of the pelvis.
};

human::Clip MakeWalk(const human::Skeleton& skeleton) {
  const Walk walk(skeleton);
  human::Clip clip =
      MakeClip(skeleton, "walk", kStrideSeconds, true, [&](float time) { return walk.At(time); });
  clip.stride = walk.stride();
  return clip;
}

// ---- Standing ----

// Stands on both feet and breathes: two breaths and a slow shift of weight, all with a period
// of eight seconds.
Posture Stand(const PoseMaker& maker, float time) {
  const float slow = 2.0f * kPiF * time / 8.0f;
  const float breath = std::sin(2.0f * slow);
  Posture posture;
  posture.pelvis_position = maker.Rest("humanoid_root");
  posture.pelvis_position +=
      glm::vec3(0.014f * std::sin(slow), -0.010f + 0.002f * std::cos(2 * slow),
                0.004f * std::sin(slow + 1.0f));
  posture.pelvis = TurnZ(0.022f * std::sin(slow)) * TurnY(0.02f * std::sin(slow + 0.5f));
  posture.thorax = TurnX(0.014f * breath) * TurnZ(-0.012f * std::sin(slow));
  posture.head =
      TurnY(0.09f * std::sin(slow + 1.2f)) * TurnX(-0.03f + 0.025f * std::sin(2.0f * slow + 0.4f));
  posture.shoulder_lift = 0.012f * breath;
  for (const int side : {kRightSide, kLeft}) {
    const float sign = SideSign(side);
    posture.arms[side] = HangingArm(side, -0.02f + 0.015f * std::sin(slow + sign),
                                    0.16f + 0.02f * std::sin(2.0f * slow + sign));
    const glm::quat turned_out = TurnY(-0.14f * sign);
    glm::vec3 ankle = maker.Rest(SideName(side, "ankle"));
    ankle.z += 0.015f * sign;
    posture.feet[side] = {ankle, turned_out, turned_out};
  }
  return posture;
}

human::Clip MakeIdle(const human::Skeleton& skeleton) {
  const PoseMaker maker(skeleton);
  return MakeClip(skeleton, "idle", 8.0f, true, [&](float time) { return Stand(maker, time); });
}

human::Clip MakeLookAround(const human::Skeleton& skeleton) {
  const PoseMaker maker(skeleton);
  return MakeClip(skeleton, "look_around", 8.0f, true, [&](float time) {
    Posture posture = Stand(maker, time);
    const float slow = 2.0f * kPiF * time / 8.0f;
    const float look = std::tanh(2.5f * std::sin(slow));  // Rests at either side.
    posture.thorax = TurnY(0.22f * look) * posture.thorax;
    posture.head = TurnY(0.75f * look) * TurnX(0.06f * std::sin(2.0f * slow)) * posture.head;
    return posture;
  });
}

human::Clip MakeWave(const human::Skeleton& skeleton) {
  constexpr float kSeconds = 3.2f;
  const PoseMaker maker(skeleton);
  return MakeClip(skeleton, "wave", kSeconds, false, [&](float time) {
    Posture posture = Stand(maker, time);
    const float raised =
        glm::smoothstep(0.0f, 0.7f, time) * glm::smoothstep(kSeconds, kSeconds - 0.8f, time);
    const float waving = 0.32f * std::sin(2.0f * kPiF * 1.9f * time);
    Posture::Arm& arm = posture.arms[kRightSide];
    arm.upper = glm::slerp(arm.upper, TurnX(0.45f) * TurnZ(0.75f), raised);
    arm.fore = glm::slerp(arm.fore, TurnX(0.25f) * TurnZ(2.45f + waving), raised);
    arm.finger_curl = glm::mix(0.25f, -0.1f, raised);
    posture.shoulder_lift += 0.12f * raised;
    posture.head = TurnY(-0.12f * raised) * posture.head;
    return posture;
  });
}

}  // namespace

std::vector<human::Clip> PlainClips(const human::Skeleton& skeleton) {
  return {MakeWalk(skeleton), MakeIdle(skeleton), MakeLookAround(skeleton), MakeWave(skeleton)};
}

}  // namespace lararium::import
