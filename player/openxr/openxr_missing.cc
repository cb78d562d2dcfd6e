// Replaces openxr_headset.cc if the player is built without OpenXR.

#include "player/openxr/openxr_headset.h"

namespace lararium::player {

Result<std::unique_ptr<OpenXrHeadset>> OpenXrHeadset::Open(const Headset& /*headset*/,
                                                           const std::string& /*title*/,
                                                           Log& /*log*/) {
  return Status::Error("OpenXR", "this player was built without OpenXR",
                       "install libopenxr-dev and build the player again");
}

}  // namespace lararium::player
