#pragma once

// The folders for files that belong to the user rather than to a project (XDG base directories).
// They need not exist.

#include <filesystem>
#include <string_view>

#include "shared/core/status.h"

namespace lararium::editor {

std::filesystem::path StateFolder();   // State that is kept between starts.
std::filesystem::path ConfigFolder();  // The user's settings.
std::filesystem::path CacheFolder();   // Files that can be generated again.
std::filesystem::path DataFolder();    // The user's own data.

// Moves an unreadable file to FILE.damaged, so that a new one can be written. Returns an error that
// tells why and where it went. remedy: what the user can do without the file.
Status SetAside(const std::filesystem::path& file, const Status& why, std::string_view remedy);

// The user's home; "/" where the system does not define it.
std::filesystem::path HomeFolder();

}  // namespace lararium::editor
