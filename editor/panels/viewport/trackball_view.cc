#include "editor/panels/viewport/trackball_view.h"

#include <imgui.h>

#include "editor/panels/viewport/gizmo_view.h"
#include "editor/panels/viewport/trackball.h"
#include "editor/panels/widgets/theme.h"

namespace lararium::panels {

namespace {

// The axes of the camera view, which do not change when the stage rotates, or of the scene view.
Eigen::Quaterniond WorldFromCamera(const editor::Workspace& workspace,
                                   const ViewOptions& options,
                                   const OrbitCamera& orbit) {
  const std::shared_ptr<const editor::PreviewPicture>& picture = workspace.preview().picture();
  if (options.view == ViewKind::kCamera && picture != nullptr && picture->camera_from_map) {
    return geometry::CameraFromB(*picture->camera_from_map,
                                 workspace.map().loaded().picks.map_from_picked)
        .rotation.conjugate();
  }
  return orbit.CameraFromWorld().rotation.conjugate();
}

}  // namespace

bool DrawTrackball(editor::Workspace& workspace,
                   const ViewOptions& options,
                   const OrbitCamera& orbit,
                   Eigen::Quaterniond& world_from_thing) {
  using Eigen::Vector2d;
  using Eigen::Vector3d;
  const float radius = Px(58);
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::Dummy(ImVec2(0, Px(2)));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const Vector2d center(corner.x + 0.5 * width, corner.y + radius + Px(4));
  ImGui::SetCursorScreenPos(ImVec2(static_cast<float>(center.x()) - radius, corner.y + Px(4)));
  ImGui::InvisibleButton("trackball", ImVec2(2 * radius, 2 * radius));
  const bool active = ImGui::IsItemActive();
  const bool hovered = ImGui::IsItemHovered();
  if (ImGui::IsItemDeactivated()) {
    workspace.project().EndGesture();
  }
  // View axes are x right, y up, z to the viewer: the camera's axes after half a turn about x.
  const Eigen::Quaterniond world_from_view =
      WorldFromCamera(workspace, options, orbit) * Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0);
  bool changed = false;
  const ImGuiIO& io = ImGui::GetIO();
  if (active && (io.MouseDelta.x != 0.0f || io.MouseDelta.y != 0.0f)) {
    const Vector2d to = ToEigen(io.MousePos);
    const Vector2d from = to - ToEigen(io.MouseDelta);
    const Eigen::Quaterniond turn = Trackball(center, radius).Turn(from, to);
    world_from_thing =
        (world_from_view * turn * world_from_view.conjugate() * world_from_thing).normalized();
    changed = true;
  }
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddCircleFilled(ToImGui(center), radius, Packed(Colours().frame), 48);
  draw.AddCircle(ToImGui(center), radius,
                 active || hovered ? Packed(Colours().accent) : Packed(Colours().line), 48,
                 Px(1.5f));
  static constexpr const char* kNames[] = {"X", "Y", "Z"};
  const ImVec2 letter = ImGui::CalcTextSize("X");
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d in_view =
        world_from_view.conjugate() * (world_from_thing * Vector3d::Unit(axis));
    const Vector2d tip = center + 0.74 * radius * Vector2d(in_view.x(), -in_view.y());
    const Vector2d label = center + 0.88 * radius * Vector2d(in_view.x(), -in_view.y());
    const float alpha = in_view.z() < 0.0 ? 0.45f : 1.0f;  // Faint behind the ball.
    const ImU32 packed = Packed(kAxisColours[axis], alpha);
    draw.AddLine(ToImGui(center), ToImGui(tip), packed, Px(2.5f));
    draw.AddText(ImVec2(static_cast<float>(label.x()) - 0.5f * letter.x,
                        static_cast<float>(label.y()) - 0.5f * letter.y),
                 packed, kNames[axis]);
  }
  ImGui::SetCursorScreenPos(ImVec2(corner.x, corner.y + 2 * radius + Px(14)));
  return changed;
}

}  // namespace lararium::panels
