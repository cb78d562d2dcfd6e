#include "shared/core/free_space.h"

#include <cstdio>
#include <string>
#include <system_error>

namespace lararium {

std::optional<uint64_t> FreeSpaceOf(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::path existing = std::filesystem::absolute(folder, error);
  while (existing.has_relative_path() && !std::filesystem::exists(existing, error)) {
    existing = existing.parent_path();
  }
  const std::filesystem::space_info space = std::filesystem::space(existing, error);
  return error ? std::nullopt : std::optional<uint64_t>(space.available);
}

Status RequireSpace(const std::filesystem::path& folder,
                    uint64_t bytes,
                    const FreeSpace& free_space) {
  const std::optional<uint64_t> available = free_space(folder);
  if (!available || *available >= bytes) {
    return Status();  // A file system that does not tell is tried.
  }
  char room[64];
  std::snprintf(room, sizeof room, "%.0f MB are free and %.0f MB are needed",
                static_cast<double>(*available) * 1e-6, static_cast<double>(bytes) * 1e-6);
  return Status::Error(folder.string(), std::string("the disk is full: ") + room,
                       "make room, or choose a folder on another disk");
}

}  // namespace lararium
