#include "editor/cli/subcommands.h"

#include <optional>
#include <string>
#include <utility>

#include "editor/check/project_check.h"
#include "editor/document/project.h"
#include "editor/jobs/baking.h"
#include "editor/jobs/cast_library_fetch.h"
#include "editor/jobs/credits.h"
#include "editor/jobs/exporting.h"
#include "editor/jobs/lines.h"
#include "editor/jobs/rendering.h"
#include "editor/jobs/sounds.h"
#include "editor/jobs/staging.h"
#include "shared/bundle/bundle_writer.h"
#include "shared/core/file.h"
#include "shared/stage/stage.h"

namespace lararium::editor {

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

namespace {

CommandResult DescribeWebFolder(const std::filesystem::path& folder,
                                const bundle::WebFolderReport& report) {
  CommandResult result;
  result.text = "wrote " + folder.string() + "\n  page " + std::to_string(report.page) + " bytes\n";
  for (const auto& [kind, bytes] : report.members) {
    result.text += "  " + kind + " " + std::to_string(bytes) + " bytes\n";
  }
  result.json = {{"folder", folder.string()}, {"page", report.page}, {"members", report.members}};
  return result;
}

Result<std::optional<bundle::FleetEntry>> ReadFleet(const ExportOptions& options) {
  constexpr uint64_t kMostPasswordBytes = 1024;
  if (options.fleet.empty()) {
    return std::optional<bundle::FleetEntry>();
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::string text,
                            ReadText(options.fleet_password, kMostPasswordBytes));
  bundle::FleetEntry fleet = {options.fleet, options.group, text.substr(0, text.find('\n'))};
  LARARIUM_RETURN_IF_ERROR(bundle::CheckFleet(fleet, "--fleet"));
  return std::optional(std::move(fleet));
}

}  // namespace

Result<CommandResult> RunExport(const ExportOptions& options, Progress& progress) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(const ProjectDocument document, LoadProject(paths));
  ExportRequest request{
      .out = options.out, .key = options.sign, .page = options.page, .address = options.address};
  LARARIUM_ASSIGN_OR_RETURN(request.fleet, ReadFleet(options));
  request.budget.max_points = options.points.value_or(request.budget.max_points);
  if (!options.web.empty()) {
    request.out = options.web;
    LARARIUM_ASSIGN_OR_RETURN(const bundle::WebFolderReport report,
                              ExportProjectForWeb(paths, document, request, progress));
    return DescribeWebFolder(options.web, report);
  }
  LARARIUM_RETURN_IF_ERROR(ExportProject(paths, document, request, progress));
  std::error_code ignored;
  const auto bytes = std::filesystem::file_size(options.out, ignored);
  return CommandResult{"wrote " + options.out.string() + " (" + std::to_string(bytes) + " bytes)\n",
                       {{"out", options.out.string()}, {"bytes", bytes}}};
}

Result<CommandResult> RunPublish(const PublishOptions& options, Progress& progress) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(const ProjectDocument document, LoadProject(paths));
  ExportRequest request{.out = options.folder, .key = options.sign};
  request.budget.max_points = options.points.value_or(request.budget.max_points);
  LARARIUM_ASSIGN_OR_RETURN(const bundle::Publication published,
                            PublishProject(paths, document, request, progress));
  return CommandResult{options.folder.string() + ": show " + std::to_string(published.serial) +
                           " is the newest (" + std::to_string(published.size) + " bytes)\n",
                       {{"folder", options.folder.string()},
                        {"serial", published.serial},
                        {"file", published.file()},
                        {"bytes", published.size}}};
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

Result<CommandResult> RunFetchCastLibrary(Progress& progress) {
  LARARIUM_RETURN_IF_ERROR(FetchCastLibrary(progress));
  const std::string folder = FindCastLibrary().value_or("").string();
  return CommandResult{"the cast library is in " + folder + "\n", {{"folder", folder}}};
}

}  // namespace lararium::editor
