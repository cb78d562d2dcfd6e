#pragma once

// The icons of the interface: characters of the font Material Design Icons, which theme.cc merges
// into the interface's fonts. An icon therefore has the colour of the surrounding text.

#include <string>
#include <string_view>

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

// The icon's character in the font.
char32_t LetterOf(Icon icon);
// The character in UTF-8, alone and in front of a text.
std::string IconText(Icon icon);
std::string WithIcon(Icon icon, std::string_view text);

// The icon of a timeline item.
Icon IconOf(drama::LaneKind kind);

}  // namespace lararium::panels
