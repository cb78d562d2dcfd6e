#pragma once

// How a headset's runtime shows what is real behind a program's own layers: it blends them with
// what its cameras see, or with what is seen through its glass, or has a layer of its own for that
// (XR_FB_passthrough). Private to the OpenXR headset.

#include <vector>

#include "player/openxr_calls.h"
#include "shared/core/log.h"

namespace lararium::player {

class OpenXrSeeThrough {
 public:
  OpenXrSeeThrough() = default;
  OpenXrSeeThrough(const OpenXrSeeThrough&) = delete;
  OpenXrSeeThrough& operator=(const OpenXrSeeThrough&) = delete;

  // What an instance needs for it, of what the runtime has.
  static std::vector<const char*> Extensions();

  // Chooses the best way that the system offers. Fails where there is none.
  Status Begin(XrInstance instance, XrSystemId system, XrSession session, Log& log);

  XrEnvironmentBlendMode blend_mode() const { return blend_mode_; }
  // To be shown below all others; nullptr: there is none.
  const XrCompositionLayerBaseHeader* layer() const;

 private:
  Status BeginPassthrough(XrInstance instance, XrSession session);

  XrEnvironmentBlendMode blend_mode_ = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
  XrCompositionLayerPassthroughFB layer_ = {};
};

}  // namespace lararium::player
