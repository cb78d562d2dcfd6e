#include "editor/panels/viewport/place_cards.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "editor/jobs/staging.h"
#include "editor/panels/viewport/gizmo_view.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"

namespace lararium::panels {

namespace {

using Eigen::Vector3d;
using geometry::Similarity3;

constexpr float kToolsWidth = 316.0f;  // logical pixels
constexpr float kPointWidth = 300.0f;
constexpr float kMargin = 10.0f;

constexpr const char* kTools = "place tools";
constexpr const char* kPointCard = "point card";

// The height of a card in the last frame.
float& CardHeight(const char* id) {
  return *ImGui::GetStateStorage()->GetFloatRef(ImGui::GetID(id), Px(40));
}

// A panel over a view, as high as its content in the last frame. corner: 0 or 1 along each axis of
// the view.
void DrawCard(Input& input,
              const char* id,
              const ImVec2& origin,
              const ImVec2& size,
              const ImVec2& corner,
              float width,
              const std::function<void()>& content) {
  float& height = CardHeight(id);
  const float wide = std::min(Px(width), size.x - 2 * Px(kMargin));
  const auto along = [](float from, float whole, float extent, float share) {
    return from + Px(kMargin) + share * (whole - extent - 2 * Px(kMargin));
  };
  ImGui::SetCursorScreenPos(
      ImVec2(along(origin.x, size.x, wide, corner.x), along(origin.y, size.y, height, corner.y)));
  ImGui::PushStyleColor(ImGuiCol_ChildBg, WithAlpha(Colours().panel, 0.94f));
  ImGui::PushStyleVar(ImGuiStyleVar_ChildRounding, Px(4));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(Px(10), Px(8)));
  ImGui::BeginChild(id, ImVec2(wide, height), false,
                    ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar |
                        ImGuiWindowFlags_NoScrollWithMouse);
  content();
  height = ImGui::GetCursorPosY() - ImGui::GetStyle().ItemSpacing.y + Px(8);
  if (ImGui::IsWindowHovered() && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    input.focus = Focus::kViews;
  }
  ImGui::EndChild();
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor();
}

// ------------------------------------------------------------ Legends

void DrawRamp(const std::array<std::string, 3>& labels) {
  constexpr int kParts = 24;
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const float height = Px(10);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  for (int i = 0; i < kParts; ++i) {
    const ImU32 left = Packed(RampColour(static_cast<double>(i) / kParts));
    const ImU32 right = Packed(RampColour(static_cast<double>(i + 1) / kParts));
    draw.AddRectFilledMultiColor(
        ImVec2(from.x + width * static_cast<float>(i) / kParts, from.y),
        ImVec2(from.x + width * static_cast<float>(i + 1) / kParts, from.y + height), left, right,
        right, left);
  }
  ImGui::Dummy(ImVec2(width, height));
  const ImVec2 below = ImGui::GetCursorScreenPos();
  for (size_t i = 0; i < labels.size(); ++i) {
    const float share = static_cast<float>(i) / (static_cast<float>(labels.size()) - 1.0f);
    const float extent = ImGui::CalcTextSize(labels[i].c_str()).x;
    ImGui::SetCursorScreenPos(ImVec2(from.x + share * (width - extent), below.y));
    DimText(labels[i]);
  }
}

void DrawSwatch(const ImVec4& colour, const std::string& text) {
  const float side = Px(11);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float down = 0.5f * (ImGui::GetTextLineHeight() - side);
  ImGui::GetWindowDrawList()->AddRectFilled(
      ImVec2(at.x, at.y + down), ImVec2(at.x + side, at.y + down + side), Packed(colour), Px(2));
  ImGui::Dummy(ImVec2(side, ImGui::GetTextLineHeight()));
  ImGui::SameLine(0.0f, Px(7));
  DimText(Elided(text, ImGui::GetContentRegionAvail().x));
}

void DrawSessionLegend(const editor::PlaceDocument& place, const vision::SceneDatabase& database) {
  constexpr size_t kMostRows = 10;
  const std::vector<uint32_t> sessions = SessionsOf(database);
  for (size_t i = 0; i < sessions.size() && i < kMostRows; ++i) {
    DrawSwatch(SessionColour(sessions[i]), SessionName(place, sessions[i]));
  }
  if (sessions.size() > kMostRows) {
    DimText(Text(Tr("and %zu more"), sessions.size() - kMostRows));
  }
  if (sessions.size() > 1) {
    DrawSwatch(kSeveralColour, Tr("several sessions"));
  }
}

void DrawLegend(const editor::Workspace& workspace, const PlaceView& place) {
  const ColourRange& range = place.range;
  switch (place.colours) {
    case PointColour::kPicture:
      break;
    case PointColour::kSessions:
      DrawSessionLegend(*workspace.project().place(), *workspace.map().loaded().database);
      break;
    case PointColour::kError:
      DrawRamp({"0", Text("%.3g", 0.5 * range.high), Text(Tr("%.3g px or more"), range.high)});
      break;
    case PointColour::kViews:
      DrawRamp({Text("%.3g", range.low), Text("%.3g", 0.5 * (range.low + range.high)),
                Text(Tr("%.3g views or more"), range.high)});
      break;
  }
}

// ------------------------------------------------------------ Selected points

std::string SessionsText(const editor::PlaceDocument& place, uint32_t mask) {
  std::string text;
  for (uint32_t session = 0; session < 32; ++session) {
    if ((mask >> session & 1) != 0) {
      text += (text.empty() ? "" : ", ") + SessionName(place, session);
    }
  }
  return text;
}

Similarity3 MapFromStage(const editor::Workspace& workspace) {
  return workspace.map().loaded().picks.map_from_picked *
         workspace.project().place()->picked_from_stage;
}

Vector3d PointInMap(const editor::Workspace& workspace, uint32_t point) {
  return workspace.map().loaded().database->points[point].cast<double>();
}

void DrawPoint(const editor::Workspace& workspace, uint32_t point) {
  const editor::LoadedMap& loaded = workspace.map().loaded();
  Heading(Text(Tr("Point %d"), static_cast<int>(point)).c_str());
  if (!BeginProperties("point", 76.0f)) {
    return;
  }
  const Vector3d at = MapFromStage(workspace).Inverse() * PointInMap(workspace, point);
  PropertyText(Tr("Position"), Text("%.3f, %.3f, %.3f m", at.x(), at.y(), at.z()));
  const float error = loaded.statistics->point_error_px[point];
  PropertyText(Tr("Error"), error < 0.0f ? std::string("-") : Text("%.2f px", error));
  PropertyText(Tr("Views"), std::to_string(loaded.statistics->ViewsOf(point)));
  PropertyText(Tr("Sessions"),
               SessionsText(*workspace.project().place(), loaded.database->session_masks[point]));
  EndProperties();
}

double ChosenDistance(const editor::Workspace& workspace, const PlaceView& place) {
  return editor::StageDistance(MapFromStage(workspace), PointInMap(workspace, place.points[0]),
                               PointInMap(workspace, place.points[1]));
}

std::string DistanceText(const editor::Workspace& workspace, const PlaceView& place) {
  const editor::LoadedMap& loaded = workspace.map().loaded();
  std::string text = Text("%.3f m", ChosenDistance(workspace, place));
  if (const auto deviation = train::DistanceDeviation(*loaded.database, *loaded.statistics,
                                                      place.points[0], place.points[1])) {
    text += Text(" \xc2\xb1 %.1f mm", 1000.0 * *deviation / MapFromStage(workspace).scale);
  }
  return text;
}

const char* WhatSetsMetres(const editor::LoadedMap& loaded) {
  if (loaded.measures.tags) {
    return Tr(
        "Metres come from the tags. The scale is a correction of them that stays when the place is "
        "trained again.");
  }
  if (loaded.picks.solution) {
    return Tr(
        "Metres come from the picked length. The scale is a correction of it that stays when the "
        "place is trained again.");
  }
  return Tr(
      "Metres are a guess from this map. After training again, set the scale again; picks with a "
      "known length, or tags, keep it.");
}

void DrawDistance(editor::Workspace& workspace, PlaceView& place) {
  const double said = ChosenDistance(workspace, place);
  if (!(place.metres > 0.0)) {
    place.metres = said;
  }
  Heading(Tr("Distance"));
  if (BeginProperties("distance", 76.0f)) {
    PropertyText(Tr("On stage"), DistanceText(workspace, place));
    Tooltip(
        Tr("The standard deviation is what the points' sights leave open: the angles they are seen "
           "under and how far they lie off. Errors that the whole map has in common are not in "
           "it."));
    PropertyLabel(Tr("In truth"));
    ImGui::InputDouble("##metres", &place.metres, 0.0, 0.0, "%.3f m");
    place.metres = std::clamp(place.metres, 0.001, 1e4);
    PropertyText(Tr("Residual"), Text("%+.2f %%", 100.0 * (said / place.metres - 1.0)));
    EndProperties();
  }
  // Both values have the same text, so there is nothing to do.
  const bool same = std::abs(said - place.metres) < 0.0005;
  ImGui::BeginDisabled(same || !(said > 0.0));
  if (ImGui::Button(Tr("Set the scale"), ImVec2(-FLT_MIN, 0))) {
    workspace.map().SetDistance(place.points[0], place.points[1], place.metres);
  }
  ImGui::EndDisabled();
  Tooltip(!(said > 0.0) ? Tr("The two points lie in one place. Choose others.")
          : same        ? Tr("They are so far apart already. Type what it is in truth.")
                        : Tr("Scales the stage about its origin until they are so far apart"));
  Hint(WhatSetsMetres(workspace.map().loaded()));
}

// Whether there are selected points that still exist.
bool AnyChosen(const editor::Workspace& workspace, const PlaceView& place) {
  const editor::LoadedMap& loaded = workspace.map().loaded();
  return !place.points.empty() && workspace.project().place() != nullptr &&
         loaded.statistics != nullptr &&
         std::all_of(place.points.begin(), place.points.end(),
                     [&](uint32_t point) { return point < loaded.database->points.size(); });
}

}  // namespace

const char* PointColourName(PointColour colour) {
  switch (colour) {
    case PointColour::kPicture:
      return TrIn("colour of points", "Picture");
    case PointColour::kError:
      return TrIn("colour of points", "Error");
    case PointColour::kViews:
      return TrIn("colour of points", "Views");
    case PointColour::kSessions:
      return TrIn("colour of points", "Sessions");
  }
  return "";
}

void ChooseNoPoints(PlaceView& place_view) {
  place_view.points.clear();
  place_view.metres = 0.0;
}

std::string SessionName(const editor::PlaceDocument& place, uint32_t session) {
  std::string path;
  if (session == 0) {
    path = place.training.path;
  } else if (session <= place.added.size()) {
    path = place.added[session - 1].source.path;
  }
  const std::string name = std::filesystem::path(path).filename().string();
  return name.empty() ? Text(Tr("session %d"), static_cast<int>(session)) : name;
}

// Buttons that bring the view to the stage, to the whole map or to the selection.
void DrawLookButtons(PlaceView& place) {
  using LookAt = PlaceView::LookAt;
  struct Target {
    const char* label;
    LookAt look_at;
    const char* tip;
    const char* keys;
  };
  const std::string home = KeyText(KeyAction::kLookAtStage);
  const std::string all = std::string(Tr("Shift")) + "+" + home;
  const std::string selected = KeyText(KeyAction::kLookAtSelected);
  const Target targets[] = {
      {Tr("Stage"), LookAt::kStage, Tr("Looks at the stage as at first"), home.c_str()},
      {Tr("Map"), LookAt::kMap, Tr("Looks at all of the map"), all.c_str()},
      {Tr("Selected"), LookAt::kSelected, Tr("Looks at what is selected"), selected.c_str()}};
  ImGui::AlignTextToFramePadding();
  DimText(Tr("Look at"));
  for (const Target& target : targets) {
    SameLineIfFits(std::array{target.label});
    if (ImGui::Button(target.label)) {
      place.look_at = target.look_at;
    }
    Tip(std::string(target.tip) + " (" + target.keys + ")");
  }
}

void DrawPlaceTools(editor::Workspace& workspace,
                    ViewOptions& options,
                    PlaceView& place_view,
                    Input& input,
                    const ImVec2& origin,
                    const ImVec2& size) {
  if (workspace.project().place() == nullptr || workspace.map().loaded().statistics == nullptr) {
    return;
  }
  const bool fits = CardHeight(kTools) + CardHeight(kPointCard) + 3 * Px(kMargin) <= size.y;
  if (!fits && AnyChosen(workspace, place_view)) {
    return;  // The card of the selected points replaces the buttons in a small view.
  }
  DrawCard(input, kTools, origin, size, ImVec2(0, 0), kToolsWidth, [&] {
    std::array<const char*, kPointColours> labels = {};
    for (int i = 0; i < kPointColours; ++i) {
      labels[static_cast<size_t>(i)] = PointColourName(static_cast<PointColour>(i));
    }
    int colours = static_cast<int>(place_view.colours);
    ImGui::BeginGroup();
    if (Segmented("colours", labels, colours)) {
      place_view.colours = static_cast<PointColour>(colours);
    }
    ImGui::EndGroup();
    Tooltip(WithKey(Tr("What the points are coloured by: the picture, their mean error, how many "
                       "images show them, the sessions that saw them"),
                    KeyAction::kPointColours));
    DrawLegend(workspace, place_view);
    ImGui::Checkbox(Tr("Measure"), &place_view.measure);
    Tooltip(WithKey(Tr("A click chooses a point, the next one the other end of a distance"),
                    KeyAction::kMeasure));
    SameLineIfFits(std::array{Tr("In steps"), "    "}, Px(16));
    ImGui::Checkbox(Tr("In steps"), &options.snap);
    Tooltip(WithKey(
        Tr("Handles move by 5 cm (1 cm with Shift), turn by 5\xc2\xb0, scale by a twentieth "
           "and stop at the floor. Ctrl does so for one drag."),
        KeyAction::kSnapHandles));
    DrawLookButtons(place_view);
  });
}

void DrawPointCard(editor::Workspace& workspace,
                   PlaceView& place_view,
                   Input& input,
                   const ImVec2& origin,
                   const ImVec2& size) {
  if (!AnyChosen(workspace, place_view)) {
    return;
  }
  DrawCard(input, kPointCard, origin, size, ImVec2(1, 1), kPointWidth, [&] {
    if (place_view.points.size() == 1) {
      DrawPoint(workspace, place_view.points.front());
      Hint(Tr("Shift and a click on another point measures."));
    } else {
      DrawDistance(workspace, place_view);
    }
  });
}

void DrawChosenPoints(const editor::Workspace& workspace,
                      const PlaceView& place_view,
                      const ViewCamera& view,
                      ImDrawList& draw) {
  if (!AnyChosen(workspace, place_view)) {
    return;
  }
  const editor::LoadedMap& loaded = workspace.map().loaded();
  const Similarity3 world_from_map = loaded.picks.map_from_picked.Inverse();
  std::vector<Vector3d> ends;
  for (const uint32_t point : place_view.points) {
    ends.push_back(world_from_map * PointInMap(workspace, point));
  }
  if (ends.size() == 1) {
    for (const uint32_t observation :
         loaded.statistics->ObservationsOf(place_view.points.front())) {
      const vision::Keyframe& keyframe =
          loaded.database->keyframes[loaded.database->observations[observation].keyframe];
      const ImVec4 colour = place_view.colours == PointColour::kSessions
                                ? SessionColour(keyframe.session)
                                : OverPicture().warning;
      DrawWorldLine(view, ends.front(), world_from_map * keyframe.camera_from_map.Center(),
                    Packed(colour, 0.45f), Px(1), draw);
    }
  } else {
    DrawWorldLine(view, ends[0], ends[1], Packed(OverPicture().accent), Px(2), draw);
    if (const auto middle = view.Project(0.5 * (ends[0] + ends[1]))) {
      LabelMark(ToImGui(*middle), DistanceText(workspace, place_view), Packed(OverPicture().text),
                draw);
    }
  }
  for (const Vector3d& end : ends) {
    if (const auto pixel = view.Project(end)) {
      draw.AddCircleFilled(ToImGui(*pixel), Px(3.5f), Packed(OverPicture().accent));
      draw.AddCircle(ToImGui(*pixel), Px(7), Packed(OverPicture().text), 0, Px(1.5f));
    }
  }
}

void KeyframeCard::Show(const editor::Workspace& workspace,
                        PictureTextures& pictures,
                        uint32_t keyframe) {
  const editor::LoadedMap& loaded = workspace.map().loaded();
  const vision::Keyframe& shown = loaded.database->keyframes[keyframe];
  if (database_ != loaded.database || keyframe_ != keyframe) {
    database_ = loaded.database;
    keyframe_ = keyframe;
    picture_ = nullptr;
    if (!shown.grey.empty()) {
      constexpr int kWidth = 256;  // pixels
      cv::Mat small;
      const int height = std::max(1, shown.grey.rows * kWidth / shown.grey.cols);
      cv::resize(shown.grey, small, cv::Size(kWidth, height), 0.0, 0.0, cv::INTER_AREA);
      cv::cvtColor(small, small, cv::COLOR_GRAY2BGR);
      picture_ = std::make_shared<const cv::Mat>(std::move(small));
    }
  }
  ImGui::BeginTooltip();
  if (picture_ != nullptr) {
    const float width = Px(220);
    const float height =
        width * static_cast<float>(picture_->rows) / static_cast<float>(picture_->cols);
    ImGui::Image(pictures.Show("keyframe", picture_), ImVec2(width, height));
  } else {
    DimText(Tr("The map was made small and holds no image here."));
  }
  ImGui::TextUnformatted(shown.name.c_str());
  DimText(SessionName(*workspace.project().place(), shown.session));
  const float error = loaded.statistics->keyframe_error_px[keyframe];
  const int points = static_cast<int>(loaded.statistics->keyframe_points[keyframe]);
  DimText(TrCount("%d point", "%d points", points) +
          (error < 0.0f ? std::string() : Text(", %.2f px", error)));
  DimText(Tr("A click shows it among the picks."));
  ImGui::EndTooltip();
}

}  // namespace lararium::panels
