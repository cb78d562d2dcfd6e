#include "editor/panels/dialogs/dropped_file.h"

#include <algorithm>
#include <utility>

#include "editor/document/project_paths.h"
#include "editor/panels/widgets/file_kinds.h"
#include "shared/core/lower_case.h"
#include "shared/core/utf8.h"

namespace lararium::panels {

namespace fs = std::filesystem;

DroppedFile ClassifyDrop(std::span<const fs::path> paths) {
  using Kind = DroppedFile::Kind;
  if (paths.empty()) {
    return {};
  }
  const fs::path& first = paths.front();
  const bool images = std::all_of(paths.begin(), paths.end(), [&](const fs::path& path) {
    return path.parent_path() == first.parent_path() &&
           HasExtension(path, SpecOf(FileType::kImages).extensions);
  });
  std::error_code ignored;
  if (images && fs::is_regular_file(first, ignored) && IsUtf8(first.parent_path().string())) {
    return {Kind::kImages, first.parent_path()};
  }
  if (paths.size() > 1 || !IsUtf8(first.string())) {
    return {Kind::kOther, first};
  }
  if (first.filename() == "project.json" && editor::IsProject(first.parent_path())) {
    return {Kind::kProject, first.parent_path()};
  }
  if (LowerCase(first.extension().string()) == ".vrm" && Fits(first, FileType::kModel)) {
    return {Kind::kFigure, first};
  }
  constexpr std::pair<FileType, Kind> kTypes[] = {{FileType::kProject, Kind::kProject},
                                                  {FileType::kVideo, Kind::kVideo},
                                                  {FileType::kImages, Kind::kImages},
                                                  {FileType::kModel, Kind::kModel},
                                                  {FileType::kProbe, Kind::kProbe}};
  for (const auto& [type, kind] : kTypes) {
    if (Fits(first, type)) {
      return {kind, first};
    }
  }
  return {Kind::kOther, first};
}

}  // namespace lararium::panels
