#pragma once

// The tools, the legend and the cards over the scene view: the data of the selected points, and the
// keyframe under the pointer.

#include <imgui.h>

#include <cstdint>
#include <optional>
#include <string>

#include "editor/panels/widgets/editor_state.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// The name in menus and on buttons, translated.
const char* PointColourName(PointColour colour);

void ChooseNoPoints(EditorState& state);

// "kitchen.mp4", or the number of a session that is not in the document.
std::string SessionName(const editor::PlaceDocument& place, uint32_t session);

// In the top left corner of the view. origin, size: the view on the screen, pixels.
void DrawPlaceTools(editor::Workspace& workspace,
                    EditorState& state,
                    const ImVec2& origin,
                    const ImVec2& size);

// In the bottom right corner; nothing where no point is selected.
void DrawPointCard(editor::Workspace& workspace,
                   EditorState& state,
                   const ImVec2& origin,
                   const ImVec2& size);

// Draws the selected points, the cameras that observed a single one, and the line between two.
void DrawChosenPoints(const editor::Workspace& workspace,
                      const EditorState& state,
                      const ViewCamera& view,
                      ImDrawList& draw);

// A small picture of a map's keyframe beside the pointer.
class KeyframeCard {
 public:
  void Show(const editor::Workspace& workspace, EditorState& state, uint32_t keyframe);

 private:
  std::shared_ptr<const vision::SceneDatabase> database_;  // The database that has the keyframe.
  std::optional<uint32_t> keyframe_;
  std::shared_ptr<const cv::Mat> picture_;  // nullptr: the map has no image.
};

}  // namespace lararium::panels
