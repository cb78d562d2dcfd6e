#include "editor/document/project_lock.h"

#include <fcntl.h>
#include <pwd.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string>
#include <utility>

#include "shared/core/file.h"

namespace lararium::editor {
namespace {

// The user and the machine, as other people know them.
std::string Holder() {
  std::array<char, 256> host = {};
  if (::gethostname(host.data(), host.size() - 1) != 0) {
    host = {'?'};
  }
  const passwd* user = ::getpwuid(::geteuid());
  return std::string(user != nullptr ? user->pw_name : "?") + " on " + host.data() + ", process " +
         std::to_string(::getpid());
}

}  // namespace

Result<ProjectLock> ProjectLock::Take(const ProjectPaths& paths) {
  ProjectLock lock;
  lock.file_ = paths.folder / ".open";
  lock.descriptor_ = ::open(lock.file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (lock.descriptor_ < 0) {
    lock.read_only_ = errno == EROFS || errno == EACCES || errno == EPERM;
    return lock;
  }
  if (::flock(lock.descriptor_, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK) {
      return lock;
    }
    Result<std::string> holder = ReadText(lock.file_, 1024);
    lock.file_.clear();  // The file belongs to the other window.
    return Status::Error(
        paths.folder.string(),
        "is open in another window" + (holder.ok() && !holder->empty() ? " (" + *holder + ")" : ""),
        "close it there, or work on a copy");
  }
  const std::string holder = Holder();
  if (::ftruncate(lock.descriptor_, 0) != 0 ||
      ::pwrite(lock.descriptor_, holder.data(), holder.size(), 0) < 0) {
    return lock;  // The name is only for people; the lock holds without it.
  }
  return lock;
}

ProjectLock::ProjectLock(ProjectLock&& other) noexcept { *this = std::move(other); }

ProjectLock& ProjectLock::operator=(ProjectLock&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(read_only_, other.read_only_);
  return *this;
}

ProjectLock::~ProjectLock() {
  if (descriptor_ >= 0) {
    if (!file_.empty()) {
      ::unlink(file_.c_str());
    }
    ::close(descriptor_);
  }
}

}  // namespace lararium::editor
