#include "shared/group/group_relay.h"

#include <algorithm>
#include <optional>

namespace lararium::group {
namespace {

constexpr int64_t kPlayerAnswers = 500'000;  // The player says what it has within this time.
constexpr int64_t kClockAgain = 1'000'000;
constexpr size_t kMostToldMarkers = 64;

}  // namespace

Status GroupRelay::TakeMessage(const std::string& from, std::string_view bytes, int64_t now) {
  LARARIUM_ASSIGN_OR_RETURN(const GroupMessage message, ParseGroupMessage(bytes));
  if (std::holds_alternative<GroupOwn>(message) ||
      std::holds_alternative<GroupClockNews>(message)) {
    return Status::Error("message of the group", "is one between a player and its link");
  }
  member_.Receive(from, message, now);
  return Status();
}

void GroupRelay::TakeOwn(std::string_view bytes, int64_t now) {
  const Result<GroupMessage> message = ParseGroupMessage(bytes);
  const GroupOwn* own = message.ok() ? std::get_if<GroupOwn>(&*message) : nullptr;
  if (own != nullptr) {
    player_said_ = own->places;
    member_.SetOwn(*own, now);
  }
}

// The clock follows the log that belongs to it.
std::vector<std::string> GroupRelay::TakeForPlayer(int64_t now) {
  std::vector<std::string> messages;
  const std::optional<GroupClockNews> clock = member_.ClockNews();
  if (!clock) {
    return messages;
  }
  const GroupLog& log = member_.log();
  const GroupPlace said = player_said_.empty() ? GroupPlace{0, 1} : player_said_.front();
  if (!(said == player_has_) && now - told_ > kPlayerAnswers) {
    player_has_ = said;  // A message was lost, or another player began.
  }
  std::string clock_bytes = FormatGroupMessage(*clock);
  const bool has_log = player_has_ == log.place();
  if (has_log && clock_bytes == told_clock_ && now - told_ < kClockAgain) {
    return messages;
  }
  if (!has_log) {
    size_t from = log.Has(player_has_) ? player_has_.count : log.CommonWith(player_said_);
    do {
      const GroupLogPart part = {0, clock->run, log.PlaceAt(from), log.Part(from)};
      from += part.part.entries.size();
      messages.push_back(FormatGroupMessage(part));
    } while (from < log.size());
    player_has_ = log.place();
  }
  told_ = now;
  told_clock_ = clock_bytes;
  messages.push_back(std::move(clock_bytes));
  return messages;
}

Json GroupRelay::State() const {
  Json markers = Json::array();
  for (const GroupOwn::Marker& marker : member_.markers()) {
    if (markers.size() < kMostToldMarkers) {
      markers.push_back(marker.name);
    }
  }
  return {{"markers", markers},           {"leader", member_.leader()},
          {"leads", member_.leads()},     {"in_step", member_.ready()},
          {"members", member_.members()}, {"held", member_.schedule().held()}};
}

}  // namespace lararium::group
