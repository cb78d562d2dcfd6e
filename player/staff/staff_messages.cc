#include "player/staff/staff_messages.h"

#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <iterator>
#include <utility>

#include "shared/core/json.h"
#include "shared/show/show_content.h"

namespace lararium::player {
namespace {

constexpr size_t kMostLanguage = 64;

constexpr std::pair<std::string_view, Action> kActions[] = {{"restart", Action::kRestart},
                                                            {"find_anew", Action::kFindAnew},
                                                            {"louder", Action::kLouder},
                                                            {"quieter", Action::kQuieter}};

template <typename Choice, size_t n>
Result<Choice> ParseChoice(const JsonView& view, const std::array<std::string_view, n>& names) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string name, view.Text("value", kMostLanguage));
  const std::optional<Choice> choice = render::ChoiceOf<Choice>(names, name);
  if (!choice) {
    return view.Problem("there is no such value");
  }
  return *choice;
}

Result<bool> ParseSwitch(const JsonView& view) {
  LARARIUM_ASSIGN_OR_RETURN(const JsonView value, view.Field("value"));
  return value.Boolean();
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
  constexpr std::string_view kPlace = "command";
  LARARIUM_ASSIGN_OR_RETURN(const Json json, ParseJson(text, kPlace));
  const JsonView view(json, std::string(kPlace));
  LARARIUM_ASSIGN_OR_RETURN(const std::string what, view.Text("do", 32));
  StaffCommand command;
  const auto* found = std::find_if(std::begin(kActions), std::end(kActions),
                                   [&](const auto& entry) { return entry.first == what; });
  if (found != std::end(kActions)) {
    command.action = found->second;
  } else if (what == "volume") {
    LARARIUM_ASSIGN_OR_RETURN(command.volume, view.Number("value", 0.0, 1.0));
  } else if (what == "language") {
    LARARIUM_ASSIGN_OR_RETURN(command.language, view.Text("value", kMostLanguage));
  } else if (what == "captions") {
    LARARIUM_ASSIGN_OR_RETURN(command.captions, view.Text("value", kMostLanguage));
  } else if (what == "caption_size") {
    LARARIUM_ASSIGN_OR_RETURN(command.caption_size,
                              ParseChoice<render::CaptionSize>(view, render::kCaptionSizes));
  } else if (what == "caption_contrast") {
    LARARIUM_ASSIGN_OR_RETURN(command.caption_contrast, ParseChoice<render::CaptionContrast>(
                                                            view, render::kCaptionContrasts));
  } else if (what == "descriptions") {
    LARARIUM_ASSIGN_OR_RETURN(command.descriptions, ParseSwitch(view));
  } else if (what == "reduced_motion") {
    LARARIUM_ASSIGN_OR_RETURN(command.reduced_motion, ParseSwitch(view));
  } else if (what == "end") {
    command.end = true;
  } else if (what == "begin_again") {
    command.begin_again = true;
  } else {
    return view.Problem("there is no such thing to do");
  }
  return command;
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
