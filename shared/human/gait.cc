#include "shared/human/gait.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "shared/human/turns.h"

namespace lararium::human {
namespace {

constexpr int kSamples = 20;  // one for each 5 % of the stride
constexpr int kHarmonics = 6;
using Samples = std::array<float, kSamples>;  // degrees

constexpr Samples kThigh = {20,  20,  18.5f, 14, 8,  2,  -3.5f, -9, -14, -18,
                            -20, -18, -10,   1,  11, 18, 23,    25, 24,  22};
constexpr Samples kKnee = {4,  11, 16, 18, 16, 13, 10, 8,  7,  8,
                           12, 23, 38, 53, 61, 61, 52, 37, 19, 6};
constexpr Samples kAnkle = {0, -5, -3,  1,   4,   6,  7.5f, 9, 10, 9,
                            4, -5, -15, -18, -13, -6, -2,   0, 0,  0};

class FourierCurve {
 public:
  explicit FourierCurve(const Samples& samples) {
    for (int h = 0; h <= kHarmonics; ++h) {
      const float scale = (h == 0 ? 1.0f : 2.0f) / static_cast<float>(kSamples);
      for (int i = 0; i < kSamples; ++i) {
        const float angle = 2.0f * kPiF * static_cast<float>(h * i) / static_cast<float>(kSamples);
        const float value = scale * glm::radians(samples[static_cast<size_t>(i)]);
        cosine_[static_cast<size_t>(h)] += value * std::cos(angle);
        sine_[static_cast<size_t>(h)] += value * std::sin(angle);
      }
    }
  }

  float At(float phase) const {
    float sum = 0.0f;
    for (size_t h = 0; h <= kHarmonics; ++h) {
      const float angle = 2.0f * kPiF * static_cast<float>(h) * phase;
      sum += cosine_[h] * std::cos(angle) + sine_[h] * std::sin(angle);
    }
    return sum;
  }

 private:
  std::array<float, kHarmonics + 1> cosine_ = {}, sine_ = {};
};

// Share of the stride in which the foot is on the floor in these curves.
constexpr float kCurveStance = 0.61f;
// Lengths of leg segments (Drillis & Contini, 1966, in Winter, 2009), as shares of the hip height.
constexpr float kThighLength = 0.245f / 0.53f;
constexpr float kShankLength = 0.246f / 0.53f;
// Constants of the flat foot through a stance, fitted to the curves: the line through the ankle's
// path against the hip between 3 % and 58 %, without the foot's roll.
constexpr float kStrideLength = 1.547f;
constexpr float kAheadShare = 0.333f;
constexpr float kHipRise = 0.02f;  // half of the hip's vertical motion

constexpr int kTableSize = 33;
template <typename T>
using Table = std::array<T, kTableSize>;

template <typename T>
struct PhaseBetween {
  const T& a;
  const T& b;
  float t;
};
template <typename T>
PhaseBetween<T> Lookup(const Table<T>& table, float x) {
  const float position = std::clamp(x, 0.0f, 1.0f) * (kTableSize - 1);
  const size_t first = std::min(static_cast<size_t>(position), size_t{kTableSize - 2});
  return {table[first], table[first + 1], position - static_cast<float>(first)};
}

template <typename T, typename F>
Table<T> Tabulate(const F& function) {
  Table<T> table;
  for (size_t i = 0; i < kTableSize; ++i) {
    table[i] = function(static_cast<float>(i) / (kTableSize - 1));
  }
  return table;
}

// Position of the ankle relative to the hip at phase 0: forward and up.
struct Planar {
  float forward, up;
};
Planar AnkleWay(float phase) {
  const float thigh = ThighInclination(phase);
  const float shank = thigh - KneeFlexion(phase);
  const float hip = kHipRise * std::cos(4.0f * kPiF * (phase - 0.8f));
  return {kThighLength * std::sin(thigh) + kShankLength * std::sin(shank) + kStrideLength * phase,
          hip - kThighLength * std::cos(thigh) - kShankLength * std::cos(shank)};
}

SwingPoint ComputeSwing(float swing) {
  const float phase = glm::mix(kCurveStance, 1.0f, swing);
  const Planar from = AnkleWay(kCurveStance), to = AnkleWay(1.0f), now = AnkleWay(phase);
  const float pitch_from = SolePitch(kCurveStance), pitch_to = SolePitch(1.0f);
  return {(now.forward - from.forward) / (to.forward - from.forward),
          now.up - glm::mix(from.up, to.up, swing),
          (SolePitch(phase) - pitch_from) / (pitch_to - pitch_from)};
}

// The sole meets the floor at 20 degrees and is flat after a ninth of the stride (Perry &
// Burnfield, 2010); the heel rises as in the curves.
float ComputeStancePitch(float stance) {
  constexpr float kFlat = 0.18f;  // share of the stance
  const float landing = glm::radians(20.0f) * (1.0f - glm::smoothstep(0.0f, kFlat, stance));
  const float rise = stance > kFlat ? std::min(SolePitch(kCurveStance * stance), 0.0f) : 0.0f;
  return landing + rise * glm::smoothstep(glm::radians(7.0f), glm::radians(16.0f), -rise);
}

}  // namespace

float ThighInclination(float phase) {
  static const FourierCurve curve(kThigh);
  return curve.At(phase);
}

float KneeFlexion(float phase) {
  static const FourierCurve curve(kKnee);
  return curve.At(phase);
}

float AnkleFlexion(float phase) {
  static const FourierCurve curve(kAnkle);
  return curve.At(phase);
}

float SolePitch(float phase) {
  return ThighInclination(phase) - KneeFlexion(phase) + AnkleFlexion(phase);
}

Stride StrideAt(
    float speed, float forwardness, float turn_rate, float leg_length, const GaitStyle& style) {
  constexpr float kGravity = 9.81f;
  constexpr float kWalkRatio = 0.838f;    // 6.4 mm per step a minute with legs of 0.9 m
  constexpr float kStepInPlace = 0.24f;   // strides per sqrt(leg length / g)
  constexpr float kTurnPerStride = 1.5f;  // radians per stride when turning on the spot
  const float clock = std::sqrt(kGravity / leg_length);
  const float pace = speed / std::sqrt(kGravity * leg_length);
  const float by_speed = 0.5f * kWalkRatio * std::sqrt(pace) * (1.0f + 0.7f * (1.0f - forwardness));
  const float on_the_spot = std::max(0.0f, 1.0f - pace / 0.1f);
  const float by_turn = std::min(std::abs(turn_rate) / (kTurnPerStride * clock), 0.42f);
  const float rate = std::clamp(style.cadence, 0.3f, 3.0f) *
                     std::max(by_speed, on_the_spot * std::max(kStepInPlace, by_turn));
  Stride stride;
  stride.per_second = rate * clock;
  // The stance is 62 % of the stride at a comfortable speed and less at higher speeds (Murray et
  // al., 1964, 1966).
  stride.stance_share = std::clamp(0.62f - 0.16f * (pace - 0.43f), 0.56f, 0.68f);
  const float length = rate > 0.0f ? pace / rate : 0.0f;
  const float begins = glm::smoothstep(0.02f, 0.12f, pace);
  const float walks = 0.25f + 0.75f * forwardness * forwardness;
  stride.amount = walks * std::min(begins * length / kStrideLength, 1.3f);
  const float rolls = forwardness * std::min(stride.amount, 1.1f);
  stride.ahead_share = glm::mix(0.5f, kAheadShare, rolls);
  return stride;
}

std::optional<GaitStyle> GaitStyleNamed(std::string_view name) {
  if (name == "grown" || name == "normal") return GaitStyle{};
  if (name == "tired") {
    return GaitStyle{
        .cadence = 0.88f, .stoop = 0.14f, .arm_swing = 0.55f, .sway = 1.2f, .lift = 0.75f};
  }
  if (name == "proud") {
    return GaitStyle{.cadence = 0.92f, .step_width = 1.1f, .arm_swing = 0.8f, .arm_spread = 0.06f};
  }
  if (name == "hurried") {
    return GaitStyle{.cadence = 1.15f, .step_width = 0.9f, .stoop = 0.07f, .arm_swing = 1.3f};
  }
  if (name == "child") return GaitStyle{.cadence = 1.06f, .arm_swing = 1.2f, .sway = 1.1f};
  if (name == "stout") {
    return GaitStyle{.cadence = 0.96f, .step_width = 1.35f, .arm_spread = 0.04f, .sway = 1.35f};
  }
  if (name == "old") {
    return GaitStyle{
        .cadence = 1.12f, .step_width = 1.15f, .stoop = 0.20f, .arm_swing = 0.6f, .lift = 0.7f};
  }
  return std::nullopt;
}

float StancePitch(float stance) {
  static const Table<float> table = Tabulate<float>(ComputeStancePitch);
  const auto at = Lookup(table, stance);
  return glm::mix(at.a, at.b, at.t);
}

SwingPoint SwingAt(float swing) {
  static const Table<SwingPoint> table = Tabulate<SwingPoint>(ComputeSwing);
  const auto at = Lookup(table, swing);
  return {glm::mix(at.a.progress, at.b.progress, at.t), glm::mix(at.a.height, at.b.height, at.t),
          glm::mix(at.a.pitch, at.b.pitch, at.t)};
}

}  // namespace lararium::human
