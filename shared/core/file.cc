#include "shared/core/file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
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

// Follows symbolic links to the file that they finally name, which need not exist. The result has a
// folder.
Result<std::filesystem::path> WithoutLinks(const std::filesystem::path& file) {
  constexpr int kMostLinks = 40;  // The kernel follows as many.
  std::filesystem::path path = file;
  std::error_code error;
  for (int i = 0; std::filesystem::is_symlink(path, error); ++i) {
    if (i == kMostLinks) {
      return Status::Error(file.string(), "the symbolic links lead in a circle", "remove them");
    }
    const std::filesystem::path named = std::filesystem::read_symlink(path, error);
    if (error) {
      return Status::Error(file.string(), "the symbolic link cannot be read: " + error.message());
    }
    path = path.parent_path() / named;  // Keeps an absolute path as it is.
  }
  return path.has_parent_path() ? path : "." / path;
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

Result<FileReplacement> FileReplacement::Begin(const std::filesystem::path& file) {
  FileReplacement replacement;
  replacement.named_ = file;
  LARARIUM_ASSIGN_OR_RETURN(replacement.file_, WithoutLinks(file));
  const std::filesystem::path& path = replacement.file_;
  struct stat info {};
  replacement.replaces_ = ::stat(path.c_str(), &info) == 0;
  if (replacement.replaces_ && !S_ISREG(info.st_mode)) {
    return Status::Error(file.string(), "not a regular file", "name a file");
  }
  if (replacement.replaces_ && ::access(path.c_str(), W_OK) != 0) {
    return SystemError(file, "cannot be changed");
  }
  // A short part of the name, because the whole may leave no room for a suffix.
  constexpr size_t kNameBytes = 200;
  static std::atomic<unsigned> count = 0;
  const std::string base =
      path.filename().string().substr(0, kNameBytes) + "." + std::to_string(::getpid()) + "-";
  int descriptor = -1;
  do {
    replacement.unfinished_ = path.parent_path() / (base + std::to_string(count++) + ".part");
    descriptor =
        ::open(replacement.unfinished_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor < 0 && errno == EEXIST);
  const Descriptor created(descriptor);
  if (created.get() < 0) {
    const Status status = SystemError(file, "cannot be written");
    replacement.unfinished_.clear();
    return status;
  }
  if (!replacement.replaces_ && ::fstat(created.get(), &info) != 0) {
    return SystemError(file, "cannot be written");
  }
  replacement.mode_ = static_cast<uint32_t>(info.st_mode) & 0777;
  replacement.owner_ = info.st_uid;
  replacement.group_ = info.st_gid;
  return replacement;
}

FileReplacement::FileReplacement(FileReplacement&& other) noexcept { *this = std::move(other); }

FileReplacement& FileReplacement::operator=(FileReplacement&& other) noexcept {
  std::swap(named_, other.named_);
  std::swap(file_, other.file_);
  std::swap(unfinished_, other.unfinished_);
  std::swap(mode_, other.mode_);
  std::swap(replaces_, other.replaces_);
  std::swap(owner_, other.owner_);
  std::swap(group_, other.group_);
  return *this;
}

FileReplacement::~FileReplacement() {
  if (!unfinished_.empty()) {
    ::unlink(unfinished_.c_str());
  }
}

Status FileReplacement::Commit() {
  const Descriptor file(::open(unfinished_.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) {
    return SystemError(named_, "cannot write to disk");
  }
  // Disks that keep neither owners nor modes (exFAT, cameras, shares) refuse to change them, even
  // to what they are.
  struct stat now {};
  if (::fstat(file.get(), &now) != 0) {
    return SystemError(named_, "cannot write to disk");
  }
  const bool owned = !replaces_ || (now.st_uid == owner_ && now.st_gid == group_);
  // Who may not give the file away keeps at least its group, and otherwise owns it.
  if (!owned && ::fchown(file.get(), owner_, group_) != 0 &&
      ::fchown(file.get(), static_cast<uid_t>(-1), group_) != 0) {
    mode_ &= static_cast<uint32_t>(~0070) | (mode_ & 0007) << 3;  // Another group gains no rights.
  }
  const bool has_mode = (static_cast<uint32_t>(now.st_mode) & 0777) == mode_;
  if ((!has_mode && ::fchmod(file.get(), mode_) != 0) || ::fsync(file.get()) != 0) {
    return SystemError(named_, "cannot write to disk");
  }
  if (::rename(unfinished_.c_str(), file_.c_str()) != 0) {
    return SystemError(named_, "cannot replace");
  }
  unfinished_.clear();
  const Descriptor directory(
      ::open(file_.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory.get() >= 0) {
    ::fsync(directory.get());
  }
  return Status();
}

Status WriteFileAtomically(const std::filesystem::path& path, std::span<const std::byte> content) {
  LARARIUM_ASSIGN_OR_RETURN(FileReplacement replacement, FileReplacement::Begin(path));
  {
    const Descriptor file(::open(replacement.unfinished().c_str(), O_WRONLY | O_CLOEXEC));
    if (file.get() < 0) {
      return SystemError(path, "cannot write");
    }
    LARARIUM_RETURN_IF_ERROR(WriteAll(path, file.get(), content));
  }
  return replacement.Commit();
}

Status WriteFileAtomically(const std::filesystem::path& path, std::string_view content) {
  return WriteFileAtomically(path, std::as_bytes(std::span(content.data(), content.size())));
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
