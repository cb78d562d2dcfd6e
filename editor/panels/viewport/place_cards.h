#pragma once

// The tools, the legend and the cards over the scene view: the data of the selected points, and the
// keyframe under the pointer.

#include <imgui.h>

#include <cstdint>
#include <optional>
#include <string>

#include "editor/panels/viewport/picture_textures.h"
#include "editor/panels/viewport/point_colours.h"
#include "editor/panels/viewport/view_camera.h"
#include "editor/panels/widgets/input.h"
#include "editor/panels/widgets/view_options.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// How the scene view shows the map, and the selected points.
struct PlaceView {
  enum class LookAt { kWhereItDoes, kStage, kMap, kSelected };
  OrbitCamera orbit;
  LookAt look_at = LookAt::kWhereItDoes;  // The next viewpoint, requested by a button or a key.
  PointColour colours = PointColour::kPicture;
  ColourRange range;     // The range of the present point colours.
  bool measure = false;  // A click adds a second point to the first.
  // Selected points of the map: none, one, or the two ends of a distance.
  std::vector<uint32_t> points;
  double metres = 0.0;  // The distance of the two that was typed; 0: none yet.
};

// The name in menus and on buttons, translated.
const char* PointColourName(PointColour colour);

void ChooseNoPoints(PlaceView& place_view);

// "kitchen.mp4", or the number of a session that is not in the document.
std::string SessionName(const editor::PlaceDocument& place, uint32_t session);

// In the top left corner of the view. origin, size: the view on the screen, pixels.
void DrawPlaceTools(editor::Workspace& workspace,
                    ViewOptions& options,
                    PlaceView& place_view,
                    Input& input,
                    const ImVec2& origin,
                    const ImVec2& size);

// In the bottom right corner; nothing where no point is selected.
void DrawPointCard(editor::Workspace& workspace,
                   PlaceView& place_view,
                   Input& input,
                   const ImVec2& origin,
                   const ImVec2& size);

// Draws the selected points, the cameras that observed a single one, and the line between two.
void DrawChosenPoints(const editor::Workspace& workspace,
                      const PlaceView& place_view,
                      const ViewCamera& view,
                      ImDrawList& draw);

// A small picture of a map's keyframe beside the pointer.
class KeyframeCard {
 public:
  void Show(const editor::Workspace& workspace, PictureTextures& pictures, uint32_t keyframe);

 private:
  std::shared_ptr<const vision::SceneDatabase> database_;  // The database that has the keyframe.
  std::optional<uint32_t> keyframe_;
  std::shared_ptr<const cv::Mat> picture_;  // nullptr: the map has no image.
};

}  // namespace lararium::panels
