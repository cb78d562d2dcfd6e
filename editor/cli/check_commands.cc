#include "editor/cli/check_commands.h"

#include <algorithm>
#include <utility>

#include "editor/cli/command_arguments.h"
#include "editor/document/picked_images.h"
#include "editor/jobs/check_points.h"
#include "editor/jobs/staging.h"

namespace lararium::editor {

namespace {

class CheckPointWorker {
 public:
  CheckPointWorker(ProjectPaths paths, ProjectDocument document, CheckPointsOptions options)
      : paths_(std::move(paths)), document_(std::move(document)), options_(std::move(options)) {}

  Result<CommandResult> Run() {
    LARARIUM_ASSIGN_OR_RETURN(const bool changed, Work());
    if (changed) {
      LARARIUM_RETURN_IF_ERROR(SaveProject(paths_, document_));
    }
    CommandResult result;
    if (document_.check_points.empty()) {
      result.text = "no check points; add one with --set NAME --at x,y,z\n";
    }
    for (const PlaceDocument& place : document_.places) {
      if (!document_.check_points.empty() &&
          (options_.place.empty() || place.name == options_.place)) {
        LARARIUM_RETURN_IF_ERROR(Report(place, result));
      }
    }
    return result;
  }

 private:
  Result<bool> Work() {
    if (!options_.set.empty()) {
      return Done(Set());
    }
    if (!options_.pick.empty()) {
      return Done(Pick());
    }
    if (!options_.clear.empty()) {
      return Done(Clear());
    }
    if (!options_.remove.empty()) {
      LARARIUM_RETURN_IF_ERROR(FindPoint(options_.remove).status());
      RemoveCheckPoint(document_, options_.remove);
      return true;
    }
    if (!options_.rename.empty()) {
      return Done(Rename());
    }
    if (options_.lay) {
      return Done(Lay());
    }
    return false;
  }

  static Result<bool> Done(const Status& status) {
    LARARIUM_RETURN_IF_ERROR(status);
    return true;
  }

  Result<CheckPointDocument*> FindPoint(const std::string& name) {
    return FindNamed(document_.check_points, name, paths_.Project().string(), "has no check point");
  }

  Result<PlaceDocument*> Place() {
    LARARIUM_ASSIGN_OR_RETURN(const std::string name,
                              ChoosePlace(paths_, document_, options_.place));
    return document_.FindPlace(name);
  }

  Status Set() {
    if (options_.set.size() > kMaxCheckPointName) {
      return Status::Error("--set", "the name is too long", "use 200 bytes or less");
    }
    CheckPointDocument point{options_.set, {}};
    if (options_.here) {
      LARARIUM_ASSIGN_OR_RETURN(point.position, FoundHere());
    } else {
      LARARIUM_ASSIGN_OR_RETURN(point.position, ParsePosition("--at", options_.at));
    }
    const auto known = std::find_if(document_.check_points.begin(), document_.check_points.end(),
                                    [&](const auto& p) { return p.name == point.name; });
    if (known != document_.check_points.end()) {
      *known = point;
    } else if (document_.check_points.size() < kMaxCheckPoints) {
      document_.check_points.push_back(point);
    } else {
      return Status::Error("--set", "there are too many check points already", "remove one");
    }
    return Status();
  }

  Status Rename() {
    LARARIUM_RETURN_IF_ERROR(FindPoint(options_.rename).status());
    if (options_.to.empty() || options_.to.size() > kMaxCheckPointName ||
        FindPoint(options_.to).ok()) {
      return Status::Error("--to", "is empty, too long, or the name of another point",
                           "choose another name");
    }
    RenameCheckPoint(document_, options_.rename, options_.to);
    return Status();
  }

  // The position of the point according to the staging of the place. The point may be new, with
  // picks that already exist.
  Result<Eigen::Vector3d> FoundHere() {
    LARARIUM_ASSIGN_OR_RETURN(const PlaceDocument* place, Place());
    LARARIUM_ASSIGN_OR_RETURN(const StagedMap map, LoadStagedMap(paths_, *place));
    const stage::Anchor* picks = FindCheckPicks(*place, options_.set);
    if (picks == nullptr) {
      return Status::Error("--here", "\"" + options_.set + "\" was not picked at " + place->name,
                           "pick it first, or give --at");
    }
    LARARIUM_ASSIGN_OR_RETURN(const stage::AnchorReport report,
                              stage::SolveAnchor(*picks, *map.database));
    const geometry::Similarity3 map_from_stage =
        map.picks.map_from_picked * place->picked_from_stage;
    return Eigen::Vector3d(map_from_stage.Inverse() * report.point_in_map);
  }

  Status Pick() {
    LARARIUM_RETURN_IF_ERROR(FindPoint(options_.pick).status());
    LARARIUM_ASSIGN_OR_RETURN(PlaceDocument * place, Place());
    LARARIUM_ASSIGN_OR_RETURN(const vision::SceneDatabase map, LoadMap(paths_, place->name));
    LARARIUM_ASSIGN_OR_RETURN(
        const stage::Pick pick,
        PickInImage(map, place->name, options_.frame, static_cast<uint32_t>(options_.session),
                    {options_.pixel[0], options_.pixel[1]}));
    SetCheckPick(*place, options_.pick, pick);
    return Status();
  }

  Status Clear() {
    LARARIUM_RETURN_IF_ERROR(FindPoint(options_.clear).status());
    LARARIUM_ASSIGN_OR_RETURN(PlaceDocument * place, Place());
    if (options_.frame.empty()) {
      ClearCheckPicks(*place, options_.clear);
      return Status();
    }
    const stage::Anchor* picks = FindCheckPicks(*place, options_.clear);
    LARARIUM_ASSIGN_OR_RETURN(
        const stage::Pick pick,
        FindPick(picks != nullptr ? *picks : stage::Anchor{options_.clear, {}}, "--clear",
                 options_.frame, static_cast<uint32_t>(options_.session)));
    RemoveCheckPick(*place, options_.clear, pick);
    return Status();
  }

  Status Lay() {
    LARARIUM_ASSIGN_OR_RETURN(PlaceDocument * place, Place());
    LARARIUM_ASSIGN_OR_RETURN(const StagedMap map, LoadStagedMap(paths_, *place));
    const CheckReport report =
        CheckStaging(document_, *place, *map.database, map.picks.map_from_picked);
    if (!report.map_from_stage || !report.fit_good) {
      return Status::Error("check points of " + place->name, "do not determine where the stage is",
                           CheckAdvice(report, false));
    }
    place->picked_from_stage = map.picks.map_from_picked.Inverse() * *report.map_from_stage;
    return Status();
  }

  Status Report(const PlaceDocument& place, CommandResult& result) {
    LARARIUM_ASSIGN_OR_RETURN(const StagedMap map, LoadStagedMap(paths_, place));
    const CheckReport report =
        CheckStaging(document_, place, *map.database, map.picks.map_from_picked);
    result.text += place.name + ":\n" + CheckText(report);
    result.json[place.name] = CheckJson(report);
    result.failed |= report.verdict == CheckReport::Verdict::kPoor;
    return Status();
  }

  ProjectPaths paths_;
  ProjectDocument document_;
  CheckPointsOptions options_;
};

}  // namespace

Result<CommandResult> RunCheckPoints(const CheckPointsOptions& options) {
  return RunOnProject<CheckPointWorker>(options);
}

}  // namespace lararium::editor
