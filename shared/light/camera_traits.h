#pragma once

// What a camera's images are like beside where things lie in them, so that people can be made
// alike.

#include <optional>
#include <string_view>

#include "shared/core/json.h"
#include "shared/core/status.h"
#include "shared/light/camera_response.h"

namespace lararium::light {

struct CameraTraits {
  int width = 0;  // pixels, of the images that the rest was measured on; blur goes with it
  // Noise of the encoded image, values 0..1: variance = floor^2 + slope * value.
  float noise_floor = 0.0f;
  float noise_slope = 0.0f;
  // The point spread of the lens, a Gaussian: standard deviation, pixels.
  float blur_px = 0.0f;
  // Where highlights begin to be compressed: ShoulderResponse(); 1: nowhere.
  float knee = 0.6f;
  // Share of the time between frames for which the shutter is open. None: as it is learnt
  // while tracking (vision::TrackedFrame::shutter).
  std::optional<float> shutter = std::nullopt;
  // As it was measured; goes before the knee.
  std::optional<CameraResponse> response = std::nullopt;

  friend bool operator==(const CameraTraits&, const CameraTraits&) = default;
};

inline constexpr float kMaxNoise = 0.25f;   // floor and slope
inline constexpr float kMaxBlurPx = 16.0f;  // more is a wrong focus, not a lens

// A field of project.json, of a bundle's manifest or of a device file: {"width", "noise":
// [floor, slope], "blur_px", "knee", "shutter", "response"}; the last two may be missing.
Json FormatCameraTraits(const CameraTraits& traits);
Result<CameraTraits> ParseCameraTraits(const JsonView& view);

}  // namespace lararium::light
