#include "editor/session/player_trial.h"

#include <unistd.h>

#include <system_error>

#include "editor/jobs/run_program.h"
#include "shared/core/program.h"

namespace lararium::editor {

namespace {

namespace fs = std::filesystem;

constexpr const char* kPlayer = "lararium-player";

// The path of the player beside this program. Where it is not there: its name, to be found in PATH.
fs::path FindPlayer() {
  const fs::path beside = ProgramFolder() / kPlayer;
  return ::access(beside.c_str(), X_OK) == 0 ? beside : fs::path(kPlayer);
}

}  // namespace

std::vector<std::string> TrialArguments(const ProjectPaths& paths,
                                        const PlaceDocument& place,
                                        const fs::path& show) {
  std::vector<std::string> arguments = {show.string(), "--place", place.name};
  const SourceDocument& source = place.preview.empty() ? place.training : place.preview;
  const bool images = source.kind == SourceDocument::Kind::kImages;
  const fs::path file = paths.Resolve(source.path);
  std::error_code error;
  if (!source.empty() && fs::exists(file, error)) {
    arguments.insert(arguments.end(), {images ? "--images" : "--video", file.string(), "--loop"});
  }
  return arguments;
}

Status RunPlayer(const std::vector<std::string>& arguments, Progress& progress) {
  return RunProgram(
      FindPlayer(), arguments,
      {"install lararium-player beside the editor", "check the show with lararium-player doctor"},
      progress);
}

}  // namespace lararium::editor
