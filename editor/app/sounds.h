#pragma once

// The sounds of a project: its own files, and the built-in ones that none of them
// replaces.

#include <filesystem>
#include <string>
#include <vector>

#include "editor/app/project.h"
#include "shared/audio/sound_library.h"
#include "shared/core/status.h"

namespace lararium::app {

struct SoundFile {
  std::string name;
  std::filesystem::path file;
  bool built_in = false;  // file is where it is baked
};

// In the order of their names. Of two files of one name (bell.wav, bell.flac) the first.
std::vector<SoundFile> FindSounds(const ProjectPaths& paths);

// Encoded, for a show; without the built-in ones that were not baked yet.
Result<std::vector<audio::SoundData>> LoadSounds(const ProjectPaths& paths);

// One Status for each sound that an object or a place asks for and that is not there.
// Objects that were not baked are passed over.
std::vector<Status> FindSilences(const ProjectPaths& paths, const ProjectDocument& document);

}  // namespace lararium::app
