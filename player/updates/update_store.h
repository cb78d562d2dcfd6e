#pragma once

// The shows that a kiosk has fetched. Each is a file of a folder, and these files alone say what is
// played, so that nothing can disagree after a failure:
//
//   SERIAL.larshow  a whole, verified show
//   SERIAL.part     the beginning of a show that is being fetched
//   SERIAL.good     the show has played for a while
//   SERIAL.bad      the show failed at its start and was removed

#include <cstdint>
#include <filesystem>

#include "shared/core/log.h"
#include "shared/core/status.h"

namespace lararium::player {

class UpdateStore {
 public:
  // shipped: the show that the player was started with, of serial 0.
  UpdateStore(std::filesystem::path folder, std::filesystem::path shipped);

  struct Show {
    uint64_t serial = 0;
    std::filesystem::path file;
  };
  // The newest whole show.
  Show Newest() const;
  // The show to start. failed_starts: consecutive starts that have failed. If there were three, the
  // newest show is removed unless it has played before, and the one before is put back.
  Show Choose(int failed_starts, Log& log) const;
  // The highest serial of a show that was fetched, whether it is still there or not.
  uint64_t HighestSerial() const;
  // Marks a show as one that has played for a while. Its starts may fail for other reasons now.
  Status MarkGood(uint64_t serial) const;

  std::filesystem::path part(uint64_t serial) const { return File(serial, ".part"); }
  // Makes the part of a serial a whole show. Removes all shows but this one and the one before.
  Status Complete(uint64_t serial) const;
  // Removes parts of other serials.
  void RemoveOtherParts(uint64_t serial) const;
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path File(uint64_t serial, const char* ending) const;

  std::filesystem::path folder_;
  std::filesystem::path shipped_;
};

}  // namespace lararium::player
