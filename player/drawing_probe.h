#pragma once

// How fast a machine draws a show. What is drawn is compiled on the way, so that the first visitor
// after a driver was installed does not wait for that.

#include <optional>
#include <string>
#include <vector>

#include "player/options.h"
#include "shared/core/log.h"
#include "shared/core/status.h"
#include "shared/show/show_content.h"

namespace lararium::player {

struct DrawingProbe {
  Status problem;  // why nothing could be drawn
  PictureSize size;
  // Pictures a second that the machine keeps up at each level of render::QualityLadder(); 0 where a
  // coarser one was too slow already.
  std::vector<double> rates;
};

// Draws off screen, with nothing to track beside it: people of the drama a while after it began, as
// that keyframe of the first place sees them that sees most of them. size: of the pictures;
// nullopt: as the camera's images. graphics: to draw with. wanted: pictures a second. Finer levels
// than one that is half as slow are not tried. Takes seconds.
DrawingProbe ProbeDrawing(const show::ShowContent& content,
                          std::optional<PictureSize> size,
                          render::GraphicsChoice graphics,
                          double wanted,
                          Log& log);

}  // namespace lararium::player
