#pragma once

// What a kiosk remembers across restarts: the position of the show and the visitor's choices.

#include <filesystem>
#include <string>
#include <string_view>

#include "shared/core/status.h"
#include "shared/render/text/caption_style.h"

namespace lararium::player {

// The choices of a visitor.
struct Choices {
  std::string language;  // spoken language; empty: the author's choice
  std::string captions;  // language of captions; empty: the author's choice
  double volume = 1.0;   // 0..1
  render::CaptionStyle caption_style = {};
  bool descriptions = false;    // audio descriptions are heard
  bool reduced_motion = false;  // elements fade instead of gliding
  std::string read = {};        // language of captions before they were turned off

  friend bool operator==(const Choices&, const Choices&) = default;
};

struct KioskState {
  std::string title;     // title of the show that `seconds` belongs to
  double seconds = 0.0;  // drama time
  Choices choices;       // choices of the last visitor
  Choices house;         // defaults for each new visitor, set by the staff

  friend bool operator==(const KioskState&, const KioskState&) = default;
};

// folder: used by the player only. If it contains no state, the state of a new show is returned.
Result<KioskState> LoadKioskState(const std::filesystem::path& folder);
// where: name of the text in errors.
Result<KioskState> ParseKioskState(std::string_view text, const std::string& where);
// Writes atomically: after a failure the old file is still complete.
Status SaveKioskState(const std::filesystem::path& folder, const KioskState& state);

}  // namespace lararium::player
