#pragma once

// The actions of visitors, and their keys and buttons.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "player/kiosk/kiosk_state.h"
#include "shared/core/json_fields.h"

namespace lararium::player {

enum class Action {
  kLouder,
  kQuieter,
  kLanguage,         // next spoken language
  kCaptions,         // next language of captions; after the last, none
  kCaptionSize,      // next size; after the largest, the normal one
  kCaptionContrast,  // the other contrast
  kDescriptions,     // switches audio descriptions on or off
  kReducedMotion,    // switches reduced motion on or off: elements fade instead of gliding
  kRestart,          // restarts the show from its beginning
  kFindAnew,         // relocalises without using the last pose
  kMenu              // opens or closes the menu
};

// Buttons of OpenXR controllers, for either hand.
inline constexpr char kHandSelect[] = "hand_select";
inline constexpr char kHandMenu[] = "hand_menu";

// The actions of keys (render::KeyName) and of buttons of game controllers (Window::TakePadButtons)
// and OpenXR controllers.
class Buttons {
 public:
  Buttons();  // the defaults in docs/player.md

  std::optional<Action> ActionOf(std::string_view button) const;
  // Replaces the buttons of an action.
  void Set(Action action, const std::vector<std::string>& buttons);

  friend bool operator==(const Buttons&, const Buttons&) = default;

 private:
  std::vector<std::pair<std::string, Action>> actions_;
};

// Describes an object with the buttons of each named action, for reading.
void DescribeButtons(Fields& fields, const FieldKey& key, Buttons& buttons);

// The choices that a show offers.
struct Offer {
  const std::vector<std::string>& spoken;    // languages of speech
  const std::vector<std::string>& captions;  // languages of captions
  bool descriptions = false;
};

// Applies an action to choices. Actions that are not choices (such as kRestart) change nothing.
void Choose(Action action, const Offer& offer, Choices& choices);

}  // namespace lararium::player
