#pragma once

// What lies over the view around the place: its tools and legend, what is known of the points
// that are chosen, and the keyframe below the pointer.

#include <imgui.h>

#include <cstdint>
#include <optional>
#include <string>

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

// In menus and on buttons, translated.
const char* PointColourName(PointColour colour);

void ChooseNoPoints(EditorState& state);

// "kitchen.mp4", or the number of a session that the place does not name.
std::string SessionName(const app::PlaceDocument& place, uint32_t session);

// In the top left corner of a view from origin, of so many pixels.
void ShowPlaceTools(app::Workspace& workspace,
                    EditorState& state,
                    const ImVec2& origin,
                    const ImVec2& size);

// In its bottom right corner; nothing where no point is chosen.
void ShowPointCard(app::Workspace& workspace,
                   EditorState& state,
                   const ImVec2& origin,
                   const ImVec2& size);

// The chosen points, the cameras that saw one, the line between two.
void DrawChosenPoints(const app::Workspace& workspace,
                      const EditorState& state,
                      const ViewCamera& view,
                      ImDrawList& draw);

// Beside the pointer: a keyframe of the map, small.
class KeyframeCard {
 public:
  void Show(const app::Workspace& workspace, EditorState& state, uint32_t keyframe);

 private:
  std::shared_ptr<const vision::SceneDatabase> database_;  // whose keyframe is pictured
  std::optional<uint32_t> keyframe_;
  std::shared_ptr<const cv::Mat> picture_;  // nullptr: the map holds none
};

}  // namespace lararium::panels
