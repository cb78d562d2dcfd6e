#pragma once

// Things in the light: a prop with baked light transfer is lit as a person is
// (person_light.h), by a figure whose joints are its parts. What stands in light that does not
// change is not lit again in each frame.

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

// Without light where the prop has none; blockers it has always.
std::shared_ptr<human::Human> FigureOf(const stage::Prop& prop);

// The figure's matrices where its actor frame is that of the first part. A part that is not
// there is very far away, where it keeps no light off anything.
void SkinOfFigure(std::span<const glm::mat4> stage_from_part,
                  std::span<const uint8_t> shown,
                  std::span<glm::mat4> skin);

// What one thing was lit by when that was last worked out.
class ThingMemory {
 public:
  // radius: of a ball about the thing's own frame that holds all its parts at rest, metres.
  explicit ThingMemory(float radius) : radius_(radius) {}

  // Whether light, the thing, or a lamp or blocker (centre and radius, stage axes) near enough
  // to matter has changed by more than can be seen; if so, this is remembered. Blockers of the
  // thing itself count too. Allocates nothing once as many were near.
  bool Update(const light::ShRgb& light,
              std::span<const light::Lamp> lamps,
              const glm::mat4& stage_from_thing,
              std::span<const glm::mat4> skin,
              std::span<const glm::vec4> blockers);

 private:
  // All that it depends on, but for the light.
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
  Surroundings then_;  // when it was lit
  Surroundings now_;   // of the call
};

// Of the ball of ThingMemory.
float RadiusOf(const stage::Prop& prop);

}  // namespace lararium::show
