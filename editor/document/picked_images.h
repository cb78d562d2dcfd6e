#pragma once

// The picks of one point, as the interface lists them: the image of each pick and its error. Also
// the edits that remove a pick.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "editor/document/project.h"
#include "shared/core/status.h"
#include "shared/stage/picks.h"
#include "shared/vision/scene_database.h"

namespace lararium::editor {

struct PickedImage {
  stage::Pick pick;
  std::optional<uint32_t> keyframe;  // Not set where the map no longer has this image.
  // Distance, pixels, between the pick and the projection of the point that all picks together
  // locate. Not set where the point is unknown: at least two picks from different directions are
  // needed.
  std::optional<double> error_px;
};

// In the order of the map's images; picks in images that the map does not have come last.
std::vector<PickedImage> PickedImagesOf(const stage::Anchor& anchor,
                                        const vision::SceneDatabase& map);

// The nearest image with a pick before (direction -1) or after (+1) an image of the map; nullopt
// where there is none.
std::optional<uint32_t> NextPicked(std::span<const PickedImage> images,
                                   uint32_t keyframe,
                                   int direction);

// "000010.png", or the number of the frame where it has no name.
std::string NameOfImage(const stage::Pick& pick);

// The pick of an anchor in the image of that name, which the map need not contain any more. option:
// the command line option that named the image, for the error.
Result<stage::Pick> FindPick(const stage::Anchor& anchor,
                             const std::string& option,
                             const std::string& frame,
                             uint32_t session);

// These edits remove the pick of a point in one image. They return false and change nothing where
// the point was not picked there.
bool RemovePick(stage::Anchor& anchor, const stage::Pick& pick);
// Removes the pick of a check point at a place.
bool RemoveCheckPick(PlaceDocument& place, std::string_view point, const stage::Pick& pick);
// Removes the pick of a corner of an occluder. A corner without picks is deleted, and the corners
// after it are renamed.
bool RemoveCornerPick(OccluderDocument& occluder, size_t corner, const stage::Pick& pick);

}  // namespace lararium::editor
