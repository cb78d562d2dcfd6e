#pragma once

// Aligns a probe with the stage: its rotation from directions that are known in both, its
// radiance from surfaces of known albedo.

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "shared/core/status.h"
#include "shared/light/probe_light.h"

namespace lararium::bake {

// The smallest rotation that takes one direction to another. For opposite directions it is half
// a turn about a perpendicular axis.
glm::quat LeastRotation(const glm::vec3& from, const glm::vec3& to);

// Turns the probe by the least rotation so that the direction `in_probe` (its sun, for example)
// comes to `in_stage`. Unit vectors.
glm::quat DraggedTo(const glm::quat& stage_from_probe,
                    const glm::vec3& in_probe,
                    const glm::vec3& in_stage);
// Does the same about the vertical axis only, for probes that were photographed level. Nearly
// vertical directions cause no rotation.
glm::quat TurnedTo(const glm::quat& stage_from_probe,
                   const glm::vec3& in_probe,
                   const glm::vec3& in_stage);

struct DirectionPair {
  glm::vec3 in_probe = glm::vec3(0.0f);
  glm::vec3 in_stage = glm::vec3(0.0f);
};
struct DirectionMatch {
  glm::quat stage_from_probe = glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
  float residual = 0.0f;  // Error of each direction, in radians.
};
// The least-squares rotation that takes both directions to the stage. Fails if they are less
// than five degrees apart.
Result<DirectionMatch> MatchDirections(const DirectionPair& first, const DirectionPair& second);

// A matte surface of known albedo in an image of the place.
struct GreyPatch {
  // Its pixels, linearised by the response of the camera, R, G, B.
  glm::vec3 linear = glm::vec3(0.0f);
  glm::vec3 gain = glm::vec3(1.0f);  // Gain of that image (`TrackedFrame::gain`).
  glm::vec3 albedo = glm::vec3(0.18f);
  glm::vec3 normal = glm::vec3(0.0f, 1.0f, 0.0f);  // unit, stage axes
};
struct ScaleMatch {
  float scale = 1.0f;  // Factor to apply to the light.
  // Remaining factors of the channels; their logarithms have mean 0.
  glm::vec3 balance = glm::vec3(1.0f);
  float residual = 0.0f;  // RMS over patches and channels, in stops.
};
// Fits linear = gain albedo / pi irradiance scale by least squares of logarithms. The patches
// must not be in shadow. Fails if a patch is black, clipped (0.98 or more) or unlit.
Result<ScaleMatch> MatchScale(const light::ProbeLight& light, std::span<const GreyPatch> patches);

}  // namespace lararium::bake
