#include "editor/app/subcommands.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "editor/app/baking.h"
#include "editor/app/credits.h"
#include "editor/app/dry_run.h"
#include "editor/app/exporting.h"
#include "editor/app/line_checks.h"
#include "editor/app/lines.h"
#include "editor/app/paradata.h"
#include "editor/app/project.h"
#include "editor/app/rendering.h"
#include "editor/app/sounds.h"
#include "editor/app/stage_report.h"
#include "editor/app/staging.h"
#include "editor/bake/probe.h"
#include "shared/bundle/bundle_writer.h"
#include "shared/core/file.h"
#include "shared/stage/stage.h"

namespace lararium::app {

Status FillStage(const ProjectPaths& paths,
                 const ProjectDocument& document,
                 const std::string& spoken,
                 stage::Stage& stage,
                 show::ShowContent& content) {
  for (const CastDocument& member : document.cast) {
    LARARIUM_ASSIGN_OR_RETURN(const show::CastMember person,
                              ShareBakedHuman(paths, member, kAnyDetail));
    LARARIUM_RETURN_IF_ERROR(stage.Add(member.name, person.model).status());
  }
  LARARIUM_ASSIGN_OR_RETURN(const auto objects, LoadObjects(paths, document));
  for (const show::StageObject& object : objects) {
    LARARIUM_RETURN_IF_ERROR(
        stage.AddObject(object.name, object.model, object.stage_from_object).status());
  }
  LARARIUM_RETURN_IF_ERROR(
      AddLines(paths, document, {spoken, std::string(show::kNoCaptions)}, content));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<audio::SoundData> sounds, LoadSounds(paths));
  for (const audio::SoundData& sound : sounds) {
    LARARIUM_ASSIGN_OR_RETURN(const auto reader, audio::SoundReader::Open(sound.bytes, sound.name));
    LARARIUM_RETURN_IF_ERROR(stage.sounds().Add(sound.name, reader.seconds()));
  }
  for (const show::Speech& speech : content.speech) {
    LARARIUM_RETURN_IF_ERROR(stage.AddSpeech(speech.name, speech.visemes));
  }
  std::vector<stage::Place> places;
  for (const PlaceDocument& place : document.places) {
    LARARIUM_ASSIGN_OR_RETURN(stage::Place staged, StageObstacles(paths, place));
    places.push_back(std::move(staged));
  }
  return stage.SetFloor({}, places);
}

namespace {

// Lines that cannot be read are a problem, and none.
ProjectLines CheckLines(const ProjectPaths& paths,
                        const ProjectDocument& document,
                        std::vector<std::string>& problems) {
  Result<ProjectLines> lines = LoadProjectLines(paths, document);
  if (!lines.ok()) {
    problems.push_back(lines.message());
    return {};
  }
  for (std::string& problem : CheckTable(paths, document, *lines)) {
    problems.push_back(std::move(problem));
  }
  if (const Result<std::string> script = ReadText(paths.Drama()); script.ok()) {
    for (std::string& problem : CheckScriptLines(paths, document, *lines, *script)) {
      problems.push_back(std::move(problem));
    }
  }
  return *std::move(lines);
}

// What is wrong with a place's probes, each with its file; adds to warnings what was mended.
std::vector<std::string> CheckProbes(const ProjectPaths& paths,
                                     const PlaceDocument& place,
                                     std::vector<std::string>& warnings) {
  std::vector<std::string> problems;
  for (const ProbeDocument& probe : place.probes) {
    const std::filesystem::path file = paths.Resolve(probe.file);
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) {
      continue;  // FindMissingFiles() says so
    }
    const Result<bake::ProbeImage> image = bake::ReadProbeImage(file);
    if (!image.ok()) {
      problems.push_back(image.message());
      continue;
    }
    for (const std::string& warning : image->warnings) {
      warnings.push_back(file.string() + ": " + warning);
    }
  }
  return problems;
}

// What CheckPlace() gathers of all places.
struct PlacesChecked {
  std::string text;  // how well their stages are known
  Json stages = Json::object();
  std::vector<std::string> problems;
  std::vector<std::string> warnings;
};

// What keeps a place from being shown, and whether the stage lies there as it should.
Status CheckPlace(const ProjectPaths& paths,
                  const ProjectDocument& document,
                  const PlaceDocument& place,
                  PlacesChecked& checked) {
  for (std::string& problem : CheckProbes(paths, place, checked.warnings)) {
    checked.problems.push_back(std::move(problem));
  }
  LARARIUM_ASSIGN_OR_RETURN(const StagedMap map, LoadStagedMap(paths, place));
  const StageReport stage = ReportStage(document, place, map);
  checked.text += place.name + ":\n" + stage.text;
  checked.stages[place.name] = stage.json;
  LARARIUM_RETURN_IF_ERROR(map.picks.problem);
  if (!document.check_points.empty() && stage.points.verdict != CheckReport::Verdict::kGood) {
    const bool poor = stage.points.verdict == CheckReport::Verdict::kPoor;
    (poor ? checked.problems : checked.warnings)
        .push_back("check points of " + place.name + ": " + CheckAdvice(stage.points, false));
  }
  return AssembleShow(paths, document, place, map.database, map.picks.map_from_picked).status();
}

}  // namespace

Result<std::string> ChoosePlace(const ProjectPaths& paths,
                                const ProjectDocument& document,
                                const std::string& name) {
  if (!name.empty()) {
    if (document.FindPlace(name) == nullptr) {
      return Status::Error(paths.Project().string(), "has no place \"" + name + "\"");
    }
    return name;
  }
  if (document.places.size() != 1) {
    return Status::Error(paths.Project().string(),
                         "has " + std::to_string(document.places.size()) + " places",
                         "name one with --place");
  }
  return document.places.front().name;
}

Result<CommandResult> RunNew(const NewOptions& options) {
  const ProjectPaths paths{options.project};
  const std::filesystem::path folder = options.project.lexically_normal();
  const std::string stem = (folder.has_filename() ? folder : folder.parent_path()).stem().string();
  LARARIUM_RETURN_IF_ERROR(CreateProject(paths, options.title.empty() ? stem : options.title));
  return CommandResult{"made " + options.project.string() + "\n",
                       {{"project", options.project.string()}}};
}

Result<CommandResult> RunBake(const BakeOptions& options, Progress& progress) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(const ProjectDocument document, LoadProject(paths));
  LARARIUM_ASSIGN_OR_RETURN(const BakeReport report, Bake(paths, document, progress));
  CommandResult result;
  for (const std::string& warning : report.warnings) {
    result.text += "warning: " + warning + "\n";
  }
  for (const std::string& name : report.baked) {
    result.text += "baked " + name + "\n";
  }
  result.text += std::to_string(report.unchanged.size()) + " up to date\n";
  result.json = {
      {"baked", report.baked}, {"unchanged", report.unchanged}, {"warnings", report.warnings}};
  return result;
}

Result<CommandResult> RunCheck(const CheckOptions& options, Progress& progress) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(const ProjectDocument document, LoadProject(paths));
  std::vector<std::string> problems;
  for (const Status& missing : FindMissingFiles(paths, document)) {
    problems.push_back(missing.message());
  }
  if (document.places.empty()) {
    problems.push_back(paths.Project().string() + ": has no place; train one");
  }
  PlacesChecked places;
  for (const PlaceDocument& place : document.places) {
    const Status problem = CheckPlace(paths, document, place, places);
    if (!problem.ok()) {
      problems.push_back(problem.message());
    }
  }
  problems.insert(problems.end(), places.problems.begin(), places.problems.end());
  std::vector<std::string>& warnings = places.warnings;
  for (const Status& problem : FindSilences(paths, document)) {
    problems.push_back(problem.message());
  }
  const ParadataReport paradata = CheckParadata(paths, document);
  problems.insert(problems.end(), paradata.problems.begin(), paradata.problems.end());
  warnings.insert(warnings.end(), paradata.warnings.begin(), paradata.warnings.end());
  const ProjectLines lines = CheckLines(paths, document, problems);
  const DryRunReport run = DryRunAll(paths, document, lines, options, progress);
  problems.insert(problems.end(), run.problems.begin(), run.problems.end());
  if (progress.Cancelled()) {
    return Status::Error("check", "cancelled");
  }
  // What several parts need is reported by each of them.
  std::sort(problems.begin(), problems.end());
  problems.erase(std::unique(problems.begin(), problems.end()), problems.end());
  CommandResult result;
  result.text = places.text;
  for (const std::string& warning : warnings) {
    result.text += "warning: " + warning + "\n";
  }
  for (const std::string& problem : problems) {
    result.text += problem + "\n";
  }
  if (problems.empty()) {
    result.text += "no problems\n";
  }
  result.json = {{"problems", problems},      {"warnings", warnings}, {"stages", places.stages},
                 {"paradata", paradata.json}, {"tasks", run.tasks},   {"seeks", run.seeks},
                 {"runs", run.runs}};
  if (options.seeks > 0) {
    result.text += "seeks: " + run.seeks.dump() + "\n";
  }
  result.failed = !problems.empty();
  return result;
}

Result<CommandResult> RunCredits(const CreditsOptions& options) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(const ProjectDocument document, LoadProject(paths));
  LARARIUM_ASSIGN_OR_RETURN(Credits credits, MakeCredits(paths, document));
  if (options.out.empty()) {
    return CommandResult{std::move(credits.text), std::move(credits.json)};
  }
  LARARIUM_RETURN_IF_ERROR(options.out.extension() == ".json"
                               ? SaveJson(options.out, credits.json)
                               : WriteFileAtomically(options.out, credits.text));
  return CommandResult{"wrote " + options.out.string() + "\n", std::move(credits.json)};
}

Result<CommandResult> RunRender(const RenderOptions& options, Progress& progress, Log& log) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(const ProjectDocument document, LoadProject(paths));
  LARARIUM_ASSIGN_OR_RETURN(const std::string place, ChoosePlace(paths, document, options.place));
  LARARIUM_ASSIGN_OR_RETURN(const BakeReport baked, Bake(paths, document, progress));
  LARARIUM_ASSIGN_OR_RETURN(show::ShowContent content, LoadShowContent(paths, document, place));
  RenderJob job;
  job.content = std::move(content);
  job.video = options.video;
  job.intrinsics = options.intrinsics;
  job.out = options.out;
  job.sound = options.sound;
  job.evidence = options.evidence;
  LARARIUM_ASSIGN_OR_RETURN(const RenderReport report, RenderVideo(std::move(job), progress, log));
  return CommandResult{
      options.out.string() + ": " + std::to_string(report.frames) + " frames, " +
          std::to_string(report.tracked) + " tracked\n",
      {{"out", options.out.string()}, {"frames", report.frames}, {"tracked", report.tracked}}};
}

Result<CommandResult> RunExport(const ExportOptions& options, Progress& progress) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(const ProjectDocument document, LoadProject(paths));
  ExportRequest request{.out = options.out, .key = options.sign};
  request.budget.max_points = options.points.value_or(request.budget.max_points);
  LARARIUM_RETURN_IF_ERROR(ExportProject(paths, document, request, progress));
  std::error_code ignored;
  const auto bytes = std::filesystem::file_size(options.out, ignored);
  return CommandResult{"wrote " + options.out.string() + " (" + std::to_string(bytes) + " bytes)\n",
                       {{"out", options.out.string()}, {"bytes", bytes}}};
}

Result<CommandResult> RunKey(const KeyOptions& options) {
  const std::string secret = options.name.string() + ".key";
  const std::string open = options.name.string() + ".pub";
  const bundle::SecretKey key = bundle::MakeSecretKey();
  LARARIUM_RETURN_IF_ERROR(bundle::SaveSecretKey(secret, key));
  LARARIUM_RETURN_IF_ERROR(bundle::SavePublicKey(open, key.public_key()));
  return CommandResult{"keep " + secret + " to yourself, give " + open + " to the players\n",
                       {{"secret", secret}, {"public", open}}};
}

}  // namespace lararium::app
