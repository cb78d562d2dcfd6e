#include "editor/session/sample.h"

#include <string>

#include "shared/core/program.h"

namespace lararium::editor {

namespace fs = std::filesystem;

fs::path ShippedSample() {
  std::error_code error;
  const fs::path program = ProgramFolder();
  const fs::path root = program / ".." / ".." / "..";
  const fs::path sample = (root / "scenes" / "maquette" / "maquette.lararium").lexically_normal();
  return !program.empty() && fs::exists(sample, error) ? sample : fs::path();
}

Result<fs::path> OwnSample(const fs::path& shipped, const fs::path& folder) {
  const fs::path own = folder / shipped.filename();
  std::error_code error;
  if (fs::exists(own, error)) {
    return own;
  }
  // The copy gets its name when it is complete, so that an interrupted one is not used.
  const fs::path part = folder / (shipped.filename().string() + ".part");
  const auto failed = [&](const char* what) {
    return Status::Error(own.string(), std::string(what) + ": " + error.message(),
                         "make room, or open " + shipped.string() + " itself");
  };
  fs::create_directories(folder, error);
  fs::remove_all(part, error);
  fs::copy(shipped, part, fs::copy_options::recursive, error);
  if (error) {
    return failed("the sample cannot be copied");
  }
  fs::rename(part, own, error);
  if (error) {
    return failed("the copy of the sample cannot be renamed");
  }
  return own;
}

}  // namespace lararium::editor
