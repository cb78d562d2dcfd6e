#include "player/staff/staff_messages.h"

#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <utility>

#include "shared/core/json_fields.h"
#include "shared/show/show_content.h"

namespace lararium::player {
namespace {

constexpr size_t kMostLanguage = 64;
constexpr size_t kMostMarker = 512;

constexpr std::pair<std::string_view, Action> kActions[] = {{"restart", Action::kRestart},
                                                            {"find_anew", Action::kFindAnew},
                                                            {"louder", Action::kLouder},
                                                            {"quieter", Action::kQuieter}};

// Describes a command, for reading.
void DescribeCommand(Fields& fields, StaffCommand& command) {
  constexpr std::string_view kNoValue = "there is no such value";
  std::string what;
  fields.Text("do", what, 32);
  const auto* found = std::find_if(std::begin(kActions), std::end(kActions),
                                   [&](const auto& entry) { return entry.first == what; });
  if (found != std::end(kActions)) {
    command.action = found->second;
  } else if (what == "volume") {
    fields.Number("value", command.volume.emplace(), 0.0, 1.0);
  } else if (what == "language") {
    fields.Text("value", command.language.emplace(), kMostLanguage);
  } else if (what == "captions") {
    fields.Text("value", command.captions.emplace(), kMostLanguage);
  } else if (what == "caption_size") {
    fields.Choice("value", command.caption_size.emplace(), render::kCaptionSizes, kNoValue);
  } else if (what == "caption_contrast") {
    fields.Choice("value", command.caption_contrast.emplace(), render::kCaptionContrasts, kNoValue);
  } else if (what == "descriptions") {
    fields.Flag("value", command.descriptions.emplace());
  } else if (what == "reduced_motion") {
    fields.Flag("value", command.reduced_motion.emplace());
  } else if (what == "end") {
    command.end = true;
  } else if (what == "begin_again") {
    command.begin_again = true;
  } else if (what == "update") {
    command.update = true;
  } else if (what == "hold" || what == "resume") {
    command.hold = what == "hold";
  } else if (what == "go_to") {
    fields.Text("value", command.go_to, kMostMarker);
    fields.Require(!command.go_to.empty(), "\"value\" must name a marker");
  } else {
    fields.Require(false, "there is no such thing to do");
  }
}

}  // namespace

bool SendStaffMessage(int link, StaffMessage kind, std::string_view content) {
  if (content.size() >= kMostStaffMessage) {
    return false;
  }
  std::string message(1, static_cast<char>(kind));
  message += content;
  return ::send(link, message.data(), message.size(), MSG_DONTWAIT | MSG_NOSIGNAL) ==
         static_cast<ssize_t>(message.size());
}

std::optional<ReceivedStaffMessage> ReceiveStaffMessage(int link, std::string& buffer, bool& open) {
  buffer.resize(kMostStaffMessage);
  const ssize_t size = ::recv(link, buffer.data(), buffer.size(), MSG_DONTWAIT);
  open = size > 0 || (size < 0 && (errno == EAGAIN || errno == EINTR));
  if (size <= 0) {
    return std::nullopt;
  }
  return ReceivedStaffMessage{static_cast<StaffMessage>(buffer[0]),
                              std::string_view(buffer).substr(1, static_cast<size_t>(size) - 1)};
}

Result<StaffCommand> ParseStaffCommand(std::string_view text) {
  return ParseFields<StaffCommand>(text, "command", DescribeCommand, UnknownFields::kIgnore);
}

void Choose(const StaffCommand& command, const Offer& offer, Choices& choices) {
  const auto has = [](const std::vector<std::string>& languages, const std::string& language) {
    return std::find(languages.begin(), languages.end(), language) != languages.end();
  };
  choices.volume = command.volume.value_or(choices.volume);
  if (command.language && has(offer.spoken, *command.language)) {
    choices.language = *command.language;
  }
  if (command.captions &&
      (has(offer.captions, *command.captions) || *command.captions == show::kNoCaptions)) {
    choices.captions = *command.captions;
  }
  render::CaptionStyle& style = choices.caption_style;
  style.size = command.caption_size.value_or(style.size);
  style.contrast = command.caption_contrast.value_or(style.contrast);
  choices.descriptions = command.descriptions.value_or(choices.descriptions);
  choices.reduced_motion = command.reduced_motion.value_or(choices.reduced_motion);
}

}  // namespace lararium::player
