#include "editor/panels/viewport/corner_view.h"

#include <string>
#include <vector>

#include "editor/jobs/drawn_occluder.h"
#include "editor/panels/viewport/gizmo_view.h"
#include "editor/panels/viewport/picture_textures.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"

namespace lararium::panels {

using Eigen::Vector2d;

void DrawOccluderCorners(const editor::Workspace& workspace,
                         const editor::OccluderDocument& occluder,
                         const vision::Keyframe& keyframe,
                         const ImageView& map,
                         ImDrawList& draw) {
  std::vector<ImVec2> outline;
  for (size_t i = 0; i < occluder.corners.size(); ++i) {
    if (const stage::Pick* pick = editor::PickIn(occluder.corners[i], keyframe)) {
      outline.push_back(ToImGui(map.ToScreen(pick->pixel)));
      DrawCross(outline.back(), Packed(OverPicture().accent), draw);
      LabelMark(outline.back(), std::to_string(i + 1), Packed(OverPicture().text), draw);
    }
  }
  const bool all = outline.size() == occluder.corners.size();
  draw.AddPolyline(outline.data(), static_cast<int>(outline.size()),
                   Packed(OverPicture().accent, 0.8f),
                   all && outline.size() > 2 ? ImDrawFlags_Closed : 0, Px(1.5f));
  const vision::SceneDatabase& database = *workspace.map().loaded().database;
  for (const stage::Anchor& corner : occluder.corners) {
    if (corner.picks.size() < 2) {
      continue;
    }
    const Result<stage::AnchorReport> report = stage::SolveAnchor(corner, database);
    if (!report.ok()) {
      continue;
    }
    const auto pixel = database.camera.Project(keyframe.camera_from_map * report->point_in_map);
    if (pixel && (!map.redrawn || database.camera.Contains(*pixel))) {
      draw.AddCircle(ToImGui(map.ToScreen(*pixel)), Px(6), Packed(OverPicture().warning), 0,
                     Px(1.5f));
    }
  }
}

void DrawLoupe(const ImVec2& pointer,
               const Vector2d& pixel,
               const render::Texture& texture,
               ImDrawList& draw) {
  const float half = Px(64);
  constexpr float kSourceHalf = 12.0f;  // Image pixels.
  const ImVec2 center(pointer.x + Px(88), pointer.y - Px(88));
  const ImVec2 a(center.x - half, center.y - half);
  const ImVec2 b(center.x + half, center.y + half);
  const float u = (static_cast<float>(pixel.x()) + 0.5f) / static_cast<float>(texture.width());
  const float v = (static_cast<float>(pixel.y()) + 0.5f) / static_cast<float>(texture.height());
  const float du = kSourceHalf / static_cast<float>(texture.width());
  const float dv = kSourceHalf / static_cast<float>(texture.height());
  draw.AddRectFilled(a, b, Packed(OverPicture().window));
  draw.AddImage(ShownTexture(texture), a, b, ImVec2(u - du, v - dv), ImVec2(u + du, v + dv));
  draw.AddRect(a, b, Packed(OverPicture().line), 0, 0, Px(2));
  DrawCross(center, Packed(OverPicture().accent), draw);
}

std::string CornerHint(const editor::Workspace& workspace,
                       const editor::OccluderDocument& occluder) {
  const auto drawn = editor::DrawOccluder(occluder, *workspace.map().loaded().database, 1.0);
  return drawn.ok() ? Text(Tr("%d corners, %.2f px off on average; drag one to move it"),
                           static_cast<int>(occluder.corners.size()), drawn->error_px)
                    : Tr("Click the corners of a face in turn, then the same ones in another "
                         "image.");
}

// A press on an existing corner moves it; elsewhere it sets the next corner.
void CornerDrag::Update(editor::Workspace& workspace,
                        const editor::OccluderDocument& occluder,
                        const vision::Keyframe& keyframe,
                        const ImageView& map,
                        ImDrawList& draw) {
  constexpr double kReach = 8.0;  // Screen pixels.
  const Vector2d pixel = map.ToPixel(ToEigen(ImGui::GetMousePos()));
  const std::optional<size_t> near =
      editor::CornerNear(occluder, keyframe, pixel, kReach / map.scale);
  const std::optional<size_t> next = editor::NextCorner(occluder, keyframe);
  if (next && !near) {
    LabelMark(ImGui::GetMousePos(), Text(Tr("corner %d"), static_cast<int>(*next) + 1),
              Packed(OverPicture().text), draw);
  }
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    dragged_corner_ = near ? near : next;
    if (near || !dragged_corner_) {
      return;  // A click alone moves nothing.
    }
  } else if (!dragged_corner_ || !ImGui::IsMouseDragging(ImGuiMouseButton_Left)) {
    return;
  }
  workspace.map().KeepFrame(keyframe);
  const std::string name = occluder.name;
  const size_t corner = *dragged_corner_;
  workspace.project().EditOccluder(
      Sentence("draw %s", {name}), name,
      [&](editor::OccluderDocument& edited) { editor::SetCorner(edited, corner, keyframe, pixel); },
      "corner");
}

void CornerDrag::EndDrag(editor::Workspace& workspace) {
  if (ImGui::IsMouseReleased(ImGuiMouseButton_Left) && dragged_corner_) {
    dragged_corner_.reset();
    workspace.project().EndGesture();
  }
}

}  // namespace lararium::panels
