#include "editor/panels/viewport/pick_view.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <vector>

#include "editor/document/place_edits.h"
#include "editor/jobs/check_points.h"
#include "editor/jobs/drawn_occluder.h"
#include "editor/jobs/occluder_alignment.h"
#include "editor/panels/viewport/gizmo_view.h"
#include "editor/panels/viewport/picks_list.h"
#include "editor/panels/viewport/place_cards.h"
#include "editor/panels/viewport/view_tools.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"

namespace lararium::panels {

namespace {

using Eigen::Vector2d;

constexpr std::array<AnchorEntry, 5> kAnchors = {{
    {TrLater("Origin"), TrLater("where the stage begins, on the floor"),
     &stage::StagePicks::origin},
    {TrLater("Forward"), TrLater("a point straight ahead of the origin"),
     &stage::StagePicks::forward},
    {TrLater("Floor"), TrLater("another point of the floor, to the side"),
     &stage::StagePicks::floor},
    {TrLater("Length from"), TrLater("one end of a known length"), &stage::StagePicks::length_from},
    {TrLater("Length to"), TrLater("its other end"), &stage::StagePicks::length_to},
}};

void SetPick(editor::Workspace& workspace,
             int anchor_index,
             const vision::Keyframe& keyframe,
             const Vector2d& pixel) {
  const AnchorEntry& entry = kAnchors[static_cast<size_t>(anchor_index)];
  workspace.project().EditPlace(
      Sentence("pick %s", {Sentence(entry.label)}), [&](editor::PlaceDocument& place) {
        editor::SetPick(place.picks.*entry.anchor,
                        {keyframe.frame_index, keyframe.name, pixel, keyframe.session});
      });
}

void PickCheckPoint(editor::Workspace& workspace,
                    const std::string& name,
                    const vision::Keyframe& keyframe,
                    const Vector2d& pixel) {
  const stage::Pick pick{keyframe.frame_index, keyframe.name, pixel, keyframe.session};
  workspace.project().EditPlace(
      Sentence("pick %s", {name}),
      [&, name](editor::PlaceDocument& place) { editor::SetCheckPick(place, name, pick); });
}

// Draws crosses at the picks of anchors in this image, and rings at the projections of their
// located points: the gap is the residual.
void DrawAnchors(const editor::Workspace& workspace,
                 const PickTarget& target,
                 const vision::Keyframe& keyframe,
                 const ImageView& map,
                 ImDrawList& draw) {
  const stage::StagePicks& picks = workspace.project().place()->picks;
  const std::optional<stage::StageSolution>& solution = workspace.map().loaded().picks.solution;
  for (size_t i = 0; i < kAnchors.size(); ++i) {
    const bool active = static_cast<int>(i) == target.anchor;
    const ImU32 packed = active ? Packed(OverPicture().accent) : Packed(OverPicture().warning);
    const stage::Anchor& anchor = picks.*kAnchors[i].anchor;
    for (const stage::Pick& pick : anchor.picks) {
      if (stage::LiesIn(pick, keyframe)) {
        const ImVec2 at = ToImGui(map.ToScreen(pick.pixel));
        DrawCross(at, packed, draw);
        LabelMark(at, Tr(kAnchors[i].label), packed, draw);
      }
    }
    if (!solution) {
      continue;
    }
    for (const stage::AnchorReport& report : solution->anchors) {
      const auto pixel = workspace.map().loaded().database->camera.Project(
          keyframe.camera_from_map * report.point_in_map);
      if (report.name == anchor.name && pixel) {
        draw.AddCircle(ToImGui(map.ToScreen(*pixel)), Px(6), packed, 0, Px(1.5f));
      }
    }
  }
}

// Draws crosses at the picks of check points in this image, and rings at their known positions: the
// gap is what visitors would see.
void DrawCheckPicks(const editor::Workspace& workspace,
                    const Selection& selection,
                    const vision::Keyframe& keyframe,
                    const ImageView& map,
                    ImDrawList& draw) {
  const editor::PlaceDocument& place = *workspace.project().place();
  const geometry::Similarity3 map_from_stage =
      workspace.map().loaded().picks.map_from_picked * place.picked_from_stage;
  for (const editor::CheckPointDocument& point : workspace.project().document().check_points) {
    const bool active = point.name == selection.name;
    const ImU32 packed = Packed(active ? OverPicture().accent : OverPicture().warning);
    const stage::Anchor* anchor = editor::FindCheckPicks(place, point.name);
    const stage::Pick* pick = anchor != nullptr ? editor::PickIn(*anchor, keyframe) : nullptr;
    if (pick != nullptr) {
      const ImVec2 at = ToImGui(map.ToScreen(pick->pixel));
      DrawCross(at, packed, draw);
      LabelMark(at, point.name, packed, draw);
    }
    const auto pixel = workspace.map().loaded().database->camera.Project(
        keyframe.camera_from_map * (map_from_stage * point.position));
    if (pixel && (active || pick != nullptr)) {
      draw.AddCircle(ToImGui(map.ToScreen(*pixel)), Px(6), packed, 0, Px(1.5f));
    }
  }
}

void PickModelPoint(editor::Workspace& workspace,
                    const ModelPairInWork& work,
                    const vision::Keyframe& keyframe,
                    const Vector2d& pixel) {
  const stage::Pick pick{keyframe.frame_index, keyframe.name, pixel, keyframe.session};
  const std::string name = work.occluder->name;
  workspace.project().EditOccluder(Sentence("pick %s", {name}), name,
                                   [&, pair = work.pair](editor::OccluderDocument& occluder) {
                                     editor::SetModelPick(occluder, pair, pick);
                                   });
}

// Draws crosses at the picks of a model's points in this image, and rings at their present
// projections.
void DrawModelPicks(const editor::Workspace& workspace,
                    const ModelPairInWork& work,
                    const vision::Keyframe& keyframe,
                    const ImageView& map,
                    ImDrawList& draw) {
  const geometry::Similarity3 map_from_mesh = workspace.map().loaded().picks.map_from_picked *
                                              workspace.project().place()->picked_from_stage *
                                              work.occluder->stage_from_mesh;
  const std::vector<editor::ModelPairDocument>& pairs = work.occluder->model_pairs;
  for (size_t i = 0; i < pairs.size(); ++i) {
    const ImU32 packed = Packed(i == work.pair ? OverPicture().accent : OverPicture().warning);
    if (const stage::Pick* pick = editor::PickIn(pairs[i].anchor, keyframe)) {
      const ImVec2 at = ToImGui(map.ToScreen(pick->pixel));
      DrawCross(at, packed, draw);
      LabelMark(at, std::to_string(i + 1), packed, draw);
    }
    const auto pixel = workspace.map().loaded().database->camera.Project(
        keyframe.camera_from_map * (map_from_mesh * pairs[i].on_mesh));
    if (pixel) {
      draw.AddCircle(ToImGui(map.ToScreen(*pixel)), Px(6), packed, 0, Px(1.5f));
    }
  }
}

// Draws as much of a text as fits on the same line; a tooltip shows all of it.
void DimTextBeside(const std::string& text) {
  ImGui::SameLine(0.0f, Px(14));
  const float width = ImGui::GetContentRegionAvail().x;
  if (width < Px(60)) {
    ImGui::NewLine();
    return;
  }
  ImGui::AlignTextToFramePadding();
  const std::string shown = Elided(text, width);
  DimText(shown);
  if (shown != text) {
    Tooltip(text);
  }
}

void DrawAnchorButtons(const editor::Workspace& workspace, PickTarget& picks) {
  std::array<std::string, kAnchors.size()> labels;
  std::array<const char*, kAnchors.size()> texts = {};
  for (size_t i = 0; i < kAnchors.size(); ++i) {
    const size_t count = (workspace.project().place()->picks.*kAnchors[i].anchor).picks.size();
    labels[i] = Tr(kAnchors[i].label) + std::string("  ") + std::to_string(count);
    texts[i] = labels[i].c_str();
  }
  Segmented("anchors", texts, picks.anchor);
  DimTextBeside(Tr(kAnchors[static_cast<size_t>(picks.anchor)].hint));
}

void DrawCornerHint(const editor::Workspace& workspace, const editor::OccluderDocument& occluder) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(occluder.name.c_str());
  DimTextBeside(CornerHint(workspace, occluder));
}

void DrawCheckHint(const editor::Workspace& workspace, CheckView& check, const std::string& name) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(name.c_str());
  for (const editor::CheckPointReport& point : CheckedPoints(workspace, check).points) {
    if (point.name == name) {
      DimTextBeside(
          point.located()
              ? Text(Tr("%d picks agree to %.2f px; the ring is where the stage says it is"),
                     point.anchor.picks, point.anchor.error_px)
              : Tr("Click it in this image, then in one taken from elsewhere."));
    }
  }
}

void DrawModelHint(const editor::Workspace& workspace,
                   AlignView& align,
                   const ModelPairInWork& work) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(
      Text(Tr("%s, point %d"), work.occluder->name.c_str(), static_cast<int>(work.pair) + 1)
          .c_str());
  const editor::ModelPairReport& pair =
      Alignment(workspace, align, *work.occluder).pairs[work.pair];
  DimTextBeside(pair.located && pair.anchor.picks > 1
                    ? Text(Tr("%d picks agree to %.2f px; the ring is where the model has it"),
                           pair.anchor.picks, pair.anchor.error_px)
                    : Tr("Click it in this image, then in one taken from elsewhere."));
}

}  // namespace

std::span<const AnchorEntry> AnchorEntries() { return kAnchors; }

const editor::OccluderDocument* OccluderInWork(const editor::Workspace& workspace,
                                               const Selection& selection) {
  if (workspace.project().place() == nullptr || selection.kind != Selection::Kind::kOccluder) {
    return nullptr;
  }
  const editor::OccluderDocument* occluder =
      workspace.project().place()->FindOccluder(selection.name);
  return occluder != nullptr && occluder->drawn() ? occluder : nullptr;
}

void DrawNewOccluder(editor::Workspace& workspace, Selection& selection, ViewOptions& options) {
  editor::OccluderDocument occluder;
  for (int number = 1; occluder.name.empty(); ++number) {
    const std::string name = "face" + std::to_string(number);
    if (workspace.project().place()->FindOccluder(name) == nullptr) {
      occluder.name = name;
    }
  }
  workspace.project().EditPlace(
      Sentence("add %s", {occluder.name}),
      [&](editor::PlaceDocument& place) { place.occluders.push_back(occluder); });
  selection = {Selection::Kind::kOccluder, occluder.name};
  options.view = ViewKind::kPicks;
}

void PickView::DrawImage(editor::Workspace& workspace,
                         const Selection& selection,
                         PickTarget& picks,
                         const AlignView& align,
                         const vision::Keyframe& keyframe) {
  const geometry::CameraModel& camera = workspace.map().loaded().database->camera;
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
  const PictureRect rect = FitPicture(corner, size, camera.width, camera.height);
  const ImageView map{ToEigen(rect.origin), rect.size.x / static_cast<double>(camera.width)};
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddImage(ShownTexture(texture_), rect.origin, rect.corner());
  if (keyframe.grey.empty()) {
    draw.AddText(ToImGui(map.origin + Vector2d(Px(12), Px(12))), Packed(OverPicture().dim),
                 Tr("The map was made small and holds no image here."));
  }
  const editor::OccluderDocument* drawn = OccluderInWork(workspace, selection);
  // Drawing outside the image must not cover the controls.
  draw.PushClipRect(corner, ImVec2(corner.x + size.x, corner.y + size.y), true);
  const editor::CheckPointDocument* checked = SelectedCheckPoint(workspace, selection);
  const ModelPairInWork modelled = PairInWork(workspace, selection, align);
  if (drawn != nullptr) {
    DrawOccluderCorners(workspace, *drawn, keyframe, map, draw);
  } else if (checked != nullptr) {
    DrawCheckPicks(workspace, selection, keyframe, map, draw);
  } else if (modelled.occluder != nullptr) {
    DrawModelPicks(workspace, modelled, keyframe, map, draw);
  } else {
    DrawAnchors(workspace, picks, keyframe, map, draw);
  }
  draw.PopClipRect();
  const Vector2d pixel = map.ToPixel(ToEigen(ImGui::GetMousePos()));
  if (hovered && camera.Contains(pixel)) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_None);
    DrawCross(ImGui::GetMousePos(), Packed(OverPicture().text), draw);
    DrawLoupe(ImGui::GetMousePos(), pixel, texture_, draw);
    if (drawn != nullptr) {
      corners_.Update(workspace, *drawn, keyframe, map, draw);
    } else if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
      if (checked != nullptr) {
        PickCheckPoint(workspace, checked->name, keyframe, pixel);
      } else if (modelled.occluder != nullptr) {
        PickModelPoint(workspace, modelled, keyframe, pixel);
      } else {
        SetPick(workspace, picks.anchor, keyframe, pixel);
      }
    }
  }
  corners_.EndDrag(workspace);
  ImGui::SetCursorScreenPos(ImVec2(corner.x, corner.y + size.y + Px(8)));
}

void PickView::Show(const PanelContext& context) {
  auto [workspace, selection, options, tools, cast, pictures, input, dialogs, actions] = context;
  const auto& database = workspace.map().loaded().database;
  if (workspace.project().place() == nullptr || database == nullptr ||
      database->keyframes.empty()) {
    uploaded_ = nullptr;
    Hint(Tr("Picks are made in the training images. Train the place first."));
    return;
  }
  if (const editor::OccluderDocument* drawn = OccluderInWork(workspace, selection)) {
    DrawCornerHint(workspace, *drawn);
  } else if (const editor::CheckPointDocument* checked = SelectedCheckPoint(workspace, selection)) {
    DrawCheckHint(workspace, tools.check, checked->name);
  } else if (const ModelPairInWork work = PairInWork(workspace, selection, tools.align);
             work.occluder != nullptr) {
    DrawModelHint(workspace, tools.align, work);
  } else {
    DrawAnchorButtons(workspace, tools.picks);
  }
  const int last = static_cast<int>(database->keyframes.size()) - 1;
  tools.picks.keyframe = std::clamp(tools.picks.keyframe, 0, last);
  HandlePickKeys(workspace, selection, tools.picks, tools.align, input);
  const vision::Keyframe& keyframe = database->keyframes[static_cast<size_t>(tools.picks.keyframe)];
  DrawImage(workspace, selection, tools.picks, tools.align, keyframe);
  std::string name = keyframe.name;
  if (keyframe.session != 0) {
    name += ", " + SessionName(*workspace.project().place(), keyframe.session);
  }
  const float name_width = ImGui::CalcTextSize(name.c_str()).x + Px(12);
  const float steps = 2 * ImGui::GetFrameHeight() + Px(4) + ImGui::GetStyle().ItemSpacing.x;
  const float width = ImGui::GetContentRegionAvail().x - name_width - steps;
  const std::string longest = Text(Tr("training image %d"), last);
  const bool named = ImGui::CalcTextSize(longest.c_str()).x + Px(16) <= width;
  ImGui::SetNextItemWidth(width);
  ImGui::SliderInt("##keyframe", &tools.picks.keyframe, 0, last,
                   named ? Tr("training image %d") : "%d", ImGuiSliderFlags_AlwaysClamp);
  ImGui::SameLine();
  DrawPickSteps(workspace, selection, options, tools.picks, tools.align, input);
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  DimText(name);
}

}  // namespace lararium::panels
