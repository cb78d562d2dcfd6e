#pragma once

// Location of the running program, beside which its data and companion programs are.

#include <filesystem>

namespace lararium {

// Returns the program's folder; empty if the system does not provide it.
std::filesystem::path ProgramFolder();

// Returns the path of data that comes with the programs in a folder. Installed programs and build
// trees have it as `shared` in the folder share beside that of the programs. Where it is not there,
// the path is `source` in the checkout that has the build tree.
std::filesystem::path ShippedData(const std::filesystem::path& shared,
                                  const std::filesystem::path& source,
                                  const std::filesystem::path& programs = ProgramFolder());

}  // namespace lararium
