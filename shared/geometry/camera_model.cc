#include "shared/geometry/camera_model.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "shared/core/json_fields.h"

namespace lararium::geometry {
namespace {

// Distorts a point on the plane z = 1. Computes the 2x2 Jacobian unless `jacobian` is nullptr.
Eigen::Vector2d Distort(const CameraModel& c, const Eigen::Vector2d& p, Eigen::Matrix2d* jacobian) {
  const double x = p.x();
  const double y = p.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (c.k1 + r2 * c.k2);
  if (jacobian != nullptr) {
    const double slope = 2.0 * (c.k1 + 2.0 * c.k2 * r2);  // d radial / d r2, times 2
    (*jacobian)(0, 0) = radial + x * x * slope + 2.0 * c.p1 * y + 6.0 * c.p2 * x;
    (*jacobian)(0, 1) = x * y * slope + 2.0 * c.p1 * x + 2.0 * c.p2 * y;
    (*jacobian)(1, 0) = x * y * slope + 2.0 * c.p2 * y + 2.0 * c.p1 * x;
    (*jacobian)(1, 1) = radial + y * y * slope + 6.0 * c.p1 * y + 2.0 * c.p2 * x;
  }
  return {x * radial + 2.0 * c.p1 * x * y + c.p2 * (r2 + 2.0 * x * x),
          y * radial + c.p1 * (r2 + 2.0 * y * y) + 2.0 * c.p2 * x * y};
}

// An array of four numbers that are members of their own.
void DescribeFour(Fields& fields, const char* name, const std::array<double*, 4>& members) {
  std::array values = {*members[0], *members[1], *members[2], *members[3]};
  fields.Numbers(name, values);
  if (fields.reading()) {
    for (size_t i = 0; i < values.size(); ++i) {
      *members[i] = values[i];
    }
  }
}

constexpr std::string_view kPlace = "camera intrinsics";

}  // namespace

Result<CameraModel> CameraModel::FromNumbers(std::span<const double> numbers,
                                             int width,
                                             int height) {
  if (numbers.size() != 4 && numbers.size() != 8) {
    return Status::Error(kPlace, "must be 4 or 8 numbers", "give fx, fy, cx, cy[, k1, k2, p1, p2]");
  }
  CameraModel camera{width, height, numbers[0], numbers[1], numbers[2], numbers[3]};
  if (numbers.size() == 8) {
    camera.k1 = numbers[4];
    camera.k2 = numbers[5];
    camera.p1 = numbers[6];
    camera.p2 = numbers[7];
  }
  LARARIUM_RETURN_IF_ERROR(camera.Validate());
  return camera;
}

Status CameraModel::Validate() const {
  if (width < 16 || height < 16 || width > 16384 || height > 16384) {
    return Status::Error(kPlace, "image size must lie between 16 and 16384 pixels");
  }
  for (const double value : {fx, fy, cx, cy, k1, k2, p1, p2}) {
    if (!std::isfinite(value)) {
      return Status::Error(kPlace, "all numbers must be finite");
    }
  }
  const double side = std::max(width, height);
  if (fx < 0.05 * side || fy < 0.05 * side || fx > 100.0 * side || fy > 100.0 * side) {
    return Status::Error(kPlace, "the focal length is impossible for this image size",
                         "give fx and fy in pixels");
  }
  if (cx < -side || cy < -side || cx > 2.0 * side || cy > 2.0 * side) {
    return Status::Error(kPlace, "the principal point is far outside the image",
                         "give cx and cy in pixels");
  }
  // Undistorting and distorting a pixel must return it, also in the corners.
  for (const double x : {-0.5, 0.5 * width, width - 0.5}) {
    for (const double y : {-0.5, 0.5 * height, height - 0.5}) {
      const Eigen::Vector2d pixel(x, y);
      const double error = (PixelFromPlane(PlaneFromPixel(pixel)) - pixel).norm();
      if (!(error < 1e-3)) {
        return Status::Error(kPlace, "the distortion folds the image over itself",
                             "check k1, k2, p1, p2");
      }
    }
  }
  return Status();
}

std::optional<Eigen::Vector2d> CameraModel::Project(const Eigen::Vector3d& point_in_camera) const {
  if (point_in_camera.z() <= 1e-9) {
    return std::nullopt;
  }
  const Eigen::Vector2d plane = point_in_camera.hnormalized();
  if (FoldsBackAt(plane)) {
    return std::nullopt;
  }
  return PixelFromPlane(plane);
}

bool CameraModel::FoldsBackAt(const Eigen::Vector2d& plane) const {
  // The slope of r (1 + k1 r^2 + k2 r^4) is 1 + 3 k1 s + 5 k2 s^2 with s = r^2. It is 1 on the
  // axis; it has a zero up to s if it is negative there, or fell below zero and rose again.
  const double s = plane.squaredNorm();
  if (1.0 + s * (3.0 * k1 + s * 5.0 * k2) <= 0.0) {
    return true;
  }
  const bool rises_again = k1 < 0.0 && k2 > 0.0 && 10.0 * k2 * s > -3.0 * k1;
  return rises_again && 9.0 * k1 * k1 >= 20.0 * k2;
}

Eigen::Vector2d CameraModel::PixelFromPlane(const Eigen::Vector2d& plane) const {
  const Eigen::Vector2d d = HasDistortion() ? Distort(*this, plane, nullptr) : plane;
  return {fx * d.x() + cx, fy * d.y() + cy};
}

Eigen::Vector2d CameraModel::PixelFromPlane(const Eigen::Vector2d& plane,
                                            Eigen::Matrix2d& slope) const {
  const Eigen::Vector2d d = Distort(*this, plane, &slope);
  slope.row(0) *= fx;
  slope.row(1) *= fy;
  return {fx * d.x() + cx, fy * d.y() + cy};
}

Eigen::Vector2d CameraModel::PlaneFromPixel(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d target((pixel.x() - cx) / fx, (pixel.y() - cy) / fy);
  if (!HasDistortion()) {
    return target;
  }
  Eigen::Vector2d point = target;
  for (int i = 0; i < 20; ++i) {
    Eigen::Matrix2d jacobian;
    const Eigen::Vector2d residual = Distort(*this, point, &jacobian) - target;
    if (residual.squaredNorm() < 1e-20 || std::abs(jacobian.determinant()) < 1e-9) {
      break;
    }
    point -= jacobian.inverse() * residual;
  }
  return point;
}

CameraModel CameraModel::Resized(int new_width, int new_height) const {
  const double sx = static_cast<double>(new_width) / width;
  const double sy = static_cast<double>(new_height) / height;
  CameraModel resized = *this;
  resized.width = new_width;
  resized.height = new_height;
  resized.fx = sx * fx;
  resized.fy = sy * fy;
  resized.cx = sx * (cx + 0.5) - 0.5;
  resized.cy = sy * (cy + 0.5) - 0.5;
  return resized;
}

Result<CameraModel> CameraModel::ForImages(int new_width, int new_height) const {
  const double wanted_width = static_cast<double>(width) * new_height / height;
  if (std::abs(wanted_width - new_width) > 1.0) {
    const auto size = [](int w, int h) { return std::to_string(w) + "x" + std::to_string(h); };
    return Status::Error(
        kPlace,
        "are for images of " + size(width, height) + ", these are " + size(new_width, new_height),
        "use the same camera and format, or give its intrinsics");
  }
  return Resized(new_width, new_height);
}

CameraModel CameraModel::GuessForImages(int new_width, int new_height) const {
  if (const Result<CameraModel> same = ForImages(new_width, new_height); same.ok()) {
    return *same;
  }
  const double focal = Focal() * std::max(new_width, new_height) / std::max(width, height);
  return {new_width, new_height, focal, focal, 0.5 * (new_width - 1), 0.5 * (new_height - 1)};
}

CameraModel CameraModel::DisplayPinhole() const {
  CameraModel display = *this;
  display.k1 = display.k2 = display.p1 = display.p2 = 0.0;
  if (!HasDistortion()) {
    return display;
  }
  // The largest rectangle around the axis that lies completely inside the undistorted image border.
  std::array<double, 4> inner = {-1e9, 1e9, -1e9, 1e9};  // left, right, top, bottom on z = 1
  constexpr int kSteps = 64;
  for (int i = 0; i <= kSteps; ++i) {
    const double x = -0.5 + static_cast<double>(width) * i / kSteps;
    const double y = -0.5 + static_cast<double>(height) * i / kSteps;
    inner[0] = std::max(inner[0], PlaneFromPixel({-0.5, y}).x());
    inner[1] = std::min(inner[1], PlaneFromPixel({width - 0.5, y}).x());
    inner[2] = std::max(inner[2], PlaneFromPixel({x, -0.5}).y());
    inner[3] = std::min(inner[3], PlaneFromPixel({x, height - 0.5}).y());
  }
  // A single focal length keeps pixels square; the window is cut to the aspect ratio.
  const double focal = std::max(width / (inner[1] - inner[0]), height / (inner[3] - inner[2]));
  display.fx = display.fy = focal;
  display.cx = 0.5 * (width - 1) - focal * 0.5 * (inner[0] + inner[1]);
  display.cy = 0.5 * (height - 1) - focal * 0.5 * (inner[2] + inner[3]);
  return display;
}

void DescribePinhole(Fields& fields, CameraModel& camera) {
  fields.Integer("width", camera.width, 16, 16384);
  fields.Integer("height", camera.height, 16, 16384);
  DescribeFour(fields, "K", {&camera.fx, &camera.fy, &camera.cx, &camera.cy});
}

void DescribeDistortion(Fields& fields, CameraModel& camera) {
  DescribeFour(fields, "k1_k2_p1_p2", {&camera.k1, &camera.k2, &camera.p1, &camera.p2});
}

void DescribeFields(Fields& fields, CameraModel& camera) {
  DescribePinhole(fields, camera);
  if (fields.Has("k1_k2_p1_p2", true)) {
    DescribeDistortion(fields, camera);
  }
  fields.Check(camera.Validate().At(fields.where()));
}

}  // namespace lararium::geometry
