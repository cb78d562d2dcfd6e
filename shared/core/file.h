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

// A file that is written beside the one that it replaces, which stays as it is until the new one is
// complete, even if the system crashes. If the path is a symbolic link, the file that it names is
// replaced and the link stays. The new file gets the mode of the old one and, as far as the system
// permits it, its owner and group; where there was no file, the umask decides. Move-only; the
// destructor removes a file that was not committed.
class FileReplacement {
 public:
  // Creates the unfinished file, empty.
  static Result<FileReplacement> Begin(const std::filesystem::path& file);

  FileReplacement(FileReplacement&& other) noexcept;
  FileReplacement& operator=(FileReplacement&& other) noexcept;
  ~FileReplacement();

  // The path to write to, by any means; it may be replaced.
  const std::filesystem::path& unfinished() const { return unfinished_; }

  // Flushes the unfinished file to disk and lets it take the place of the old one.
  Status Commit();

 private:
  FileReplacement() = default;

  std::filesystem::path named_;       // The path that the caller gave, for error messages.
  std::filesystem::path file_;        // The path without symbolic links.
  std::filesystem::path unfinished_;  // Empty after Commit().
  uint32_t mode_ = 0;
  bool replaces_ = false;  // True where the path named a file, whose owner and group follow.
  uint32_t owner_ = 0;
  uint32_t group_ = 0;
};

// Replaces the file completely or leaves it unchanged, see FileReplacement.
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
