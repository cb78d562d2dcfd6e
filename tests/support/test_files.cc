#include "tests/support/test_files.h"

#include <cstdlib>
#include <string>

#include "shared/core/check.h"

namespace lararium::test {

std::filesystem::path SourceDir() { return LARARIUM_SOURCE_DIR; }

std::filesystem::path DataDir() { return LARARIUM_DATA_DIR; }

std::filesystem::path CastLibraryDir() {
  const char* chosen = std::getenv("LARARIUM_CAST_LIBRARY");
  return chosen != nullptr ? chosen : SourceDir() / "build/cast-library";
}

std::filesystem::path BoardPhotographsDir() { return SourceDir() / "build/board-photographs"; }

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "lararium_test.XXXXXX").string();
  CHECK(mkdtemp(name.data()) != nullptr);
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace lararium::test
