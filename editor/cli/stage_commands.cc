#include "editor/cli/stage_commands.h"

#include <utility>

#include "editor/check/stage_report.h"
#include "editor/cli/command_arguments.h"
#include "editor/document/document_fields.h"
#include "editor/document/picked_images.h"
#include "editor/document/place_edits.h"
#include "editor/jobs/staging.h"
#include "editor/train/april_tags.h"

namespace lararium::editor {

namespace {

std::string KnownAnchors() {
  std::string known;
  for (const std::string& name : AnchorNames()) {
    known += (known.empty() ? "" : ", ") + name;
  }
  return known;
}

class StageWorker {
 public:
  StageWorker(ProjectPaths paths, ProjectDocument document, const StageOptions& options)
      : paths_(std::move(paths)), document_(std::move(document)), options_(options) {}

  Result<CommandResult> Run() {
    LARARIUM_ASSIGN_OR_RETURN(const std::string name,
                              ChoosePlace(paths_, document_, options_.place));
    place_ = document_.FindPlace(name);
    LARARIUM_ASSIGN_OR_RETURN(map_, LoadStagedMap(paths_, *place_));
    LARARIUM_RETURN_IF_ERROR(EditPicks());
    LARARIUM_RETURN_IF_ERROR(EditTags());
    map_.picks = ResolvePicks(*place_, *map_.database, map_.measures);
    LARARIUM_RETURN_IF_ERROR(Adjust());
    if (changed_) {
      LARARIUM_RETURN_IF_ERROR(SaveProject(paths_, document_));
    }
    return Report();
  }

 private:
  Result<stage::Anchor*> Anchor(const std::string& option, const std::string& name) {
    if (stage::Anchor* anchor = FindAnchor(place_->picks, name)) {
      return anchor;
    }
    return Status::Error(option + " " + name, "is not a point of the stage",
                         "choose one of " + KnownAnchors());
  }

  Status EditPicks() {
    for (const std::string& text : options_.clear) {
      LARARIUM_RETURN_IF_ERROR(Clear(text));
      changed_ = true;
    }
    for (const std::string& text : options_.picks) {
      LARARIUM_RETURN_IF_ERROR(Pick(text));
      changed_ = true;
    }
    if (options_.length) {
      place_->picks.length_m = *options_.length;
      changed_ = true;
    }
    return Status();
  }

  // "POINT", or "POINT=FRAME"
  Status Clear(const std::string& text) {
    const size_t equals = text.find('=');
    LARARIUM_ASSIGN_OR_RETURN(stage::Anchor * anchor, Anchor("--clear", text.substr(0, equals)));
    if (equals == std::string::npos) {
      anchor->picks.clear();
      return Status();
    }
    LARARIUM_ASSIGN_OR_RETURN(const stage::Pick pick,
                              FindPick(*anchor, "--clear", text.substr(equals + 1),
                                       static_cast<uint32_t>(options_.session)));
    RemovePick(*anchor, pick);
    return Status();
  }

  // "POINT=FRAME,x,y"
  Status Pick(const std::string& text) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos) {
      return Status::Error("--pick " + text, "does not name a point", "give POINT=FRAME,x,y");
    }
    LARARIUM_ASSIGN_OR_RETURN(stage::Anchor * anchor, Anchor("--pick", text.substr(0, equals)));
    LARARIUM_ASSIGN_OR_RETURN(
        const stage::Pick pick,
        ParsePick(*map_.database, place_->name, static_cast<uint32_t>(options_.session), "--pick",
                  text.substr(equals + 1)));
    SetPick(*anchor, pick);
    return Status();
  }

  Status EditTags() {
    if (options_.without_tags) {
      place_->tags.reset();
    } else if (options_.tag_size || !options_.tag_family.empty()) {
      TagsDocument tags = place_->tags.value_or(TagsDocument());
      tags.size_m = options_.tag_size.value_or(tags.size_m);
      tags.family = options_.tag_family.empty() ? tags.family : options_.tag_family;
      const train::TagOptions options = {tags.family, tags.size_m};
      LARARIUM_RETURN_IF_ERROR(options.Validate());
      place_->tags = tags;
    } else {
      return Status();
    }
    map_.measures = MeasureMap(*place_, *map_.database);
    changed_ = true;
    return Status();
  }

  // Applies manual adjustments on top of the picks.
  Status Adjust() {
    geometry::Similarity3& adjusted = place_->picked_from_stage;
    if (options_.back_to_picks) {
      adjusted = geometry::Similarity3();
    }
    if (!options_.at.empty()) {
      LARARIUM_ASSIGN_OR_RETURN(adjusted.translation, ParsePosition("--at", options_.at));
    }
    if (!options_.turn.empty()) {
      adjusted.rotation = RotationOf(options_.turn);
    }
    adjusted.scale = options_.scale.value_or(adjusted.scale);
    if (options_.on_floor) {
      LARARIUM_RETURN_IF_ERROR(LayOnFloorOfMap());
    }
    if (!options_.nudge.empty()) {
      LARARIUM_ASSIGN_OR_RETURN(place_->camera_nudge, ParsePosition("--nudge", options_.nudge));
    }
    changed_ |= options_.back_to_picks || !options_.at.empty() || !options_.turn.empty() ||
                options_.scale || options_.on_floor || !options_.nudge.empty();
    return Status();
  }

  Status LayOnFloorOfMap() {
    if (!map_.measures.floor) {
      return Status::Error("--floor", "no large level surface was found among the points",
                           "film more of the floor, or lay the stage by --pick or --at");
    }
    place_->picked_from_stage =
        LayOnFloor(map_.picks.map_from_picked, place_->picked_from_stage, *map_.measures.floor);
    return Status();
  }

  CommandResult Report() const {
    const StageReport report = ReportStage(document_, *place_, map_);
    CommandResult result;
    result.text = place_->name + ":\n" + report.text +
                  "by hand: " + DescribePose(place_->picked_from_stage) + "\n";
    result.json = report.json;
    result.json["place"] = place_->name;
    FormatSimilarity(place_->picked_from_stage, result.json["adjust"]);
    if (!map_.picks.problem.ok()) {
      result.text += "warning: " + map_.picks.problem.message() + "\n";
    }
    return result;
  }

  ProjectPaths paths_;
  ProjectDocument document_;
  const StageOptions& options_;
  PlaceDocument* place_ = nullptr;
  StagedMap map_;
  bool changed_ = false;
};

}  // namespace

Result<CommandResult> RunStage(const StageOptions& options) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(ProjectDocument document, LoadProject(paths));
  return StageWorker(paths, std::move(document), options).Run();
}

}  // namespace lararium::editor
