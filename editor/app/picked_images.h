#pragma once

// The picks of one point as people look for them: in which image each was made, and how far off it
// is; and how one of them is taken back.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "editor/app/project.h"
#include "shared/core/status.h"
#include "shared/stage/picks.h"
#include "shared/vision/scene_database.h"

namespace lararium::app {

struct PickedImage {
  stage::Pick pick;
  std::optional<uint32_t> keyframe;  // none: the map has no such image now
  // From the pick to where all of the point's picks together put it; none where that is not known:
  // it takes two, from different directions.
  std::optional<double> error_px;
};

// In the order of the map's images; those that it does not have come last.
std::vector<PickedImage> PickedImagesOf(const stage::Anchor& anchor,
                                        const vision::SceneDatabase& map);

// The nearest image with a pick before (-1) or after (1) an image of the map; none: there is none.
std::optional<uint32_t> NextPicked(std::span<const PickedImage> images,
                                   uint32_t keyframe,
                                   int direction);

// "000010.png", or the number of a frame that has no name.
std::string NameOfImage(const stage::Pick& pick);

// Where an anchor was picked in an image of that name, which the map need not have any more.
// option: what named it, for the error.
Result<stage::Pick> FindPick(const stage::Anchor& anchor,
                             const std::string& option,
                             const std::string& frame,
                             uint32_t session);

// Edits: forget where a point was picked in the image of a pick. False, and nothing has changed: it
// was not picked there.
bool RemovePick(stage::Anchor& anchor, const stage::Pick& pick);
// Of a check point at a place.
bool RemoveCheckPick(PlaceDocument& place, std::string_view point, const stage::Pick& pick);
// Of a corner of an occluder. One that is picked nowhere then is none: it goes, and those behind it
// are renamed.
bool RemoveCornerPick(OccluderDocument& occluder, size_t corner, const stage::Pick& pick);

}  // namespace lararium::app
