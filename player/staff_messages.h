#pragma once

// What the player and the process of its staff page tell each other, over a pair of sockets that
// keep messages whole. Neither waits for the other: what does not fit is dropped.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "player/visitor_actions.h"
#include "shared/core/status.h"

namespace lararium::player {

enum class StaffMessage : char {
  // To the page.
  kState = 'S',       // JSON, staff_state.h
  kPicture = 'P',     // a JPEG
  kStatistics = 'C',  // VisitStatistics::ToCsv
  // To the player.
  kCommand = 'A',        // JSON, ParseStaffCommand
  kPictureWanted = 'W',  // empty
  kNote = 'N',           // a text for the log
};

// Of a message with its kind.
inline constexpr size_t kMostStaffMessage = 150'000;

// False: it was dropped, or nobody is there any more.
bool SendStaffMessage(int link, StaffMessage kind, std::string_view content);

// A message that has come. open: whether another may come. buffer: keeps content.
struct ReceivedStaffMessage {
  StaffMessage kind;
  std::string_view content;
};
std::optional<ReceivedStaffMessage> ReceiveStaffMessage(int link, std::string& buffer, bool& open);

// What staff tell the player to do: one of it.
struct StaffCommand {
  std::optional<Action> action;  // restart, find_anew, louder or quieter
  std::optional<double> volume;  // 0..1
  std::optional<std::string> language;
  std::optional<std::string> captions;
  std::optional<render::CaptionSize> caption_size;
  std::optional<render::CaptionContrast> caption_contrast;
  std::optional<bool> descriptions;
  std::optional<bool> reduced_motion;
  bool end = false;          // the player; a kiosk too
  bool begin_again = false;  // the player: a kiosk's watchdog begins it again

  friend bool operator==(const StaffCommand&, const StaffCommand&) = default;
};

// Changes what a command is about, as far as the show offers it. Its action is another matter.
void Choose(const StaffCommand& command, const Offer& offer, Choices& choices);

// {"do": "restart" | "find_anew" | "louder" | "quieter" | "end" | "begin_again"}, or
// {"do": "volume" | "language" | "captions" | "caption_size" | "caption_contrast" |
// "descriptions" | "reduced_motion", "value": ...}. It was written by anybody.
Result<StaffCommand> ParseStaffCommand(std::string_view text);

}  // namespace lararium::player
