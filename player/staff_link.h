#pragma once

// The player's end of its staff page: what it tells and is told, without the frames ever waiting.

#include <atomic>
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "player/recent_warnings.h"
#include "player/staff_messages.h"
#include "player/staff_state.h"
#include "player/visit_statistics.h"
#include "shared/core/log.h"
#include "shared/core/mailbox.h"

namespace lararium::player {

// Whatever takes time (JSON, JPEG, sensors, the socket) is done on a thread of its own.
class StaffLink {
 public:
  static constexpr int kPictureWidth = 320;  // at most

  // link: of StaffPage, which must outlive this. Hears of the log's warnings from now on, and so
  // must be made while nobody else writes to it. Borrows log.
  StaffLink(int link, Log& log);

  // Of these the newest counts.
  void Tell(StaffState state) { state_.Put(std::move(state)); }
  void TellStatistics(VisitStatistics statistics) { statistics_.Put(std::move(statistics)); }
  // rgba: of render::PictureMirror.
  void Show(cv::Mat rgba) { picture_.Put(std::move(rgba)); }

  // Whether somebody looks at the mirror. now: as in Now().
  bool PictureWanted(double now) const {
    return now < wanted_until_.load(std::memory_order_relaxed);
  }
  // Seconds of a steady clock.
  static double Now();

  // What came since the last call, oldest first.
  std::vector<StaffCommand> TakeCommands() { return commands_.TryTake().value_or(Commands()); }

 private:
  using Commands = std::vector<StaffCommand>;

  void Run(const std::stop_token& stop);
  void Receive(bool& open);
  void AddCommand(StaffCommand command);
  void SendState(const StaffState& state);
  void SendPicture(const cv::Mat& rgba);
  void ReadMachine();

  int link_;
  Log& log_;
  std::shared_ptr<RecentWarnings> warnings_;
  Mailbox<StaffState> state_;
  Mailbox<VisitStatistics> statistics_;
  Mailbox<cv::Mat> picture_;
  Mailbox<Commands> commands_;
  std::atomic<double> wanted_until_ = -1.0;
  // The thread's own.
  std::string buffer_;
  StaffMachine machine_;
  double machine_read_ = -1e9;
  std::jthread thread_;
};

}  // namespace lararium::player
