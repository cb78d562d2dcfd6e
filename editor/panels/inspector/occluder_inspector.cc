#include "editor/panels/inspector/occluder_inspector.h"

#include <imgui.h>

#include <algorithm>
#include <vector>

#include "editor/jobs/drawn_occluder.h"
#include "editor/panels/viewport/gizmo_view.h"
#include "editor/panels/viewport/picks_list.h"
#include "editor/panels/viewport/trackball_view.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"

namespace lararium::panels {

namespace {

using geometry::Similarity3;

void DrawSizes(editor::Workspace& workspace, const editor::OccluderDocument& occluder) {
  editor::OccluderShape shape = *occluder.shape;
  PropertyText(Tr("Shape"), Tr(editor::EntryOf(shape.kind).label));
  if (ShapeSizes(workspace, shape)) {
    workspace.project().EditOccluder(
        Sentence("size of %s", {occluder.name}), occluder.name,
        [&](editor::OccluderDocument& edited) { edited.shape = shape; }, "occluder size");
  }
}

// The pose of a model or a shape.
void DrawPlaced(editor::Workspace& workspace,
                const Selection& selection,
                const editor::OccluderDocument& occluder) {
  Similarity3 transform = occluder.stage_from_mesh;
  bool changed = false;
  if (BeginProperties("occluder")) {
    if (occluder.shape) {
      DrawSizes(workspace, occluder);
    } else {
      PropertyText(Tr("File"), occluder.file);
    }
    changed = TransformProperties(workspace, transform);
    EndProperties();
  }
  if (changed) {
    MoveSelected(workspace, selection, workspace.project().place()->picked_from_stage * transform,
                 "inspector occluder");
  }
}

// A trackball for rotation in the axes of the view.
void DrawBall(editor::Workspace& workspace,
              const Selection& selection,
              const ViewOptions& options,
              const OrbitCamera& orbit,
              const editor::OccluderDocument& occluder) {
  if (!Fold(Label(Tr("Turn by hand"), "ball"), false)) {
    return;
  }
  Similarity3 world_from_mesh =
      workspace.project().place()->picked_from_stage * occluder.stage_from_mesh;
  if (DrawTrackball(workspace, options, orbit, world_from_mesh.rotation)) {
    MoveSelected(workspace, selection, world_from_mesh, "ball of an occluder");
  }
}

// Columns: corner, number of picks, residual.
void DrawCornerTable(const editor::OccluderDocument& occluder,
                     const std::vector<stage::AnchorReport>& reports) {
  if (!ImGui::BeginTable("corners", 3, ImGuiTableFlags_SizingStretchProp)) {
    return;
  }
  ImGui::TableSetupColumn(Tr("Corner"), ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn(Tr("Images"), ImGuiTableColumnFlags_WidthFixed, Px(64));
  ImGui::TableSetupColumn(Tr("Error"), ImGuiTableColumnFlags_WidthFixed, Px(76));
  ImGui::PushStyleColor(ImGuiCol_Text, Colours().dim);
  ImGui::TableHeadersRow();
  ImGui::PopStyleColor();
  for (size_t i = 0; i < occluder.corners.size(); ++i) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::Text("%zu", i + 1);
    ImGui::TableNextColumn();
    ImGui::Text("%zu", occluder.corners[i].picks.size());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(i < reports.size() ? Text("%.2f px", reports[i].error_px).c_str() : "-");
  }
  ImGui::EndTable();
}

// The corners of a drawn occluder.
void DrawCorners(editor::Workspace& workspace,
                 const Selection& selection,
                 ViewOptions& options,
                 PickTarget& picks,
                 const AlignView& align,
                 Input& input,
                 const editor::OccluderDocument& occluder) {
  const double units =
      workspace.map().loaded().picks.map_from_picked.scale *
      workspace.project().place()->picked_from_stage.scale;  // Map units per metre.
  if (workspace.map().loaded().database != nullptr) {
    const auto drawn = editor::DrawOccluder(occluder, *workspace.map().loaded().database, units);
    if (BeginProperties("drawn")) {
      double depth = occluder.depth;
      if (NumberProperty(workspace, Tr("Depth"), depth, 0.01, 0.0, editor::kMaxDepth, "%.2f m")) {
        workspace.project().EditOccluder(
            Sentence("depth of %s", {occluder.name}), occluder.name,
            [&](editor::OccluderDocument& edited) { edited.depth = depth; }, "occluder depth");
      }
      Tooltip(Tr("How far it goes on behind the face that you drew; 0: the face alone."));
      if (drawn.ok()) {
        PropertyText(Tr("Error"), Text("%.2f px", drawn->error_px));
        PropertyText(Tr("Uneven by"), Text("%.1f cm", 100.0 * drawn->unevenness / units));
      }
      bool flat = occluder.flat;
      PropertyLabel(Tr("Flat"));
      if (ImGui::Checkbox("##flat", &flat)) {
        workspace.project().EditOccluder(
            Sentence("flatten %s", {occluder.name}), occluder.name,
            [&](editor::OccluderDocument& edited) { edited.flat = flat; });
      }
      Tooltip(Tr("Lays the corners onto the plane that fits them best"));
      EndProperties();
    }
    DrawCornerTable(occluder, drawn.ok() ? drawn->corners : std::vector<stage::AnchorReport>());
    if (!drawn.ok()) {
      ImGui::PushStyleColor(ImGuiCol_Text, Colours().warning);
      ImGui::TextWrapped("%s", drawn.message().c_str());
      ImGui::PopStyleColor();
    }
  }
  DrawPicksList(workspace, selection, options, picks, align, input);
  if (options.view != ViewKind::kPicks &&
      ImGui::Button(Tr("Draw on the training images"), ImVec2(-FLT_MIN, 0))) {
    options.view = ViewKind::kPicks;
  }
  ImGui::BeginDisabled(occluder.corners.empty());
  if (ImGui::Button(Tr("Remove the last corner"), ImVec2(-FLT_MIN, 0))) {
    workspace.project().EditOccluder(
        Sentence("remove a corner"), occluder.name,
        [](editor::OccluderDocument& edited) { edited.corners.pop_back(); });
  }
  ImGui::EndDisabled();
}

void DrawEffects(editor::Workspace& workspace, const editor::OccluderDocument& occluder) {
  struct Effect {
    bool editor::OccluderDocument::*does;
    const char* label;
    const char* tip;
    const char* command;
  };
  static constexpr Effect kEffects[] = {
      {&editor::OccluderDocument::receives_shadow, TrLater("Receives shadow"),
       TrLater("Shadows of people are seen on it, and the light of lamps"),
       TrLater("shadow on %s")},
      {&editor::OccluderDocument::blocks_sound, TrLater("Blocks sound"),
       TrLater("What sounds behind it is muffled"), TrLater("sound through %s")},
      {&editor::OccluderDocument::blocks_walking, TrLater("Blocks walking"),
       TrLater("People walk around it, at every place of the drama"), TrLater("ways through %s")}};
  for (const Effect& effect : kEffects) {
    bool on = occluder.*effect.does;
    if (CheckRow(Tr(effect.label), on)) {
      workspace.project().EditOccluder(
          Sentence(effect.command, {occluder.name}), occluder.name,
          [&](editor::OccluderDocument& edited) { edited.*effect.does = on; });
    }
    Tooltip(Tr(effect.tip));
  }
}

}  // namespace

bool ShapeSizes(editor::Workspace& workspace, editor::OccluderShape& shape) {
  bool changed = false;
  for (const editor::ShapeSize& size : editor::EntryOf(shape.kind).sizes) {
    const auto [least, most] = editor::RangeOf(shape, size);
    changed |=
        NumberProperty(workspace, Tr(size.label), shape.*size.value, 0.01, least, most, "%.3f m");
  }
  return changed;
}

void DrawOccluder(editor::Workspace& workspace,
                  Selection& selection,
                  ViewOptions& options,
                  PickTarget& picks,
                  const OrbitCamera& orbit,
                  AlignView& align,
                  Input& input,
                  const editor::OccluderDocument& occluder) {
  Heading(occluder.name.c_str());
  Hint(Tr("It is real, and hides who is behind it."));
  if (occluder.drawn()) {
    DrawCorners(workspace, selection, options, picks, align, input, occluder);
  } else {
    DrawPlaced(workspace, selection, occluder);
  }
  if (occluder.kind() == editor::OccluderDocument::Kind::kModel) {
    DrawAlignment(workspace, selection, options, picks, align, input, occluder);
  }
  DrawEffects(workspace, occluder);
  if (!occluder.drawn()) {
    DrawBall(workspace, selection, options, orbit, occluder);
  }
  if (ImGui::Button(Tr("Remove"), ImVec2(-FLT_MIN, 0))) {
    workspace.project().EditPlace(
        Sentence("remove %s", {occluder.name}), [name = occluder.name](editor::PlaceDocument& p) {
          std::erase_if(p.occluders, [&](const auto& o) { return o.name == name; });
        });
    selection = {};
  }
}

}  // namespace lararium::panels
