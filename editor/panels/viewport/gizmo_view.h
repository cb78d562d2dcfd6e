#pragma once

// The handles of the selected object in a viewport. The world frame of both viewports is the stage
// that the picks give, before the manual adjustment.

#include <imgui.h>

#include <optional>
#include <string>

#include "editor/panels/viewport/gizmo.h"
#include "editor/panels/widgets/input.h"
#include "editor/panels/widgets/selection.h"
#include "editor/panels/widgets/view_options.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// The tool that moves, turns or scales the selected object.
struct GizmoTool {
  GizmoMode mode = GizmoMode::kMove;
  std::optional<GizmoDrag> drag;
  bool given_up = false;  // The drag was cancelled.
};

// The transform of the selected object; nullopt where it cannot be moved or nothing is selected.
std::optional<geometry::Similarity3> SelectedTransform(const editor::Workspace& workspace,
                                                       const Selection& selection);

// The transform of an occluder's mesh. A drawn occluder is fixed in the map and cannot be moved.
geometry::Similarity3 WorldFromOccluder(const editor::Workspace& workspace,
                                        const std::string& name);

// Moves the selected object. gesture: see CommandStack::Edit.
void MoveSelected(editor::Workspace& workspace,
                  const Selection& selection,
                  const geometry::Similarity3& world_from_thing,
                  std::string_view gesture);

// Draws the handles and handles drags. hovered: the pointer is over the view. Returns true while
// the handles use the pointer.
bool DrawGizmo(editor::Workspace& workspace,
               Selection& selection,
               const ViewOptions& options,
               GizmoTool& gizmo,
               const Input& input,
               const ViewCamera& view,
               bool hovered,
               ImDrawList& draw);

// Draws the axes of the stage and a grid of one metre.
void DrawStage(const editor::Workspace& workspace, const ViewCamera& view, ImDrawList& draw);

// Draws a line of the world, clipped at the near plane.
void DrawWorldLine(const ViewCamera& view,
                   const Eigen::Vector3d& from,
                   const Eigen::Vector3d& to,
                   ImU32 colour,
                   float width,
                   ImDrawList& draw);

// Draws a mark over a picture.
void DrawCross(const ImVec2& at, ImU32 packed, ImDrawList& draw);
// DrawLabel(): at is the top left corner. LabelMark() places the label beside a mark.
void DrawLabel(const ImVec2& at, const std::string& text, ImU32 packed, ImDrawList& draw);
void LabelMark(const ImVec2& mark, const std::string& text, ImU32 packed, ImDrawList& draw);

inline ImVec2 ToImGui(const Eigen::Vector2d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y())};
}
inline Eigen::Vector2d ToEigen(const ImVec2& v) { return {v.x, v.y}; }

}  // namespace lararium::panels
