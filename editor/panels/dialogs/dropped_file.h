#pragma once

// What a file or a folder is that was dropped on the window.

#include <filesystem>
#include <span>

namespace lararium::panels {

struct DroppedFile {
  enum class Kind {
    kProject,
    kVideo,
    kImages,  // A folder.
    kModel,   // The model of an object, an occluder or a person.
    kFigure,  // The model of a person (VRM).
    kProbe,
    kOther,
  };
  Kind kind = Kind::kOther;
  std::filesystem::path file;
};

// Several files are one thing only where they are images of one folder: that folder. A project.json
// stands for its project.
DroppedFile ClassifyDrop(std::span<const std::filesystem::path> paths);

}  // namespace lararium::panels
