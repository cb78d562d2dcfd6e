#pragma once

// Locations of test data and temporary files.

#include <filesystem>
#include <string_view>

// In a test: defines `variable` as the folder `name` below the data folder, or skips the test with
// a message.
#define LARARIUM_REQUIRE_DATA(variable, name)                                  \
  const std::filesystem::path variable = ::lararium::test::DataDir() / (name); \
  if (!std::filesystem::exists(variable)) {                                    \
    GTEST_SKIP() << "needs " << variable << " (set LARARIUM_DATA_DIR)";        \
  }                                                                            \
  static_assert(true, "")

namespace lararium::test {

// The checkout, and the folder of LARARIUM_DATA_DIR. Functions, so that no other object of the
// tests depends on where the checkout is.
std::filesystem::path SourceDir();
std::filesystem::path DataDir();
// The cast library (scripts/fetch_cast_library.sh), or LARARIUM_CAST_LIBRARY if set.
std::filesystem::path CastLibraryDir();
// The photographs of a board (scripts/fetch_board_photographs.sh).
std::filesystem::path BoardPhotographsDir();

// A new folder, removed with its content at destruction.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace lararium::test
