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

// Returns an error if a file system has less room than `bytes` for files in a folder, which need
// not exist yet. Call it before long work, whose result would be lost. The default is enough for
// what one job writes.
Status RequireSpace(const std::filesystem::path& folder,
                    uint64_t bytes = 64'000'000,
                    const FreeSpace& free_space = FreeSpaceOf);

}  // namespace lararium
