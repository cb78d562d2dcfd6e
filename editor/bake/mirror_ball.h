#pragma once

// Light probes from photographs of a mirror ball (Debevec, "Rendering Synthetic Objects
// into Real Scenes", SIGGRAPH 1998).

#include <glm/vec3.hpp>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "editor/bake/probe.h"
#include "shared/core/status.h"

namespace lararium::bake {

// The outline of the ball: raw pixels, integer coordinates are pixel centres.
struct BallCircle {
  double x = 0.0;
  double y = 0.0;
  double radius = 0.0;
  double residual_px = 0.0;  // RMS distance of the edges that it was fitted to; 0: given
};

// The most circular strong edge of a picture (CV_8UC3 or CV_8UC1): found by Hough's
// transform, then fitted to the edges along its radii by least squares, outliers left out.
// nullopt where no circle of at least a twentieth of the picture is supported by most of its
// outline.
std::optional<BallCircle> FindBall(const cv::Mat& picture);

struct BallView {
  BallCircle circle;
  // From the camera to the ball's centre, in radii of the ball; 0: so far that rays are
  // parallel. Otherwise above 1; the ball is near the middle of the picture.
  double distance = 0.0;
  glm::vec3 reflectance = glm::vec3(1.0f);  // of the ball; polished steel about 0.6
};

// What the ball shows, as an equirectangular image of width x width / 2. In the probe's axes
// the camera looks along -Z with +X to its right and +Y up, so that the camera itself is seen
// at the left and right border; what the ball hides, about the centre, takes the radiance of
// the outline next to it. linear: CV_32FC3, R, G, B. Fails where the circle does not lie in
// the picture or a number is impossible.
Result<ProbeImage> UnwrapBall(const cv::Mat& linear, const BallView& view, int width);

// The picture of the directions about a ball.
class BallProjection {
 public:
  explicit BallProjection(const BallView& view);

  // Where a direction (unit, probe axes) is reflected; beyond the usable part of the outline,
  // the nearest point of that.
  cv::Point2d Pixel(const glm::dvec3& direction) const;

 private:
  BallView view_;
  double largest_;  // angle of a normal that is read, from the axis towards the camera
};

}  // namespace lararium::bake
