#include "editor/import/objects/object_library.h"

#include <algorithm>
#include <system_error>

#include "shared/core/file.h"
#include "shared/core/program.h"

namespace lararium::import {

namespace fs = std::filesystem;

fs::path ObjectLibrary() {
  return ShippedData("lararium/library/objects", "scenes/library/objects");
}

std::vector<std::string> LibraryObjectNames(const fs::path& library) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(library, ignored)) {
    std::string name = entry.path().filename().string();
    if (entry.is_directory(ignored) && !name.starts_with('.')) {
      names.push_back(std::move(name));
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

Result<fs::path> FindLibraryObject(std::string_view name, const fs::path& library) {
  const std::vector<std::string> names = LibraryObjectNames(library);
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    std::string known;
    for (const std::string& other : names) {
      known += (known.empty() ? "name one of " : ", ") + other;
    }
    return Status::Error("object model \"" + std::string(name) + "\"",
                         "is not in the library " + library.string(),
                         known.empty() ? "install the editor again" : known);
  }
  const fs::path stem = library / name / name;
  for (const char* ending : {".glb", ".gltf", ".fbx", ".dae", ".obj", ".ply", ".object.json"}) {
    if (fs::path file = stem.string() + ending; FileExists(file)) {
      return file;
    }
  }
  return Status::Error(stem.parent_path().string(),
                       "has no model " + stem.filename().string() + ".glb",
                       "put the model there, or install the editor again");
}

}  // namespace lararium::import
