#include "shared/light/camera_traits.h"

#include <array>

#include "shared/core/json.h"

namespace lararium::light {

void DescribeFields(Fields& fields, CameraTraits& traits) {
  fields.Integer("width", traits.width, 16, 65536);
  std::array<double, 2> noise = {traits.noise_floor, traits.noise_slope};
  fields.Numbers("noise", noise);
  fields.Require(
      noise[0] >= 0.0 && noise[0] <= kMaxNoise && noise[1] >= 0.0 && noise[1] <= kMaxNoise,
      "\"noise\" must hold two numbers between 0 and 0.25", "measure the camera again");
  if (fields.reading()) {
    traits.noise_floor = static_cast<float>(noise[0]);
    traits.noise_slope = static_cast<float>(noise[1]);
  }
  fields.Number("blur_px", traits.blur_px, 0.0, kMaxBlurPx);
  fields.Number("knee", traits.knee, 0.05, 1.0);
  fields.Number("shutter", traits.shutter, 0.0, 1.0);
  fields.Object("response", traits.response);
}

}  // namespace lararium::light
