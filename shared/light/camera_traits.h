#pragma once

// Properties of a camera's images beside its geometry, with which rendered people are matched to
// the images.

#include <optional>

#include "shared/core/json_fields.h"
#include "shared/light/camera_response.h"

namespace lararium::light {

struct CameraTraits {
  int width = 0;  // Width in pixels of the measured images; blur_px scales with it.
  // Noise of the encoded image, values 0..1: variance = floor^2 + slope * value.
  float noise_floor = 0.0f;
  float noise_slope = 0.0f;
  // Point spread of the lens as a Gaussian: standard deviation, pixels.
  float blur_px = 0.0f;
  // Value from which highlights are compressed (ShoulderResponse); 1: no compression.
  float knee = 0.6f;
  // Share of the frame interval for which the shutter is open. If not set, it is estimated while
  // tracking (vision::TrackedFrame::shutter).
  std::optional<float> shutter = std::nullopt;
  // The measured response, which has priority over the knee.
  std::optional<CameraResponse> response = std::nullopt;

  friend bool operator==(const CameraTraits&, const CameraTraits&) = default;
};

inline constexpr float kMaxNoise = 0.25f;   // limit of floor and slope
inline constexpr float kMaxBlurPx = 16.0f;  // A larger blur means a wrong focus.

// JSON format in project.json, in a bundle's manifest or in a device file: {"width", "noise":
// [floor, slope], "blur_px", "knee", "shutter", "response"}. The last two are optional.
void DescribeFields(Fields& fields, CameraTraits& traits);

}  // namespace lararium::light
