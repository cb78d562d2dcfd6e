#pragma once

// Chooses how a headset's runtime shows the real world behind the layers of a program: it blends
// them with images of its cameras, or its glasses are transparent, or it has a layer of its own
// (XR_FB_passthrough). Private to the OpenXR headset.

#include <vector>

#include "player/openxr/openxr_calls.h"
#include "shared/core/log.h"

namespace lararium::player {

class OpenXrSeeThrough {
 public:
  OpenXrSeeThrough() = default;
  OpenXrSeeThrough(const OpenXrSeeThrough&) = delete;
  OpenXrSeeThrough& operator=(const OpenXrSeeThrough&) = delete;

  // The extensions that the instance needs, as far as the runtime has them.
  static std::vector<const char*> Extensions();

  // Chooses the best way that the system offers. Fails if there is none.
  Status Begin(XrInstance instance, XrSystemId system, XrSession session, Log& log);

  XrEnvironmentBlendMode blend_mode() const { return blend_mode_; }
  // A layer that must be submitted below all others; nullptr: none is needed.
  const XrCompositionLayerBaseHeader* layer() const;

 private:
  Status BeginPassthrough(XrInstance instance, XrSession session);

  XrEnvironmentBlendMode blend_mode_ = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
  XrCompositionLayerPassthroughFB layer_ = {};
};

}  // namespace lararium::player
