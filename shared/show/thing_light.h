#pragma once

// Lights objects: a prop with baked light transfer is lit like a person (person_light.h), as a
// figure whose joints are the prop's parts. An object in constant light is not lit again in each
// frame.

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <vector>

#include "shared/human/human.h"
#include "shared/light/lamp.h"
#include "shared/light/spherical_harmonics.h"
#include "shared/stage/prop.h"

namespace lararium::show {

// The figure of a prop. It has light transfer only if the prop has, but always has blockers.
std::shared_ptr<human::Human> FigureOf(const stage::Prop& prop);

// The figure's skin matrices; its actor frame is that of the first part. Hidden parts are moved
// very far away, where they block no light.
void SkinOfFigure(std::span<const glm::mat4> stage_from_part,
                  std::span<const uint8_t> shown,
                  std::span<glm::mat4> skin);

// Remembers the conditions under which one object was last lit.
class ThingMemory {
 public:
  // radius: of a sphere around the object's origin that encloses all its parts at rest, metres.
  explicit ThingMemory(float radius) : radius_(radius) {}

  // Returns whether the light, the object, or a lamp or blocker (centre and radius, stage axes)
  // near enough to matter has visibly changed; if so, remembers the new conditions. The object's
  // own blockers count too. Allocates nothing once as many lamps and blockers were near.
  bool Update(const light::ShRgb& light,
              std::span<const light::Lamp> lamps,
              const glm::mat4& stage_from_thing,
              std::span<const glm::mat4> skin,
              std::span<const glm::vec4> blockers);

 private:
  // All conditions except the distant light.
  struct Surroundings {
    glm::mat4 stage_from_thing = glm::mat4(1.0f);
    std::vector<glm::mat4> skin;
    std::vector<light::Lamp> lamps;
    std::vector<glm::vec4> blockers;
  };
  bool Alike(const Surroundings& a, const Surroundings& b) const;

  float radius_;
  bool known_ = false;
  light::ShRgb light_ = {};
  Surroundings then_;  // Conditions when the object was lit last.
  Surroundings now_;   // Conditions in the present call.
};

// Radius for ThingMemory, metres.
float RadiusOf(const stage::Prop& prop);

}  // namespace lararium::show
