#include "editor/panels/viewport/align_panel.h"

#include <algorithm>
#include <string>

#include "editor/jobs/occluder_alignment.h"
#include "editor/panels/viewport/gizmo_view.h"
#include "editor/panels/viewport/model_point.h"
#include "editor/panels/viewport/picks_list.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"
#include "shared/core/units.h"

namespace lararium::panels {

namespace {

using Eigen::Vector3d;
using geometry::Similarity3;

// Discards the state of another model.
void DiscardOtherModel(AlignView& align, const std::string& occluder) {
  if (align.occluder != occluder) {
    const double search = align.search_m;
    align = {};
    align.occluder = occluder;
    align.search_m = search;
  }
}

void Warn(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, Colours().warning);
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
}

// Columns: point, images, centimetres, pixels. A click on a row selects the pair for picking.
void DrawPairTable(ViewOptions& options,
                   AlignView& align,
                   const editor::OccluderDocument& occluder,
                   const editor::AlignmentReport& report) {
  if (occluder.model_pairs.empty() ||
      !ImGui::BeginTable("pairs", 4, ImGuiTableFlags_SizingStretchProp)) {
    return;
  }
  ImGui::TableSetupColumn(Tr("Point"), ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn(Tr("Images"), ImGuiTableColumnFlags_WidthFixed, Px(64));
  ImGui::TableSetupColumn("cm", ImGuiTableColumnFlags_WidthFixed, Px(56));
  ImGui::TableSetupColumn("px", ImGuiTableColumnFlags_WidthFixed, Px(56));
  ImGui::PushStyleColor(ImGuiCol_Text, Colours().dim);
  ImGui::TableHeadersRow();
  ImGui::PopStyleColor();
  for (size_t i = 0; i < occluder.model_pairs.size(); ++i) {
    const bool located = i < report.pairs.size() && report.pairs[i].located;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const std::string number = std::to_string(i + 1);
    if (ImGui::Selectable(number.c_str(), align.pair == i, ImGuiSelectableFlags_SpanAllColumns)) {
      align.pair = align.pair == i ? std::nullopt : std::optional(i);
      options.view = align.pair ? ViewKind::kPicks : options.view;
    }
    ImGui::TableNextColumn();
    ImGui::Text("%zu", occluder.model_pairs[i].anchor.picks.size());
    ImGui::TableNextColumn();
    const auto number_or_dash = [&](double value) {
      ImGui::TextUnformatted(located ? Text("%.1f", value).c_str() : "-");
    };
    number_or_dash(located ? kCentimetresPerMetre * report.pairs[i].distance_m : 0.0);
    ImGui::TableNextColumn();
    number_or_dash(located ? report.pairs[i].distance_px : 0.0);
  }
  ImGui::EndTable();
}

// The result of the pairs, or what is missing.
void DrawPairs(const editor::OccluderDocument& occluder, const editor::AlignmentReport& report) {
  for (size_t i = 0; i < report.pairs.size(); ++i) {
    if (!report.pairs[i].located && occluder.model_pairs[i].anchor.picks.empty()) {
      Hint(Text(Tr("Click point %d in two training images."), static_cast<int>(i) + 1));
    } else if (!report.pairs[i].located) {
      Warn(report.pairs[i].problem.message());
    }
  }
  if (report.worst) {
    Hint(Text(Tr("All are %.1f cm off, root mean square; point %d is the worst."),
              kCentimetresPerMetre * report.rms_m, static_cast<int>(*report.worst) + 1));
  }
}

void DrawPairButtons(editor::Workspace& workspace,
                     ViewOptions& options,
                     AlignView& align,
                     const editor::OccluderDocument& occluder) {
  const ImVec2 wide(-FLT_MIN, 0);
  const std::string name = occluder.name;
  ImGui::BeginDisabled(workspace.preview().staged() == nullptr ||
                       occluder.model_pairs.size() >= editor::kMaxModelPairs);
  if (ImGui::Button(align.picking ? Tr("Stop adding") : Tr("Add a point"), wide)) {
    align.picking = !align.picking;
    if (align.picking && options.view == ViewKind::kPicks) {
      options.view = ViewKind::kAround;
    }
  }
  ImGui::EndDisabled();
  if (align.picking) {
    Hint(
        Tr("Click a corner of the model, through the camera or around the place, then the same "
           "point in the training images. Escape ends."));
  }
  ImGui::BeginDisabled(!align.pair);
  if (ImGui::Button(Tr("Remove the point"), wide)) {
    workspace.project().EditOccluder(
        Sentence("remove a point of the model"), name,
        [pair = *align.pair](editor::OccluderDocument& o) { editor::RemoveModelPair(o, pair); });
    align.pair.reset();
  }
  ImGui::EndDisabled();
}

void AlignByPointsButton(editor::Workspace& workspace,
                         const editor::OccluderDocument& occluder,
                         const editor::AlignmentReport& report,
                         const Similarity3& map_from_stage) {
  const bool enough = report.located >= 3;
  ImGui::BeginDisabled(!enough);
  if (ImGui::Button(Tr("Align by the points"), ImVec2(-FLT_MIN, 0))) {
    const auto aligned =
        editor::AlignByPoints(occluder, *workspace.map().loaded().database, map_from_stage);
    if (aligned.ok()) {
      workspace.project().EditOccluder(
          Sentence("align %s", {occluder.name}), occluder.name,
          [&](editor::OccluderDocument& edited) { edited.stage_from_mesh = *aligned; });
    } else {
      workspace.messages().Tell(editor::Message::Level::kError, aligned.message());
    }
  }
  ImGui::EndDisabled();
  if (!enough) {
    Tooltip(Tr("Three points are needed, each clicked in two training images."));
  }
}

void DrawRefining(editor::Workspace& workspace,
                  AlignView& align,
                  const editor::OccluderDocument& occluder) {
  if (BeginProperties("refine")) {
    NumberProperty(workspace, Tr("Search within"), align.search_m, 0.005, editor::kMinSearch,
                   editor::kMaxSearch, "%.3f m");
    EndProperties();
  }
  ImGui::BeginDisabled(workspace.preview().staged() == nullptr ||
                       workspace.tasks().Running(editor::TaskKind::kRefining));
  if (ImGui::Button(Tr("Refine on the map"), ImVec2(-FLT_MIN, 0))) {
    workspace.map().RefineOccluder(occluder.name, workspace.preview().staged(), align.search_m);
  }
  ImGui::EndDisabled();
  Tooltip(Tr("Moves the model so that its surface lies among the map's points near it"));
  if (const auto* refined = workspace.map().refinement(occluder)) {
    if (refined->report.ok()) {
      Hint(editor::RefineText(*refined->report, true));
    } else {
      Warn(refined->report.message());
    }
  }
}

// The staged model; nullptr: it is not staged yet.
const stage::Occluder* Staged(const editor::Workspace& workspace, const std::string& name) {
  const auto& staged = workspace.preview().staged();
  if (staged == nullptr) {
    return nullptr;
  }
  const auto found = std::find_if(staged->occluders.begin(), staged->occluders.end(),
                                  [&](const stage::Occluder& o) { return o.name == name; });
  return found == staged->occluders.end() ? nullptr : &*found;
}

const editor::OccluderDocument* SelectedModel(const editor::Workspace& workspace,
                                              const Selection& selection) {
  if (workspace.project().place() == nullptr || selection.kind != Selection::Kind::kOccluder) {
    return nullptr;
  }
  const editor::OccluderDocument* occluder =
      workspace.project().place()->FindOccluder(selection.name);
  return occluder != nullptr && occluder->kind() == editor::OccluderDocument::Kind::kModel
             ? occluder
             : nullptr;
}

// Shows the point that a click would take, and handles the click.
void PickOnModel(editor::Workspace& workspace,
                 ViewOptions& options,
                 AlignView& align,
                 const editor::OccluderDocument& occluder,
                 const ViewCamera& view,
                 ImDrawList& draw) {
  constexpr float kReach = 14.0f;
  const stage::Occluder* solid = Staged(workspace, occluder.name);
  if (solid == nullptr) {
    return;
  }
  if (align.tree == nullptr || align.tree_of != workspace.preview().staged()) {
    align.tree_of = workspace.preview().staged();
    align.tree = std::make_shared<const vision::OccluderTree>(vision::Placed(solid->mesh, {}));
  }
  const Similarity3 world_from_mesh = WorldFromOccluder(workspace, occluder.name);
  const auto meant = FindModelPoint(solid->mesh, *align.tree, world_from_mesh, view,
                                    ToEigen(ImGui::GetMousePos()), static_cast<double>(Px(kReach)));
  if (!meant) {
    return;
  }
  const ImVec2 at = ToImGui(*view.Project(world_from_mesh * meant->on_mesh));
  const ImU32 packed = Packed(OverPicture().accent);
  draw.AddCircle(at, Px(meant->vertex ? 7 : 4), packed, 0, Px(2));
  LabelMark(at, meant->vertex ? Tr("corner of the model") : Tr("surface of the model"),
            Packed(OverPicture().text), draw);
  if (!ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    return;
  }
  const Vector3d on_mesh = meant->on_mesh;
  align.pair = occluder.model_pairs.size();
  align.picking = false;
  options.view = ViewKind::kPicks;
  workspace.project().EditOccluder(
      Sentence("add a point of the model"), occluder.name,
      [&](editor::OccluderDocument& edited) { editor::AddModelPair(edited, on_mesh); });
}

}  // namespace

void DrawAlignment(editor::Workspace& workspace,
                   const Selection& selection,
                   ViewOptions& options,
                   PickTarget& picks,
                   AlignView& align,
                   Input& input,
                   const editor::OccluderDocument& occluder) {
  // Copied, because edits below replace the object behind the reference.
  const editor::OccluderDocument model = occluder;
  DiscardOtherModel(align, model.name);
  if (align.pair && *align.pair >= model.model_pairs.size()) {
    align.pair.reset();  // The pair was removed by undo.
  }
  ImGui::Dummy(ImVec2(0, Px(4)));
  if (!Fold(Label(Tr("Align"), "align"), !model.model_pairs.empty())) {
    return;
  }
  Hint(
      Tr("By points that you find on the model and in the training images, then by the map's "
         "points on its surface."));
  if (workspace.map().loaded().database == nullptr) {
    Hint(Tr("Train the place first."));
    return;
  }
  const Similarity3 map_from_stage = workspace.map().loaded().picks.map_from_picked *
                                     workspace.project().place()->picked_from_stage;
  const editor::AlignmentReport report = Alignment(workspace, align, model);
  DrawPairTable(options, align, model, report);
  DrawPairs(model, report);
  DrawPairButtons(workspace, options, align, model);
  bool keep = model.keep_scale;
  if (CheckRow(Tr("Its scale is right"), keep)) {
    workspace.project().EditOccluder(
        Sentence("scale of %s", {model.name}), model.name,
        [&](editor::OccluderDocument& edited) { edited.keep_scale = keep; });
  }
  Tooltip(Tr("As where the model is in metres: aligning only moves and turns it"));
  AlignByPointsButton(workspace, model, report, map_from_stage);
  ImGui::Dummy(ImVec2(0, Px(4)));
  DrawRefining(workspace, align, model);
  if (align.pair) {
    DrawPicksList(workspace, selection, options, picks, align, input);
  }
}

ModelPairInWork PairInWork(const editor::Workspace& workspace,
                           const Selection& selection,
                           const AlignView& align) {
  const editor::OccluderDocument* model = SelectedModel(workspace, selection);
  if (model == nullptr || align.occluder != model->name || !align.pair ||
      *align.pair >= model->model_pairs.size()) {
    return {};
  }
  return {model, *align.pair};
}

const editor::AlignmentReport& Alignment(const editor::Workspace& workspace,
                                         AlignView& align,
                                         const editor::OccluderDocument& occluder) {
  DiscardOtherModel(align, occluder.name);
  const auto document = workspace.project().commands().snapshot();
  const editor::LoadedMap& loaded = workspace.map().loaded();
  if (loaded.database == nullptr) {
    align.report = {};
    align.document = nullptr;
  } else if (align.document != document || align.database != loaded.database ||
             align.place != workspace.project().place()->name ||
             align.map_from_picked != loaded.picks.map_from_picked) {
    align.document = document;
    align.database = loaded.database;
    align.place = workspace.project().place()->name;
    align.map_from_picked = loaded.picks.map_from_picked;
    align.report = editor::ReportAlignment(
        occluder, *loaded.database,
        align.map_from_picked * workspace.project().place()->picked_from_stage);
  }
  return align.report;
}

bool DrawModelPoints(editor::Workspace& workspace,
                     const Selection& selection,
                     ViewOptions& options,
                     AlignView& align,
                     const ViewCamera& view,
                     bool hovered,
                     ImDrawList& draw) {
  const editor::OccluderDocument* model = SelectedModel(workspace, selection);
  if (model == nullptr) {
    return false;
  }
  const Similarity3& world_from_stage = workspace.project().place()->picked_from_stage;
  const Similarity3 world_from_mesh = world_from_stage * model->stage_from_mesh;
  const editor::AlignmentReport& report = Alignment(workspace, align, *model);
  for (size_t i = 0; i < model->model_pairs.size(); ++i) {
    const ImU32 packed = Packed(align.pair == i ? OverPicture().accent : OverPicture().warning);
    const Vector3d at = world_from_mesh * model->model_pairs[i].on_mesh;
    if (i < report.pairs.size() && report.pairs[i].located) {
      const Vector3d picked = world_from_stage * report.pairs[i].on_stage;
      DrawWorldLine(view, at, picked, packed, Px(1.5f), draw);
      if (const auto pixel = view.Project(picked)) {
        draw.AddCircle(ToImGui(*pixel), Px(6), packed, 0, Px(1.5f));
      }
    }
    if (const auto pixel = view.Project(at)) {
      DrawCross(ToImGui(*pixel), packed, draw);
      LabelMark(ToImGui(*pixel), std::to_string(i + 1), Packed(OverPicture().text), draw);
    }
  }
  if (!align.picking) {
    return false;
  }
  if (hovered) {
    PickOnModel(workspace, options, align, *model, view, draw);
  }
  return true;
}

}  // namespace lararium::panels
