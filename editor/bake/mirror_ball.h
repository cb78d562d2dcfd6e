#pragma once

// Makes light probes from photographs of a mirror ball (Debevec, "Rendering Synthetic Objects
// into Real Scenes", SIGGRAPH 1998).

#include <glm/vec3.hpp>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "editor/bake/probe.h"
#include "shared/core/status.h"

namespace lararium::bake {

// Outline of the ball in raw pixels; integer coordinates are pixel centres.
struct BallCircle {
  double x = 0.0;
  double y = 0.0;
  double radius = 0.0;
  // RMS distance of the edges used in the fit; 0 if the circle was entered.
  double residual_px = 0.0;
};

// Finds the most circular strong edge of a picture (CV_8UC3 or CV_8UC1) with the Hough
// transform and fits a circle to the edges along its radii by least squares without outliers.
// Gives nullopt if most of the outline supports no circle of at least a twentieth of the
// picture.
std::optional<BallCircle> FindBall(const cv::Mat& picture);

struct BallView {
  BallCircle circle;
  // Distance from the camera to the centre of the ball, in radii of the ball. 0 means so far
  // that rays are parallel; otherwise it exceeds 1 and the ball is near the middle of the
  // picture.
  double distance = 0.0;
  glm::vec3 reflectance = glm::vec3(1.0f);  // Polished steel has about 0.6.
};

// Unwraps the reflection in the ball to an equirectangular image of width x width / 2. In the
// axes of the probe the camera looks along -Z with +X to its right and +Y up, so that the
// camera itself appears at the left and right border. The part behind the ball, about the
// centre, takes the radiance of the outline next to it. `linear` is CV_32FC3 in R, G, B. Fails
// if the circle is not inside the picture or a number is impossible.
Result<ProbeImage> UnwrapBall(const cv::Mat& linear, const BallView& view, int width);

// Maps directions about a ball to pixels of its photograph.
class BallProjection {
 public:
  explicit BallProjection(const BallView& view);

  // The pixel that reflects a direction (unit, probe axes); for directions beyond the usable
  // part of the ball, the nearest point of that part.
  cv::Point2d Pixel(const glm::dvec3& direction) const;

 private:
  BallView view_;
  // The largest angle between the axis towards the camera and a normal that is used.
  double largest_;
};

}  // namespace lararium::bake
