#pragma once

// Reads, maps and safely replaces files.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"

namespace lararium {

// Whether there is a file or a folder. One that cannot be looked at counts as missing.
bool FileExists(const std::filesystem::path& path);

// Default size limit of ReadBytes and ReadText.
inline constexpr uint64_t kMaxFileBytes = uint64_t{1} << 30;

Result<std::vector<std::byte>> ReadBytes(const std::filesystem::path& path,
                                         uint64_t max_bytes = kMaxFileBytes);
// Reads `size` bytes from `offset` on.
Result<std::vector<std::byte>> ReadBytesAt(const std::filesystem::path& path,
                                           uint64_t offset,
                                           size_t size);
Result<std::string> ReadText(const std::filesystem::path& path, uint64_t max_bytes = kMaxFileBytes);

// Replaces the file completely or leaves it unchanged, even if the system crashes: writes a
// temporary file beside it, calls fsync, renames it and calls fsync on the folder.
Status WriteFileAtomically(const std::filesystem::path& path, std::span<const std::byte> content);
Status WriteFileAtomically(const std::filesystem::path& path, std::string_view content);

// A file mapped read-only into memory. Move-only; unmapped by the destructor.
class MappedFile {
 public:
  static Result<MappedFile> Open(const std::filesystem::path& path);

  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;
  ~MappedFile();

  std::span<const std::byte> bytes() const { return {data_, size_}; }

 private:
  MappedFile(const std::byte* data, size_t size) : data_(data), size_(size) {}

  const std::byte* data_ = nullptr;
  size_t size_ = 0;
};

}  // namespace lararium
