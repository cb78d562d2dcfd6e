#pragma once

// Pictures of a light probe: as a panorama of the stage, on a mirror ball, on a grey ball.

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

namespace lararium::editor {

// A reduced copy that is fast enough to draw again during a drag.
struct ProbePicture {
  int width = 0;
  int height = 0;
  // Equirectangular, in the probe's axes and the units of the file.
  std::vector<glm::vec3> radiance;
  light::ProbeLight light;  // Axes of the probe, units of the file.
  // The direction of the brightest point, whether it is a sun or not.
  glm::vec3 brightest = glm::vec3(0.0f, 1.0f, 0.0f);
  bool is_sun = false;
  std::vector<std::string> warnings;
};

// Fails in the same cases as baking (bake::ReadProbeImage).
Result<ProbePicture> LoadProbePicture(const std::filesystem::path& file);

// How a probe is shown.
struct ProbeLook {
  glm::quat stage_from_probe = glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
  glm::vec3 exposure = glm::vec3(1.0f);  // Display-linear value for one unit of the file.
  float knee = 0.6f;                     // The value above which highlights are compressed.
  std::optional<light::CameraResponse> response = std::nullopt;  // Replaces the knee.
};

// All directions of the stage, in the layout of a probe's image (bake/probe.h): bgr, twice as wide
// as high.
cv::Mat DrawPanorama(const ProbePicture& picture, const ProbeLook& look, int width);

enum class BallSurface { kMirror, kGrey };
// A square picture filled by a ball that a distant viewer sees: bgr. camera_from_stage: camera axes
// x right, y down, z forward, with z towards the ball. albedo: of the grey ball.
cv::Mat DrawBall(const ProbePicture& picture,
                 const ProbeLook& look,
                 const glm::quat& camera_from_stage,
                 BallSurface surface,
                 float albedo,
                 int size);

// The stage direction that the mirror ball shows at a point of its picture. x right and y down,
// both -1..1. Points outside the ball give the direction at its rim.
glm::vec3 MirroredDirection(const glm::quat& camera_from_stage, float x, float y);

// The exposure that shows the median of a panorama as middle grey.
float ExposureFor(const ProbePicture& picture);

}  // namespace lararium::editor
