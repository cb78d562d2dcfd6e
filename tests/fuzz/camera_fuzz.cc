// libFuzzer harness: reading any text as a camera's response and as its traits terminates, and an
// accepted input is valid and survives being written.

#include <cmath>
#include <string_view>

#include "shared/core/check.h"
#include "shared/core/json.h"
#include "shared/light/camera_response.h"
#include "shared/light/camera_traits.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lararium;         // NOLINT: a program
  using namespace lararium::light;  // NOLINT
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const Result<Json> json = ParseJson(text, "fuzz.json");
  if (!json.ok()) {
    return 0;
  }
  const auto response =
      ParseFields<CameraResponse>(JsonView(*json, "fuzz.json"), UnknownFields::kIgnore);
  if (response.ok()) {
    CHECK(response->Validate("fuzz.json").ok());
    const FittedKnee knee = FitKnee(*response);
    CHECK(knee.knee > 0.0f && knee.knee <= 1.0f && std::isfinite(knee.residual));
    const Json again = FormatFields(*response);
    CHECK(ParseFields<CameraResponse>(JsonView(again, "fuzz.json")).ok());
  }
  const auto traits =
      ParseFields<CameraTraits>(JsonView(*json, "fuzz.json"), UnknownFields::kIgnore);
  if (traits.ok()) {
    CHECK(traits->width > 0 && std::isfinite(traits->blur_px));
    const Json again = FormatFields(*traits);
    CHECK(ParseFields<CameraTraits>(JsonView(again, "fuzz.json")).value() == *traits);
  }
  return 0;
}
