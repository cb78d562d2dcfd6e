#include "editor/document/project_paths.h"

namespace lararium::editor {

namespace fs = std::filesystem;

std::filesystem::path ProjectPaths::Resolve(const std::string& path) const {
  return (folder / path).lexically_normal();
}

std::string ProjectPaths::Shorten(const std::filesystem::path& file) const {
  std::error_code ignored;
  const std::filesystem::path absolute =
      std::filesystem::absolute(file, ignored).lexically_normal();
  const std::filesystem::path base = std::filesystem::absolute(folder, ignored).lexically_normal();
  const std::filesystem::path relative = absolute.lexically_relative(base);
  const bool inside = !relative.empty() && *relative.begin() != "..";
  return (inside ? relative : absolute).generic_string();
}

bool IsProject(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_regular_file(ProjectPaths{folder}.Project(), ignored);
}

fs::path NormalFolder(const fs::path& folder) {
  std::error_code error;
  fs::path normal = fs::weakly_canonical(fs::absolute(folder, error), error);
  if (error) {
    normal = folder.lexically_normal();
  }
  return normal.has_filename() ? normal : normal.parent_path();
}

}  // namespace lararium::editor
