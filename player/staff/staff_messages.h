#pragma once

// Messages between the player and the processes beside it, that of its staff page and that of its
// fleet, over a pair of sockets that keep message boundaries. Neither side waits for the other:
// messages that do not fit are dropped.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "player/kiosk/visitor_actions.h"
#include "shared/core/status.h"

namespace lararium::player {

enum class StaffMessage : char {
  // Messages to the processes. Only the page gets pictures and the table
  // of days, and only the fleet the published days.
  kState = 'S',       // JSON, staff_state.h
  kPicture = 'P',     // a JPEG
  kStatistics = 'C',  // VisitStatistics::ToCsv
  kDays = 'D',        // PublishedStatistics()
  // Messages to the player.
  kCommand = 'A',        // JSON, ParseStaffCommand
  kPictureWanted = 'W',  // empty; only the page sends it
  kNote = 'N',           // a text for the log
  // A message between the player and its link to a group (shared/group/group_message.h).
  kGroup = 'G',
};

// Limits on the bytes of a message including its kind, and of a command from the network.
inline constexpr size_t kMostStaffMessage = 150'000;
inline constexpr size_t kMostStaffCommand = 1024;

// Returns false if the message was dropped, or if the other side has ended.
bool SendStaffMessage(int link, StaffMessage kind, std::string_view content);

// A received message; content points into `buffer`. ReceiveStaffMessage returns nullopt if there is
// none; open: false: the other side has ended.
struct ReceivedStaffMessage {
  StaffMessage kind;
  std::string_view content;
};
std::optional<ReceivedStaffMessage> ReceiveStaffMessage(int link, std::string& buffer, bool& open);

// A command of the staff to the player. Only one member is set.
struct StaffCommand {
  std::optional<Action> action;  // restart, find_anew, louder or quieter
  std::optional<double> volume;  // 0..1
  std::optional<std::string> language;
  std::optional<std::string> captions;
  std::optional<render::CaptionSize> caption_size;
  std::optional<render::CaptionContrast> caption_contrast;
  std::optional<bool> descriptions;
  std::optional<bool> reduced_motion;
  bool end = false;          // ends the player, also a kiosk
  bool begin_again = false;  // ends the player; a kiosk's watchdog starts it again
  bool update = false;       // looks for a newer show at once
  // Commands for the drama. In a group they are for that of all its devices.
  std::optional<bool> hold;  // true holds the drama, false lets it go on
  std::string go_to;         // name of a marker; empty: stay

  friend bool operator==(const StaffCommand&, const StaffCommand&) = default;
};

// Applies a command to choices, if the show offers the value. Ignores StaffCommand::action.
void Choose(const StaffCommand& command, const Offer& offer, Choices& choices);

// {"do": "restart" | "find_anew" | "louder" | "quieter" | "end" | "begin_again" |
// "update" | "hold" | "resume"}, or
// {"do": "volume" | "language" | "captions" | "caption_size" | "caption_contrast" |
// "descriptions" | "reduced_motion", "value": ...}, or {"do": "go_to", "value": MARKER}. The text
// may come from an attacker.
Result<StaffCommand> ParseStaffCommand(std::string_view text);

}  // namespace lararium::player
