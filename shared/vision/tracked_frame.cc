#include "shared/vision/tracked_frame.h"

namespace lararium::vision {

std::string_view Name(TrackState state) {
  switch (state) {
    case TrackState::kSearching:
      return "searching";
    case TrackState::kTracking:
      return "tracking";
    case TrackState::kLost:
      return "lost";
  }
  return "unknown";
}

std::string_view Name(TrackReason reason) {
  switch (reason) {
    case TrackReason::kNone:
      return "none";
    case TrackReason::kTooDark:
      return "too dark";
    case TrackReason::kTooFewFeatures:
      return "too few features";
    case TrackReason::kTooFewMatches:
      return "too few matches";
    case TrackReason::kNoConsistentPose:
      return "no consistent pose";
    case TrackReason::kAmbiguous:
      return "ambiguous";
  }
  return "unknown";
}

}  // namespace lararium::vision
