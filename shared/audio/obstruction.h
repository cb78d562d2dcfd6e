#pragma once

// Which sounds are heard past something solid.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/stage/place.h"
#include "shared/vision/occluders.h"

namespace lararium::audio {

class SoundBlockers {
 public:
  // Those of the occluders that block sound.
  explicit SoundBlockers(std::span<const stage::Occluder> occluders);

  // The share of rays from an ear to a source 0.4 m across that meet something solid,
  // 0 to 1; both in stage metres. Whatever is within 5 cm before the source belongs to it.
  float Obstruction(const glm::vec3& ear, const glm::vec3& source) const;

 private:
  std::vector<vision::OccluderTree> trees_;  // stage frame
};

}  // namespace lararium::audio
