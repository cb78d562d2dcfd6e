#pragma once

// Finds sounds that are obstructed by occluders.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/stage/place.h"
#include "shared/vision/occluders.h"

namespace lararium::audio {

class SoundBlockers {
 public:
  // Uses the occluders that block sound.
  explicit SoundBlockers(std::span<const stage::Occluder> occluders);

  // Share, 0 to 1, of rays from the ear to a source 0.4 m across that meet an occluder. Positions
  // in stage metres. Occluders within 5 cm of the source do not count.
  float Obstruction(const glm::vec3& ear, const glm::vec3& source) const;

 private:
  std::vector<vision::OccluderTree> trees_;  // Stage frame.
};

}  // namespace lararium::audio
