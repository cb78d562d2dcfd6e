#include "editor/panels/viewport/portrait_view.h"

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"
#include "shared/core/units.h"

namespace lararium::panels {
namespace {
constexpr float kWidestPortrait = 420.0f;  // logical pixels
constexpr float kLowest = 150.0f;
constexpr float kBelow = 270.0f;  // Space below the portrait, including the switches.
// Pixels; a drag of a splitter does not need a new picture at every step.
constexpr int kSizeStep = 16;
constexpr editor::StudioFrame kFrames[] = {editor::StudioFrame::kBust, editor::StudioFrame::kFace,
                                           editor::StudioFrame::kFigure};
constexpr int kFigure = 2;

struct Place {
  ImVec2 from;
  ImVec2 to;
  float scale = 1.0f;  // Screen pixels per pixel of the picture.

  ImVec2 At(const glm::vec2& pixel) const {
    return {from.x + scale * (pixel.x + 0.5f), from.y + scale * (pixel.y + 0.5f)};
  }
};

// Small enough to leave space below for the person's properties.
cv::Size PictureSize(int frame) {
  const float height_of_width = frame == kFigure ? 1.2f : 0.75f;
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float width = std::min(
      {room.x, Px(kWidestPortrait), std::max(room.y - Px(kBelow), Px(kLowest)) / height_of_width});
  const int columns = std::max(1, static_cast<int>(width) / kSizeStep) * kSizeStep;
  return {columns, static_cast<int>(height_of_width * static_cast<float>(columns))};
}

// The joint under the pointer; -1: none is near.
int JointAt(const editor::CastPortrait& portrait, const Place& place, const ImVec2& mouse) {
  int nearest = -1;
  float best = Px(9);
  for (size_t i = 0; i < portrait.pixels.size(); ++i) {
    const ImVec2 at = place.At(portrait.pixels[i]);
    const float distance = std::hypot(at.x - mouse.x, at.y - mouse.y);
    if (distance < best) {
      best = distance;
      nearest = static_cast<int>(i);
    }
  }
  return nearest;
}

void DrawSkeleton(const editor::CastPortrait& portrait,
                  const Place& place,
                  const std::string& lit) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 shadow = IM_COL32(0, 0, 0, 110);
  for (size_t i = 0; i < portrait.pixels.size(); ++i) {
    if (portrait.parents[i] >= 0) {
      const ImVec2 from = place.At(portrait.pixels[static_cast<size_t>(portrait.parents[i])]);
      const ImVec2 to = place.At(portrait.pixels[i]);
      draw.AddLine(from, to, shadow, Px(3.5f));
      draw.AddLine(from, to, Packed(kAxisColours[2], 0.9f), Px(1.5f));
    }
  }
  for (size_t i = 0; i < portrait.pixels.size(); ++i) {
    const bool chosen = portrait.joints[i] == lit;
    const ImVec2 at = place.At(portrait.pixels[i]);
    draw.AddCircleFilled(at, Px(chosen ? 7.0f : 3.5f), shadow);
    draw.AddCircleFilled(at, Px(chosen ? 5.5f : 2.2f),
                         Packed(chosen ? OverPicture().accent : OverPicture().text));
  }
}

void Turn(CastView& cast_view, float radians) {
  cast_view.azimuth = std::remainder(cast_view.azimuth + radians, 2.0f * kPiF);
}

// While the portrait has the keyboard focus, left, right and Home rotate it instead of moving the
// focus. ImGui 1.86 draws no ring around such a button, so it is drawn here.
void TurnByKeys(CastView& cast_view, const Input& input, const ImRect& frame) {
  constexpr float kStep = kPiF / 12.0f;
  const ImGuiContext& g = *ImGui::GetCurrentContext();
  if (!ImGui::IsItemFocused() || !input.keyboard.walks()) {
    return;
  }
  ImGui::RenderNavHighlight(frame, g.NavId);
  const bool front = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Home));
  if (front) {
    cast_view.azimuth = 0.0f;
  } else if (g.NavMoveDir == ImGuiDir_Left || g.NavMoveDir == ImGuiDir_Right) {
    Turn(cast_view, g.NavMoveDir == ImGuiDir_Left ? -kStep : kStep);
  } else {
    return;
  }
  ImGui::NavMoveRequestCancel();
}

void Interact(CastView& cast_view,
              const Input& input,
              const editor::CastPortrait* portrait,
              const Place& place,
              bool bones) {
  const ImVec2 size(place.to.x - place.from.x, place.to.y - place.from.y);
  ImGui::SetCursorScreenPos(place.from);
  ImGui::InvisibleButton("portrait", size);
  TurnByKeys(cast_view, input, ImRect(place.from, place.to));
  const bool hovered = ImGui::IsItemHovered();
  if (ImGui::IsItemActive()) {
    // The person follows the hand: dragging to the right shows the right side.
    Turn(cast_view, kPiF * ImGui::GetIO().MouseDelta.x / size.x);
  }
  if (hovered && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
    cast_view.azimuth = 0.0f;
  }
  if (!bones || portrait == nullptr) {
    return;
  }
  const int joint = hovered ? JointAt(*portrait, place, ImGui::GetIO().MousePos) : -1;
  if (joint >= 0) {
    const std::string& name = portrait->joints[static_cast<size_t>(joint)];
    ImGui::SetTooltip("%s", name.c_str());
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
      cast_view.joint = name;
    }
  }
}

void DrawPicture(CastView& cast_view,
                 PictureTextures& pictures,
                 const editor::CastPortrait* portrait,
                 Place& place) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float rounding = ImGui::GetStyle().FrameRounding;
  draw.AddRectFilled(place.from, place.to, Packed(Colours().frame), rounding);
  if (portrait == nullptr) {
    return;
  }
  // The older picture can have another aspect ratio, which is kept.
  const float width = place.to.x - place.from.x;
  const float height = place.to.y - place.from.y;
  place.scale = std::min(width / static_cast<float>(portrait->bgr.cols),
                         height / static_cast<float>(portrait->bgr.rows));
  const ImVec2 shown(place.scale * static_cast<float>(portrait->bgr.cols),
                     place.scale * static_cast<float>(portrait->bgr.rows));
  place.from = {place.from.x + 0.5f * (width - shown.x), place.from.y + 0.5f * (height - shown.y)};
  place.to = {place.from.x + shown.x, place.from.y + shown.y};
  const auto whole = std::shared_ptr<const cv::Mat>(cast_view.portrait, &portrait->bgr);
  draw.AddImageRounded(pictures.Show("portrait", whole), place.from, place.to, ImVec2(0, 0),
                       ImVec2(1, 1), IM_COL32_WHITE, rounding);
}

void Caption(const Place& frame, const char* text) {
  const ImVec2 size = ImGui::CalcTextSize(text);
  const ImVec2 at(frame.from.x + Px(10), frame.to.y - size.y - Px(10));
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(ImVec2(at.x - Px(6), at.y - Px(3)),
                     ImVec2(at.x + size.x + Px(6), at.y + size.y + Px(3)),
                     Packed(OverPicture().window, 0.75f), ImGui::GetStyle().FrameRounding);
  draw.AddText(at, Packed(OverPicture().text), text);
}

}  // namespace

void DrawPortrait(editor::Workspace& workspace,
                  CastView& cast_view,
                  PictureTextures& pictures,
                  const Input& input,
                  const editor::CastDocument& member,
                  bool bones) {
  const cv::Size size = PictureSize(cast_view.frame);
  workspace.cast().pictures().Look(
      member.name, {.azimuth = cast_view.azimuth, .frame = kFrames[cast_view.frame]}, size);
  cast_view.portrait = workspace.cast().pictures().portrait();
  const bool known = cast_view.portrait != nullptr && cast_view.portrait->name == member.name;
  const editor::CastPortrait* portrait = known ? cast_view.portrait.get() : nullptr;
  const ImVec2 begin = ImGui::GetCursorScreenPos();
  const float beside = ImGui::GetContentRegionAvail().x - static_cast<float>(size.width);
  const ImVec2 from(begin.x + std::floor(std::max(0.0f, 0.5f * beside)), begin.y);
  const Place frame{
      from,
      {from.x + static_cast<float>(size.width), from.y + static_cast<float>(size.height)},
      1.0f};
  Place picture = frame;
  DrawPicture(cast_view, pictures, portrait, picture);
  if (bones && portrait != nullptr) {
    ImGui::PushClipRect(frame.from, frame.to, true);
    DrawSkeleton(*portrait, picture, cast_view.joint);
    ImGui::PopClipRect();
  }
  Interact(cast_view, input, portrait, picture, bones);
  ImGui::SetCursorScreenPos(ImVec2(begin.x, frame.to.y + ImGui::GetStyle().ItemSpacing.y));
  if (workspace.cast().pictures().Working(member.name)) {
    Caption(frame, Tr("Building\xe2\x80\xa6"));
  }
  const char* const labels[] = {Tr("Bust"), Tr("Face"), Tr("Figure")};
  const std::string tips[] = {Tr("Head and shoulders"), Tr("The face alone"),
                              Tr("From head to foot")};
  Segmented("frame", labels, cast_view.frame, tips);
  if (FitsBeside(std::array{Tr("Drag to turn")})) {
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    DimText(Tr("Drag to turn"));
    Tip(
        Tr("Drag the picture to turn it, double-click it for the front. While the keyboard is on "
           "it, the arrows to the left and right turn it, and Home shows the front."));
  } else {
    ImGui::Dummy(ImVec2(0, 0));  // The space below a row.
  }
}

}  // namespace lararium::panels
