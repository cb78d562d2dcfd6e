#pragma once

// The image of a light probe as light from every direction of the stage, with importance
// sampling.

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "editor/bake/probe.h"

namespace lararium::bake {

class Environment {
 public:
  Environment(ProbeImage image, const ProbePlacement& placement);

  // Radiance from a unit direction in stage axes, interpolated between texels.
  glm::vec3 Radiance(const glm::vec3& direction) const;

  struct Sample {
    glm::vec3 direction = glm::vec3(0.0f, 1.0f, 0.0f);
    float density = 0.0f;  // Per steradian; 0 means no sample.
  };
  // Draws a direction with a density in proportion to the luminance of the texels. `random`
  // holds two numbers in [0, 1).
  Sample Draw(const glm::vec2& random) const;
  // The density with which Draw gives a direction, per steradian.
  float Density(const glm::vec3& direction) const;

 private:
  struct Texel {
    int column = 0;
    int row = 0;
  };
  Texel TexelOf(const glm::vec3& in_probe) const;
  float TexelDensity(const Texel& texel) const;

  ProbeImage image_;
  glm::quat stage_from_probe_;
  glm::quat probe_from_stage_;
  float scale_;
  std::vector<float> row_ends_;  // Cumulative power of the rows; the last entry is 1.
  // For each row, the cumulative power of its texels; the last is 1.
  std::vector<float> column_ends_;
};

}  // namespace lararium::bake
