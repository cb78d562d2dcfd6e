#include "editor/app/subcommands.h"

#include <utility>
#include <vector>

#include "editor/app/baking.h"
#include "editor/app/credits.h"
#include "editor/app/exporting.h"
#include "editor/app/lines.h"
#include "editor/app/project.h"
#include "editor/app/project_check.h"
#include "editor/app/rendering.h"
#include "editor/app/sounds.h"
#include "editor/app/staging.h"
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
  LARARIUM_ASSIGN_OR_RETURN(CheckedProject checked, CheckProject(options, progress));
  return std::move(checked.result);
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
