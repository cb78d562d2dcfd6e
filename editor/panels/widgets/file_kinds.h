#pragma once

// The kinds of files that the editor asks for.

#include <filesystem>
#include <span>

#include "editor/desktop/file_portal.h"

namespace lararium::panels {

enum class FileType {
  kVideo,
  kImages,  // A folder.
  kMesh,    // A model of an object or an occluder.
  kModel,   // A model of anything, also of a person.
  kFigure,  // A model of a person, or a recipe.
  kProbe,
  kClip,
  kBones,
  kSound,
  kShow,  // A file to write.
  kKey,
  kProject,  // A folder.
  kFolder,
};

struct FileTypeSpec {
  const char* title;  // The title of the dialog; English.
  const char* label;  // The choice in the list of kinds; English.
  // With the dot, lower case. For a folder: what it holds.
  std::span<const char* const> extensions;
  editor::FileRequest::Kind kind = editor::FileRequest::Kind::kFile;

  bool folder() const { return kind == editor::FileRequest::Kind::kFolder; }
};

const FileTypeSpec& SpecOf(FileType type);

bool HasExtension(const std::filesystem::path& file, std::span<const char* const> extensions);

// Whether a file or a folder exists and is of the type. A kFolder is one of no other type.
bool Fits(const std::filesystem::path& file, FileType type);

// Whether the folder exists and has an image, not counting its own folders.
bool HoldsImages(const std::filesystem::path& folder);

}  // namespace lararium::panels
