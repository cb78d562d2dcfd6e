#include "player/staff/staff_link.h"

#include <poll.h>

#include <chrono>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <string_view>
#include <utility>

#include "player/kiosk/power_sensors.h"
#include "shared/image/encode.h"
#include "shared/show/show_statistics.h"

namespace lararium::player {
namespace {

constexpr int kLookUpMs = 100;
constexpr int kLookUpInGroupMs = 20;
constexpr double kMachineSeconds = 5.0;
constexpr double kWantedSeconds = 5.0;  // pictures are sent for this time after a request
constexpr size_t kMostCommands = 16;    // limit of waiting commands
constexpr size_t kMostNote = 200;
constexpr int kJpegQuality = 75;

// Converts a received text to one line for the log.
std::string OneLine(std::string_view text) {
  std::string line(text.substr(0, kMostNote));
  for (char& c : line) {
    c = static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return line;
}

}  // namespace

StaffLink::StaffLink(const StaffLinks& links, Log& log, GroupPort group)
    : page_{"staff page", links.page},
      fleet_{"fleet", links.fleet},
      log_(log),
      group_(std::move(group)),
      warnings_(RecentWarnings::Of(log)),
      thread_([this](const std::stop_token& stop) { Run(stop); }) {}

double StaffLink::Now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void StaffLink::Run(const std::stop_token& stop) {
  while (!stop.stop_requested() && (page_.socket >= 0 || fleet_.socket >= 0)) {
    // Negative sockets are ignored.
    pollfd waiting[] = {{page_.socket, POLLIN, 0}, {fleet_.socket, POLLIN, 0}};
    if (::poll(waiting, std::size(waiting), group_.take_own ? kLookUpInGroupMs : kLookUpMs) > 0) {
      Receive(page_);
      Receive(fleet_);
    }
    if (const std::string own = group_.take_own ? group_.take_own() : ""; !own.empty()) {
      SendStaffMessage(fleet_.socket, StaffMessage::kGroup, own);
    }
    if (const std::optional<StaffState> state = state_.TryTake()) {
      SendState(*state);
    }
    if (const std::optional<VisitStatistics> statistics = statistics_.TryTake()) {
      SendStaffMessage(page_.socket, StaffMessage::kStatistics, statistics->ToCsv());
      SendStaffMessage(fleet_.socket, StaffMessage::kDays, PublishedStatistics(*statistics));
    }
    if (const std::optional<cv::Mat> picture = picture_.TryTake()) {
      SendPicture(*picture);
    }
  }
}

// Messages are checked here again, because other machines can reach the processes.
void StaffLink::Receive(End& end) {
  bool open = true;
  while (end.socket >= 0) {
    const auto message = ReceiveStaffMessage(end.socket, buffer_, open);
    if (!open) {
      log_.Warn("the process of the {} ended; the show goes on without it", end.name);
      end.socket = -1;
    }
    if (!message) {
      return;
    }
    if (message->kind == StaffMessage::kPictureWanted) {
      wanted_until_.store(Now() + kWantedSeconds, std::memory_order_relaxed);
    } else if (message->kind == StaffMessage::kNote) {
      log_.Warn("{}: {}", end.name, OneLine(message->content));
    } else if (message->kind == StaffMessage::kGroup && group_.take_news) {
      group_.take_news(message->content);
    } else if (message->kind == StaffMessage::kCommand) {
      if (Result<StaffCommand> command = ParseStaffCommand(message->content); command.ok()) {
        log_.Info("{}: {}", end.name, OneLine(message->content));
        AddCommand(*std::move(command));
      }
    }
  }
}

// Adds to the commands that wait. Only this thread puts into the mailbox, so commands that it takes
// out have not been handled yet.
void StaffLink::AddCommand(StaffCommand command) {
  Commands commands = commands_.TryTake().value_or(Commands());
  if (commands.size() < kMostCommands) {
    commands.push_back(std::move(command));
  }
  commands_.Put(std::move(commands));
}

void StaffLink::ReadMachine() {
  if (Now() - machine_read_ >= kMachineSeconds) {
    machine_read_ = Now();
    machine_.celsius = ReadPower().celsius;
    machine_.battery = ReadBattery();
    machine_.memory_mib = show::ResidentMebibytes();
  }
  machine_.warnings = warnings_->Entries();
}

void StaffLink::SendState(const StaffState& state) {
  ReadMachine();
  const std::string json = StaffJson(state, machine_);
  for (const End& end : {page_, fleet_}) {
    SendStaffMessage(end.socket, StaffMessage::kState, json);
  }
}

void StaffLink::SendPicture(const cv::Mat& rgba) {
  cv::Mat bgr;
  cv::cvtColor(rgba, bgr, cv::COLOR_RGBA2BGR);
  const auto jpeg = image::EncodeJpeg(bgr, kJpegQuality);
  if (!jpeg.ok()) {
    return;  // the page then shows that there is no picture
  }
  SendStaffMessage(page_.socket, StaffMessage::kPicture,
                   {reinterpret_cast<const char*>(jpeg->data()), jpeg->size()});
}

}  // namespace lararium::player
