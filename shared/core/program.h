#pragma once

// Location of the running program, beside which its data and companion programs are.

#include <filesystem>

namespace lararium {

// Returns the program's folder; empty if the system does not provide it.
std::filesystem::path ProgramFolder();

}  // namespace lararium
