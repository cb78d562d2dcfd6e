#pragma once

#include <filesystem>
#include <string>

namespace lararium::app {

// Changes when the file does: its time alone stands still for a few milliseconds at a time, but
// whoever writes a file anew gives it another number. "none": it is not there.
std::string FileStamp(const std::filesystem::path& file);

}  // namespace lararium::app
