#pragma once

// Measures how fast a machine draws a show. This also makes the driver compile and cache the
// shaders, so that the first visitor after the installation of a driver does not wait for it.

#include <optional>
#include <vector>

#include "player/app/options.h"
#include "shared/core/log.h"
#include "shared/core/status.h"
#include "shared/show/show_content.h"

namespace lararium::player {

struct DrawingProbe {
  Status problem;  // why nothing could be drawn
  PictureSize size;
  // Pictures per second at each level of render::QualityLadder(); 0: not measured, because a
  // coarser level was too slow already.
  std::vector<double> rates;
};

// Draws off screen, without tracking: the people of the drama some time after its beginning, seen
// from the keyframe of the first place that shows most of them. size: size of pictures; nullopt:
// that of the camera's images. wanted: required pictures per second. If a level reaches less than
// half of that, finer levels are not measured. Takes seconds.
DrawingProbe ProbeDrawing(const show::ShowContent& content,
                          std::optional<PictureSize> size,
                          render::GraphicsChoice graphics,
                          double wanted,
                          Log& log);

}  // namespace lararium::player
