#include "player/updates/updater.h"

#include <curl/curl.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>
#include <span>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "player/kiosk/sandbox.h"
#include "shared/bundle/bundle.h"
#include "shared/bundle/bundle_parts.h"
#include "shared/bundle/publication.h"
#include "shared/core/file.h"
#include "shared/core/free_space.h"

namespace lararium::player {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kSpareBytes = 64'000'000;  // Stays free on the disk.
constexpr double kFirstRetrySeconds = 30.0;
constexpr double kLeastPauseSeconds = 1.0;  // Passes between two looks that were asked for.
constexpr int kLowestPriority = 19;

// The part of a show that has arrived. Only appends.
class PartFile {
 public:
  static Result<PartFile> Open(const fs::path& path) {
    PartFile part(path, ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0644));
    struct stat state = {};
    if (part.file_ < 0 || ::fstat(part.file_, &state) != 0) {
      return part.Failure();
    }
    part.size_ = static_cast<uint64_t>(state.st_size);
    return part;
  }
  PartFile(PartFile&& other) noexcept
      : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)), size_(other.size_) {}
  PartFile& operator=(PartFile&& other) = delete;
  ~PartFile() {
    if (file_ >= 0) {
      ::close(file_);
    }
  }

  uint64_t size() const { return size_; }

  // Appends `bytes`, which begin at an offset of the show, from the end of the file on.
  Status Write(uint64_t begin, std::span<const std::byte> bytes) {
    bytes = bytes.subspan(static_cast<size_t>(std::min<uint64_t>(size_ - begin, bytes.size())));
    while (!bytes.empty()) {
      const ssize_t written = ::write(file_, bytes.data(), bytes.size());
      if (written < 0) {
        return Failure();
      }
      size_ += static_cast<uint64_t>(written);
      bytes = bytes.subspan(static_cast<size_t>(written));
    }
    return Status();
  }
  // Fetches the bytes from the end of the file to an offset of the show.
  Status FetchUntil(uint64_t end, const std::string& name, HttpFolder& server) {
    if (size_ < end) {
      LARARIUM_RETURN_IF_ERROR(server.Append(name, size_, end, file_));
      size_ = end;
    }
    return Status();
  }
  Status Flush() { return ::fsync(file_) == 0 ? Status() : Failure(); }

 private:
  PartFile(fs::path path, int file) : path_(std::move(path)), file_(file) {}

  Status Failure() const {
    return Status::Error(path_.string(), std::string("cannot be written: ") + std::strerror(errno),
                         "make room on the disk");
  }

  fs::path path_;
  int file_;
  uint64_t size_ = 0;
};

// Puts the bundle of a publication together. former: the show at hand, or nullptr.
Status Assemble(const bundle::Publication& wanted,
                const bundle::Bundle* former,
                const fs::path& path,
                HttpFolder& server) {
  LARARIUM_ASSIGN_OR_RETURN(PartFile part, PartFile::Open(path));
  const uint64_t head_size = bundle::HeadSize(wanted.manifest_size);
  LARARIUM_RETURN_IF_ERROR(part.FetchUntil(head_size, wanted.file(), server));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<std::byte> head,
                            ReadBytesAt(path, 0, static_cast<size_t>(head_size)));
  LARARIUM_ASSIGN_OR_RETURN(const bundle::ShowManifest manifest,
                            bundle::ReadHead(head, wanted, wanted.file()));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<bundle::BundlePart> parts,
                            bundle::PartsOf(wanted, manifest, former));
  for (const bundle::BundlePart& next : parts) {
    if (part.size() >= next.end) {
      continue;
    }
    if (next.header.empty()) {
      LARARIUM_RETURN_IF_ERROR(part.FetchUntil(next.end, wanted.file(), server));
    } else {
      LARARIUM_RETURN_IF_ERROR(part.Write(next.begin, next.header));
      LARARIUM_RETURN_IF_ERROR(part.Write(next.begin + next.header.size(), next.content));
    }
  }
  return part.Flush();
}

// Waits for a time, or until the bell rings. Returns whether it rang.
bool Wait(double seconds, int bell) {
  pollfd waiting = {bell, POLLIN, 0};
  uint64_t rung = 0;
  return ::poll(&waiting, 1, static_cast<int>(std::min(1000.0 * seconds, 2e9))) > 0 &&
         ::read(bell, &rung, sizeof(rung)) > 0;
}

// Looks at the server until the program ends. After a failure it comes back sooner at first.
[[noreturn]] void Run(const UpdaterOptions& options, int bell, Log& log) {
  const UpdateStore store(options.folder, options.shipped);
  std::string fault;
  double retry = 0.0;
  while (true) {
    const Result<bool> fetched = FetchNewest(options, store);
    const std::string message = fetched.ok() ? "" : fetched.message();
    if (message != fault && !message.empty()) {
      log.Warn("update: {}", message);
    } else if (message != fault) {
      log.Info("update: the server can be used again");
    }
    fault = message;
    if (fetched.ok() && *fetched) {
      log.Info("update: {} is ready", store.Newest().file.string());
    }
    retry = fetched.ok() ? 0.0 : std::max(2.0 * retry, kFirstRetrySeconds);
    const double pause =
        fetched.ok() ? options.interval_seconds : std::min(retry, options.interval_seconds);
    if (Wait(pause, bell)) {
      log.Info("update: the staff asked to look now");
      std::this_thread::sleep_for(std::chrono::duration<double>(kLeastPauseSeconds));
    }
  }
}

}  // namespace

Result<bool> FetchNewest(const UpdaterOptions& options, const UpdateStore& store) {
  LARARIUM_ASSIGN_OR_RETURN(HttpFolder server, HttpFolder::Open(options.server));
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, server.Fetch(std::string(bundle::kNewestName),
                                                                 bundle::kMaxNewestBytes));
  const std::string where = options.server.url + ": " + std::string(bundle::kNewestName);
  LARARIUM_ASSIGN_OR_RETURN(const bundle::Publication wanted,
                            bundle::ParsePublication(text, options.trusted, where));
  const uint64_t highest = store.HighestSerial();
  if (wanted.serial < highest) {
    return Status::Error(where,
                         "offers show " + std::to_string(wanted.serial) + ", which is older than " +
                             std::to_string(highest) + " that was fetched before",
                         "publish the show that is wanted again");
  }
  if (wanted.serial == highest || bundle::IsBundleOf(wanted, store.Newest().file)) {
    return false;
  }
  std::error_code error;
  fs::create_directories(store.folder(), error);
  store.RemoveOtherParts(wanted.serial);
  LARARIUM_RETURN_IF_ERROR(RequireSpace(store.folder(), wanted.size + kSpareBytes));
  // Without a readable show at hand, all is fetched.
  const Result<bundle::Bundle> former = bundle::Bundle::Open(store.Newest().file);
  const fs::path part = store.part(wanted.serial);
  LARARIUM_RETURN_IF_ERROR(Assemble(wanted, former.ok() ? &*former : nullptr, part, server));
  if (const auto whole = bundle::Bundle::Open(part, {.trusted = options.trusted}); !whole.ok()) {
    fs::remove(part, error);
    return whole.status();
  }
  LARARIUM_RETURN_IF_ERROR(store.Complete(wanted.serial));
  return true;
}

Result<std::unique_ptr<Updater>> Updater::Start(const UpdaterOptions& options, Log& log) {
  const int bell = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  const pid_t process = bell < 0 ? -1 : ::fork();
  if (process < 0) {
    ::close(bell);
    return Status::Error("update",
                         std::string("no process can be started: ") + std::strerror(errno));
  }
  if (process > 0) {
    return std::unique_ptr<Updater>(new Updater(process, bell));
  }
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  ::prctl(PR_SET_NAME, "lararium-update");
  // This signal reaches the whole process group, and this process ends after the player.
  std::signal(SIGINT, SIG_IGN);
  if (::nice(kLowestPriority) < 0) {
    log.Info("update: the priority stays as it is");
  }
  curl_global_init(CURL_GLOBAL_DEFAULT);
  if (const Status entered = options.sandbox ? EnterUpdateSandbox() : Status(); !entered.ok()) {
    log.Warn("update: {}", entered.message());
  }
  Run(options, bell, log);
}

void Updater::LookNow() const {
  const uint64_t ring = 1;
  // A bell that has rung too often to count has rung.
  [[maybe_unused]] const ssize_t written = ::write(bell_, &ring, sizeof(ring));
}

Updater::~Updater() {
  ::kill(process_, SIGTERM);
  ::waitpid(process_, nullptr, 0);
  ::close(bell_);
}

}  // namespace lararium::player
