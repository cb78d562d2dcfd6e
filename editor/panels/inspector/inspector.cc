#include "editor/panels/inspector/inspector.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "editor/document/place_edits.h"
#include "editor/panels/inspector/cast_inspector.h"
#include "editor/panels/inspector/light_panel.h"
#include "editor/panels/inspector/object_inspector.h"
#include "editor/panels/inspector/occluder_inspector.h"
#include "editor/panels/inspector/place_inspector.h"
#include "editor/panels/inspector/project_inspector.h"
#include "editor/panels/viewport/check_point_panel.h"
#include "editor/panels/viewport/gizmo_view.h"
#include "editor/panels/viewport/pick_view.h"
#include "editor/panels/viewport/picks_list.h"
#include "editor/panels/viewport/place_cards.h"
#include "editor/panels/viewport/trackball_view.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"
#include "editor/panels/widgets/wrapped_field.h"
#include "shared/core/units.h"

namespace lararium::panels {

namespace {

using geometry::Similarity3;

void DrawProject(editor::Workspace& workspace, Dialogs& dialogs) {
  Heading(Tr("Project"));
  if (!BeginProperties("project")) {
    return;
  }
  std::string title = workspace.project().document().title;
  PropertyLabel(Tr("Title"));
  if (ImGui::InputText("##title", &title)) {
    workspace.project().Edit(
        Sentence("title"), [&](editor::ProjectDocument& document) { document.title = title; },
        "title");
  }
  if (ImGui::IsItemDeactivated()) {
    workspace.project().EndGesture();
  }
  std::string credits = workspace.project().document().credits;
  PropertyLabel(Tr("Credits"));
  if (WrappedField("credits", credits, 4, 16)) {
    workspace.project().Edit(
        Sentence("credits"), [&](editor::ProjectDocument& document) { document.credits = credits; },
        "credits");
  }
  if (ImGui::IsItemDeactivated()) {
    workspace.project().EndGesture();
  }
  PropertyText(Tr("Drama"), workspace.project().paths().Drama().filename().string());
  EndProperties();
  DrawLanguages(workspace);
  DrawSounds(workspace, dialogs);
}

std::string SourceText(const editor::SourceDocument& source) {
  return source.empty() ? Tr("none") : source.path;
}

void DrawMap(const editor::Workspace& workspace, const vision::SceneDatabase& database) {
  const geometry::CameraModel& camera = database.camera;
  const editor::TrainingReport* training = workspace.map().loaded().report.get();
  if (training != nullptr) {
    PropertyText(Tr("Frames"), Text(Tr("%d of %d located"), training->located, training->frames));
  }
  PropertyText(Tr("Keyframes"), std::to_string(database.keyframes.size()));
  PropertyText(Tr("Points"), std::to_string(database.points.size()));
  PropertyText(Tr("Error"), Text("%.3f px", database.mean_reprojection_error_px));
  PropertyText(Tr("Image"), Text("%d \xc3\x97 %d", camera.width, camera.height));
  std::string focal = Text("%.1f, %.1f px", camera.fx, camera.fy);
  const bool estimated = training != nullptr && training->focal_deviation_px.has_value();
  if (estimated) {
    focal = Text("%.1f \xc2\xb1 %.1f px", camera.fx, *training->focal_deviation_px);
  }
  PropertyText(Tr("Focal"), focal);
  if (estimated && ImGui::IsItemHovered()) {
    ImGui::SetTooltip("%s",
                      Tr("Estimated from the video itself; \xc2\xb1 is a standard deviation."));
  }
  PropertyText(Tr("Centre"), Text("%.1f, %.1f px", camera.cx, camera.cy));
  PropertyText(Tr("Distortion"), Text("%.4f, %.4f", camera.k1, camera.k2));
}

const char* ScaleSource(const editor::LoadedMap& loaded) {
  if (!loaded.measured) {
    return Tr("being measured");
  }
  if (loaded.measures.tags) {
    return Tr("tags in the images");
  }
  return loaded.picks.solution ? Tr("the picked length") : Tr("a guess");
}

// The source of the stage's scale, and its error.
void DrawScale(editor::Workspace& workspace, const editor::PlaceDocument& place) {
  Heading(Tr("Metres"));
  const editor::LoadedMap& loaded = workspace.map().loaded();
  editor::TagsDocument tags = place.tags.value_or(editor::TagsDocument());
  bool changed = false;
  if (BeginProperties("scale")) {
    PropertyText(Tr("From"), ScaleSource(loaded));
    if (loaded.measures.tags) {
      const train::TagScale& scale = *loaded.measures.tags;
      PropertyText(Tr("Tags"),
                   Text(Tr("%zu, %zu left out"), scale.tags.size(), scale.left_out.size()));
      PropertyText(Tr("Uncertainty"), Text("\xc2\xb1 %.2f %%", 100.0 * scale.deviation));
      PropertyText(Tr("Residual"), Text(Tr("%.2f %% of the sides"), 100.0 * scale.spread));
    }
    if (loaded.picks.solution) {
      const stage::StageSolution& solution = *loaded.picks.solution;
      PropertyText(Tr("Known length"), Text(Tr("%.3f m, measured %.3f m"), place.picks.length_m,
                                            solution.measured_length_m));
      PropertyText(Tr("for each px"), Text("\xc2\xb1 %.2f cm (%.2f %%)",
                                           100.0 * solution.length_spread * place.picks.length_m,
                                           100.0 * solution.length_spread));
    }
    if (place.picked_from_stage.scale != 1.0) {
      PropertyText(Tr("By hand"), Text("\xc3\x97 %.4f", place.picked_from_stage.scale));
    }
    if (place.tags) {
      PropertyLabel(Tr("Family"));
      if (ImGui::BeginCombo("##family", tags.family.c_str())) {
        for (const std::string_view family : train::TagFamilies()) {
          if (ImGui::Selectable(std::string(family).c_str(), family == tags.family)) {
            tags.family = family;
            changed = true;
          }
        }
        ImGui::EndCombo();
      }
      changed |=
          NumberProperty(workspace, Tr("Tag size"), tags.size_m, 0.001, 0.001, 100.0, "%.4f m");
    }
    EndProperties();
  }
  if (changed) {
    workspace.project().EditPlace(
        Sentence("tags"), [&](editor::PlaceDocument& p) { p.tags = tags; }, "tags");
  }
  if (!loaded.measures.tag_problem.ok()) {
    Hint(loaded.measures.tag_problem.message());
  }
  if (!place.tags) {
    Hint(
        Tr("An AprilTag of known size in view of the recording gives the metres without picking."));
    if (ImGui::Button(Tr("Take the metres from tags"), ImVec2(-FLT_MIN, 0))) {
      workspace.project().EditPlace(Sentence("metres from tags"), [](editor::PlaceDocument& p) {
        p.tags = editor::TagsDocument();
        p.tags->size_m = 0.1;
      });
    }
  } else if (ImGui::Button(Tr("Do without tags"), ImVec2(-FLT_MIN, 0))) {
    workspace.project().EditPlace(Sentence("do without tags"),
                                  [](editor::PlaceDocument& p) { p.tags.reset(); });
  }
}

// A description of the command, or why it is not possible.
const char* AboutLayingOnFloor(const editor::LoadedMap& loaded) {
  if (loaded.database == nullptr) {
    return Tr("The place has to be trained first: its floor is looked for in the map.");
  }
  if (!loaded.measured) {
    return Tr("The floor is still being looked for in the map.");
  }
  if (!loaded.measures.floor) {
    return Tr("No large level surface was found among the points.");
  }
  return Tr("Levels the stage and lays it on the floor that was found in the map");
}

void LayOnFloorButton(editor::Workspace& workspace) {
  ImGui::BeginDisabled(!workspace.map().loaded().measures.floor.has_value());
  if (ImGui::Button(Tr("Lay the stage on the floor"), ImVec2(-FLT_MIN, 0))) {
    workspace.map().LayStageOnFloor();
  }
  ImGui::EndDisabled();
  Tooltip(AboutLayingOnFloor(workspace.map().loaded()));
}

void DrawFloor(editor::Workspace& workspace, const editor::PlaceDocument& place) {
  Heading(Tr("Floor"));
  const editor::LoadedMap& loaded = workspace.map().loaded();
  if (!loaded.measures.floor) {
    Hint(Tr("No large level surface was found among the points."));
    return;
  }
  const train::FloorPlane& floor = *loaded.measures.floor;
  const Similarity3 map_from_stage = loaded.picks.map_from_picked * place.picked_from_stage;
  if (BeginProperties("floor")) {
    PropertyText(Tr("Points"), std::to_string(floor.points));
    PropertyText(Tr("Spread"), Text("%.1f mm", 1000.0 * floor.spread / map_from_stage.scale));
    PropertyText(Tr("Level to"), Text("%.2f\xc2\xb0", kDegreesPerRadian * floor.tilt_deviation));
    const double cosine = floor.normal.dot(map_from_stage.rotation * Eigen::Vector3d::UnitY());
    const double tilt = std::acos(std::clamp(cosine, -1.0, 1.0));
    const double height = floor.Height(map_from_stage.translation) / map_from_stage.scale;
    PropertyText(Tr("Stage"), Text(height < 0.0 ? Tr("%.1f mm below, tilted %.2f\xc2\xb0")
                                                : Tr("%.1f mm above, tilted %.2f\xc2\xb0"),
                                   1000.0 * std::abs(height), kDegreesPerRadian * tilt));
    EndProperties();
  }
  LayOnFloorButton(workspace);
}

void TakeOverOccluders(editor::Workspace& workspace, const editor::PlaceDocument& from) {
  workspace.project().EditPlace(
      Sentence("take over the occluders of %s", {from.label()}),
      [&](editor::PlaceDocument& place) { editor::TakeOverOccluders(from, place); });
}

// The choice of another place.
void DrawOtherPlaces(editor::Workspace& workspace, const editor::PlaceDocument& place) {
  const std::shared_ptr<const editor::ProjectDocument> document =
      workspace.project().commands().snapshot();
  const ImVec2 wide(-FLT_MIN, 0);
  for (const editor::PlaceDocument& other : document->places) {
    const bool has_models = std::any_of(other.occluders.begin(), other.occluders.end(),
                                        [](const auto& occluder) { return !occluder.drawn(); });
    const std::string label = Text(Tr("Take over the occluders of %s"), other.label().c_str());
    if (other.name != place.name && has_models && ImGui::Button(label.c_str(), wide)) {
      TakeOverOccluders(workspace, other);
    }
  }
  const std::string remove = Text(Tr("Remove %s from the project"), place.label().c_str());
  if (ImGui::Button(remove.c_str(), wide)) {
    workspace.project().Edit(
        Sentence("remove %s", {place.label()}), [&](editor::ProjectDocument& edited) {
          std::erase_if(edited.places, [&](const auto& p) { return p.name == place.name; });
        });
  }
  Hint(Tr("Its files stay on the disk, and undo brings it back."));
}

// A button that asks first, because the map is written without the recording and this cannot be
// undone.
void RemoveSessionButton(editor::Workspace& workspace, uint32_t session, const std::string& name) {
  ImGui::PushID(static_cast<int>(session));
  ImGui::BeginDisabled(workspace.tasks().Running(editor::TaskKind::kTraining));
  if (ImGui::Button(Tr("Remove\xe2\x80\xa6"))) {
    ImGui::OpenPopup("remove");
  }
  ImGui::EndDisabled();
  // Beside the button, not over it.
  ImGui::SetNextWindowPos(ImVec2(ImGui::GetItemRectMin().x - Px(8), ImGui::GetItemRectMin().y),
                          ImGuiCond_Appearing, ImVec2(1, 0));
  ImGui::SetNextWindowSize(ImVec2(Px(320), 0));
  if (ImGui::BeginPopup("remove")) {
    Heading(Text(Tr("Remove %s from the map?"), name.c_str()).c_str());
    Hint(
        Tr("Its keyframes go, with the points that too few others see and what was picked in its "
           "images. Undo does not bring them back: adding the recording again does."));
    const float half = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
    if (ImGui::Button(Tr("Cancel"), ImVec2(half, 0))) {
      ImGui::CloseCurrentPopup();
    }
    ImGui::SameLine();
    if (ImGui::Button(Tr("Remove"), ImVec2(half, 0))) {
      workspace.training().RemoveSession(session);
      ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
  }
  ImGui::PopID();
}

void DrawTraining(editor::Workspace& workspace, Dialogs& dialogs) {
  if (workspace.map().loaded().report != nullptr &&
      ImGui::Button(Tr("The training's report\xe2\x80\xa6"), ImVec2(-FLT_MIN, 0))) {
    dialogs.shown = Dialog::kTrainingReport;
  }
  if (workspace.map().loaded().has_previous) {
    ImGui::BeginDisabled(workspace.tasks().Running(editor::TaskKind::kTraining));
    if (ImGui::Button(Tr("Put the former map back"), ImVec2(-FLT_MIN, 0))) {
      workspace.training().RestorePreviousMap();
    }
    ImGui::EndDisabled();
    Tooltip(
        Tr("The map from before the last training. Doing so again changes "
           "back to the one at hand."));
  }
}

// The recordings of the map with their results.
void DrawSessions(editor::Workspace& workspace,
                  const editor::PlaceDocument& place,
                  const train::MapStatistics& statistics) {
  Heading(Tr("Sessions"));
  for (uint32_t session = 0; session <= place.added.size(); ++session) {
    const std::string name = SessionName(place, session);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(Elided(name, ImGui::GetContentRegionAvail().x).c_str());
    if (ImGui::IsItemHovered()) {
      const editor::SourceDocument& source =
          session == 0 ? place.training : place.added[session - 1].source;
      ImGui::SetTooltip("%s", SourceText(source).c_str());
    }
    ImGui::AlignTextToFramePadding();
    DimText(Text(Tr("%u keyframes, %u points"), statistics.session_keyframes[session],
                 statistics.session_points[session]));
    if (session > 0) {
      SameLineIfFits(std::array{Tr("Remove\xe2\x80\xa6")});
      RemoveSessionButton(workspace, session, name);
    }
  }
}

// What the recordings of the map, and of the camera view, contain that is used otherwise or not.
void DrawRecordingWarnings(const editor::Workspace& workspace) {
  const std::vector<std::string>& of_map = workspace.map().loaded().warnings;
  std::vector<std::string> others = workspace.preview().recording_notes();
  std::erase_if(others, [&](const std::string& note) {
    return std::find(of_map.begin(), of_map.end(), note) != of_map.end();
  });
  DrawWarnings(of_map);
  DrawWarnings(others);
}

void DrawPlace(editor::Workspace& workspace,
               Selection& selection,
               ViewOptions& options,
               Dialogs& dialogs,
               const editor::PlaceDocument& place) {
  Heading(place.label().c_str());
  const auto database = workspace.map().loaded().database;
  if (BeginProperties("place")) {
    PropertyText(TrIn("recording", "Training"), SourceText(place.training));
    PropertyText(Tr("Preview"), place.preview.empty() ? Tr("the training") : place.preview.path);
    if (database != nullptr) {
      DrawMap(workspace, *database);
    } else {
      PropertyText(Tr("State"), Tr("not trained"));
    }
    EndProperties();
  }
  DrawRecordingWarnings(workspace);
  DrawRecordingToLookAt(workspace, options, dialogs, place);
  if (database != nullptr) {
    DrawTraining(workspace, dialogs);
    DrawSessions(workspace, place, *workspace.map().loaded().statistics);
    DrawScale(workspace, place);
    DrawFloor(workspace, place);
  }
  DrawPlaceSound(workspace, dialogs, place);
  ImGui::Dummy(ImVec2(0, Px(6)));
  DrawPlaceName(workspace, selection, dialogs, place);
  DrawOtherPlaces(workspace, place);
}

void DrawStage(editor::Workspace& workspace,
               Selection& selection,
               const ViewOptions& options,
               const OrbitCamera& orbit,
               const editor::PlaceDocument& place) {
  Heading(Tr("Stage"));
  Hint(Tr("Moved by hand on top of the picks, in their metres."));
  Similarity3 transform = place.picked_from_stage;
  bool changed = false;
  if (BeginProperties("stage")) {
    changed = TransformProperties(workspace, transform);
    EndProperties();
  }
  changed |= DrawTrackball(workspace, options, orbit, transform.rotation);
  if (changed) {
    MoveSelected(workspace, selection, transform, "inspector stage");
  }
  LayOnFloorButton(workspace);
  if (ImGui::Button(Tr("Back to the picks"), ImVec2(-FLT_MIN, 0))) {
    MoveSelected(workspace, selection, Similarity3(), "");
  }
}

const stage::AnchorReport* FindReport(const editor::Workspace& workspace, const std::string& name) {
  const auto& solution = workspace.map().loaded().picks.solution;
  if (!solution) {
    return nullptr;
  }
  const auto found = std::find_if(solution->anchors.begin(), solution->anchors.end(),
                                  [&](const auto& report) { return report.name == name; });
  return found == solution->anchors.end() ? nullptr : &*found;
}

// Columns: anchor, number of picks, residual, largest angle.
void DrawAnchorTable(editor::Workspace& workspace,
                     ViewOptions& options,
                     PickTarget& picks,
                     const editor::PlaceDocument& place) {
  if (!ImGui::BeginTable("anchors", 4, ImGuiTableFlags_SizingStretchProp)) {
    return;
  }
  ImGui::TableSetupColumn(Tr("Point"), ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn(TrIn("column", "Picks"), ImGuiTableColumnFlags_WidthFixed, Px(46));
  ImGui::TableSetupColumn(Tr("Error"), ImGuiTableColumnFlags_WidthFixed, Px(66));
  ImGui::TableSetupColumn(Tr("Angle"), ImGuiTableColumnFlags_WidthFixed, Px(56));
  ImGui::PushStyleColor(ImGuiCol_Text, Colours().dim);
  ImGui::TableHeadersRow();
  ImGui::PopStyleColor();
  const std::span<const AnchorEntry> entries = AnchorEntries();
  for (size_t i = 0; i < entries.size(); ++i) {
    const stage::Anchor& anchor = place.picks.*entries[i].anchor;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (ImGui::Selectable(Tr(entries[i].label), picks.anchor == static_cast<int>(i),
                          ImGuiSelectableFlags_SpanAllColumns)) {
      picks.anchor = static_cast<int>(i);
      options.view = ViewKind::kPicks;
    }
    ImGui::TableNextColumn();
    ImGui::Text("%zu", anchor.picks.size());
    const stage::AnchorReport* report = FindReport(workspace, anchor.name);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(report != nullptr ? Text("%.2f px", report->error_px).c_str() : "-");
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(
        report != nullptr ? Text("%.1f\xc2\xb0", report->angle * kDegreesPerRadian).c_str() : "-");
  }
  ImGui::EndTable();
}

// Lists picks that this map does not use.
void DrawLeftOut(const editor::Workspace& workspace) {
  if (!workspace.map().loaded().picks.solution) {
    return;
  }
  for (const stage::AnchorReport& report : workspace.map().loaded().picks.solution->anchors) {
    if (!report.left_out.empty()) {
      std::string text =
          Text(Tr("%s: left out, in frames that are no keyframes now:"), report.name.c_str());
      for (const std::string& frame : report.left_out) {
        text += " " + frame;
      }
      Hint(text);
    }
  }
}

void DrawPicks(editor::Workspace& workspace,
               const Selection& selection,
               ViewOptions& options,
               PickTarget& picks,
               const AlignView& align,
               Input& input,
               const editor::PlaceDocument& place) {
  Heading(Tr("Picks"));
  Hint(Tr("Points of the place, clicked in two or more training images, tie the stage to it."));
  DrawAnchorTable(workspace, options, picks, place);
  if (BeginProperties("length")) {
    double length = place.picks.length_m;
    if (NumberProperty(workspace, Tr("Length"), length, 0.01, 1e-3, 1e4, "%.3f m")) {
      workspace.project().EditPlace(
          Sentence("known length"), [&](editor::PlaceDocument& p) { p.picks.length_m = length; },
          "length");
    }
    if (const auto& solution = workspace.map().loaded().picks.solution) {
      PropertyText(Tr("Uncertainty"), Text(Tr("%.2f cm (%.2f %%) for each px"),
                                           100.0 * solution->length_spread * place.picks.length_m,
                                           100.0 * solution->length_spread));
      if (workspace.map().loaded().measures.tags) {
        PropertyText(Tr("By the tags"), Text("%.3f m", solution->measured_length_m));
      }
    }
    EndProperties();
  }
  Hint(Tr(
      "The length lies between the two length points; without them, between origin and forward."));
  DrawLeftOut(workspace);
  DrawPicksList(workspace, selection, options, picks, align, input);
  if (options.view != ViewKind::kPicks) {
    if (ImGui::Button(Tr("Pick in the training images"), ImVec2(-FLT_MIN, 0))) {
      options.view = ViewKind::kPicks;
    }
  } else {
    const AnchorEntry& entry = AnchorEntries()[static_cast<size_t>(picks.anchor)];
    const bool any = !(place.picks.*entry.anchor).picks.empty();
    ImGui::BeginDisabled(!any);
    const std::string label = Text(Tr("Clear the picks of %s"), Tr(entry.label));
    if (ImGui::Button(label.c_str(), ImVec2(-FLT_MIN, 0))) {
      workspace.project().EditPlace(Sentence("clear picks"), [&](editor::PlaceDocument& p) {
        (p.picks.*entry.anchor).picks.clear();
      });
    }
    ImGui::EndDisabled();
  }
}

void DrawNudge(editor::Workspace& workspace, const editor::PlaceDocument& place) {
  Heading(Tr("Camera nudge"));
  Hint(Tr(
      "Moves the camera along its own axes: right, down, forward. In the camera view: arrow keys, "
      "Page Up and Page Down; with Shift ten times as far."));
  if (!BeginProperties("nudge")) {
    return;
  }
  Eigen::Vector3d nudge = place.camera_nudge;
  if (VectorProperty(workspace, Tr("Metres"), nudge, 0.001, "%.3f")) {
    workspace.project().EditPlace(
        Sentence("nudge the camera"), [&](editor::PlaceDocument& p) { p.camera_nudge = nudge; },
        "nudge");
  }
  EndProperties();
  if (ImGui::Button(Tr("Back to zero"), ImVec2(-FLT_MIN, 0))) {
    workspace.project().EditPlace(Sentence("reset the nudge"),
                                  [](editor::PlaceDocument& p) { p.camera_nudge.setZero(); });
  }
}

void DrawProbe(editor::Workspace& workspace,
               Selection& selection,
               ViewOptions& options,
               LightView& light,
               PictureTextures& pictures,
               editor::ProbeDocument probe) {
  Heading(probe.name.c_str());
  Hint(Tr(
      "The light at a point of the stage and a time of day. Between probes it is blended, by where "
      "a person stands and by the drama's time of day."));
  bool changed = false;
  if (BeginProperties("probe")) {
    PropertyText(Tr("File"), probe.file);
    changed = VectorProperty(workspace, Tr("Position"), probe.position, 0.01, "%.2f");
    changed |= NumberProperty(workspace, Tr("Time of day"), probe.hour, 0.05, 0.0, 24.0, "%.2f h");
    EndProperties();
  }
  if (changed) {
    workspace.project().EditPlace(
        Sentence("light probe"),
        [&](editor::PlaceDocument& p) {
          for (editor::ProbeDocument& other : p.probes) {
            if (other.name == probe.name) {
              other = probe;
            }
          }
        },
        "probe " + probe.name);
  }
  DrawLightPanel(workspace, options, light, pictures, probe);
  if (ImGui::Button(Tr("Remove"), ImVec2(-FLT_MIN, 0))) {
    workspace.project().EditPlace(
        Sentence("remove %s", {probe.name}), [&](editor::PlaceDocument& p) {
          std::erase_if(p.probes, [&](const auto& other) { return other.name == probe.name; });
        });
    selection = {};
  }
}

template <typename Entry>
const Entry* FindByName(const std::vector<Entry>& entries, const std::string& name) {
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [&](const Entry& entry) { return entry.name == name; });
  return found == entries.end() ? nullptr : &*found;
}

}  // namespace

void DrawInspector(const PanelContext& context) {
  auto [workspace, selection, options, tools, cast, pictures, input, dialogs, actions] = context;
  using Kind = Selection::Kind;
  // Keeps the document alive: an edit below can replace it.
  const auto document = workspace.project().commands().snapshot();
  const editor::PlaceDocument* place = workspace.project().place();
  const std::string& name = selection.name;
  if (selection.kind != Kind::kActor) {
    workspace.cast().pictures().Look("", {}, {});
  }
  if (selection.kind == Kind::kProject) {
    DrawProject(workspace, dialogs);
    return;
  }
  if (selection.kind == Kind::kActor) {
    if (const auto* member = FindByName(document->cast, name)) {
      DrawActor(workspace, selection, cast, pictures, input, dialogs, *member);
    }
    return;
  }
  if (selection.kind == Kind::kObject) {
    if (const auto* object = FindByName(document->objects, name)) {
      DrawObject(workspace, selection, *object);
    }
    return;
  }
  if (place == nullptr) {
    Hint(Tr("Add a place to begin: choose Train\xe2\x80\xa6 and name a recording of it."));
    return;
  }
  switch (selection.kind) {
    case Kind::kPlace:
      DrawPlace(workspace, selection, options, dialogs, *place);
      break;
    case Kind::kStage:
      DrawStage(workspace, selection, options, tools.place.orbit, *place);
      break;
    case Kind::kPicks:
      DrawPicks(workspace, selection, options, tools.picks, tools.align, input, *place);
      break;
    case Kind::kNudge:
      DrawNudge(workspace, *place);
      break;
    case Kind::kProbe:
      if (const auto* probe = FindByName(place->probes, name)) {
        DrawProbe(workspace, selection, options, tools.light, pictures, *probe);
      }
      break;
    case Kind::kOccluder:
      if (const auto* occluder = FindByName(place->occluders, name)) {
        DrawOccluder(workspace, selection, options, tools.picks, tools.place.orbit, tools.align,
                     input, *occluder);
      }
      break;
    case Kind::kCheckPoint:
      if (const auto* point = FindByName(document->check_points, name)) {
        DrawCheckPoint(workspace, selection, options, tools.picks, tools.check, tools.align, input,
                       *point);
      }
      break;
    case Kind::kProject:
    case Kind::kActor:
    case Kind::kObject:
      break;
  }
}

}  // namespace lararium::panels
