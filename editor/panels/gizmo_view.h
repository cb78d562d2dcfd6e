#pragma once

// The handles of the selected thing in a viewport. The world of both viewports
// is the stage that the picks give, before the adjustment by hand.

#include <imgui.h>

#include <optional>
#include <string>

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

// Where the selected thing is; nullopt where it cannot be moved (or nothing is
// selected).
std::optional<geometry::Similarity3> SelectedTransform(const app::Workspace& workspace,
                                                       const Selection& selection);

// Where an occluder's mesh lies in the world. One that was drawn lies in the map and cannot be
// moved.
geometry::Similarity3 WorldFromOccluder(const app::Workspace& workspace, const std::string& name);

// Moves the selected thing. gesture: see CommandStack::Edit.
void MoveSelected(app::Workspace& workspace,
                  const Selection& selection,
                  const geometry::Similarity3& world_from_thing,
                  std::string_view gesture);

// Draws the handles and drags them. hovered: the pointer is over the view. True
// while the handles want the pointer for themselves.
bool ShowGizmo(app::Workspace& workspace,
               EditorState& state,
               const ViewCamera& view,
               bool hovered,
               ImDrawList& draw);

// Axes and a metre grid of the stage.
void DrawStage(const app::Workspace& workspace, const ViewCamera& view, ImDrawList& draw);

// A line of the world, clipped at the near plane.
void DrawWorldLine(const ViewCamera& view,
                   const Eigen::Vector3d& from,
                   const Eigen::Vector3d& to,
                   ImU32 colour,
                   float width,
                   ImDrawList& draw);

// Marks over a picture.
void DrawCross(const ImVec2& at, ImU32 packed, ImDrawList& draw);
// at: its top left corner; or beside a mark.
void DrawLabel(const ImVec2& at, const std::string& text, ImU32 packed, ImDrawList& draw);
void LabelMark(const ImVec2& mark, const std::string& text, ImU32 packed, ImDrawList& draw);

inline ImVec2 ToImGui(const Eigen::Vector2d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y())};
}
inline Eigen::Vector2d ToEigen(const ImVec2& v) { return {v.x, v.y}; }

}  // namespace lararium::panels
