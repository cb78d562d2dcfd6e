#pragma once

// The player's ends of the links to the processes that show its state and pass commands on.

#include <atomic>
#include <functional>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "player/kiosk/recent_warnings.h"
#include "player/kiosk/visit_statistics.h"
#include "player/staff/staff_messages.h"
#include "player/staff/staff_state.h"
#include "shared/core/log.h"
#include "shared/core/mailbox.h"

namespace lararium::player {

// Links to processes beside the player. The number is -1 where there is no such process.
struct StaffLinks {
  int page = -1;   // StaffPage::link()
  int fleet = -1;  // FleetLink::link()

  bool any() const { return page >= 0 || fleet >= 0; }
};

// What passes between the show and the process of a fleet whose device is in a group. The link's
// thread calls both.
struct GroupPort {
  std::function<std::string()> take_own;            // A message to the process; empty: none.
  std::function<void(std::string_view)> take_news;  // A message of the process.
};

// Sends state and pictures and receives commands without delaying frames: slow work (JSON, JPEG,
// sensors, the socket) is done on its own thread.
class StaffLink {
 public:
  static constexpr int kPictureWidth = 320;  // maximum

  // The processes of the links must outlive this object. The constructor starts to collect the
  // log's warnings, so no other thread may write to the log meanwhile. Borrows log.
  StaffLink(const StaffLinks& links, Log& log, GroupPort group = {});

  // Send a state, statistics or a picture. If several wait, only the newest is sent. The fleet gets
  // no pictures, and of the statistics what may be published.
  void Tell(StaffState state) { state_.Put(std::move(state)); }
  void TellStatistics(VisitStatistics statistics) { statistics_.Put(std::move(statistics)); }
  // rgba: result of render::AsyncReadback.
  void Show(cv::Mat rgba) { picture_.Put(std::move(rgba)); }

  // True if a browser currently shows the mirror. now: value of Now().
  bool PictureWanted(double now) const {
    return now < wanted_until_.load(std::memory_order_relaxed);
  }
  // Seconds of a steady clock.
  static double Now();

  // Returns the commands that arrived since the last call, oldest first.
  std::vector<StaffCommand> TakeCommands() { return commands_.TryTake().value_or(Commands()); }

 private:
  using Commands = std::vector<StaffCommand>;

  // A process that the player tells of its state.
  struct End {
    std::string_view name;  // Name in the log.
    int socket = -1;        // -1: there is no process, or it has ended.
  };

  void Run(const std::stop_token& stop);
  void Receive(End& end);
  void AddCommand(StaffCommand command);
  void SendState(const StaffState& state);
  void SendPicture(const cv::Mat& rgba);
  void ReadMachine();

  End page_;
  End fleet_;
  Log& log_;
  GroupPort group_;
  std::shared_ptr<RecentWarnings> warnings_;
  Mailbox<StaffState> state_;
  Mailbox<VisitStatistics> statistics_;
  Mailbox<cv::Mat> picture_;
  Mailbox<Commands> commands_;
  std::atomic<double> wanted_until_ = -1.0;
  // Used by the thread only.
  std::string buffer_;
  StaffMachine machine_;
  double machine_read_ = -1e9;
  std::jthread thread_;
};

}  // namespace lararium::player
