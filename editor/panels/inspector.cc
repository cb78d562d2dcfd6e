#include "editor/panels/inspector.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cstdio>
#include <numbers>
#include <string>

#include "editor/panels/gizmo_view.h"
#include "editor/panels/pick_view.h"
#include "editor/panels/theme.h"
#include "editor/panels/trackball_view.h"
#include "editor/panels/widgets.h"

namespace lararium::panels {

namespace {

using geometry::Similarity3;

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kMinScale = 1e-4;
constexpr double kMaxScale = 1e4;

template <typename... Values>
std::string Format(const char* format, Values... values) {
  char text[256];
  std::snprintf(text, sizeof(text), format, values...);
  return text;
}

bool TransformProperties(app::Workspace& workspace, Similarity3& transform) {
  bool changed = VectorProperty(workspace, "Position", transform.translation, 0.005, "%.3f");
  changed |= RotationProperty(workspace, "Rotation", transform.rotation);
  changed |=
      NumberProperty(workspace, "Scale", transform.scale, 0.005, kMinScale, kMaxScale, "%.4f");
  return changed;
}

void ShowProject(app::Workspace& workspace) {
  Heading("Project");
  if (!BeginProperties("project")) {
    return;
  }
  std::string title = workspace.document().title;
  PropertyLabel("Title");
  if (ImGui::InputText("##title", &title)) {
    workspace.Edit(
        "title", [&](app::ProjectDocument& document) { document.title = title; }, "title");
  }
  if (ImGui::IsItemDeactivated()) {
    workspace.EndGesture();
  }
  std::string credits = workspace.document().credits;
  PropertyLabel("Credits");
  if (ImGui::InputTextMultiline("##credits", &credits, ImVec2(-FLT_MIN, Px(90)))) {
    workspace.Edit(
        "credits", [&](app::ProjectDocument& document) { document.credits = credits; }, "credits");
  }
  if (ImGui::IsItemDeactivated()) {
    workspace.EndGesture();
  }
  PropertyText("Drama", workspace.paths().Drama().filename().string());
  EndProperties();
}

std::string SourceText(const app::SourceDocument& source) {
  return source.empty() ? "none" : source.path;
}

void ShowPlace(app::Workspace& workspace, const app::PlaceDocument& place) {
  Heading(place.name.c_str());
  if (!BeginProperties("place")) {
    return;
  }
  PropertyText("Training", SourceText(place.training));
  PropertyText("Preview", place.preview.empty() ? "the training" : place.preview.path);
  if (const auto& database = workspace.loaded().database) {
    const geometry::CameraModel& camera = database->camera;
    PropertyText("Points", std::to_string(database->points.size()));
    PropertyText("Keyframes", std::to_string(database->keyframes.size()));
    PropertyText("Error", Format("%.3f px", database->mean_reprojection_error_px));
    PropertyText("Image", Format("%d x %d", camera.width, camera.height));
    PropertyText("Focal", Format("%.1f, %.1f px", camera.fx, camera.fy));
    PropertyText("Centre", Format("%.1f, %.1f px", camera.cx, camera.cy));
    PropertyText("Distortion", Format("%.4f, %.4f", camera.k1, camera.k2));
  } else {
    PropertyText("State", "not trained");
  }
  EndProperties();
}

void ShowStage(app::Workspace& workspace, EditorState& state, const app::PlaceDocument& place) {
  Heading("Stage");
  Hint("Moved by hand on top of the picks, in their metres.");
  Similarity3 transform = place.picked_from_stage;
  bool changed = false;
  if (BeginProperties("stage")) {
    changed = TransformProperties(workspace, transform);
    EndProperties();
  }
  changed |= ShowTrackball(workspace, state, transform.rotation);
  if (changed) {
    MoveSelected(workspace, state.selection, transform, "inspector stage");
  }
  if (ImGui::Button("Back to the picks", ImVec2(-FLT_MIN, 0))) {
    MoveSelected(workspace, state.selection, Similarity3(), "");
  }
}

const stage::AnchorReport* FindReport(const app::Workspace& workspace, const std::string& name) {
  const auto& solution = workspace.loaded().picks.solution;
  if (!solution) {
    return nullptr;
  }
  const auto found = std::find_if(solution->anchors.begin(), solution->anchors.end(),
                                  [&](const auto& report) { return report.name == name; });
  return found == solution->anchors.end() ? nullptr : &*found;
}

// Anchor, number of picks, residual, widest angle.
void ShowAnchorTable(app::Workspace& workspace,
                     EditorState& state,
                     const app::PlaceDocument& place) {
  if (!ImGui::BeginTable("anchors", 4, ImGuiTableFlags_SizingStretchProp)) {
    return;
  }
  ImGui::TableSetupColumn("Point", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("Picks", ImGuiTableColumnFlags_WidthFixed, Px(46));
  ImGui::TableSetupColumn("Error", ImGuiTableColumnFlags_WidthFixed, Px(66));
  ImGui::TableSetupColumn("Angle", ImGuiTableColumnFlags_WidthFixed, Px(56));
  ImGui::PushStyleColor(ImGuiCol_Text, colour::kDim);
  ImGui::TableHeadersRow();
  ImGui::PopStyleColor();
  const std::span<const AnchorEntry> entries = AnchorEntries();
  for (size_t i = 0; i < entries.size(); ++i) {
    const stage::Anchor& anchor = place.picks.*entries[i].anchor;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (ImGui::Selectable(entries[i].label, state.anchor == static_cast<int>(i),
                          ImGuiSelectableFlags_SpanAllColumns)) {
      state.anchor = static_cast<int>(i);
      state.view = ViewKind::kPicks;
    }
    ImGui::TableNextColumn();
    ImGui::Text("%zu", anchor.picks.size());
    const stage::AnchorReport* report = FindReport(workspace, anchor.name);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(report != nullptr ? Format("%.2f px", report->error_px).c_str() : "-");
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(
        report != nullptr ? Format("%.1f\xc2\xb0", report->angle * kDegrees).c_str() : "-");
  }
  ImGui::EndTable();
}

void ShowPicks(app::Workspace& workspace, EditorState& state, const app::PlaceDocument& place) {
  Heading("Picks");
  Hint("Points of the place, clicked in two or more training images, tie the stage to it.");
  ShowAnchorTable(workspace, state, place);
  if (BeginProperties("length")) {
    double length = place.picks.length_m;
    if (NumberProperty(workspace, "Length", length, 0.01, 1e-3, 1e4, "%.3f m")) {
      workspace.EditPlace(
          "known length", [&](app::PlaceDocument& p) { p.picks.length_m = length; }, "length");
    }
    if (const auto& solution = workspace.loaded().picks.solution) {
      PropertyText("Uncertainty", Format("%.2f %% for each px", 100.0 * solution->length_spread));
    }
    EndProperties();
  }
  Hint("The length lies between the two length points; without them, between origin and forward.");
  if (state.view != ViewKind::kPicks) {
    if (ImGui::Button("Pick in the training images", ImVec2(-FLT_MIN, 0))) {
      state.view = ViewKind::kPicks;
    }
  } else {
    const AnchorEntry& entry = AnchorEntries()[static_cast<size_t>(state.anchor)];
    const bool any = !(place.picks.*entry.anchor).picks.empty();
    ImGui::BeginDisabled(!any);
    const std::string label = std::string("Clear the picks of ") + entry.label;
    if (ImGui::Button(label.c_str(), ImVec2(-FLT_MIN, 0))) {
      workspace.EditPlace("clear picks",
                          [&](app::PlaceDocument& p) { (p.picks.*entry.anchor).picks.clear(); });
    }
    ImGui::EndDisabled();
  }
}

void ShowNudge(app::Workspace& workspace, const app::PlaceDocument& place) {
  Heading("Camera nudge");
  Hint(
      "Moves the camera along its own axes: right, down, forward. In the camera view: arrow keys, "
      "Page Up and Page Down; with Shift ten times as far.");
  if (!BeginProperties("nudge")) {
    return;
  }
  Eigen::Vector3d nudge = place.camera_nudge;
  if (VectorProperty(workspace, "Metres", nudge, 0.001, "%.3f")) {
    workspace.EditPlace(
        "nudge the camera", [&](app::PlaceDocument& p) { p.camera_nudge = nudge; }, "nudge");
  }
  EndProperties();
  if (ImGui::Button("Back to zero", ImVec2(-FLT_MIN, 0))) {
    workspace.EditPlace("reset the nudge", [](app::PlaceDocument& p) { p.camera_nudge.setZero(); });
  }
}

void ShowOccluder(app::Workspace& workspace,
                  EditorState& state,
                  const app::OccluderDocument& occluder) {
  Heading(occluder.name.c_str());
  Hint("Real, and only there to hide people who stand behind it.");
  Similarity3 transform = occluder.stage_from_mesh;
  bool changed = false;
  if (BeginProperties("occluder")) {
    PropertyText("File", occluder.file);
    changed = TransformProperties(workspace, transform);
    EndProperties();
  }
  if (changed) {
    MoveSelected(workspace, state.selection, workspace.place()->picked_from_stage * transform,
                 "inspector occluder");
  }
  if (ImGui::Button("Remove", ImVec2(-FLT_MIN, 0))) {
    workspace.EditPlace("remove " + occluder.name, [name = occluder.name](app::PlaceDocument& p) {
      std::erase_if(p.occluders, [&](const auto& o) { return o.name == name; });
    });
    state.selection = {};
  }
}

void ShowProbe(app::Workspace& workspace, EditorState& state, const app::PlaceDocument& place) {
  Heading("Light probe");
  if (!place.probe) {
    Hint(
        "No probe: people are lit evenly from everywhere. An equirectangular HDR photograph of the "
        "place gives them its light.");
    if (ImGui::Button("Choose a probe\xe2\x80\xa6", ImVec2(-FLT_MIN, 0))) {
      state.dialog = Dialog::kProbe;
      state.fields = {};
    }
    return;
  }
  app::ProbeDocument probe = *place.probe;
  bool changed = false;
  if (BeginProperties("probe")) {
    PropertyText("File", probe.file);
    changed = RotationProperty(workspace, "Rotation", probe.stage_from_probe);
    changed |= NumberProperty(workspace, "Brightness", probe.scale, 0.01, 0.0, 1e4, "%.3f");
    EndProperties();
  }
  if (changed) {
    workspace.EditPlace(
        "light probe", [&](app::PlaceDocument& p) { p.probe = probe; }, "probe");
  }
  if (ImGui::Button("Remove", ImVec2(-FLT_MIN, 0))) {
    workspace.EditPlace("remove the probe", [](app::PlaceDocument& p) { p.probe.reset(); });
  }
}

void ShowActor(app::Workspace& workspace, EditorState& state, const app::CastDocument& member) {
  Heading(member.name.c_str());
  Hint("Where people stand and what they do is written in the drama.");
  app::CastDocument edited = member;
  bool changed = false;
  if (BeginProperties("actor")) {
    PropertyText("Figure", member.model.empty() ? "plain, built in" : member.model);
    if (member.model.empty()) {
      changed = NumberProperty(workspace, "Height", edited.height, 0.005, app::kMinHeight,
                               app::kMaxHeight, "%.2f m");
      changed |= ColourProperty(workspace, "Tunic", edited.tunic);
    }
    PropertyText("Baked", workspace.paths().Shorten(workspace.paths().Human(member.name)));
    EndProperties();
  }
  if (changed) {
    workspace.Edit(
        "figure of " + member.name,
        [&edited](app::ProjectDocument& document) {
          std::replace_if(
              document.cast.begin(), document.cast.end(),
              [&](const auto& m) { return m.name == edited.name; }, edited);
        },
        "figure");
  }
  if (ImGui::Button("Remove", ImVec2(-FLT_MIN, 0))) {
    workspace.Edit("remove " + member.name, [name = member.name](app::ProjectDocument& document) {
      std::erase_if(document.cast, [&](const auto& m) { return m.name == name; });
    });
    state.selection = {};
  }
}

template <typename Entry>
const Entry* FindByName(const std::vector<Entry>& entries, const std::string& name) {
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [&](const Entry& entry) { return entry.name == name; });
  return found == entries.end() ? nullptr : &*found;
}

}  // namespace

void ShowInspector(app::Workspace& workspace, EditorState& state) {
  using Kind = Selection::Kind;
  // What is shown may be replaced by the edit it offers: hold on to it.
  const auto document = workspace.commands().snapshot();
  const app::PlaceDocument* place = workspace.place();
  const std::string& name = state.selection.name;
  if (state.selection.kind == Kind::kProject) {
    ShowProject(workspace);
    return;
  }
  if (state.selection.kind == Kind::kActor) {
    if (const auto* member = FindByName(document->cast, name)) {
      ShowActor(workspace, state, *member);
    }
    return;
  }
  if (place == nullptr) {
    Hint("Add a place to begin: choose Train\xe2\x80\xa6 and name a recording of it.");
    return;
  }
  switch (state.selection.kind) {
    case Kind::kPlace:
      ShowPlace(workspace, *place);
      break;
    case Kind::kStage:
      ShowStage(workspace, state, *place);
      break;
    case Kind::kPicks:
      ShowPicks(workspace, state, *place);
      break;
    case Kind::kNudge:
      ShowNudge(workspace, *place);
      break;
    case Kind::kProbe:
      ShowProbe(workspace, state, *place);
      break;
    case Kind::kOccluder:
      if (const auto* occluder = FindByName(place->occluders, name)) {
        ShowOccluder(workspace, state, *occluder);
      }
      break;
    case Kind::kProject:
    case Kind::kActor:
      break;
  }
}

}  // namespace lararium::panels
