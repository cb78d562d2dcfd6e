#pragma once

// How a camera turns light into the bytes of its images.

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>

#include "shared/core/json.h"
#include "shared/core/status.h"

namespace lararium::light {

// For each byte of a channel the exposure (radiance times time, in a unit of the camera's
// own) that gives it, never falling, from 0 up; R, G, B. The inverse response of Debevec &
// Malik, "Recovering High Dynamic Range Radiance Maps from Photographs", SIGGRAPH 1997.
// The unit: value kReference of each channel stands for the linear value of sRGB.
struct CameraResponse {
  static constexpr int kReference = 128;
  using Curve = std::array<float, 256>;

  std::array<Curve, 3> linear = {};

  glm::vec3 Linear(uint8_t r, uint8_t g, uint8_t b) const {
    return {linear[0][r], linear[1][g], linear[2][b]};
  }
  // What a picture shows of an exposure: the linear value of sRGB of the byte that the camera
  // gives it, between bytes in between; 1 from where it gives white on.
  glm::vec3 Seen(const glm::vec3& exposure) const;
  Status Validate(std::string_view place) const;

  friend bool operator==(const CameraResponse&, const CameraResponse&) = default;
};

// Seen() for graphics cards: at exposures x = u / (1 - u), u from 0 to 1 in even steps; the last
// is infinitely bright.
inline constexpr size_t kSeenSteps = 256;
std::array<glm::vec3, kSeenSteps> SeenTable(const CameraResponse& response);

// What cameras that follow the standard do (IEC 61966-2-1).
CameraResponse SrgbResponse();

// The same with highlights compressed: linear up to knee, above as
// 1 - exp(-(x - knee) / (1 - knee)), scaled to meet it smoothly (render/render_scene.h).
CameraResponse ShoulderResponse(float knee);

// The knee whose response is closest to this one, over what it says of bytes from 32 to 250,
// as squared differences of logarithms; 1: none. The residual is their root mean square.
struct FittedKnee {
  float knee = 1.0f;
  float residual = 0.0f;  // of natural logarithms
};
FittedKnee FitKnee(const CameraResponse& response);

// Fields of project.json, a device file or a file of its own: {"r": [256], "g", "b"}.
Json FormatCameraResponse(const CameraResponse& response);
Result<CameraResponse> ParseCameraResponse(const JsonView& view);

// Makes a curve that rises, as near to it as can be in least squares (pool adjacent
// violators: Barlow et al. 1972), from 0, in the unit above.
CameraResponse::Curve Monotone(const CameraResponse::Curve& curve);

}  // namespace lararium::light
