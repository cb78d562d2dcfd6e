#pragma once

// Where tests find data and leave files.

#include <filesystem>
#include <string_view>

// In a test: the folder name below the data folder, or skips with a message.
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
// Where the cast library is (scripts/fetch_cast_library.sh), unless LARARIUM_CAST_LIBRARY says so.
std::filesystem::path CastLibraryDir();
// Where the photographs of a board are (scripts/fetch_board_photographs.sh).
std::filesystem::path BoardPhotographsDir();

// A fresh folder, removed with everything in it at the end of its life.
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
