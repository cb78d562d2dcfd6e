#include <unistd.h>

#include <cstdio>
#include <variant>

#include "editor/cli/align_commands.h"
#include "editor/cli/cast_commands.h"
#include "editor/cli/check_commands.h"
#include "editor/cli/line_commands.h"
#include "editor/cli/object_commands.h"
#include "editor/cli/occluder_commands.h"
#include "editor/cli/options.h"
#include "editor/cli/probe_commands.h"
#include "editor/cli/project_commands.h"
#include "editor/cli/stage_commands.h"
#include "editor/cli/subcommands.h"
#include "editor/cli/terminal.h"
#include "editor/cli/timeline_commands.h"
#include "editor/jobs/calibrating.h"
#include "editor/jobs/camera_measure.h"
#include "editor/jobs/portrait.h"
#include "editor/jobs/reference.h"
#include "editor/window/window.h"
#include "shared/core/json.h"
#include "shared/core/log.h"
#include "shared/core/uncaught.h"

namespace {

using namespace lararium;          // NOLINT: the program itself
using namespace lararium::editor;  // NOLINT

constexpr int kDone = 0;
constexpr int kFailed = 1;

int ReportFailure(const Status& status, bool json) {
  if (json) {
    std::printf("%s\n", DumpJson(Json{{"error", status.message()}}, 1).c_str());
  }
  std::fprintf(stderr, "%s\n", status.message().c_str());
  return kFailed;
}

// Visitor that runs the chosen subcommand.
struct Runner {
  Progress& progress;
  Log& log;

  Result<CommandResult> operator()(const NewOptions& options) { return RunNew(options); }
  Result<CommandResult> operator()(const ProjectOptions& options) { return RunProject(options); }
  Result<CommandResult> operator()(const PlaceOptions& options) { return RunPlace(options); }
  Result<CommandResult> operator()(const LocateOptions& options) { return RunLocate(options); }
  Result<CommandResult> operator()(const StageOptions& options) { return RunStage(options); }
  Result<CommandResult> operator()(const TrainCommandOptions& options) {
    return RunTrain(options, progress, log);
  }
  Result<CommandResult> operator()(const ImportColmapOptions& options) {
    return RunImportColmap(options, progress, log);
  }
  Result<CommandResult> operator()(const ExportColmapOptions& options) {
    return RunExportColmap(options);
  }
  Result<CommandResult> operator()(const MeasureOptions& options) { return RunMeasure(options); }
  Result<CommandResult> operator()(const PruneOptions& options) {
    return RunPrune(options, progress);
  }
  Result<CommandResult> operator()(const CastOptions& options) { return RunCast(options); }
  Result<CommandResult> operator()(const BakeOptions& options) {
    return RunBake(options, progress);
  }
  Result<CommandResult> operator()(const CheckOptions& options) {
    return RunCheck(options, progress);
  }
  Result<CommandResult> operator()(const CheckPointsOptions& options) {
    return RunCheckPoints(options);
  }
  Result<CommandResult> operator()(const OccluderOptions& options) { return RunOccluder(options); }
  Result<CommandResult> operator()(const ObjectOptions& options) { return RunObject(options); }
  Result<CommandResult> operator()(const SoundOptions& options) { return RunSound(options); }
  Result<CommandResult> operator()(const AlignOptions& options) {
    return RunAlign(options, progress);
  }
  Result<CommandResult> operator()(const LinesOptions& options) { return RunLines(options); }
  Result<CommandResult> operator()(const CaptionsOptions& options) {
    return RunCaptions(options, progress);
  }
  Result<CommandResult> operator()(const TimelineOptions& options) {
    return RunTimeline(options, progress);
  }
  Result<CommandResult> operator()(const ImportBmlOptions& options) {
    return RunImportBml(options);
  }
  Result<CommandResult> operator()(const CreditsOptions& options) { return RunCredits(options); }
  Result<CommandResult> operator()(const RenderOptions& options) {
    return RunRender(options, progress, log);
  }
  Result<CommandResult> operator()(const PortraitOptions& options) { return RunPortrait(options); }
  Result<CommandResult> operator()(const WardrobeOptions& options) {
    return RunWardrobe(options, progress);
  }
  Result<CommandResult> operator()(const ReferenceOptions& options) {
    return RunReference(options, progress, log);
  }
  Result<CommandResult> operator()(const ProbeOptions& options) { return RunProbe(options); }
  Result<CommandResult> operator()(const CameraOptions& options) {
    return RunCamera(options, progress);
  }
  Result<CommandResult> operator()(const CalibrateOptions& options) {
    return RunCalibrate(options, progress);
  }
  Result<CommandResult> operator()(const ExportOptions& options) {
    return RunExport(options, progress);
  }
  Result<CommandResult> operator()(const PublishOptions& options) {
    return RunPublish(options, progress);
  }
  Result<CommandResult> operator()(const KeyOptions& options) { return RunKey(options); }
  Result<CommandResult> operator()(const FetchCastLibraryOptions&) {
    return RunFetchCastLibrary(progress);
  }
  Result<CommandResult> operator()(const WindowOptions& options) {
    LARARIUM_RETURN_IF_ERROR(RunWindow(options.project, log));
    return CommandResult{};
  }
};

Result<CommandResult> Run(const CommandLine& line, Log& log) {
  if (std::holds_alternative<WindowOptions>(line.subcommand)) {
    NoProgress silent;
    return std::visit(Runner{silent, log}, line.subcommand);
  }
  TerminalProgress progress;
  return std::visit(Runner{progress, log}, line.subcommand);
}

}  // namespace

int main(int argc, char** argv) {
  ReportUncaughtExceptions();
  const auto parsed = ParseCommandLine(argc, argv);
  if (const int* code = std::get_if<int>(&parsed)) {
    return *code;
  }
  const CommandLine& line = std::get<CommandLine>(parsed);
  const Result<std::shared_ptr<Log>> log = MakeLog();
  if (!log.ok()) {
    return ReportFailure(log.status(), line.json);
  }
  if (::isatty(STDERR_FILENO) == 1) {
    (*log)->SetLevel(Log::Level::kWarning);  // The progress bar shows the rest.
  }
  const Result<CommandResult> result = Run(line, **log);
  if (!result.ok()) {
    return ReportFailure(result.status(), line.json);
  }
  if (line.json) {
    std::printf("%s\n", DumpJson(result->json, 1).c_str());
  } else {
    std::fputs(result->text.c_str(), stdout);
  }
  return result->failed ? kFailed : kDone;
}
