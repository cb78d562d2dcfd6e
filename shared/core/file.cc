#include "shared/core/file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace lararium {
namespace {

Status SystemError(const std::filesystem::path& path, std::string_view what) {
  return Status::Error(path.string(), std::string(what) + ": " + std::strerror(errno));
}

// An open file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (value_ >= 0) {
      ::close(value_);
    }
  }
  int get() const { return value_; }

 private:
  int value_;
};

// Without O_NONBLOCK, opening a pipe would block until a writer opens it.
constexpr int kReadFlags = O_RDONLY | O_CLOEXEC | O_NONBLOCK;

// The size of an open regular file.
Result<uint64_t> RegularFileSize(const std::filesystem::path& path, int descriptor) {
  struct stat info {};
  if (::fstat(descriptor, &info) != 0) {
    return SystemError(path, "cannot read its size");
  }
  if (!S_ISREG(info.st_mode)) {
    return Status::Error(path.string(), "not a regular file", "name a file");
  }
  return static_cast<uint64_t>(info.st_size);
}

// Fills `content` with the bytes from `offset` on.
Status ReadFrom(const std::filesystem::path& path,
                const Descriptor& file,
                uint64_t offset,
                auto& content) {
  for (size_t done = 0; done < content.size();) {
    const ssize_t count = ::pread(file.get(), content.data() + done, content.size() - done,
                                  static_cast<off_t>(offset + done));
    if (count < 0 && errno == EINTR) {
      continue;
    }
    if (count <= 0) {
      return count == 0 ? Status::Error(path.string(), "became shorter while it was read")
                        : SystemError(path, "cannot read");
    }
    done += static_cast<size_t>(count);
  }
  return Status();
}

Status ReadInto(const std::filesystem::path& path, uint64_t max_bytes, auto& content) {
  const Descriptor file(::open(path.c_str(), kReadFlags));
  if (file.get() < 0) {
    return SystemError(path, "cannot open");
  }
  LARARIUM_ASSIGN_OR_RETURN(const uint64_t size, RegularFileSize(path, file.get()));
  if (size > max_bytes) {
    return Status::Error(path.string(), "larger than the " + std::to_string(max_bytes) +
                                            " bytes that are allowed here");
  }
  content.resize(size);
  return ReadFrom(path, file, 0, content);
}

Status WriteAll(const std::filesystem::path& path,
                int descriptor,
                std::span<const std::byte> content) {
  while (!content.empty()) {
    const ssize_t count = ::write(descriptor, content.data(), content.size());
    if (count < 0 && errno == EINTR) {
      continue;
    }
    if (count < 0) {
      return SystemError(path, "cannot write");
    }
    content = content.subspan(static_cast<size_t>(count));
  }
  return Status();
}

}  // namespace

bool FileExists(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

Result<std::vector<std::byte>> ReadBytes(const std::filesystem::path& path, uint64_t max_bytes) {
  std::vector<std::byte> content;
  LARARIUM_RETURN_IF_ERROR(ReadInto(path, max_bytes, content));
  return content;
}

Result<std::vector<std::byte>> ReadBytesAt(const std::filesystem::path& path,
                                           uint64_t offset,
                                           size_t size) {
  const Descriptor file(::open(path.c_str(), kReadFlags));
  if (file.get() < 0) {
    return SystemError(path, "cannot open");
  }
  LARARIUM_ASSIGN_OR_RETURN(const uint64_t all, RegularFileSize(path, file.get()));
  if (offset > all || size > all - offset) {
    return Status::Error(path.string(), "is shorter than it was");
  }
  std::vector<std::byte> content(size);
  LARARIUM_RETURN_IF_ERROR(ReadFrom(path, file, offset, content));
  return content;
}

Result<std::string> ReadText(const std::filesystem::path& path, uint64_t max_bytes) {
  std::string content;
  LARARIUM_RETURN_IF_ERROR(ReadInto(path, max_bytes, content));
  return content;
}

Status WriteFileAtomically(const std::filesystem::path& path, std::span<const std::byte> content) {
  std::string temporary = path.string() + ".XXXXXX";
  const Descriptor file(::mkostemp(temporary.data(), O_CLOEXEC));
  if (file.get() < 0) {
    return SystemError(path, "cannot create a file beside it");
  }
  Status status = WriteAll(path, file.get(), content);
  if (status.ok() && (::fchmod(file.get(), 0644) != 0 || ::fsync(file.get()) != 0)) {
    status = SystemError(path, "cannot write to disk");
  }
  if (status.ok() && ::rename(temporary.c_str(), path.c_str()) != 0) {
    status = SystemError(path, "cannot replace");
  }
  if (!status.ok()) {
    ::unlink(temporary.c_str());
    return status;
  }
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  const Descriptor directory(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory.get() >= 0) {
    ::fsync(directory.get());
  }
  return Status();
}

Status WriteFileAtomically(const std::filesystem::path& path, std::string_view content) {
  return WriteFileAtomically(path, std::as_bytes(std::span(content)));
}

Result<MappedFile> MappedFile::Open(const std::filesystem::path& path) {
  const Descriptor file(::open(path.c_str(), kReadFlags));
  if (file.get() < 0) {
    return SystemError(path, "cannot open");
  }
  LARARIUM_ASSIGN_OR_RETURN(const uint64_t size, RegularFileSize(path, file.get()));
  if (size == 0) {
    return Status::Error(path.string(), "the file is empty", "copy or export it again");
  }
  void* data = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.get(), 0);
  if (data == MAP_FAILED) {
    return SystemError(path, "cannot map");
  }
  return MappedFile(static_cast<const std::byte*>(data), size);
}

MappedFile::MappedFile(MappedFile&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  return *this;
}

MappedFile::~MappedFile() {
  if (data_ != nullptr) {
    ::munmap(const_cast<std::byte*>(data_), size_);
  }
}

}  // namespace lararium
