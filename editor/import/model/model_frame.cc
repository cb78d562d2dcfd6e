#include "editor/import/model/model_frame.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <string>

namespace lararium::import {
namespace {

// Cosine (26 degrees) within which a direction counts as an axis of the file.
constexpr float kMeant = 0.9f;

// The nearest axis of the file, or the direction itself if none is near.
glm::vec3 Snapped(const glm::vec3& direction) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(direction[axis]) > kMeant) {
      glm::vec3 snapped(0.0f);
      snapped[axis] = direction[axis] > 0.0f ? 1.0f : -1.0f;
      return snapped;
    }
  }
  return direction;
}

}  // namespace

std::optional<FigureFrame> FindFigureFrame(const Rig& rig, const BoneMap& map, bool is_posed) {
  if (!map.IsHuman()) {
    return std::nullopt;
  }
  const auto at = [&](const std::string& joint) { return rig.positions[map.Find(joint)->bone]; };
  const glm::vec3 rise = at("skullbase") - 0.5f * (at("r_ankle") + at("l_ankle"));
  const float height = glm::length(rise);
  if (!(height > 0.0f) || !std::isfinite(height)) {
    return std::nullopt;
  }
  const glm::vec3 up = Snapped(rise / height);
  glm::vec3 right(0.0f);
  for (const std::string joint : {"hip", "knee", "shoulder"}) {
    right += joint == "knee" && is_posed ? glm::vec3(0.0f) : at("r_" + joint) - at("l_" + joint);
  }
  right -= glm::dot(right, up) * up;
  if (!(glm::length(right) > 0.01f * height)) {
    return std::nullopt;
  }
  right = is_posed ? glm::normalize(right) : Snapped(glm::normalize(right));
  right = glm::normalize(right - glm::dot(right, up) * up);
  const glm::vec3 back = glm::cross(right, up);
  FigureFrame frame;
  frame.actor_from_scene = glm::transpose(glm::mat3(right, up, back));
  float forwards = 0.0f;
  for (const std::string side : {"r_", "l_"}) {
    if (map.Find(side + "midtarsal") != nullptr) {
      forwards -= glm::dot(at(side + "midtarsal") - at(side + "ankle"), back);
    }
  }
  frame.sides_fit_feet = forwards > -0.02f * height;
  return frame;
}

}  // namespace lararium::import
