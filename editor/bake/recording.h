#pragma once

// Recordings of lines, as microphones and field recorders leave them.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "editor/bake/speech_sound.h"
#include "shared/core/status.h"

namespace lararium::bake {

// Reads a recording as ReadSound() does. Averages its channels, or takes the loudest one if the
// mean is weak, because the others are silent or cancel it. What is louder than full scale, as
// recordings in floats may be, is turned down. Adds a note for people about what it changed.
Result<Sound> ReadRecording(const std::filesystem::path& file, std::vector<std::string>& notes);
Result<Sound> ReadRecording(std::span<const std::byte> bytes,
                            const std::string& where,
                            std::vector<std::string>& notes);

}  // namespace lararium::bake
