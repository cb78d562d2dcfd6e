#include "player/updates/update_store.h"

#include <algorithm>
#include <charconv>
#include <functional>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "shared/core/file.h"

namespace lararium::player {
namespace {

namespace fs = std::filesystem;

constexpr int kMostFailedStarts = 3;

std::optional<uint64_t> SerialOf(const fs::path& file) {
  const std::string stem = file.stem().string();
  uint64_t serial = 0;
  const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), serial);
  return error == std::errc() && end == stem.data() + stem.size() ? std::optional(serial)
                                                                  : std::nullopt;
}

// The serials of the files with an ending, highest first.
std::vector<uint64_t> SerialsIn(const fs::path& folder, const char* ending) {
  std::vector<uint64_t> serials;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::optional<uint64_t> serial = SerialOf(entry.path());
    if (serial && entry.path().extension() == ending) {
      serials.push_back(*serial);
    }
  }
  std::sort(serials.begin(), serials.end(), std::greater());
  return serials;
}

}  // namespace

UpdateStore::UpdateStore(fs::path folder, fs::path shipped)
    : folder_(std::move(folder)), shipped_(std::move(shipped)) {}

fs::path UpdateStore::File(uint64_t serial, const char* ending) const {
  return folder_ / (std::to_string(serial) + ending);
}

UpdateStore::Show UpdateStore::Newest() const {
  const std::vector<uint64_t> whole = SerialsIn(folder_, ".larshow");
  return whole.empty() ? Show{0, shipped_} : Show{whole.front(), File(whole.front(), ".larshow")};
}

UpdateStore::Show UpdateStore::Choose(int failed_starts, Log& log) const {
  const Show newest = Newest();
  if (failed_starts < kMostFailedStarts || newest.serial == 0 ||
      FileExists(File(newest.serial, ".good"))) {
    return newest;
  }
  std::error_code error;
  fs::rename(newest.file, File(newest.serial, ".bad"), error);
  if (error) {
    log.Error("{}: cannot be put aside: {}", newest.file.string(), error.message());
    return newest;
  }
  fs::resize_file(File(newest.serial, ".bad"), 0, error);
  const Show former = Newest();
  log.Error("the show {} failed at its start {} times; the one before, {}, is put back",
            newest.serial, failed_starts, former.file.string());
  return former;
}

uint64_t UpdateStore::HighestSerial() const {
  uint64_t highest = 0;
  for (const char* ending : {".larshow", ".bad"}) {
    for (const uint64_t serial : SerialsIn(folder_, ending)) {
      highest = std::max(highest, serial);
    }
  }
  return highest;
}

Status UpdateStore::MarkGood(uint64_t serial) const {
  return serial == 0 ? Status() : WriteFileAtomically(File(serial, ".good"), std::string_view());
}

Status UpdateStore::Complete(uint64_t serial) const {
  std::error_code error;
  fs::rename(part(serial), File(serial, ".larshow"), error);
  if (error) {
    return Status::Error(folder_.string(), "cannot be written: " + error.message());
  }
  const std::vector<uint64_t> whole = SerialsIn(folder_, ".larshow");
  for (const char* ending : {".larshow", ".good", ".bad"}) {
    for (const uint64_t old : SerialsIn(folder_, ending)) {
      if (old != serial && (whole.size() < 2 || old < whole[1])) {
        fs::remove(File(old, ending), error);
      }
    }
  }
  return Status();
}

void UpdateStore::RemoveOtherParts(uint64_t serial) const {
  std::error_code ignored;
  for (const uint64_t other : SerialsIn(folder_, ".part")) {
    if (other != serial) {
      fs::remove(part(other), ignored);
    }
  }
}

}  // namespace lararium::player
