#pragma once

// The sounds of a project: its own files, and those of the library that no file replaces.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "editor/document/missing_files.h"
#include "editor/document/project.h"
#include "shared/audio/sound_library.h"
#include "shared/core/status.h"

namespace lararium::editor {

struct SoundFile {
  std::string name;
  std::filesystem::path file;
  bool of_library = false;  // The file comes with the editor (scenes/library).
};

// Sorted by name. Of two files with the same name (bell.wav, bell.flac) the first.
std::vector<SoundFile> FindSounds(const ProjectPaths& paths);

// The encoded sounds for a show.
Result<std::vector<audio::SoundData>> LoadSounds(const ProjectPaths& paths);

// Each missing sound once. Objects that were not baked are skipped; in a script only literal names
// are found, as in sound("bell").
std::vector<MissingSound> FindMissingSounds(const ProjectPaths& paths,
                                            const ProjectDocument& document,
                                            std::string_view script);

// Copies a recording into the project as the sound of that name. Fails where it cannot be decoded,
// or where the name cannot be a file name.
Status BringInSound(const ProjectPaths& paths,
                    const std::string& name,
                    const std::filesystem::path& file);

// One Status for each sound that an object or a place uses but that does not exist, and for each
// file that no sound is played from: one in a container that is not played, or the second of two of
// one name.
std::vector<Status> FindSilences(const ProjectPaths& paths, const ProjectDocument& document);

}  // namespace lararium::editor
