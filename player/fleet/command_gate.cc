#include "player/fleet/command_gate.h"

#include "player/staff/staff_messages.h"

namespace lararium::player {

Status CommandGate::Check(std::string_view payload, bool kept, Clock::time_point now) {
  Status status = Judge(payload, kept, now);
  refused_ += status.ok() ? 0 : 1;
  return status;
}

Status CommandGate::Judge(std::string_view payload, bool kept, Clock::time_point now) {
  constexpr std::string_view kWhere = "command of the fleet";
  if (kept) {
    return Status::Error(kWhere, "the broker kept it from earlier", "publish without \"retain\"");
  }
  if (payload.size() > kMostStaffCommand) {
    return Status::Error(kWhere, "is longer than 1024 bytes");
  }
  LARARIUM_RETURN_IF_ERROR(ParseStaffCommand(payload).status().At(kWhere));
  if (now - second_began_ >= std::chrono::seconds(1)) {
    second_began_ = now;
    in_second_ = 0;
  }
  return ++in_second_ <= kMostInASecond ? Status()
                                        : Status::Error(kWhere, "there are too many in a second");
}

}  // namespace lararium::player
