#pragma once

// What a kiosk remembers across restarts: where the show is, and how the visitor wants it.

#include <filesystem>
#include <string>
#include <string_view>

#include "shared/core/status.h"
#include "shared/render/caption_style.h"

namespace lararium::player {

// How a visitor wants a show.
struct Choices {
  std::string language;  // spoken; empty: as the author chose
  std::string captions;  // likewise
  double volume = 1.0;   // 0..1
  render::CaptionStyle caption_style = {};
  bool descriptions = false;    // of what is to be seen are heard
  bool reduced_motion = false;  // what glides elsewhere fades

  friend bool operator==(const Choices&, const Choices&) = default;
};

struct KioskState {
  std::string title;     // of the show that the time is of
  double seconds = 0.0;  // of the drama
  Choices choices;       // of who was there
  Choices house;         // of staff: how each visitor finds it

  friend bool operator==(const KioskState&, const KioskState&) = default;
};

// folder: of the player's alone. A folder without a state has the state of a new show.
Result<KioskState> LoadKioskState(const std::filesystem::path& folder);
// place: what errors call the text.
Result<KioskState> ParseKioskState(std::string_view text, const std::string& place);
// As a whole or not at all.
Status SaveKioskState(const std::filesystem::path& folder, const KioskState& state);

}  // namespace lararium::player
