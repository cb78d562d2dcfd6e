#include "editor/panels/inspector/light_maths.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "shared/core/srgb.h"
#include "shared/core/units.h"
#include "shared/geometry/glm_convert.h"

namespace lararium::panels {
namespace {

using Eigen::Vector3d;

uchar Luminance(const cv::Vec3b& bgr) {
  return static_cast<uchar>(std::lround(0.114 * bgr[0] + 0.587 * bgr[1] + 0.299 * bgr[2]));
}

// Möller & Trumbore, "Fast, Minimum Storage Ray-Triangle Intersection", 1997.
std::optional<double> Meet(const Ray& ray,
                           const Vector3d& a,
                           const Vector3d& b,
                           const Vector3d& c) {
  const Vector3d ab = b - a;
  const Vector3d ac = c - a;
  const Vector3d p = ray.direction.cross(ac);
  const double determinant = ab.dot(p);
  if (std::abs(determinant) < 1e-12) {
    return std::nullopt;
  }
  const Vector3d from = ray.origin - a;
  const double u = from.dot(p) / determinant;
  const Vector3d q = from.cross(ab);
  const double v = ray.direction.dot(q) / determinant;
  const double distance = ac.dot(q) / determinant;
  const bool inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 1e-6;
  return inside ? std::optional(distance) : std::nullopt;
}

struct Hit {
  double distance = std::numeric_limits<double>::infinity();
  Vector3d normal = Vector3d::UnitY();
};

void MeetOccluder(const Ray& ray, const stage::Occluder& occluder, Hit& hit) {
  const auto corner = [&](uint32_t index) -> Vector3d {
    const glm::vec3& p = occluder.mesh.positions[index];
    return occluder.stage_from_mesh * Vector3d(p.x, p.y, p.z);
  };
  const std::vector<uint32_t>& indices = occluder.mesh.indices;
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    const Vector3d a = corner(indices[i]);
    const Vector3d b = corner(indices[i + 1]);
    const Vector3d c = corner(indices[i + 2]);
    const std::optional<double> distance = Meet(ray, a, b, c);
    if (distance && *distance < hit.distance) {
      hit = {*distance, (b - a).cross(c - a).normalized()};
    }
  }
}

}  // namespace

glm::vec3 PanoramaDirection(double x, double y) {
  const double azimuth = 2.0 * kPi * (x - 0.5);
  const double elevation = kPi * (0.5 - y);
  return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
          -std::cos(elevation) * std::cos(azimuth)};
}

Eigen::Vector2d PanoramaPoint(const glm::vec3& direction) {
  const double azimuth = std::atan2(direction.x, -direction.z);
  const double elevation = std::asin(std::clamp(static_cast<double>(direction.y), -1.0, 1.0));
  return {azimuth / (2.0 * kPi) + 0.5, 0.5 - elevation / kPi};
}

std::optional<SurfacePoint> FindSurface(const Ray& ray_in_stage,
                                        std::span<const stage::Occluder> occluders) {
  Hit hit;
  for (const stage::Occluder& occluder : occluders) {
    MeetOccluder(ray_in_stage, occluder, hit);
  }
  const double down = -ray_in_stage.direction.y();
  if (std::isinf(hit.distance) && down > 1e-6 && ray_in_stage.origin.y() > 0.0) {
    hit = {ray_in_stage.origin.y() / down, Vector3d::UnitY()};
  }
  if (std::isinf(hit.distance)) {
    return std::nullopt;
  }
  const bool faces = hit.normal.dot(ray_in_stage.direction) < 0.0;
  return SurfacePoint{geometry::ToGlm(ray_in_stage.At(hit.distance)),
                      geometry::ToGlm(faces ? hit.normal : Vector3d(-hit.normal))};
}

void BrightnessHistogram::Add(uchar luminance) {
  ++counts[static_cast<size_t>(luminance) * kBins / 256];
  ++total;
}

double BrightnessHistogram::Median() const {
  int sum = 0;
  for (int bin = 0; bin < kBins && total > 0; ++bin) {
    sum += counts[bin];
    if (2 * sum >= total) {
      return (bin + 0.5) / kBins;
    }
  }
  return 0.0;
}

BrightnessComparison CompareBrightness(const cv::Mat& plain,
                                       const cv::Mat& composite,
                                       const cv::Mat& coverage) {
  BrightnessComparison comparison;
  if (plain.size() != composite.size() || plain.size() != coverage.size()) {
    return comparison;
  }
  for (int y = 0; y < plain.rows; ++y) {
    for (int x = 0; x < plain.cols; ++x) {
      comparison.real.Add(Luminance(plain.at<cv::Vec3b>(y, x)));
      if (coverage.at<uchar>(y, x) == 255) {
        comparison.people.Add(Luminance(composite.at<cv::Vec3b>(y, x)));
      }
    }
  }
  return comparison;
}

std::optional<glm::vec3> MeanLinear(const cv::Mat& bgr, const Eigen::Vector2d& pixel, int half) {
  const cv::Point centre(static_cast<int>(std::lround(pixel.x())),
                         static_cast<int>(std::lround(pixel.y())));
  const cv::Rect all(0, 0, bgr.cols, bgr.rows);
  if (!all.contains(centre)) {
    return std::nullopt;
  }
  const cv::Rect square =
      cv::Rect(centre.x - half, centre.y - half, 2 * half + 1, 2 * half + 1) & all;
  glm::dvec3 sum(0.0);
  for (int y = square.y; y < square.br().y; ++y) {
    for (int x = square.x; x < square.br().x; ++x) {
      const cv::Vec3b& p = bgr.at<cv::Vec3b>(y, x);
      sum += glm::dvec3(LinearFromSrgb(p[2] / 255.0), LinearFromSrgb(p[1] / 255.0),
                        LinearFromSrgb(p[0] / 255.0));
    }
  }
  return glm::vec3(sum / static_cast<double>(square.area()));
}

}  // namespace lararium::panels
