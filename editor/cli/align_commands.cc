#include "editor/cli/align_commands.h"

#include <algorithm>
#include <utility>

#include "editor/cli/command_arguments.h"
#include "editor/jobs/baking.h"
#include "editor/jobs/drawn_occluder.h"
#include "editor/jobs/occluder_alignment.h"
#include "editor/jobs/staging.h"
#include "editor/text/text.h"

namespace lararium::editor {

namespace {

class AlignWorker {
 public:
  AlignWorker(ProjectPaths paths,
              ProjectDocument document,
              const AlignOptions& options,
              Progress& progress)
      : paths_(std::move(paths)),
        document_(std::move(document)),
        options_(options),
        progress_(progress) {}

  Result<CommandResult> Run() {
    LARARIUM_ASSIGN_OR_RETURN(const std::string name,
                              ChoosePlace(paths_, document_, options_.place));
    place_ = document_.FindPlace(name);
    LARARIUM_RETURN_IF_ERROR(FindOccluder());
    LARARIUM_ASSIGN_OR_RETURN(map_, LoadStagedMap(paths_, *place_));
    map_from_stage_ = map_.picks.map_from_picked * place_->picked_from_stage;
    CommandResult result;
    result.text = occluder_->name + ":\n";
    LARARIUM_RETURN_IF_ERROR(occluder_->drawn() ? WorkOnDrawn(result) : WorkOnModel(result));
    if (changed_) {
      LARARIUM_RETURN_IF_ERROR(SaveProject(paths_, document_));
    }
    return result;
  }

 private:
  Status FindOccluder() {
    occluder_ = place_->FindOccluder(options_.occluder);
    if (occluder_ != nullptr) {
      return Status();
    }
    const std::string known = OccluderNames(*place_);
    return Status::Error("--occluder " + options_.occluder, "is not an occluder of " + place_->name,
                         known.empty() ? "add one in the window" : "it has " + known);
  }

  Status WorkOnDrawn(CommandResult& result) {
    if (!options_.pair.empty() || options_.remove || options_.keep_scale || options_.by_points ||
        options_.refine) {
      return Status::Error("occluder '" + occluder_->name + "'",
                           "was drawn on the training images, which determine its position",
                           "align a model instead, or use --flat");
    }
    if (options_.flat) {
      changed_ |= occluder_->flat != *options_.flat;
      occluder_->flat = *options_.flat;
    }
    LARARIUM_ASSIGN_OR_RETURN(const DrawnOccluder drawn,
                              DrawOccluder(*occluder_, *map_.database, map_from_stage_.scale));
    const double uneven_cm = 100.0 * drawn.unevenness / map_from_stage_.scale;
    result.text +=
        Text("  %zu corners, %.2f px off; %.1f cm off their plane%s\n", drawn.corners.size(),
             drawn.error_px, uneven_cm, occluder_->flat ? ", onto which they are laid" : "");
    result.json = {{"flat", occluder_->flat},
                   {"corners", drawn.corners.size()},
                   {"error_px", drawn.error_px},
                   {"uneven_cm", uneven_cm}};
    return Status();
  }

  Status WorkOnModel(CommandResult& result) {
    if (options_.flat) {
      return Status::Error("--flat", "applies only to drawn occluders");
    }
    LARARIUM_RETURN_IF_ERROR(EditPairs());
    if (options_.keep_scale) {
      changed_ |= occluder_->keep_scale != *options_.keep_scale;
      occluder_->keep_scale = *options_.keep_scale;
    }
    if (options_.by_points) {
      LARARIUM_ASSIGN_OR_RETURN(occluder_->stage_from_mesh,
                                AlignByPoints(*occluder_, *map_.database, map_from_stage_));
      changed_ = true;
    }
    Json refined = nullptr;
    std::string refine_text;
    if (options_.refine) {
      LARARIUM_ASSIGN_OR_RETURN(const geometry::TriangleMesh mesh,
                                LoadBakedMesh(paths_, *place_, *occluder_));
      LARARIUM_ASSIGN_OR_RETURN(
          const train::RefineReport report,
          RefineOnMap(*occluder_, mesh, *map_.database, map_from_stage_,
                      options_.within.value_or(train::RefineOptions().search_m), progress_));
      occluder_->stage_from_mesh = report.stage_from_mesh;
      changed_ = true;
      refined = RefineJson(report);
      refine_text = "  " + RefineText(report, false) + "\n";
    }
    const AlignmentReport report = ReportAlignment(*occluder_, *map_.database, map_from_stage_);
    result.json = AlignmentJson(*occluder_, report);
    result.json["refined"] = std::move(refined);
    result.text += AlignmentText(report) + refine_text;
    return Status();
  }

  Status EditPairs() {
    if (options_.remove) {
      const auto count = static_cast<int>(occluder_->model_pairs.size());
      if (*options_.remove > count) {
        return Status::Error("--remove", "the pair does not exist",
                             "it has " + std::to_string(count));
      }
      RemoveModelPair(*occluder_, static_cast<size_t>(*options_.remove) - 1);
      changed_ = true;
    }
    if (options_.pair.empty()) {
      return Status();
    }
    if (occluder_->model_pairs.size() >= kMaxModelPairs) {
      return Status::Error("--pair", "there are too many already", "remove one");
    }
    AddModelPair(*occluder_, {options_.pair[0], options_.pair[1], options_.pair[2]});
    for (const std::string& text : options_.picks) {
      LARARIUM_ASSIGN_OR_RETURN(const stage::Pick pick,
                                ParsePick(*map_.database, place_->name,
                                          static_cast<uint32_t>(options_.session), "--pick", text));
      SetModelPick(*occluder_, occluder_->model_pairs.size() - 1, pick);
    }
    changed_ = true;
    return Status();
  }

  ProjectPaths paths_;
  ProjectDocument document_;
  const AlignOptions& options_;
  Progress& progress_;
  PlaceDocument* place_ = nullptr;
  OccluderDocument* occluder_ = nullptr;
  StagedMap map_;
  geometry::Similarity3 map_from_stage_;
  bool changed_ = false;
};

}  // namespace

Result<CommandResult> RunAlign(const AlignOptions& options, Progress& progress) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(ProjectDocument document, LoadProject(paths));
  return AlignWorker(paths, std::move(document), options, progress).Run();
}

}  // namespace lararium::editor
