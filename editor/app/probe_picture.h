#pragma once

// A probe's image as people look at it: unrolled on the stage, on a mirror ball, on a grey one.

#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/light/camera_response.h"
#include "shared/light/probe_light.h"

namespace lararium::app {

// Small enough to be drawn anew while it is dragged.
struct ProbePicture {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> radiance;  // equirectangular, the probe's axes, units of the file
  light::ProbeLight light;          // likewise
  // The brightest place, a sun or not.
  glm::vec3 brightest = glm::vec3(0.0f, 1.0f, 0.0f);
  bool is_sun = false;
  std::vector<std::string> warnings;
};

// Fails as baking does (bake::ReadProbeImage).
Result<ProbePicture> LoadProbePicture(const std::filesystem::path& file);

// How it is looked at.
struct ProbeLook {
  glm::quat stage_from_probe = glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
  glm::vec3 exposure = glm::vec3(1.0f);  // display linear for each unit of the file
  float knee = 0.6f;                     // where highlights are compressed from
  std::optional<light::CameraResponse> response = std::nullopt;  // in place of the knee
};

// All directions of the stage, as a probe's image has them (bake/probe.h): bgr, twice as wide
// as high.
cv::Mat DrawPanorama(const ProbePicture& picture, const ProbeLook& look, int width);

enum class BallSurface { kMirror, kGrey };
// A ball as big as the square picture that somebody far away sees: bgr. camera_from_stage:
// axes x right, y down, z forward, z towards the ball. albedo: of the grey one.
cv::Mat DrawBall(const ProbePicture& picture,
                 const ProbeLook& look,
                 const glm::quat& camera_from_stage,
                 BallSurface surface,
                 float albedo,
                 int size);

// What the mirror shows at a point of its picture, -1..1, x right, y down: the stage's
// direction; outside of the ball that of its rim.
glm::vec3 MirroredDirection(const glm::quat& camera_from_stage, float x, float y);

// The exposure that shows a panorama's median as a middle grey.
float ExposureFor(const ProbePicture& picture);

}  // namespace lararium::app
