#include "shared/core/program.h"

#include <system_error>

#include "shared/core/file.h"

namespace lararium {

std::filesystem::path ProgramFolder() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? std::filesystem::path() : program.parent_path();
}

std::filesystem::path ShippedData(const std::filesystem::path& shared,
                                  const std::filesystem::path& source,
                                  const std::filesystem::path& programs) {
  const std::filesystem::path prefix = programs.parent_path();
  const std::filesystem::path installed = prefix / "share" / shared;
  return FileExists(installed) ? installed : prefix.parent_path().parent_path() / source;
}

}  // namespace lararium
