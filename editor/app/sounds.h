#pragma once

// The sounds of a project: its own files, and the built-in ones that none of them
// replaces.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
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

// A sound that something asks for and that is not there.
struct MissingSound {
  std::string name;
  std::string who;  // "object 'door'", "place 'bar'", "drama.lua:12": the first that asks
};

// Each once. Objects that were not baked are passed over; of a script sounds that it names
// outright, as in sound("bell").
std::vector<MissingSound> FindMissingSounds(const ProjectPaths& paths,
                                            const ProjectDocument& document,
                                            std::string_view script);

// Copies a recording into the project, as the sound of that name. Fails where it cannot be
// decoded, or the name cannot be one of a file.
Status BringInSound(const ProjectPaths& paths,
                    const std::string& name,
                    const std::filesystem::path& file);

// The file of a sound below a folder, with any extension that sounds have; empty: there is none.
std::filesystem::path SoundFileIn(const std::filesystem::path& folder, const std::string& name);

// With dots, lower case.
std::span<const char* const> SoundExtensions();

// One Status for each sound that an object or a place asks for and that is not there.
std::vector<Status> FindSilences(const ProjectPaths& paths, const ProjectDocument& document);

}  // namespace lararium::app
