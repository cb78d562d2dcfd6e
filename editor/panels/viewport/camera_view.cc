#include "editor/panels/viewport/camera_view.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <span>
#include <string>
#include <utility>

#include "editor/jobs/filming.h"
#include "editor/panels/viewport/align_panel.h"
#include "editor/panels/viewport/check_point_panel.h"
#include "editor/panels/viewport/gizmo_view.h"
#include "editor/panels/viewport/pick_view.h"
#include "editor/panels/widgets/icons.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"
#include "editor/session/task_text.h"

namespace lararium::panels {

namespace {

// The picture's camera in the world frame (gizmo_view.h).
ViewCamera PictureView(const editor::PreviewPicture& picture,
                       const editor::PlaceDocument& place,
                       const PictureRect& rect) {
  const double scale = rect.size.x / static_cast<double>(picture.display.width);
  ViewCamera view;
  view.camera_from_world =
      geometry::CameraFromB(*picture.camera_from_stage, place.picked_from_stage.Inverse());
  view.focal_x = picture.display.fx * scale;
  view.focal_y = picture.display.fy * scale;
  view.center = {rect.origin.x + scale * (picture.display.cx + 0.5),
                 rect.origin.y + scale * (picture.display.cy + 0.5)};
  return view;
}

const char* ReasonText(vision::TrackReason reason) {
  switch (reason) {
    case vision::TrackReason::kNone:
      return "";
    case vision::TrackReason::kTooDark:
      return Tr("too dark");
    case vision::TrackReason::kTooFewFeatures:
      return Tr("too few features: blurred or covered");
    case vision::TrackReason::kTooFewMatches:
      return Tr("does not look like this place");
    case vision::TrackReason::kNoConsistentPose:
      return Tr("no consistent pose");
    case vision::TrackReason::kAmbiguous:
      return Tr("several parts of the place look like this; show something unique");
  }
  return "";
}

// Draws the points that determine the pose, and their positions in earlier frames, which fade with
// age.
void DrawTrails(const editor::PreviewPicture& picture, const PictureRect& rect, ImDrawList& draw) {
  const float scale = rect.size.x / static_cast<float>(picture.display.width);
  const auto place = [&](const Eigen::Vector2f& pixel) {
    return ImVec2(rect.origin.x + scale * (pixel.x() + 0.5f),
                  rect.origin.y + scale * (pixel.y() + 0.5f));
  };
  // Tracked patches are round, relocalised features are square.
  const ImVec4 colour = picture.followed ? OverPicture().call : OverPicture().warning;
  for (const editor::PointTrail& trail : picture.trails) {
    for (size_t i = 1; i < trail.pixels.size(); ++i) {
      const float age = static_cast<float>(i) / static_cast<float>(editor::PointTrails::kLongest);
      draw.AddLine(place(trail.pixels[i - 1]), place(trail.pixels[i]),
                   Packed(colour, 0.85f * (1.0f - age)), Px(1.5f));
    }
    const ImVec2 at = place(trail.pixels.front());
    constexpr int kSquare = 4;
    const int corners = picture.followed ? 0 : kSquare;
    draw.AddCircleFilled(at, Px(3.0f), Packed(OverPicture().window, 0.6f), corners);
    draw.AddCircleFilled(at, Px(2.0f), Packed(colour), corners);
  }
}

// The state of tracking; shorter where the picture is narrow.
std::string BadgeText(const editor::Workspace& workspace,
                      const editor::PreviewPicture& picture,
                      float width) {
  if (!workspace.preview().camera_is_there()) {
    return Tr("The camera is unplugged");
  }
  if (!picture.camera_from_stage) {
    const char* state = picture.state == vision::TrackState::kLost ? Tr("Lost") : Tr("Searching");
    const std::string text = Text("%s: %s", state, ReasonText(picture.reason));
    return ImGui::CalcTextSize(text.c_str()).x <= width ? text : state;
  }
  const char* state = picture.followed ? Tr("Followed") : Tr("Found");
  const auto percent = static_cast<double>(100.0f * picture.confidence);
  const std::string text = Text(Tr("%s, %.0f %% sure, %d points"), state, percent, picture.inliers);
  return ImGui::CalcTextSize(text.c_str()).x <= width ? text : Text("%s, %.0f %%", state, percent);
}

Icon BadgeIcon(const editor::Workspace& workspace, const editor::PreviewPicture& picture) {
  if (!workspace.preview().camera_is_there()) {
    return Icon::kWarning;
  }
  if (!picture.camera_from_stage) {
    return picture.state == vision::TrackState::kLost ? Icon::kLost : Icon::kSearching;
  }
  return picture.followed ? Icon::kGood : Icon::kFound;
}

void DrawBadge(const editor::Workspace& workspace,
               const editor::PreviewPicture& picture,
               const PictureRect& rect,
               ImDrawList& draw) {
  const bool tracked = picture.camera_from_stage.has_value();
  const std::string text = BadgeText(workspace, picture, rect.size.x - Px(58));
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 at(rect.origin.x + Px(12), rect.origin.y + Px(12));
  draw.AddRectFilled(at, ImVec2(at.x + size.x + Px(34), at.y + size.y + Px(10)),
                     Packed(OverPicture().window, 0.8f), Px(4));
  draw.AddText(ImVec2(at.x + Px(5), at.y + Px(5)),
               Packed(tracked ? OverPicture().good : OverPicture().warning),
               IconText(BadgeIcon(workspace, picture)).c_str());
  draw.AddText(ImVec2(at.x + Px(27), at.y + Px(5)), Packed(OverPicture().text), text.c_str());
}

// A direction in camera axes: x right, y down, z forward.
Eigen::Vector3d NudgeDirection(KeyAction action) {
  switch (action) {
    case KeyAction::kNudgeLeft:
      return {-1, 0, 0};
    case KeyAction::kNudgeRight:
      return {1, 0, 0};
    case KeyAction::kNudgeUp:
      return {0, -1, 0};
    case KeyAction::kNudgeDown:
      return {0, 1, 0};
    case KeyAction::kNudgeForward:
      return {0, 0, 1};
    case KeyAction::kNudgeBack:
      return {0, 0, -1};
    default:
      return Eigen::Vector3d::Zero();
  }
}

// Keys move the camera in its image plane and in depth.
void NudgeWithKeys(editor::Workspace& workspace, const Input& input) {
  constexpr double kStep = 0.005;  // Metres; 10 times as much with Shift.
  if (ImGui::GetIO().WantTextInput || input.dialog_open) {
    return;
  }
  for (const KeyPress& press : input.keys) {
    const Eigen::Vector3d direction = NudgeDirection(ActionOf(KeyScope::kCamera, press));
    if (direction.isZero()) {
      continue;
    }
    if (!press.repeats) {
      workspace.project().EndGesture();  // Each press is a separate command.
    }
    const double step = (press.modifiers & GLFW_MOD_SHIFT) != 0 ? 10.0 * kStep : kStep;
    workspace.project().EditPlace(
        Sentence("nudge the camera"),
        [&](editor::PlaceDocument& place) { place.camera_nudge += step * direction; },
        "nudge keys");
  }
}

// A switch at the end of the row.
struct RowSwitch {
  const char* label;
  const char* does;
  KeyAction key;
  bool ViewOptions::*on;
};

constexpr std::array<RowSwitch, 3> kRowSwitches = {{
    {TrLater("Before/after"),
     TrLater("Shows the camera's image alone to the left of a line that you drag"),
     KeyAction::kWipe, &ViewOptions::show_compare},
    {TrLater("Onion skin"), TrLater("Shows people at moments before and after, too"),
     KeyAction::kOnion, &ViewOptions::show_onion},
    {TrLater("Occluders"), TrLater("Shows the occluders over the camera's picture"),
     KeyAction::kOccluders, &ViewOptions::show_occluders},
}};

// The settings of the onion skin have a separate button.
constexpr const char* kMore = "\xe2\x80\xa6";
constexpr float kMoreGap = 2.0f;

float SwitchWidth(const RowSwitch& entry) {
  const float more =
      entry.key == KeyAction::kOnion ? WidestButton(std::array{kMore}, 0.0f) + Px(kMoreGap) : 0.0f;
  return WidestButton(std::array{Tr(entry.label)}, 0.0f) + more + ImGui::GetStyle().ItemSpacing.x;
}

// The last switches, as many as fit beside the slider; the View menu has all of them.
std::span<const RowSwitch> SwitchesThatFit(float width) {
  constexpr float kSlider = 150.0f;
  size_t first = kRowSwitches.size();
  float left = width - Px(kSlider);
  while (first > 0 && left >= SwitchWidth(kRowSwitches[first - 1])) {
    left -= SwitchWidth(kRowSwitches[--first]);
  }
  return std::span(kRowSwitches).subspan(first);
}

void DrawSwitch(ViewOptions& options, const RowSwitch& entry) {
  bool& on = options.*entry.on;
  ImGui::PushStyleColor(ImGuiCol_Button, on ? Colours().chosen : Colours().frame);
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, on ? Colours().chosen : Colours().hover);
  if (ImGui::Button(Tr(entry.label))) {
    on = !on;
  }
  ImGui::PopStyleColor(2);
  if (ImGui::IsItemHovered()) {
    std::string tip = WithKey(Tr(entry.does), entry.key);
    if (entry.key == KeyAction::kOnion) {
      tip += std::string(".\n") + Tr("Not while the drama plays.");
    }
    ImGui::SetTooltip("%s", tip.c_str());
  }
}

// The number of skins on one side, in their colour.
void DrawSkinCount(const char* label, const ImVec4& colour, int& count) {
  PropertyLabel(label);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float side = ImGui::GetFrameHeight();
  ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(at.x, at.y + 0.2f * side),
                                            ImVec2(at.x + 0.6f * side, at.y + 0.8f * side),
                                            Packed(colour), Px(3));
  ImGui::Dummy(ImVec2(0.6f * side, side));
  ImGui::SameLine();
  ImGui::SetNextItemWidth(Px(150));
  ImGui::SliderInt((std::string("##") + label).c_str(), &count, 0, editor::OnionSkin::kMost, "%d",
                   ImGuiSliderFlags_AlwaysClamp);
}

void OnionMoreButton(OnionSettings& onion) {
  ImGui::SameLine(0.0f, Px(kMoreGap));
  if (ImGui::Button(Label(kMore, "onion").c_str())) {
    onion.asked = true;
  }
  Tooltip(WithKey(Tr("How many skins, and how far apart"), KeyAction::kOnionMore));
}

// The settings of the onion skin, above the end of the row, after they were requested.
void DrawOnionMore(OnionSettings& settings) {
  if (std::exchange(settings.asked, false)) {
    ImGui::OpenPopup("onion skin");
  }
  const ImVec2 row_end(ImGui::GetWindowPos().x + ImGui::GetContentRegionMax().x,
                       ImGui::GetItemRectMin().y - Px(4));
  ImGui::SetNextWindowPos(row_end, ImGuiCond_Appearing, ImVec2(1, 1));
  if (!ImGui::BeginPopup("onion skin")) {
    return;
  }
  editor::OnionSkin& onion = settings.skin;
  if (BeginProperties("onion")) {
    DrawSkinCount(Tr("Moments before"), OverPicture().call, onion.before);
    DrawSkinCount(Tr("Moments after"), OverPicture().warning, onion.after);
    PropertyLabel(Tr("Apart"));
    auto spacing = static_cast<float>(onion.spacing);
    ImGui::SetNextItemWidth(Px(150) + 0.6f * ImGui::GetFrameHeight() +
                            ImGui::GetStyle().ItemSpacing.x);
    if (ImGui::SliderFloat("##apart", &spacing, static_cast<float>(editor::OnionSkin::kShortest),
                           static_cast<float>(editor::OnionSkin::kLongest), Tr("%.1f s"),
                           ImGuiSliderFlags_AlwaysClamp)) {
      onion.spacing = std::round(10.0f * spacing) / 10.0;
    }
    EndProperties();
  }
  ImGui::EndPopup();
}

glm::vec3 ColourOf(const ImVec4& colour) { return {colour.x, colour.y, colour.z}; }

void AskForOnionSkin(editor::Workspace& workspace, bool shown, editor::OnionSkin& skin) {
  skin.colour_before = ColourOf(OverPicture().call);
  skin.colour_after = ColourOf(OverPicture().warning);
  workspace.preview().look().onion = shown ? std::optional(skin) : std::nullopt;
}

// A slider for the frame, with its time if there is space. switches: pixels at its right for the
// switches.
void DrawSlider(editor::Workspace& workspace,
                const std::optional<editor::PreviewSource>& recording,
                float switches) {
  const int64_t last = recording ? std::max<int64_t>(recording->frames - 1, 0) : 0;
  const double seconds =
      recording ? static_cast<double>(workspace.playback().frame()) / recording->frames_per_second
                : 0.0;
  const float time = Px(62) + ImGui::GetStyle().ItemSpacing.x;
  float width = ImGui::GetContentRegionAvail().x - switches;
  const bool shows_time = width - time >= Px(140);
  width -= shows_time ? time : 0.0f;
  const std::string longest = Text(Tr("frame %d"), static_cast<int>(last));
  const bool named = ImGui::CalcTextSize(longest.c_str()).x + Px(16) <= width;
  ImGui::SetNextItemWidth(width);
  // The grab is as wide as a frame, so with a single frame it would fill the slider.
  const ImVec4 grab = ImGui::GetStyleColorVec4(ImGuiCol_SliderGrab);
  ImGui::PushStyleColor(ImGuiCol_SliderGrab, last > 0 ? grab : ImVec4());
  int frame = static_cast<int>(workspace.playback().frame());
  const bool moved = ImGui::SliderInt("##frame", &frame, 0, static_cast<int>(last),
                                      named ? Tr("frame %d") : "%d", ImGuiSliderFlags_AlwaysClamp);
  ImGui::PopStyleColor();
  if (moved) {
    workspace.playback().SetPlaying(false);
    workspace.playback().SetFrame(frame);
  }
  if (shows_time) {
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    DimText(Text("%.2f s", seconds));
  }
}

// Replaces the slider for a live source: its name and the drama's time.
void DrawLive(editor::Workspace& workspace, float switches) {
  const float width = ImGui::GetContentRegionAvail().x - switches;
  const float end = WidestButton(std::array{Tr("End")}, 0.0f);
  const std::string camera =
      editor::IsCameraNumber(workspace.preview().live_camera())
          ? workspace.preview().live_camera()
          : std::filesystem::path(workspace.preview().live_camera()).filename().string();
  const std::string text =
      Text(Tr("Live: camera %s, drama at %.1f s"), camera.c_str(), workspace.playback().time());
  ImGui::AlignTextToFramePadding();
  const float x = ImGui::GetCursorPosX();
  DimText(Elided(text, width - end - ImGui::GetStyle().ItemSpacing.x));
  ImGui::SameLine(x + width - end);
  if (ImGui::Button(Tr("End"))) {
    workspace.preview().SetViewSource(editor::PreviewSession::ViewSource::kRecording);
  }
  Tooltip(Tr("Back to the place's recording"));
}

void DrawTransport(editor::Workspace& workspace, ViewOptions& options, OnionSettings& onion) {
  const std::optional<editor::PreviewSource> recording = workspace.playback().recording();
  ImGui::BeginDisabled(!recording.has_value());
  PlayButton(workspace);
  ImGui::SameLine();
  const std::span<const RowSwitch> switches = SwitchesThatFit(ImGui::GetContentRegionAvail().x);
  float width = 0.0f;
  for (const RowSwitch& entry : switches) {
    width += SwitchWidth(entry);
  }
  if (recording && recording->live) {
    DrawLive(workspace, width);
  } else {
    DrawSlider(workspace, recording, width);
  }
  ImGui::EndDisabled();
  float x = ImGui::GetContentRegionMax().x - width + ImGui::GetStyle().ItemSpacing.x;
  for (const RowSwitch& entry : switches) {
    ImGui::SameLine(x);
    DrawSwitch(options, entry);
    if (entry.key == KeyAction::kOnion) {
      OnionMoreButton(onion);
    }
    x += SwitchWidth(entry);
  }
  DrawOnionMore(onion);
}

// The task that the first picture waits for; nullptr: none.
const editor::BackgroundTask* AwaitedTask(const editor::Workspace& workspace) {
  const editor::BackgroundTask* training = workspace.tasks().Find(editor::TaskKind::kTraining);
  return training != nullptr ? training : workspace.tasks().Find(editor::TaskKind::kOpening);
}

// What is being done, or what to do, until there is a picture.
std::string EmptyText(const editor::Workspace& workspace) {
  if (const editor::BackgroundTask* task = AwaitedTask(workspace)) {
    return editor::TaskText(task->kind(), task->state());
  }
  const bool live = workspace.preview().view_source() == editor::PreviewSession::ViewSource::kLive;
  const char* text =
      live ? Tr("Opening the camera\xe2\x80\xa6") : Tr("Opening the recording\xe2\x80\xa6");
  if (workspace.project().place() == nullptr) {
    text = Tr("This project has no place yet. Train one from a recording.");
  } else if (workspace.map().loaded().database == nullptr && workspace.tasks().entries().empty()) {
    text = Tr("This place is not trained yet. Choose Train\xe2\x80\xa6 above.");
  } else if (workspace.tasks().entries().empty() && !workspace.playback().recording() &&
             !workspace.messages().entries().empty()) {
    text = Tr("No picture. The messages below say why.");
  }
  return text;
}

// Draws the recording's first image, where it is known, and over it the text with the progress.
void DrawEmpty(const editor::Workspace& workspace,
               PictureTextures& pictures,
               const ImVec2& origin,
               const ImVec2& size) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (const std::shared_ptr<const cv::Mat> image = workspace.preview().first_image()) {
    const PictureRect rect = FitPicture(origin, size, image->cols, image->rows);
    draw.AddImage(pictures.Show("first image", image), rect.origin, rect.corner());
  }
  const std::string text = EmptyText(workspace);
  const editor::BackgroundTask* task = AwaitedTask(workspace);
  const float wrap = size.x - Px(64);
  const ImVec2 extent = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
  const float bar = task != nullptr ? Px(14) : 0.0f;  // The height includes the gap above the bar.
  const ImVec2 from(origin.x + 0.5f * (size.x - extent.x),
                    origin.y + 0.5f * (size.y - extent.y - bar));
  const ImVec2 to(from.x + extent.x, from.y + extent.y);
  draw.AddRectFilled(ImVec2(from.x - Px(16), from.y - Px(12)),
                     ImVec2(to.x + Px(16), to.y + bar + Px(12)),
                     Packed(OverPicture().window, 0.85f), Px(6));
  draw.AddText(ImGui::GetFont(), ImGui::GetFontSize(), from, Packed(OverPicture().text),
               text.c_str(), nullptr, wrap);
  if (task != nullptr) {
    const float top = to.y + Px(8);
    const auto done = static_cast<float>(task->state().fraction);
    draw.AddRectFilled(ImVec2(from.x, top), ImVec2(to.x, top + Px(6)), Packed(OverPicture().frame),
                       Px(3));
    draw.AddRectFilled(ImVec2(from.x, top), ImVec2(from.x + done * extent.x, top + Px(6)),
                       Packed(OverPicture().accent), Px(3));
  }
}

}  // namespace

void CameraView::DrawCorners(editor::Workspace& workspace,
                             const Selection& selection,
                             const editor::PreviewPicture& picture,
                             const ImVec2& origin,
                             const ImVec2& size,
                             bool hovered,
                             ImDrawList& draw) {
  const editor::OccluderDocument* occluder = OccluderInWork(workspace, selection);
  if (occluder != nullptr && !workspace.playback().playing()) {
    const editor::FrameToPick frame = workspace.preview().frame_to_pick();
    DrawLabel(ImVec2(origin.x + Px(17), origin.y + Px(52)),
              frame.keyframe ? CornerHint(workspace, *occluder) : Tr(frame.problem),
              Packed(frame.keyframe ? OverPicture().text : OverPicture().warning), draw);
    if (frame.keyframe) {
      const ImageView map{ToEigen(origin), size.x / static_cast<double>(picture.display.width),
                          ImageView::Redrawn{picture.camera, picture.display}};
      DrawOccluderCorners(workspace, *occluder, *frame.keyframe, map, draw);
      const ImVec2 mouse = ImGui::GetMousePos();
      const Eigen::Vector2d pixel = map.ToPixel(ToEigen(mouse));
      const bool inside = mouse.x >= origin.x && mouse.y >= origin.y &&
                          mouse.x < origin.x + size.x && mouse.y < origin.y + size.y;
      if (hovered && inside && picture.camera.Contains(pixel)) {
        ImGui::SetMouseCursor(ImGuiMouseCursor_None);
        DrawCross(mouse, Packed(OverPicture().text), draw);
        draw.PushClipRectFullScreen();
        DrawLoupe(mouse, map.ToPicture(pixel), texture_, draw);
        draw.PopClipRect();
        corners_.Update(workspace, *occluder, *frame.keyframe, map, draw);
      }
    }
  }
  corners_.EndDrag(workspace);
}

void CameraView::Show(const PanelContext& context) {
  auto [workspace, selection, options, tools, cast, pictures, input, dialogs, actions] = context;
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  ImVec2 size = ImGui::GetContentRegionAvail();
  size.y -= ImGui::GetFrameHeightWithSpacing() + Px(4);
  ImGui::InvisibleButton("view", size);
  bool hovered = ImGui::IsItemHovered();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  workspace.preview().look().compare =
      options.show_compare || LightOverlay::ComparesPictures(workspace, selection, tools.light);
  AskForOnionSkin(workspace, options.show_onion, onion_.skin);
  const std::shared_ptr<const editor::PreviewPicture>& picture = workspace.preview().picture();
  if (picture == nullptr || workspace.project().place() == nullptr) {
    DrawEmpty(workspace, pictures, origin, size);
  } else {
    if (picture.get() != uploaded_) {
      texture_.Upload(picture->bgr);
      uploaded_ = picture.get();
    }
    const PictureRect rect = FitPicture(origin, size, picture->bgr.cols, picture->bgr.rows);
    draw.AddImage(ShownTexture(texture_), rect.origin, rect.corner());
    draw.PushClipRect(rect.origin, rect.corner(), true);
    hovered &= !compare_slider_.Show(options.show_compare, *picture, rect.origin, rect.size,
                                     hovered, draw);
    const bool shows_stage = options.show_stage || tools.align.picking;
    if (picture->camera_from_stage && (shows_stage || options.show_occluders)) {
      overlays_.Show(workspace, selection, options,
                     PictureView(*picture, *workspace.project().place(), rect), draw);
    }
    if (picture->camera_from_stage && shows_stage) {
      const ViewCamera view = PictureView(*picture, *workspace.project().place(), rect);
      DrawStage(workspace, view, draw);
      DrawCheckPoints(workspace, selection, tools.check, view, draw);
      const bool picking =
          DrawModelPoints(workspace, selection, options, tools.align, view, hovered, draw);
      const bool walking = walks_.Show(context, view, hovered && !picking, draw);
      DrawGizmo(workspace, selection, options, tools.gizmo, input, view,
                hovered && !picking && !walking, draw);
    }
    if (options.show_matches) {
      DrawTrails(*picture, rect, draw);
    }
    light_.Show(context, *picture, rect.origin, rect.size, hovered, draw);
    DrawBadge(workspace, *picture, rect, draw);
    DrawCorners(workspace, selection, *picture, rect.origin, rect.size, hovered, draw);
    draw.PopClipRect();
  }
  NudgeWithKeys(workspace, input);
  ImGui::SetCursorScreenPos(ImVec2(origin.x, origin.y + size.y + Px(8)));
  DrawTransport(workspace, options, onion_);
}

}  // namespace lararium::panels
