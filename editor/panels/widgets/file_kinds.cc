#include "editor/panels/widgets/file_kinds.h"

#include <algorithm>
#include <array>

#include "editor/document/missing_files.h"
#include "editor/document/project_paths.h"
#include "editor/panels/widgets/text.h"
#include "shared/capture/frame_source.h"
#include "shared/core/lower_case.h"

namespace lararium::panels {

namespace {

constexpr std::array<const char*, 5> kVideos = {".mp4", ".mov", ".mkv", ".avi", ".webm"};
constexpr std::array<const char*, 6> kMeshes = {".glb", ".gltf", ".fbx", ".dae", ".obj", ".ply"};
constexpr std::array<const char*, 8> kModels = {".glb", ".gltf", ".vrm", ".fbx",
                                                ".dae", ".obj",  ".ply", ".x"};
constexpr std::array<const char*, 7> kFigures = {".json", ".glb", ".gltf", ".vrm",
                                                 ".fbx",  ".dae", ".x"};
constexpr std::array kProbes = {".exr", ".hdr", ".pic"};
constexpr std::array<const char*, 6> kClips = {".bvh", ".fbx", ".dae", ".glb", ".gltf", ".vrm"};
constexpr std::array<const char*, 1> kBones = {".json"};
constexpr std::array<const char*, 1> kShows = {".larshow"};
constexpr std::array<const char*, 1> kKeys = {".key"};

using Kind = editor::FileRequest::Kind;

// In the order of FileType.
const std::array<FileTypeSpec, 13>& Specs() {
  static const std::array<FileTypeSpec, 13> specs = {{
      {TrLater("Choose a video"), TrLater("Videos"), kVideos},
      {TrLater("Choose a folder of images"), TrLater("Images"), capture::ImageExtensions(),
       Kind::kFolder},
      {TrLater("Choose a model"), TrLater("Models"), kMeshes},
      {TrLater("Choose a model"), TrLater("Models"), kModels},
      {TrLater("Choose a figure"), TrLater("Figures and recipes"), kFigures},
      {TrLater("Choose a light probe"), TrLater("Light probes"), kProbes},
      {TrLater("Choose a motion"), TrLater("Motions"), kClips},
      {TrLater("Choose a map of bones"), TrLater("Maps of bones"), kBones},
      {TrLater("Choose a sound"), TrLater("Sounds"), editor::SoundExtensions()},
      {TrLater("Write the show"), TrLater("Shows"), kShows, Kind::kSave},
      {TrLater("Choose a key"), TrLater("Secret keys"), kKeys},
      {TrLater("Choose a project"), TrLater("Projects"), {}, Kind::kFolder},
      {TrLater("Choose a folder"), TrLater("Folders"), {}, Kind::kFolder},
  }};
  return specs;
}

}  // namespace

const FileTypeSpec& SpecOf(FileType type) { return Specs()[static_cast<size_t>(type)]; }

bool HasExtension(const std::filesystem::path& file, std::span<const char* const> extensions) {
  const std::string extension = LowerCase(file.extension().string());
  return std::any_of(extensions.begin(), extensions.end(),
                     [&](const char* known) { return extension == known; });
}

bool Fits(const std::filesystem::path& file, FileType type) {
  const FileTypeSpec& spec = SpecOf(type);
  std::error_code ignored;
  if (type == FileType::kImages) {
    return HoldsImages(file);
  }
  if (spec.folder()) {
    return type == FileType::kProject ? editor::IsProject(file)
                                      : std::filesystem::is_directory(file, ignored) &&
                                            !editor::IsProject(file) && !HoldsImages(file);
  }
  return std::filesystem::is_regular_file(file, ignored) && HasExtension(file, spec.extensions);
}

bool HoldsImages(const std::filesystem::path& folder) {
  std::error_code error;
  for (auto at = std::filesystem::directory_iterator(folder, error);
       !error && at != std::filesystem::directory_iterator(); at.increment(error)) {
    if (HasExtension(at->path(), capture::ImageExtensions())) {
      return true;
    }
  }
  return false;
}

}  // namespace lararium::panels
