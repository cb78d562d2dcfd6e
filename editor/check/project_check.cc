#include "editor/check/project_check.h"

#include <map>
#include <string>
#include <utility>

#include "editor/bake/probe.h"
#include "editor/check/dry_run.h"
#include "editor/check/line_checks.h"
#include "editor/check/stage_report.h"
#include "editor/document/check_sentences.h"
#include "editor/document/project.h"
#include "editor/jobs/baking.h"
#include "editor/jobs/lines.h"
#include "editor/jobs/paradata.h"
#include "editor/jobs/sounds.h"
#include "editor/jobs/staging.h"
#include "editor/jobs/training.h"
#include "shared/core/file.h"

namespace lararium::editor {
namespace {

// Also adds the warnings with which the project's products were made. Unreadable lines are reported
// as a problem, and the result is empty.
ProjectLines CheckLines(const ProjectPaths& paths,
                        const ProjectDocument& document,
                        std::vector<Sentence>& problems,
                        std::vector<Sentence>& warnings) {
  Result<ProjectLines> lines = LoadProjectLines(paths, document);
  std::vector<SpokenLine> spoken;
  if (lines.ok()) {
    Result<std::vector<SpokenLine>> found = SpokenLines(paths, document, *lines);
    if (found.ok()) {
      spoken = *std::move(found);
    } else {
      problems.push_back(found.message());
    }
    Append(CheckTable(paths, document, *lines, spoken), problems);
    LineNotes notes = CheckLineFiles(paths, *lines, spoken);
    Append(std::move(notes.problems), problems);
    Append(std::move(notes.warnings), warnings);
    if (const Result<std::string> script = ReadText(paths.Drama()); script.ok()) {
      Append(CheckScriptLines(paths, document, *lines, spoken, *script), problems);
    }
  } else {
    problems.push_back(lines.message());
  }
  for (const std::string& warning : WarningsOfProducts(paths, document, spoken)) {
    warnings.emplace_back(warning);
  }
  return lines.ok() ? *std::move(lines) : ProjectLines();
}

// Checks the probes of a place and names their files; adds repairs to `warnings`.
std::vector<Sentence> CheckProbes(const ProjectPaths& paths,
                                  const PlaceDocument& place,
                                  std::vector<Sentence>& warnings) {
  std::vector<Sentence> problems;
  for (const ProbeDocument& probe : place.probes) {
    const std::filesystem::path file = paths.Resolve(probe.file);
    if (!FileExists(file)) {
      continue;  // FindMissingFiles() reports it.
    }
    const Result<bake::ProbeImage> image = bake::ReadProbeImage(file);
    if (!image.ok()) {
      problems.push_back(image.message());
      continue;
    }
    for (const std::string& warning : image->warnings) {
      warnings.push_back(AtPlace(file.string(), warning));
    }
  }
  return problems;
}

// Results of CheckPlace() for all places.
struct PlacesChecked {
  std::string text;  // Accuracy of their stages.
  Json stages = Json::object();
  std::vector<Sentence> problems;
  std::vector<Sentence> warnings;
};

// Checks that a place can be shown and that its stage is registered correctly.
Status CheckPlace(const ProjectPaths& paths,
                  const ProjectDocument& document,
                  const PlaceDocument& place,
                  PlacesChecked& checked) {
  Append(CheckProbes(paths, place, checked.warnings), checked.problems);
  for (const std::string& warning : MapWarnings(paths, place.name)) {
    checked.warnings.emplace_back(warning);
  }
  LARARIUM_ASSIGN_OR_RETURN(const StagedMap map, LoadStagedMap(paths, place));
  const StageReport stage = ReportStage(document, place, map);
  checked.text += place.name + ":\n" + stage.text;
  checked.stages[place.name] = stage.json;
  LARARIUM_RETURN_IF_ERROR(map.picks.problem);
  if (!document.check_points.empty() && stage.points.verdict != CheckReport::Verdict::kGood) {
    const bool poor = stage.points.verdict == CheckReport::Verdict::kPoor;
    (poor ? checked.problems : checked.warnings)
        .push_back(Sentence("check points of %s: %s", {place.name, CheckSentence(stage.points)}));
  }
  return AssembleShow(paths, document, place, map.database, map.picks.map_from_picked).status();
}

// Several checks may report the same problem; keeps it once.
std::vector<Sentence> SortedOnce(const std::vector<Sentence>& problems) {
  std::map<std::string, Sentence> by_text;
  for (const Sentence& problem : problems) {
    by_text.emplace(problem.English(), problem);
  }
  std::vector<Sentence> sorted;
  for (auto& [text, problem] : by_text) {
    sorted.push_back(std::move(problem));
  }
  return sorted;
}

// `stages` describes the accuracy of the stages as text.
CommandResult DescribeCheck(const CheckedProject& checked, const std::string& stages) {
  const std::vector<std::string> problems = EnglishOf(checked.problems);
  const std::vector<std::string> warnings = EnglishOf(checked.warnings);
  CommandResult result;
  result.text = stages;
  for (const std::string& warning : warnings) {
    result.text += "warning: " + warning + "\n";
  }
  for (const std::string& problem : problems) {
    result.text += problem + "\n";
  }
  if (problems.empty()) {
    result.text += "no problems\n";
  }
  result.json = {{"problems", problems}, {"warnings", warnings}};
  result.failed = !problems.empty();
  return result;
}

}  // namespace

Result<CheckedProject> CheckProject(const CheckOptions& options, Progress& progress) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(const ProjectDocument document, LoadProject(paths));
  std::vector<Sentence> problems;
  for (const Status& missing : FindMissingFiles(paths, document)) {
    problems.push_back(missing.message());
  }
  if (document.places.empty()) {
    problems.push_back(AtPlace(paths.Project().string(), Sentence("has no place; train one")));
  }
  PlacesChecked places;
  for (const PlaceDocument& place : document.places) {
    const Status problem = CheckPlace(paths, document, place, places);
    if (!problem.ok()) {
      problems.push_back(problem.message());
    }
  }
  Append(places.problems, problems);
  for (const Status& problem : FindSilences(paths, document)) {
    problems.push_back(problem.message());
  }
  const ParadataReport paradata = CheckParadata(paths, document);
  Append(paradata.problems, problems);
  Append(paradata.warnings, places.warnings);
  const ProjectLines lines = CheckLines(paths, document, problems, places.warnings);
  const DryRunReport run = DryRunAll(paths, document, lines, options, progress);
  Append(run.problems, problems);
  if (progress.Cancelled()) {
    return Status::Error("check", "cancelled");
  }
  CheckedProject checked;
  checked.problems = SortedOnce(problems);
  checked.warnings = std::move(places.warnings);
  checked.result = DescribeCheck(checked, places.text);
  Json& json = checked.result.json;
  json["stages"] = places.stages;
  json["paradata"] = paradata.json;
  json["tasks"] = run.tasks;
  json["seeks"] = run.seeks;
  json["runs"] = run.runs;
  if (options.seeks > 0) {
    checked.result.text += "seeks: " + run.seeks.dump() + "\n";
  }
  return checked;
}

}  // namespace lararium::editor
