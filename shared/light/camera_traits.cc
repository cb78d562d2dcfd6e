#include "shared/light/camera_traits.h"

#include <vector>

#include "shared/core/json.h"

namespace lararium::light {

Json FormatCameraTraits(const CameraTraits& traits) {
  Json json = {{"width", traits.width},
               {"noise", {traits.noise_floor, traits.noise_slope}},
               {"blur_px", traits.blur_px},
               {"knee", traits.knee}};
  if (traits.shutter) {
    json["shutter"] = *traits.shutter;
  }
  if (traits.response) {
    json["response"] = FormatCameraResponse(*traits.response);
  }
  return json;
}

Result<CameraTraits> ParseCameraTraits(const JsonView& view) {
  CameraTraits traits;
  LARARIUM_ASSIGN_OR_RETURN(const int64_t width, view.Integer("width", 16, 65536));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> noise, view.Numbers("noise", 2));
  for (const double value : noise) {
    if (!(value >= 0.0 && value <= kMaxNoise)) {
      return view.Problem("\"noise\" must hold two numbers between 0 and 0.25",
                          "measure the camera again");
    }
  }
  LARARIUM_ASSIGN_OR_RETURN(const double blur, view.Number("blur_px", 0.0, kMaxBlurPx));
  LARARIUM_ASSIGN_OR_RETURN(const double knee, view.Number("knee", 0.05, 1.0));
  traits.width = static_cast<int>(width);
  traits.noise_floor = static_cast<float>(noise[0]);
  traits.noise_slope = static_cast<float>(noise[1]);
  traits.blur_px = static_cast<float>(blur);
  traits.knee = static_cast<float>(knee);
  if (view.Has("shutter")) {
    LARARIUM_ASSIGN_OR_RETURN(const double shutter, view.Number("shutter", 0.0, 1.0));
    traits.shutter = static_cast<float>(shutter);
  }
  if (view.Has("response")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView response, view.Field("response"));
    LARARIUM_ASSIGN_OR_RETURN(traits.response, ParseCameraResponse(response));
  }
  return traits;
}

}  // namespace lararium::light
