#pragma once

// The icons of the interface: strokes on a grid of 16, drawn into the fonts (theme.cc), so that an
// icon is a letter: it has the size and the colour of the text that it stands in.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "shared/drama/timeline_lanes.h"

namespace lararium::panels {

enum class Icon {
  // what is done
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
  // the views
  kCameraView,
  kAroundView,
  kPicks,
  // what a project has
  kProject,
  kPlace,
  kStage,
  kNudge,
  kProbe,
  kOccluder,
  kPerson,
  kObject,
  kCheckPoint,
  // items of the timeline
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
  // states
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

// How much of each pixel an icon covers, 0 to 255; [side][side], rows from the top. side: pixels.
std::vector<uint8_t> DrawIcon(Icon icon, int side);

// The letter that an icon is: in Unicode's private use area, behind those of wrapped_text.h.
constexpr char32_t LetterOf(Icon icon) { return 0xe100 + static_cast<char32_t>(icon); }
// The same in UTF-8, alone and before a text.
std::string IconText(Icon icon);
std::string WithIcon(Icon icon, std::string_view text);

// Of an item of the timeline.
Icon IconOf(drama::LaneKind kind);

}  // namespace lararium::panels
