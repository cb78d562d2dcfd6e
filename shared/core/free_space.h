#pragma once

// Tells whether a disk has room.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "shared/core/status.h"

namespace lararium {

// Returns the free bytes on the disk of a folder, which need not exist yet; nullopt if the file
// system does not tell.
using FreeSpace = std::function<std::optional<uint64_t>(const std::filesystem::path& folder)>;
std::optional<uint64_t> FreeSpaceOf(const std::filesystem::path& folder);

// Like RequireSpace() in shared/core/file.h, by the free space that is given.
Status RequireSpace(const std::filesystem::path& folder,
                    uint64_t bytes,
                    const FreeSpace& free_space);

}  // namespace lararium
