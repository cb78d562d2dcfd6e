#pragma once

// Where the running program lies, beside which its data and its companions are.

#include <filesystem>

namespace lararium {

// Its folder; empty where the system does not tell.
std::filesystem::path ProgramFolder();

}  // namespace lararium
