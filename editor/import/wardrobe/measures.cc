#include "editor/import/wardrobe/measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "editor/import/wardrobe/draped.h"
#include "editor/import/wardrobe/shoulder_line.h"

namespace lararium::import {
namespace {

struct JointHeight {
  std::string_view measure;
  const char* joint;
};
constexpr JointHeight kHeights[] = {
    {"chest", "vt4"},     {"ribs", "vt10"},    {"waist", "vl1"},     {"loins", "vl5"},
    {"hip", "r_hip"},     {"knee", "r_knee"},  {"ankle", "r_ankle"}, {"shoulder_top", "r_shoulder"},
    {"elbow", "r_elbow"}, {"wrist", "r_wrist"}};
constexpr std::array<std::string_view, 15> kMeasures = {
    "chest",          "ribs",  "waist", "loins",  "hip",   "knee",     "ankle",    "shoulder_top",
    "shoulder_crest", "elbow", "wrist", "height", "girth", "shoulder", "upper_arm"};

// Height of the left shoulder, halfway to the neck.
float ShoulderCrest(const FittedBody& body, const PosedBody& standing) {
  const float side = 0.55f * JointPlace(body, standing, "l_shoulder").x;
  const std::vector<float> head = HeadShare(body);
  const std::vector<bool> is_body = IsBody(body);
  float top = 0.0f;
  for (size_t v = 0; v < standing.positions.size(); ++v) {
    const glm::vec3& p = standing.positions[v];
    if (is_body[v] && head[v] < 0.5f && std::abs(p.x - side) < 0.012f) {
      top = std::max(top, p.y);
    }
  }
  return top;
}

}  // namespace

std::span<const std::string_view> MeasureNames() { return kMeasures; }

Measures::Measures(const GarmentPattern& pattern,
                   const FittedBody& body,
                   const PosedBody& laid,
                   float above)
    : pattern_(pattern) {
  const PosedBody standing = PoseBody(body, StandingTurns(body, 1.0f));
  for (const JointHeight& height : kHeights) {
    const bool moves = height.measure == "elbow" || height.measure == "wrist";
    values_.emplace(height.measure, JointPlace(body, moves ? standing : laid, height.joint).y);
  }
  const glm::vec3 shoulder = JointPlace(body, laid, "r_shoulder");
  float girth = 0.0f;
  for (float y = Of("knee"); y < shoulder.y; y += 0.03f) {
    girth = std::max(girth, Girth(body, standing, y, 0.03f).Length());
  }
  values_.emplace("shoulder_crest", ShoulderCrest(body, standing));
  values_.emplace("height", body.height);
  values_.emplace("girth", girth);
  values_.emplace("shoulder", ShoulderLine(body, laid, above).LengthTo(shoulder.x));
  values_.emplace("upper_arm", glm::distance(shoulder, JointPlace(body, laid, "r_elbow")));
}

float Measures::Value(
    const Formula& formula, std::string_view what, float least, float most, float otherwise) const {
  if (formula.empty()) {
    return otherwise;
  }
  const float value = formula.Value([this](std::string_view name) { return ValueOf(name); });
  if (value >= least && value <= most) {
    return value;
  }
  if (error_.ok()) {
    error_ = Status::Error(
        pattern_.design->file.string(),
        std::string(what) + " is " + std::to_string(value) + " on this body",
        "write a formula from " + std::to_string(least) + " to " + std::to_string(most));
  }
  return std::isfinite(value) ? std::clamp(value, least, most) : least;
}

bool Measures::IsTrue(const Formula& formula, bool otherwise) const {
  return formula.empty()
             ? otherwise
             : formula.Value([this](std::string_view name) { return ValueOf(name); }) != 0.0f;
}

float Measures::ValueOf(std::string_view name) const {
  const auto known = values_.find(name);
  if (known != values_.end()) {
    return known->second;
  }
  const auto set = pattern_.numbers.find(name);
  if (set != pattern_.numbers.end()) {
    return set->second;
  }
  const auto size = pattern_.design->sizes.find(name);
  const float value = size->second.Value([this](std::string_view used) { return ValueOf(used); });
  values_.emplace(name, value);
  return value;
}

Dyer::Dyer(const GarmentPattern& pattern, const Measures& measures)
    : colour_(pattern.Colour(pattern.design->fabric.colour)),
      band_colour_(pattern.design->bands ? pattern.Colour(pattern.design->bands->colour) : colour_),
      soil_(measures.Value(pattern.design->fabric.soil, "fabric: soil", 0.0f, 1.0f)),
      soil_height_(pattern.design->fabric.soil_height) {}

glm::vec3 Dyer::At(bool band, float from_hem) const {
  const float soil = soil_ * std::clamp(1.0f - from_hem / soil_height_, 0.0f, 1.0f);
  return (band ? band_colour_ : colour_) * (1.0f - soil);
}

}  // namespace lararium::import
