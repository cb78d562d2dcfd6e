#include "editor/panels/pick_view.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>
#include <string>

#include "editor/panels/gizmo_view.h"
#include "editor/panels/theme.h"
#include "editor/panels/widgets.h"

namespace lararium::panels {

namespace {

using Eigen::Vector2d;

constexpr std::array<AnchorEntry, 5> kAnchors = {{
    {"Origin", "where the stage begins, on the floor", &stage::StagePicks::origin},
    {"Forward", "a point straight ahead of the origin", &stage::StagePicks::forward},
    {"Floor", "another point of the floor, to the side", &stage::StagePicks::floor},
    {"Length from", "one end of a known length", &stage::StagePicks::length_from},
    {"Length to", "its other end", &stage::StagePicks::length_to},
}};

struct ImageMap {
  Vector2d origin;  // screen position of the image's top-left corner
  double scale = 1.0;

  // Integer coordinates are pixel centres.
  Vector2d ToScreen(const Vector2d& pixel) const {
    return origin + scale * (pixel + Vector2d(0.5, 0.5));
  }
  Vector2d ToPixel(const Vector2d& screen) const {
    return (screen - origin) / scale - Vector2d(0.5, 0.5);
  }
};

bool SameFrame(const stage::Pick& pick, const vision::Keyframe& keyframe) {
  return pick.session == keyframe.session && pick.frame_index == keyframe.frame_index &&
         (pick.frame.empty() || pick.frame == keyframe.name);
}

void SetPick(app::Workspace& workspace,
             int anchor_index,
             const vision::Keyframe& keyframe,
             const Vector2d& pixel) {
  const AnchorEntry& entry = kAnchors[static_cast<size_t>(anchor_index)];
  workspace.EditPlace(std::string("pick ") + entry.label, [&](app::PlaceDocument& place) {
    std::vector<stage::Pick>& picks = (place.picks.*entry.anchor).picks;
    std::erase_if(picks, [&](const stage::Pick& pick) { return SameFrame(pick, keyframe); });
    picks.push_back({keyframe.frame_index, keyframe.name, pixel, keyframe.session});
  });
}

void DrawCross(const ImVec2& at, ImU32 packed, ImDrawList& draw) {
  const float arm = Px(9);
  const float gap = Px(3);
  for (const auto& [dx, dy] : {std::pair{1.0f, 0.0f}, {-1.0f, 0.0f}, {0.0f, 1.0f}, {0.0f, -1.0f}}) {
    draw.AddLine(ImVec2(at.x + dx * gap, at.y + dy * gap), ImVec2(at.x + dx * arm, at.y + dy * arm),
                 packed, Px(2));
  }
}

void DrawLabel(const ImVec2& at, const char* text, ImU32 packed, ImDrawList& draw) {
  const ImVec2 size = ImGui::CalcTextSize(text);
  const ImVec2 from(at.x + Px(12), at.y - 0.5f * size.y);
  draw.AddRectFilled(ImVec2(from.x - Px(4), from.y - Px(2)),
                     ImVec2(from.x + size.x + Px(4), from.y + size.y + Px(2)),
                     Packed(OverPicture().window, 0.75f), Px(3));
  draw.AddText(from, packed, text);
}

// Crosses where anchors were picked in this image, rings where their points in
// the map project to: the gap between the two is the residual.
void DrawAnchors(const app::Workspace& workspace,
                 const EditorState& state,
                 const vision::Keyframe& keyframe,
                 const ImageMap& map,
                 ImDrawList& draw) {
  const stage::StagePicks& picks = workspace.place()->picks;
  const std::optional<stage::StageSolution>& solution = workspace.loaded().picks.solution;
  for (size_t i = 0; i < kAnchors.size(); ++i) {
    const bool active = static_cast<int>(i) == state.anchor;
    const ImU32 packed = active ? Packed(OverPicture().accent) : Packed(OverPicture().warning);
    const stage::Anchor& anchor = picks.*kAnchors[i].anchor;
    for (const stage::Pick& pick : anchor.picks) {
      if (SameFrame(pick, keyframe)) {
        const ImVec2 at = ToImGui(map.ToScreen(pick.pixel));
        DrawCross(at, packed, draw);
        DrawLabel(at, kAnchors[i].label, packed, draw);
      }
    }
    if (!solution) {
      continue;
    }
    for (const stage::AnchorReport& report : solution->anchors) {
      const auto pixel = workspace.loaded().database->camera.Project(keyframe.camera_from_map *
                                                                     report.point_in_map);
      if (report.name == anchor.name && pixel) {
        draw.AddCircle(ToImGui(map.ToScreen(*pixel)), Px(6), packed, 0, Px(1.5f));
      }
    }
  }
}

// A magnifier beside the pointer, so that a single pixel can be aimed at.
void DrawLoupe(const ImVec2& pointer,
               const Vector2d& pixel,
               const render::Texture& texture,
               ImDrawList& draw) {
  const float half = Px(64);
  constexpr float kSourceHalf = 12.0f;  // image pixels
  const ImVec2 center(pointer.x + Px(88), pointer.y - Px(88));
  const ImVec2 a(center.x - half, center.y - half);
  const ImVec2 b(center.x + half, center.y + half);
  const float u = (static_cast<float>(pixel.x()) + 0.5f) / static_cast<float>(texture.width());
  const float v = (static_cast<float>(pixel.y()) + 0.5f) / static_cast<float>(texture.height());
  const float du = kSourceHalf / static_cast<float>(texture.width());
  const float dv = kSourceHalf / static_cast<float>(texture.height());
  draw.AddRectFilled(a, b, Packed(OverPicture().window));
  draw.AddImage(reinterpret_cast<ImTextureID>(static_cast<intptr_t>(texture.id())), a, b,
                ImVec2(u - du, v - dv), ImVec2(u + du, v + dv));
  draw.AddRect(a, b, Packed(OverPicture().line), 0, 0, Px(2));
  DrawCross(center, Packed(OverPicture().accent), draw);
}

void ShowAnchorButtons(const app::Workspace& workspace, EditorState& state) {
  std::array<std::string, kAnchors.size()> labels;
  std::array<const char*, kAnchors.size()> texts = {};
  for (size_t i = 0; i < kAnchors.size(); ++i) {
    const size_t count = (workspace.place()->picks.*kAnchors[i].anchor).picks.size();
    labels[i] = kAnchors[i].label + std::string("  ") + std::to_string(count);
    texts[i] = labels[i].c_str();
  }
  Segmented("anchors", texts, state.anchor);
  ImGui::SameLine(0.0f, Px(14));
  ImGui::AlignTextToFramePadding();
  DimText(kAnchors[static_cast<size_t>(state.anchor)].hint);
}

}  // namespace

std::span<const AnchorEntry> AnchorEntries() { return kAnchors; }

void PickView::ShowImage(app::Workspace& workspace,
                         EditorState& state,
                         const vision::Keyframe& keyframe) {
  const geometry::CameraModel& camera = workspace.loaded().database->camera;
  if (&keyframe != uploaded_) {
    cv::Mat bgr(camera.height, camera.width, CV_8UC3, cv::Scalar::all(36));
    if (!keyframe.grey.empty()) {
      cv::cvtColor(keyframe.grey, bgr, cv::COLOR_GRAY2BGR);
    }
    texture_.Upload(bgr);
    uploaded_ = &keyframe;
  }
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImVec2 size = ImGui::GetContentRegionAvail();
  size.y -= ImGui::GetFrameHeightWithSpacing() + Px(4);
  ImGui::InvisibleButton("image", size);
  const bool hovered = ImGui::IsItemHovered();
  const double scale = std::min(size.x / static_cast<double>(camera.width),
                                size.y / static_cast<double>(camera.height));
  const Vector2d extent = scale * Vector2d(camera.width, camera.height);
  const ImageMap map{ToEigen(corner) + 0.5 * (ToEigen(size) - extent), scale};
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddImage(reinterpret_cast<ImTextureID>(static_cast<intptr_t>(texture_.id())),
                ToImGui(map.origin), ToImGui(map.origin + extent));
  if (keyframe.grey.empty()) {
    draw.AddText(ToImGui(map.origin + Vector2d(Px(12), Px(12))), Packed(OverPicture().dim),
                 "The map was made small and holds no image here.");
  }
  DrawAnchors(workspace, state, keyframe, map, draw);
  const Vector2d pixel = map.ToPixel(ToEigen(ImGui::GetMousePos()));
  if (hovered && camera.Contains(pixel)) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_None);
    DrawCross(ImGui::GetMousePos(), Packed(OverPicture().text), draw);
    DrawLoupe(ImGui::GetMousePos(), pixel, texture_, draw);
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
      SetPick(workspace, state.anchor, keyframe, pixel);
    }
  }
  ImGui::SetCursorScreenPos(ImVec2(corner.x, corner.y + size.y + Px(8)));
}

void PickView::Show(app::Workspace& workspace, EditorState& state) {
  const auto& database = workspace.loaded().database;
  if (workspace.place() == nullptr || database == nullptr || database->keyframes.empty()) {
    uploaded_ = nullptr;
    Hint("Picks are made in the training images. Train the place first.");
    return;
  }
  ShowAnchorButtons(workspace, state);
  const int last = static_cast<int>(database->keyframes.size()) - 1;
  state.keyframe = std::clamp(state.keyframe, 0, last);
  const vision::Keyframe& keyframe = database->keyframes[static_cast<size_t>(state.keyframe)];
  ShowImage(workspace, state, keyframe);
  std::string name = keyframe.name;
  if (keyframe.session != 0) {
    name += ", session " + std::to_string(keyframe.session);
  }
  const float name_width = ImGui::CalcTextSize(name.c_str()).x + Px(12);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - name_width);
  ImGui::SliderInt("##keyframe", &state.keyframe, 0, last, "training image %d",
                   ImGuiSliderFlags_AlwaysClamp);
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  DimText(name);
}

}  // namespace lararium::panels
