#pragma once

// A probe's image as light from every direction of the stage, to be sampled.

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "editor/bake/probe.h"

namespace lararium::bake {

class Environment {
 public:
  Environment(ProbeImage image, const ProbePlacement& placement);

  // From a unit direction, stage axes: interpolated between texels.
  glm::vec3 Radiance(const glm::vec3& direction) const;

  struct Sample {
    glm::vec3 direction = glm::vec3(0.0f, 1.0f, 0.0f);
    float density = 0.0f;  // for each steradian; 0: no sample
  };
  // A direction with a density in proportion to the luminance of texels. random: two
  // numbers in [0, 1).
  Sample Draw(const glm::vec2& random) const;
  // The density with which Draw gives a direction.
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
  std::vector<float> row_ends_;     // cumulated power of rows, the last 1
  std::vector<float> column_ends_;  // of each row: cumulated power of its texels, the last 1
};

}  // namespace lararium::bake
