#pragma once

// Conversion of light into image bytes by a camera.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "shared/core/json_fields.h"
#include "shared/core/status.h"

namespace lararium::light {

// For each byte of a channel (R, G, B), the exposure that gives this byte: radiance times time in a
// unit of the camera. The curve starts at 0 and never falls. It is the inverse response of Debevec
// & Malik, "Recovering High Dynamic Range Radiance Maps from Photographs", SIGGRAPH 1997. The unit
// is chosen so that byte kReference of each channel equals the linear value of sRGB.
struct CameraResponse {
  static constexpr int kReference = 128;
  using Curve = std::array<float, 256>;

  std::array<Curve, 3> linear = {};

  glm::vec3 Linear(uint8_t r, uint8_t g, uint8_t b) const {
    return {linear[0][r], linear[1][g], linear[2][b]};
  }
  // The linear sRGB value of the byte that the camera gives an exposure, interpolated between
  // bytes; 1 from the exposure of white on.
  glm::vec3 Seen(const glm::vec3& exposure) const;
  Status Validate(std::string_view where) const;

  friend bool operator==(const CameraResponse&, const CameraResponse&) = default;
};

// Table of Seen() for the GPU, at exposures x = u / (1 - u) with u from 0 to 1 in even steps; the
// last exposure is infinite.
inline constexpr size_t kSeenSteps = 256;
std::array<glm::vec3, kSeenSteps> SeenTable(const CameraResponse& response);

// The response of cameras that follow the standard (IEC 61966-2-1).
CameraResponse SrgbResponse();

// The sRGB response with compressed highlights: linear up to the knee, and 1 - exp(-(x - knee) / (1
// - knee)) above it, scaled to continue smoothly (render/render_scene.h).
CameraResponse ShoulderResponse(float knee);

// The knee whose response is closest to the given one for bytes from 32 to 250, by squared
// differences of logarithms; 1 means no knee. The residual is the root mean square of these
// differences.
struct FittedKnee {
  float knee = 1.0f;
  float residual = 0.0f;  // natural logarithm
};
FittedKnee FitKnee(const CameraResponse& response);

// JSON format in project.json, in a device file or in a file of its own: {"r": [256], "g", "b"}.
void DescribeFields(Fields& fields, CameraResponse& response);

// Returns the closest non-decreasing curve in least squares (pool adjacent violators: Barlow et al.
// 1972), starting at 0, in the unit above.
CameraResponse::Curve Monotone(const CameraResponse::Curve& curve);

}  // namespace lararium::light
