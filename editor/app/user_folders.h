#pragma once

// Where the editor keeps what belongs to whoever uses it and to no project (XDG base
// directories). None of the folders needs to be there.

#include <filesystem>
#include <string_view>

#include "shared/core/status.h"

namespace lararium::app {

std::filesystem::path StateFolder();   // what is remembered from one start to the next
std::filesystem::path ConfigFolder();  // what people chose
std::filesystem::path CacheFolder();   // what can be made again
std::filesystem::path DataFolder();    // what people work on

// Moves a file that cannot be read to FILE.damaged, so that a good one can be written, and
// says so beside why. remedy: what to do without it.
Status SetAside(const std::filesystem::path& file, const Status& why, std::string_view remedy);

// Of the person; "/" where the system names none.
std::filesystem::path HomeFolder();

}  // namespace lararium::app
