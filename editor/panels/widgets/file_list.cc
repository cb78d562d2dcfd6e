#include "editor/panels/widgets/file_list.h"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "editor/document/project_paths.h"
#include "editor/panels/widgets/file_kinds.h"
#include "editor/panels/widgets/text.h"
#include "shared/core/lower_case.h"
#include "shared/core/utf8.h"

namespace lararium::panels {

namespace fs = std::filesystem;

std::vector<FileEntry> ListFolder(const fs::path& folder,
                                  std::span<const char* const> extensions,
                                  std::string& problem) {
  std::vector<FileEntry> entries;
  std::error_code error;
  for (auto at = fs::directory_iterator(folder, error); !error && at != fs::directory_iterator();
       at.increment(error)) {
    FileEntry entry;
    entry.name = at->path().filename().string();
    struct stat found = {};
    if (entry.name.starts_with('.') || !IsUtf8(entry.name) ||
        stat(at->path().c_str(), &found) != 0) {
      continue;
    }
    entry.folder = S_ISDIR(found.st_mode);
    if (!entry.folder && (!S_ISREG(found.st_mode) ||
                          (!extensions.empty() && !HasExtension(entry.name, extensions)))) {
      continue;
    }
    entry.project = entry.folder && editor::IsProject(at->path());
    entry.bytes = entry.folder ? 0 : static_cast<uint64_t>(found.st_size);
    entry.changed = found.st_mtime;
    entries.push_back(std::move(entry));
  }
  problem = error ? error.message() : "";
  return entries;
}

void SortEntries(FileColumn column, bool descending, std::vector<FileEntry>& entries) {
  const auto by_name = [](const FileEntry& a, const FileEntry& b) {
    const int order = strverscmp(LowerCase(a.name).c_str(), LowerCase(b.name).c_str());
    return order != 0 ? order : a.name.compare(b.name);
  };
  const auto order = [](const auto& a, const auto& b) { return a < b ? -1 : b < a ? 1 : 0; };
  std::sort(entries.begin(), entries.end(), [&](const FileEntry& a, const FileEntry& b) {
    if (a.folder != b.folder) {
      return a.folder;
    }
    int before = column == FileColumn::kSize      ? order(a.bytes, b.bytes)
                 : column == FileColumn::kChanged ? order(a.changed, b.changed)
                                                  : by_name(a, b);
    before = descending ? -before : before;
    return before != 0 ? before < 0 : by_name(a, b) < 0;
  });
}

std::string SizeText(uint64_t bytes) {
  constexpr std::array<const char*, 5> kUnits = {"B", "kB", "MB", "GB", "TB"};
  auto value = static_cast<double>(bytes);
  size_t unit = 0;
  while (value >= 999.5 && unit + 1 < kUnits.size()) {
    value /= 1000.0;
    ++unit;
  }
  return Text(unit > 0 && value < 9.95 ? "%.1f %s" : "%.0f %s", value, kUnits[unit]);
}

std::optional<size_t> TypeAhead::Type(const std::string& character,
                                      double seconds,
                                      std::span<const FileEntry> entries,
                                      std::optional<size_t> chosen) {
  constexpr double kPause = 1.0;  // Seconds after which a new name begins.
  const std::string added = LowerCase(character);
  const bool begins = seconds > last_ + kPause;
  const bool again = !begins && typed_ == added;
  last_ = seconds;
  typed_ = begins || again ? added : typed_ + added;
  // A new first character, or the same one again, looks for the next entry.
  const size_t from = !chosen ? 0 : typed_ == added ? *chosen + 1 : *chosen;
  for (size_t i = 0; i < entries.size(); ++i) {
    const size_t at = (from + i) % entries.size();
    if (LowerCase(entries[at].name).starts_with(typed_)) {
      return at;
    }
  }
  return std::nullopt;
}

}  // namespace lararium::panels
