#pragma once

// Where the editor keeps what belongs to whoever uses it and to no project (XDG base
// directories). None of the folders needs to be there.

#include <filesystem>

namespace lararium::app {

std::filesystem::path StateFolder();   // what is remembered from one start to the next
std::filesystem::path ConfigFolder();  // what people chose
std::filesystem::path CacheFolder();   // what can be made again
std::filesystem::path DataFolder();    // what people work on

// Of the person; "/" where the system names none.
std::filesystem::path HomeFolder();

}  // namespace lararium::app
