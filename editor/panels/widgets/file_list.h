#pragma once

// What the list of a folder shows, apart from drawing it.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lararium::panels {

struct FileEntry {
  std::string name;
  bool folder = false;
  bool project = false;  // A folder with a project.
  uint64_t bytes = 0;    // Files only.
  int64_t changed = 0;   // Seconds since 1970.
};

// The entries whose names do not begin with a dot and are UTF-8, because a project cannot store
// others. extensions: of the files that are listed; empty: all files. Fails where the folder cannot
// be read: the problem is then set.
std::vector<FileEntry> ListFolder(const std::filesystem::path& folder,
                                  std::span<const char* const> extensions,
                                  std::string& problem);

enum class FileColumn { kName, kSize, kChanged };

// Folders first. Names are compared without case and numbers in them by value; what is equal is in
// the order of the names.
void SortEntries(FileColumn column, bool descending, std::vector<FileEntry>& entries);

// "812 B", "1.4 MB".
std::string SizeText(uint64_t bytes);

// Typing ahead: characters that follow each other soon are the beginning of a name.
class TypeAhead {
 public:
  // Adds a character in UTF-8; seconds: the time of a clock. Returns the entry that is meant: the
  // first one from `chosen` on, around the end, whose name begins with what was typed, without
  // case. One character typed again and again goes on to the next such entry.
  std::optional<size_t> Type(const std::string& character,
                             double seconds,
                             std::span<const FileEntry> entries,
                             std::optional<size_t> chosen);

 private:
  std::string typed_;
  double last_ = -1e9;
};

}  // namespace lararium::panels
