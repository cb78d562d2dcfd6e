#pragma once

// The icons of the interface: strokes on a grid of 16, drawn into the fonts (theme.cc). An icon is
// a character, so it has the size and the colour of the surrounding text.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "shared/drama/timeline_lanes.h"

namespace lararium::panels {

enum class Icon {
  // Actions.
  kTrain,
  kAddSession,
  kBake,
  kExport,
  kMove,
  kTurn,
  kScale,
  kUndo,
  kRedo,
  kPlay,
  kPause,
  kAdd,
  kSnap,
  kRipple,
  kFit,
  // Views.
  kCameraView,
  kAroundView,
  kPicks,
  // Contents of a project.
  kProject,
  kPlace,
  kStage,
  kNudge,
  kProbe,
  kOccluder,
  kPerson,
  kObject,
  kCheckPoint,
  // Items of the timeline.
  kSpeech,
  kWalk,
  kUse,
  kGesture,
  kGaze,
  kExpression,
  kClip,
  kLight,
  kSound,
  kCaption,
  kDescription,
  kMarker,
  // States.
  kInfo,
  kWarning,
  kError,
  kGood,
  kNothingYet,
  kUnclear,
  kFound,
  kLost,
  kSearching,
};
inline constexpr int kIcons = static_cast<int>(Icon::kSearching) + 1;

// The coverage of each pixel by an icon, 0 to 255; [side][side], rows from the top. side: pixels.
std::vector<uint8_t> DrawIcon(Icon icon, int side);

// The character of an icon, in Unicode's private use area behind those of wrapped_text.h.
constexpr char32_t LetterOf(Icon icon) { return 0xe100 + static_cast<char32_t>(icon); }
// The character in UTF-8, alone and in front of a text.
std::string IconText(Icon icon);
std::string WithIcon(Icon icon, std::string_view text);

// The icon of a timeline item.
Icon IconOf(drama::LaneKind kind);

}  // namespace lararium::panels
