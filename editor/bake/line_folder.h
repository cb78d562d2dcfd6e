#pragma once

// The files that people put beside the lines of a project: recordings (audio/LANG/LINE.wav) and
// captions with manual timing (audio/LANG/LINE.CAPTIONS.srt). The case of names does not
// matter.

#include <filesystem>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "editor/bake/line_table.h"
#include "shared/core/status.h"

namespace lararium::bake {

// A file that belongs to no line.
struct StrayFile {
  std::filesystem::path file;
  std::string line;  // The line without a recording whose id its name resembles; may be empty.
};

class LineFolder {
 public:
  // Lists a folder, which may be missing. `lines` are all lines of the project.
  LineFolder(const std::filesystem::path& folder, std::span<const Line> lines);

  // The recording of a line; empty if there is none. Two are an error.
  Result<std::filesystem::path> Recording(const std::string& line) const;
  // The captions of a line in a language; empty if there are none. Two are an error.
  Result<std::filesystem::path> Captions(const std::string& line,
                                         const std::string& language) const;
  // Recordings and captions that belong to no line.
  std::vector<StrayFile> Strays() const;

 private:
  struct File {
    std::filesystem::path path;
    std::string stem;       // Name without extension.
    std::string extension;  // Lower case.
  };
  using Extensions = std::span<const std::string_view>;

  std::vector<const File*> Find(const std::string& stem, Extensions extensions) const;
  Result<std::filesystem::path> OnlyOne(const std::string& stem, Extensions extensions) const;

  // The key of a stem gives the file; names with equal keys mean one line.
  std::multimap<std::string, File> files_;
  std::set<std::string> ids_;  // The ids of all lines.
};

}  // namespace lararium::bake
