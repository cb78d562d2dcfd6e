#include "editor/bake/mirror_ball.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "shared/core/units.h"

namespace lararium::bake {
namespace {
// Usable share of the outline's radius; beyond it, a pixel covers too large an angle.
constexpr double kUsable = 0.985;

// The angle, from the axis towards the camera, of the direction that a point of the ball
// reflects. The normal is at angle a; from that point the camera is at -atan(sin a / (D - cos
// a)).
double ReflectedAngle(double normal_angle, double distance) {
  if (distance <= 0.0) {
    return 2.0 * normal_angle;
  }
  return 2.0 * normal_angle + std::atan2(std::sin(normal_angle), distance - std::cos(normal_angle));
}

// Distance from the middle of the outline, divided by its radius.
double PictureRadius(double normal_angle, double distance) {
  if (distance <= 0.0) {
    return std::sin(normal_angle);
  }
  return std::sqrt(distance * distance - 1.0) * std::sin(normal_angle) /
         (distance - std::cos(normal_angle));
}

// Inverts a function that rises on [low, high] by bisection.
template <typename Function>
double Invert(const Function& function, double value, double low, double high) {
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (function(middle) < value ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double LargestNormalAngle(double distance) {
  const double outline = distance <= 0.0 ? 0.5 * kPi : std::acos(1.0 / distance);
  return Invert([&](double a) { return PictureRadius(a, distance); }, kUsable, 0.0, outline);
}

glm::vec3 Sample(const cv::Mat& linear, const cv::Point2d& at) {
  const double x = std::clamp(at.x, 0.0, linear.cols - 1.0);
  const double y = std::clamp(at.y, 0.0, linear.rows - 1.0);
  const int left = std::min(static_cast<int>(x), linear.cols - 2);
  const int top = std::min(static_cast<int>(y), linear.rows - 2);
  const auto fx = static_cast<float>(x - left);
  const auto fy = static_cast<float>(y - top);
  const auto& p = linear.at<cv::Vec3f>(top, left);
  const auto& q = linear.at<cv::Vec3f>(top, left + 1);
  const auto& r = linear.at<cv::Vec3f>(top + 1, left);
  const auto& s = linear.at<cv::Vec3f>(top + 1, left + 1);
  const cv::Vec3f mean = (1.0f - fy) * ((1.0f - fx) * p + fx * q) + fy * ((1.0f - fx) * r + fx * s);
  return {mean[0], mean[1], mean[2]};
}

Status Check(const cv::Mat& linear, const BallView& view, int width) {
  const BallCircle& c = view.circle;
  constexpr const char* kPlace = "mirror ball";
  if (linear.type() != CV_32FC3 || linear.cols < 2 || linear.rows < 2) {
    return Status::Error(kPlace, "the picture does not have linear colour");
  }
  const bool inside = c.radius >= 4.0 && c.x - c.radius > -2.0 && c.y - c.radius > -2.0 &&
                      c.x + c.radius < linear.cols + 1.0 && c.y + c.radius < linear.rows + 1.0;
  if (!inside) {
    return Status::Error(kPlace, "its outline does not lie in the picture",
                         "give the centre and the radius in pixels");
  }
  if (!(view.distance == 0.0 || (view.distance > 1.05 && view.distance < 1e6))) {
    return Status::Error(kPlace, "the camera's distance is impossible",
                         "give it in radii of the ball, above 1, or 0 if it is far away");
  }
  if (!(std::min({view.reflectance.r, view.reflectance.g, view.reflectance.b}) > 0.01f)) {
    return Status::Error(kPlace, "the ball's reflectance must be above 0.01");
  }
  if (width < 8 || width > 8192 || width % 2 != 0) {
    return Status::Error(kPlace, "the width of the probe must be even, 8 to 8192");
  }
  return Status();
}

// The strongest edge along a radius, within a tenth of the expected radius.
std::optional<cv::Point2d> EdgeAlong(const cv::Mat& grey, const BallCircle& circle, double angle) {
  const double cosine = std::cos(angle);
  const double sine = std::sin(angle);
  const auto value = [&](double r) -> double {
    const int x = static_cast<int>(std::lround(circle.x + r * cosine));
    const int y = static_cast<int>(std::lround(circle.y + r * sine));
    return x < 0 || y < 0 || x >= grey.cols || y >= grey.rows ? -1.0 : grey.at<uchar>(y, x);
  };
  double best = 12.0;  // grey levels over two pixels
  std::optional<cv::Point2d> edge;
  for (double r = 0.9 * circle.radius; r <= 1.1 * circle.radius; r += 0.5) {
    const double inner = value(r - 1.0);
    const double outer = value(r + 1.0);
    if (inner < 0.0 || outer < 0.0) {
      continue;
    }
    if (std::abs(outer - inner) > best) {
      best = std::abs(outer - inner);
      edge = cv::Point2d(circle.x + r * cosine, circle.y + r * sine);
    }
  }
  return edge;
}

// Least squares on x^2 + y^2 = 2 x cx + 2 y cy + c (Kasa 1976).
BallCircle FitCircle(const std::vector<cv::Point2d>& points) {
  cv::Matx33d normal = cv::Matx33d::zeros();
  cv::Vec3d right(0, 0, 0);
  const cv::Point2d origin = points.front();
  for (const cv::Point2d& point : points) {
    const cv::Point2d p = point - origin;
    const cv::Vec3d row(2.0 * p.x, 2.0 * p.y, 1.0);
    normal += row * row.t();
    right += row * p.dot(p);
  }
  const cv::Vec3d solved = normal.solve(right, cv::DECOMP_SVD);
  BallCircle circle{solved[0] + origin.x, solved[1] + origin.y, 0.0, 0.0};
  circle.radius =
      std::sqrt(std::max(0.0, solved[2] + solved[0] * solved[0] + solved[1] * solved[1]));
  return circle;
}

double Off(const BallCircle& circle, const cv::Point2d& point) {
  return std::abs(std::hypot(point.x - circle.x, point.y - circle.y) - circle.radius);
}

// Fits a circle and removes outliers until nothing changes. Gives nullopt if the outline has
// little support.
std::optional<BallCircle> Refine(const cv::Mat& grey, BallCircle circle) {
  constexpr int kRays = 360;
  constexpr double kSupport = 0.5;
  for (int round = 0; round < 6; ++round) {
    std::vector<cv::Point2d> edges;
    std::vector<double> off;
    for (int i = 0; i < kRays; ++i) {
      if (const auto edge = EdgeAlong(grey, circle, 2.0 * kPi * i / kRays)) {
        edges.push_back(*edge);
        off.push_back(Off(circle, *edge));
      }
    }
    if (edges.size() < static_cast<size_t>(kSupport * kRays)) {
      return std::nullopt;
    }
    std::vector<double> sorted = off;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<ptrdiff_t>(sorted.size() / 2),
                     sorted.end());
    const double limit = std::max(1.5, 2.5 * sorted[sorted.size() / 2]);
    std::vector<cv::Point2d> near;
    for (size_t i = 0; i < edges.size(); ++i) {
      if (off[i] <= limit) {
        near.push_back(edges[i]);
      }
    }
    circle = FitCircle(near);
    double squares = 0.0;
    size_t close = 0;
    for (const cv::Point2d& edge : edges) {
      const double distance = Off(circle, edge);
      if (distance < 2.0) {
        squares += distance * distance;
        ++close;
      }
    }
    if (close < static_cast<size_t>(kSupport * kRays)) {
      if (round < 5) {
        continue;
      }
      return std::nullopt;
    }
    circle.residual_px = std::sqrt(squares / static_cast<double>(close));
  }
  return circle;
}

}  // namespace

std::optional<BallCircle> FindBall(const cv::Mat& picture) {
  constexpr int kSearchSize = 640;
  if (picture.empty() || picture.depth() != CV_8U || picture.cols < 16 || picture.rows < 16) {
    return std::nullopt;
  }
  cv::Mat grey = picture;
  if (picture.channels() == 3) {
    cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
  }
  const double scale =
      std::min(1.0, static_cast<double>(kSearchSize) / std::max(grey.cols, grey.rows));
  cv::Mat small;
  cv::resize(grey, small, cv::Size(), scale, scale, cv::INTER_AREA);
  cv::GaussianBlur(small, small, cv::Size(5, 5), 1.2);
  const int least = std::max(6, std::min(small.cols, small.rows) / 20);
  std::vector<cv::Vec3f> found;
  cv::HoughCircles(small, found, cv::HOUGH_GRADIENT, 1.5, least, 120, 40, least,
                   std::min(small.cols, small.rows) / 2 + 4);
  std::optional<BallCircle> best;
  double best_score = 0.0;
  for (size_t i = 0; i < std::min<size_t>(found.size(), 8); ++i) {
    const BallCircle guess{(found[i][0] + 0.5) / scale - 0.5, (found[i][1] + 0.5) / scale - 0.5,
                           found[i][2] / scale, 0.0};
    const auto refined = Refine(grey, guess);
    // The outline is the largest circle about this point; reflections in the ball are smaller.
    if (refined && refined->radius > best_score) {
      best = refined;
      best_score = refined->radius;
    }
  }
  return best;
}

BallProjection::BallProjection(const BallView& view)
    : view_(view), largest_(LargestNormalAngle(view.distance)) {}

cv::Point2d BallProjection::Pixel(const glm::dvec3& direction) const {
  const double angle = std::acos(std::clamp(direction.z, -1.0, 1.0));
  const double normal_angle =
      Invert([&](double a) { return ReflectedAngle(a, view_.distance); }, angle, 0.0, largest_);
  const double radius = view_.circle.radius * PictureRadius(normal_angle, view_.distance);
  const double level = std::hypot(direction.x, direction.y);
  const double x = level > 0.0 ? direction.x / level : 0.0;
  const double y = level > 0.0 ? direction.y / level : 0.0;
  return {view_.circle.x + radius * x, view_.circle.y - radius * y};
}

Result<ProbeImage> UnwrapBall(const cv::Mat& linear, const BallView& view, int width) {
  LARARIUM_RETURN_IF_ERROR(Check(linear, view, width));
  // Takes four samples per texel, because neighbours near the outline are far apart in the
  // picture.
  const BallProjection projection(view);
  constexpr std::array<double, 2> kOffsets = {0.25, 0.75};
  ProbeImage image{width, width / 2, {}, {}};
  image.pixels.reserve(static_cast<size_t>(width) * static_cast<size_t>(image.height));
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < width; ++column) {
      glm::vec3 sum(0.0f);
      for (const double down : kOffsets) {
        for (const double across : kOffsets) {
          const double azimuth = 2.0 * kPi * ((column + across) / width - 0.5);
          const double elevation = kPi * (0.5 - (row + down) / image.height);
          const glm::dvec3 direction(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                                     -std::cos(elevation) * std::cos(azimuth));
          sum += Sample(linear, projection.Pixel(direction));
        }
      }
      image.pixels.push_back(glm::max(sum, glm::vec3(0.0f)) / (4.0f * view.reflectance));
    }
  }
  return image;
}

}  // namespace lararium::bake
