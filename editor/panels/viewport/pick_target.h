#pragma once

// Where a click in a training image goes.

namespace lararium::panels {

struct PickTarget {
  int anchor = 0;    // Index into AnchorEntries(): the anchor that the next click sets.
  int keyframe = 0;  // Index of the keyframe that is shown.
};

}  // namespace lararium::panels
