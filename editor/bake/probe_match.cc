#include "editor/bake/probe_match.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "shared/core/units.h"

namespace lararium::bake {
namespace {

// Columns: the bisector of two directions, their difference, and the normal of their plane.
glm::mat3 FrameOf(const glm::vec3& a, const glm::vec3& b) {
  const glm::vec3 middle = glm::normalize(a + b);
  const glm::vec3 across = glm::normalize(a - b);
  return {middle, across, glm::cross(middle, across)};
}

float Angle(const glm::vec3& a, const glm::vec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

glm::quat LeastRotation(const glm::vec3& from, const glm::vec3& to) {
  const float cosine = glm::dot(from, to);
  if (cosine < -0.99999f) {
    const glm::vec3 other =
        std::abs(from.x) < 0.6f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
    const glm::vec3 axis = glm::normalize(glm::cross(from, other));
    return {0.0f, axis.x, axis.y, axis.z};
  }
  const glm::vec3 axis = glm::cross(from, to);
  return glm::normalize(glm::quat(1.0f + cosine, axis.x, axis.y, axis.z));
}

glm::quat DraggedTo(const glm::quat& stage_from_probe,
                    const glm::vec3& in_probe,
                    const glm::vec3& in_stage) {
  return glm::normalize(LeastRotation(stage_from_probe * in_probe, in_stage) * stage_from_probe);
}

glm::quat TurnedTo(const glm::quat& stage_from_probe,
                   const glm::vec3& in_probe,
                   const glm::vec3& in_stage) {
  glm::vec3 now = stage_from_probe * in_probe;
  glm::vec3 wanted = in_stage;
  now.y = 0.0f;
  wanted.y = 0.0f;
  if (std::min(glm::length(now), glm::length(wanted)) < 0.05f) {
    return stage_from_probe;
  }
  const float angle = std::atan2(glm::cross(now, wanted).y, glm::dot(now, wanted));
  return glm::normalize(glm::angleAxis(angle, glm::vec3(0.0f, 1.0f, 0.0f)) * stage_from_probe);
}

// For two vectors of equal weight the best rotation aligns the bisectors and the planes.
Result<DirectionMatch> MatchDirections(const DirectionPair& first, const DirectionPair& second) {
  constexpr float kLeast = 0.0873f;
  const float in_probe = Angle(first.in_probe, second.in_probe);
  const float in_stage = Angle(first.in_stage, second.in_stage);
  if (!(std::min(in_probe, in_stage) > kLeast && std::max(in_probe, in_stage) < kPiF - kLeast)) {
    return Status::Error("directions of the probe",
                         "the two are nearly the same, or opposite to one another",
                         "choose two that are far apart");
  }
  const glm::mat3 rotation = FrameOf(first.in_stage, second.in_stage) *
                             glm::transpose(FrameOf(first.in_probe, second.in_probe));
  return DirectionMatch{glm::normalize(glm::quat_cast(rotation)),
                        0.5f * std::abs(in_probe - in_stage)};
}

Result<ScaleMatch> MatchScale(const light::ProbeLight& light, std::span<const GreyPatch> patches) {
  constexpr const char* kPlace = "grey surface";
  constexpr float kClipped = 0.98f;
  if (patches.empty()) {
    return Status::Error(kPlace, "no patch was picked");
  }
  glm::dvec3 sum(0.0);
  std::vector<glm::dvec3> logs;
  for (size_t i = 0; i < patches.size(); ++i) {
    const GreyPatch& patch = patches[i];
    const glm::vec3 expected =
        patch.gain * patch.albedo * light.Irradiance(patch.normal) / std::numbers::pi_v<float>;
    for (int c = 0; c < 3; ++c) {
      if (!(patch.linear[c] > 0.002f && patch.linear[c] < kClipped)) {
        return Status::Error(kPlace, "pick " + std::to_string(i + 1) + " is black or clipped there",
                             "pick a surface of medium brightness");
      }
      if (!(expected[c] > 1e-7f) || !std::isfinite(expected[c])) {
        return Status::Error(kPlace,
                             "the probe does not light pick " + std::to_string(i + 1) +
                                 ", or its "
                                 "albedo or gain is 0",
                             "check the normal and the probe's rotation");
      }
    }
    logs.push_back(glm::log(glm::dvec3(patch.linear)) - glm::log(glm::dvec3(expected)));
    sum += logs.back();
  }
  const glm::dvec3 of_channel = sum / static_cast<double>(patches.size());
  const double mean = (of_channel.r + of_channel.g + of_channel.b) / 3.0;
  double squares = 0.0;
  for (const glm::dvec3& log : logs) {
    const glm::dvec3 off = log - mean;
    squares += glm::dot(off, off);
  }
  ScaleMatch match;
  match.scale = static_cast<float>(std::exp(mean));
  match.balance = glm::vec3(glm::exp(of_channel - mean));
  match.residual = static_cast<float>(
      std::sqrt(squares / (3.0 * static_cast<double>(logs.size()))) / std::numbers::ln2);
  return match;
}

}  // namespace lararium::bake
