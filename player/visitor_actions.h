#pragma once

// What a visitor may choose, and with which keys and buttons.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "player/kiosk_state.h"
#include "shared/core/json.h"
#include "shared/core/status.h"

namespace lararium::player {

enum class Action {
  kLouder,
  kQuieter,
  kLanguage,         // the next that people speak
  kCaptions,         // the next language of the captions; after the last, none
  kCaptionSize,      // the next; after the largest, the normal one
  kCaptionContrast,  // the other
  kDescriptions,     // of what is to be seen are heard, or not
  kReducedMotion,    // what glides elsewhere fades, or not
  kRestart,          // the show from its beginning
  kFindAnew,         // the place, from scratch
  kMenu              // opens it, or closes it
};

// Buttons of the controllers of a headset that OpenXR drives, of either hand.
inline constexpr char kHandSelect[] = "hand_select";
inline constexpr char kHandMenu[] = "hand_menu";

// Keys of the keyboard and buttons of game controllers (render::KeyName, Window::TakePadButtons),
// and of a headset's.
class Buttons {
 public:
  Buttons();  // as docs/player.md has them

  std::optional<Action> ActionOf(std::string_view button) const;
  // In place of those that an action had.
  void Set(Action action, const std::vector<std::string>& buttons);

  friend bool operator==(const Buttons&, const Buttons&) = default;

 private:
  std::vector<std::pair<std::string, Action>> actions_;
};

// The field "buttons" of a device file: for each action that is named, its buttons.
Result<Buttons> ParseButtons(const JsonView& view);

// What a show has to choose from.
struct Offer {
  const std::vector<std::string>& spoken;    // languages
  const std::vector<std::string>& captions;  // likewise
  bool descriptions = false;
};

// Changes what an action is about; others leave everything as it is.
void Choose(Action action, const Offer& offer, Choices& choices);

}  // namespace lararium::player
