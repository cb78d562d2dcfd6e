#include "editor/import/model/model_placement.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <limits>

#include "editor/import/model/model_frame.h"
#include "shared/human/finite.h"

namespace lararium::import {
namespace {

constexpr float kLeast = 0.4f, kMost = 2.4f;  // Plausible height of a person, metres.
constexpr float kStature = 1.75f;             // Height in metres if nothing else determines it.
constexpr float kWellPlaced = 0.02f;  // A figure this close to the floor is not moved, metres.
// A figure whose hips are further from the origin is moved, metres.
constexpr float kFarOff = 0.25f;

glm::mat3 FindRotation(const ModelRig& rig, std::vector<std::string>& notes) {
  const auto frame = FindFigureFrame(rig.bones, rig.map, rig.is_posed);
  if (!frame) {  // Y up, facing +Z, as figures in glTF do.
    return glm::mat3(-1, 0, 0, 0, 1, 0, 0, 0, -1);
  }
  if (!frame->sides_fit_feet) {
    notes.push_back("its feet point backwards as left and right are named: check the bone map");
  }
  return frame->actor_from_scene;
}

bool IsLeg(int node, const ModelRig& rig, const SceneNodes& nodes) {
  for (const char* knee : {"r_knee", "l_knee"}) {
    const MappedBone* mapped = rig.map.Find(knee);
    if (mapped == nullptr) {
      return false;
    }
    const int top = rig.node_of_bone[mapped->bone];
    int up = node;
    while (up > top) {
      up = nodes.parents[static_cast<size_t>(up)];
    }
    if (up == top) {
      return true;
    }
  }
  return false;
}

struct Extent {
  float low = std::numeric_limits<float>::max();
  float high = std::numeric_limits<float>::lowest();
  bool has_legs = false;

  // If there are legs, only they extend downwards: a cloak may hang lower, and a spear may be
  // deeper.
  void Extend(float y, bool is_leg) {
    high = std::max(high, y);
    if (is_leg && !has_legs) {
      low = y;
      has_legs = true;
    }
    low = is_leg || !has_legs ? std::min(low, y) : low;
  }
};

// Extent along the Y axis of the actor, in units of the scene.
Extent FindExtent(const glm::mat3& rotation,
                  std::span<const Part> parts,
                  const ModelRig& rig,
                  const SceneNodes& nodes) {
  Extent extent;
  for (const Part& part : parts) {
    for (size_t v = 0; v < part.positions.size(); ++v) {
      extent.Extend((rotation * part.positions[v]).y,
                    IsLeg(part.influences[v][0].node, rig, nodes));
    }
  }
  for (size_t bone = 0; bone < rig.bones.size(); ++bone) {
    const float y = (rotation * rig.bones.positions[bone]).y;
    const bool is_leg = IsLeg(rig.node_of_bone[bone], rig, nodes);
    if (parts.empty()) {
      extent.Extend(y, is_leg);
    } else if (is_leg && !extent.has_legs) {
      extent.low = std::min(extent.low, y);  // The legs have no surface, as of a bust.
    }
  }
  return extent;
}

// Says it where a thing, or a figure that is not human, has a size that is hardly meant.
void TellSize(std::span<const Part> parts, float scale, std::vector<std::string>& notes) {
  constexpr float kLeastThing = 0.005f, kMostThing = 50.0f;
  glm::vec3 lower(std::numeric_limits<float>::max()), upper(-lower);
  for (const Part& part : parts) {
    for (const glm::vec3& position : part.positions) {
      lower = glm::min(lower, position);
      upper = glm::max(upper, position);
    }
  }
  const glm::vec3 size = scale * (upper - lower);
  const float metres = std::max({size.x, size.y, size.z});
  if (metres > 0.0f && (metres < kLeastThing || metres > kMostThing)) {
    char text[160];
    std::snprintf(text, sizeof(text),
                  "its longest side is %.4g m, as its file says; if that is not meant, scale it in "
                  "its program to metres",
                  static_cast<double>(metres));
    notes.emplace_back(text);
  }
}

bool IsPossible(float metres) { return metres > kLeast && metres < kMost; }

// The common unit, in metres, that gives the most likely height of a person; 0 if none gives a
// plausible one.
float LikeliestUnit(float height) {
  const auto far = [&](float unit) { return std::abs(std::log(unit * height / kStature)); };
  float best = 0.0f;
  for (const float unit : {1.0f, 0.01f, 0.001f, 0.0254f, 0.3048f}) {
    if (IsPossible(unit * height) && (best == 0.0f || far(unit) < far(best))) {
      best = unit;
    }
  }
  return best;
}

// Metres per unit for a figure of the given height. `has_unit` says that the file states a unit
// that may be correct.
float FindScale(
    float height, float stated, bool has_unit, bool is_human, std::vector<std::string>& notes) {
  if (!is_human || (has_unit && IsPossible(stated * height))) {
    return stated;
  }
  if (!has_unit) {
    return kStature / height;
  }
  if (const float unit = LikeliestUnit(height); unit > 0.0f) {
    notes.push_back("its unit is taken to be " + std::to_string(unit) + " m, for a height of " +
                    std::to_string(unit * height) + " m");
    return unit;
  }
  notes.push_back("no unit gives a possible height; it is made 1.75 m tall");
  return kStature / height;
}

}  // namespace

Result<glm::mat4> PlaceFigure(const ModelScene& model,
                              std::span<const Part> parts,
                              const ModelRig& rig,
                              std::optional<float> metres_per_unit,
                              std::vector<std::string>& notes) {
  const bool is_human = rig.map.IsHuman();
  const glm::mat3 rotation = FindRotation(rig, notes);
  const Extent extent = FindExtent(rotation, parts, rig, model.nodes);
  const float height = extent.high - extent.low;
  const bool may_be_flat = !is_human && !parts.empty();
  if (!(height > 0.0f || may_be_flat) || !std::isfinite(height)) {
    return Status::Error(model.place(), "the figure has no height", "export it again");
  }
  // A mesh has some unit, if only that of the format; captured motion may have none.
  const bool has_unit = model.HasUnits() || !parts.empty();
  const float scale =
      metres_per_unit ? *metres_per_unit
                      : FindScale(height, model.StatedMetresPerUnit(), has_unit, is_human, notes);
  glm::vec3 offset(0.0f);
  if (!is_human) {
    TellSize(parts, scale, notes);
  } else {
    const float floor = scale * extent.low;
    offset.y = std::abs(floor) < kWellPlaced ? 0.0f : -floor;
    const glm::vec3 hips =
        scale * (rotation * rig.bones.positions[rig.map.Find("humanoid_root")->bone]);
    if (std::hypot(hips.x, hips.z) > kFarOff) {
      offset.x = -hips.x;
      offset.z = -hips.z;
    }
  }
  const glm::mat4 actor_from_scene =
      glm::translate(glm::mat4(1.0f), offset) * glm::scale(glm::mat4(rotation), glm::vec3(scale));
  if (!human::Finite(actor_from_scene)) {
    return Status::Error(model.place(), "its size is not a number", "export the figure again");
  }
  return actor_from_scene;
}

}  // namespace lararium::import
