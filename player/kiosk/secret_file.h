#pragma once

// Files that hold a secret: a PIN, a password, a key.

#include <filesystem>
#include <string>

#include "shared/core/status.h"

namespace lararium::player {

// An error if users of the machine other than the file's owner and group can read or write it.
Status CheckSecretFile(const std::filesystem::path& path);

// The first line of such a text file, without spaces at its end. The bytes that were read are
// overwritten before they are freed.
Result<std::string> ReadSecretLine(const std::filesystem::path& path);

}  // namespace lararium::player
