#include "shared/vision/rotation_estimator.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "shared/core/check.h"
#include "shared/geometry/transform.h"

namespace lararium::vision {
namespace {

using geometry::CameraModel;
using Vector5f = Eigen::Matrix<float, 5, 1>;  // Rotation vector, gain, offset.
using Matrix5f = Eigen::Matrix<float, 5, 5>;

constexpr int kIterations = 12;
constexpr float kHuber = 12.0f;  // Grey levels; larger residuals get less weight.
constexpr float kLeastOverlap = 0.3f;

struct System {
  Matrix5f matrix = Matrix5f::Zero();
  Vector5f right = Vector5f::Zero();
  float squares = 0.0f;
  int count = 0;
};

// Linearises the residual: image `now` at the rotated position, minus (gain * before + offset).
System Linearise(const cv::Mat& before,
                 const cv::Mat& now,
                 const CameraModel& camera,
                 const Eigen::Matrix3f& now_from_before,
                 float gain,
                 float offset) {
  System system;
  const auto fx = static_cast<float>(camera.fx);
  const auto fy = static_cast<float>(camera.fy);
  const auto cx = static_cast<float>(camera.cx);
  const auto cy = static_cast<float>(camera.cy);
  for (int row = 1; row + 1 < before.rows; ++row) {
    const uint8_t* b = before.ptr<uint8_t>(row);
    const float y = (static_cast<float>(row) - cy) / fy;
    for (int column = 1; column + 1 < before.cols; ++column) {
      const float x = (static_cast<float>(column) - cx) / fx;
      const Eigen::Vector3f ray = now_from_before * Eigen::Vector3f(x, y, 1.0f);
      const float u = fx * ray.x() / ray.z() + cx;
      const float v = fy * ray.y() / ray.z() + cy;
      if (!(ray.z() > 0.1f && u >= 0.0f && v >= 0.0f && u < static_cast<float>(now.cols - 1) &&
            v < static_cast<float>(now.rows - 1))) {
        continue;
      }
      const int iu = static_cast<int>(u);
      const int iv = static_cast<int>(v);
      const float du = u - static_cast<float>(iu);
      const float dv = v - static_cast<float>(iv);
      const uint8_t* n = now.ptr<uint8_t>(iv) + iu;
      const float top = n[0] + du * (n[1] - n[0]);
      const float bottom = n[now.step] + du * (n[now.step + 1] - n[now.step]);
      const float value = top + dv * (bottom - top);
      const float residual = value - gain * b[column] - offset;
      // Inverse composition: the derivative is taken in the image `before`.
      const float gx = 0.5f * gain * fx * (b[column + 1] - b[column - 1]);
      const float gy = 0.5f * gain * fy *
                       (b[column + static_cast<std::ptrdiff_t>(before.step)] -
                        b[column - static_cast<std::ptrdiff_t>(before.step)]);
      Vector5f jacobian;
      jacobian << -x * y * gx - (1.0f + y * y) * gy, (1.0f + x * x) * gx + x * y * gy,
          -y * gx + x * gy, -static_cast<float>(b[column]), -1.0f;
      const float size = std::abs(residual);
      const float weight = size < kHuber ? 1.0f : kHuber / size;
      system.matrix.noalias() += (weight * jacobian) * jacobian.transpose();
      system.right.noalias() -= (weight * residual) * jacobian;
      system.squares += weight * residual * residual;
      ++system.count;
    }
  }
  return system;
}

}  // namespace

std::optional<RotationEstimate> EstimateRotation(const cv::Mat& before,
                                                 const cv::Mat& now,
                                                 const CameraModel& camera,
                                                 const Eigen::Quaterniond& start) {
  CHECK(before.size() == now.size() && before.type() == CV_8UC1 && now.type() == CV_8UC1);
  CHECK(before.cols == camera.width && before.rows == camera.height);
  RotationEstimate estimate{start, 0.0};
  float gain = 1.0f;
  float offset = 0.0f;
  const float least = kLeastOverlap * static_cast<float>(before.cols * before.rows);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Eigen::Matrix3f rotation = estimate.now_from_before.toRotationMatrix().cast<float>();
    const System system = Linearise(before, now, camera, rotation, gain, offset);
    if (static_cast<float>(system.count) < least) {
      return std::nullopt;
    }
    estimate.noise = std::sqrt(system.squares / static_cast<float>(system.count));
    Matrix5f damped = system.matrix;
    damped.diagonal() *= 1.001f;
    damped.diagonal().array() += 1e-3f;
    const Vector5f change = damped.ldlt().solve(system.right);
    if (!change.allFinite()) {
      return std::nullopt;
    }
    const Eigen::Vector3d turn = change.head<3>().cast<double>();
    // Inverse composition: the increment is a rotation of the image before, so it is applied on
    // that side.
    estimate.now_from_before =
        (estimate.now_from_before * geometry::RotationFromVector(turn)).normalized();
    gain += change(3);
    offset += change(4);
    if (!(gain > 0.05f && gain < 20.0f) || turn.norm() > 0.5) {
      return std::nullopt;
    }
    if (turn.norm() * camera.fx < 0.02) {
      break;
    }
  }
  return estimate;
}

}  // namespace lararium::vision
