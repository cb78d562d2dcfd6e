#pragma once

// How a probe lies on the stage: its rotation from directions that are known in both, its
// radiance from surfaces of known albedo.

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "shared/core/status.h"
#include "shared/light/probe_light.h"

namespace lararium::bake {

// The smallest rotation that takes one direction to another. Opposite ones: half a turn about
// an axis across.
glm::quat LeastRotation(const glm::vec3& from, const glm::vec3& to);

// Drags what the probe shows at a direction (its sun) to a direction of the stage, with the
// least motion. Unit vectors.
glm::quat DraggedTo(const glm::quat& stage_from_probe,
                    const glm::vec3& in_probe,
                    const glm::vec3& in_stage);
// The same about the vertical alone, for probes that were photographed level. Directions
// that are nearly vertical turn nothing.
glm::quat TurnedTo(const glm::quat& stage_from_probe,
                   const glm::vec3& in_probe,
                   const glm::vec3& in_stage);

struct DirectionPair {
  glm::vec3 in_probe = glm::vec3(0.0f);
  glm::vec3 in_stage = glm::vec3(0.0f);
};
struct DirectionMatch {
  glm::quat stage_from_probe = glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
  float residual = 0.0f;  // radians that each direction is off
};
// The rotation that takes both as near as can be, in least squares. Fails where they are
// less than five degrees apart.
Result<DirectionMatch> MatchDirections(const DirectionPair& first, const DirectionPair& second);

// A matte surface of known albedo on an image of the place.
struct GreyPatch {
  glm::vec3 linear = glm::vec3(0.0f);  // its pixels by the camera's response, R, G, B
  glm::vec3 gain = glm::vec3(1.0f);    // of that image (TrackedFrame::gain)
  glm::vec3 albedo = glm::vec3(0.18f);
  glm::vec3 normal = glm::vec3(0.0f, 1.0f, 0.0f);  // unit, stage axes
};
struct ScaleMatch {
  float scale = 1.0f;                   // by which the light is to be multiplied
  glm::vec3 balance = glm::vec3(1.0f);  // of channels beyond it, mean of logarithms 0
  float residual = 0.0f;                // RMS over patches and channels, in stops
};
// linear = gain albedo / pi irradiance scale, as least squares of logarithms. Nothing may
// shade the patches. Fails where a patch is black, clipped (0.98 and more) or unlit.
Result<ScaleMatch> MatchScale(const light::ProbeLight& light, std::span<const GreyPatch> patches);

}  // namespace lararium::bake
