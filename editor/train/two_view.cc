#include "editor/train/two_view.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

#include "shared/core/check.h"
#include "shared/geometry/transform.h"

namespace lararium::train {
namespace {

using geometry::Rigid3;

constexpr size_t kMinPairs = 8;
constexpr double kConfidence = 0.9999;

std::vector<cv::Point2d> ToOpenCv(std::span<const Eigen::Vector2d> points) {
  std::vector<cv::Point2d> converted;
  converted.reserve(points.size());
  for (const Eigen::Vector2d& point : points) {
    converted.emplace_back(point.x(), point.y());
  }
  return converted;
}

std::vector<uint32_t> IndicesOf(const cv::Mat& mask) {
  std::vector<uint32_t> indices;
  for (int i = 0; i < static_cast<int>(mask.total()); ++i) {
    if (mask.at<uint8_t>(i) != 0) {
      indices.push_back(static_cast<uint32_t>(i));
    }
  }
  return indices;
}

// The four poses that an essential matrix allows (Hartley & Zisserman, "Multiple View Geometry",
// result 9.19).
std::array<Rigid3, 4> DecomposeEssential(const Eigen::Matrix3d& essential) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(essential, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  Eigen::Matrix3d v = svd.matrixV();
  u *= u.determinant() < 0 ? -1.0 : 1.0;
  v *= v.determinant() < 0 ? -1.0 : 1.0;
  Eigen::Matrix3d w;
  w << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const Eigen::Matrix3d rotation_1 = u * w * v.transpose();
  const Eigen::Matrix3d rotation_2 = u * w.transpose() * v.transpose();
  const Eigen::Vector3d baseline = u.col(2);
  return {Rigid3::FromMatrix(rotation_1, baseline), Rigid3::FromMatrix(rotation_1, -baseline),
          Rigid3::FromMatrix(rotation_2, baseline), Rigid3::FromMatrix(rotation_2, -baseline)};
}

// Returns whether the rays meet in front of both cameras, by the signs of the parameters of their
// closest points.
bool InFront(const Eigen::Vector3d& ray_a, const Eigen::Vector3d& ray_b, const Eigen::Vector3d& t) {
  // Both rays are in b's axes; camera a is at t. Minimises |t + x a - y b|.
  const double aa = ray_a.squaredNorm();
  const double bb = ray_b.squaredNorm();
  const double ab = ray_a.dot(ray_b);
  const double at = ray_a.dot(t);
  const double bt = ray_b.dot(t);
  return ab * bt - bb * at > 0.0 && aa * bt - ab * at > 0.0;
}

// The candidates that lie in front of both cameras.
std::vector<uint32_t> Cheiral(const PointPairs& points,
                              std::span<const uint32_t> candidates,
                              const Rigid3& b_from_a) {
  const Eigen::Matrix3d rotation = b_from_a.rotation.toRotationMatrix();
  std::vector<uint32_t> kept;
  for (const uint32_t i : candidates) {
    if (InFront(rotation * points.a[i].homogeneous(), points.b[i].homogeneous(),
                b_from_a.translation)) {
      kept.push_back(i);
    }
  }
  return kept;
}

// Median angle between the rays of point pairs after those of the first image are rotated.
double MedianAngle(const PointPairs& points,
                   std::span<const uint32_t> indices,
                   const Eigen::Matrix3d& rotation) {
  std::vector<double> angles;
  for (const uint32_t i : indices) {
    const Eigen::Vector3d a = rotation * points.a[i].homogeneous();
    const Eigen::Vector3d b = points.b[i].homogeneous();
    angles.push_back(std::atan2(a.cross(b).norm(), a.dot(b)));
  }
  const auto middle = angles.begin() + static_cast<ptrdiff_t>(angles.size() / 2);
  std::nth_element(angles.begin(), middle, angles.end());
  return *middle;
}

}  // namespace

Eigen::Matrix3d EssentialMatrix(const Rigid3& b_from_a) {
  return geometry::Skew(b_from_a.translation) * b_from_a.rotation.toRotationMatrix();
}

std::optional<RelativePose> EstimateRelativePose(const PointPairs& plane_points, double threshold) {
  if (plane_points.size() < kMinPairs) {
    return std::nullopt;
  }
  cv::Mat mask;
  cv::Mat found;
  try {
    found = cv::findEssentialMat(ToOpenCv(plane_points.a), ToOpenCv(plane_points.b),
                                 cv::Mat::eye(3, 3, CV_64F), cv::RANSAC, kConfidence, threshold,
                                 500, mask);
  } catch (const cv::Exception&) {
    return std::nullopt;  // No sample of five points has a solution.
  }
  if (found.rows < 3 || found.cols != 3) {
    return std::nullopt;
  }
  Eigen::Matrix3d essential;
  cv::cv2eigen(cv::Mat(found.rowRange(0, 3)), essential);
  if (!essential.allFinite()) {
    return std::nullopt;
  }
  const std::vector<uint32_t> candidates = IndicesOf(mask);
  RelativePose best;
  for (const Rigid3& pose : DecomposeEssential(essential)) {
    std::vector<uint32_t> inliers = Cheiral(plane_points, candidates, pose);
    if (inliers.size() > best.inliers.size()) {
      best.b_from_a = pose;
      best.inliers = std::move(inliers);
    }
  }
  if (best.inliers.size() < kMinPairs) {
    return std::nullopt;
  }
  best.median_angle =
      MedianAngle(plane_points, best.inliers, best.b_from_a.rotation.toRotationMatrix());
  return best;
}

std::optional<Fundamental> EstimateFundamental(const PointPairs& pixels, double threshold_px) {
  if (pixels.size() < kMinPairs) {
    return std::nullopt;
  }
  cv::Mat mask;
  cv::Mat found;
  try {
    found = cv::findFundamentalMat(ToOpenCv(pixels.a), ToOpenCv(pixels.b), cv::FM_RANSAC,
                                   threshold_px, kConfidence, 2000, mask);
  } catch (const cv::Exception&) {
    return std::nullopt;  // No sample of seven points has a solution.
  }
  if (found.rows < 3 || found.cols != 3) {
    return std::nullopt;
  }
  Fundamental fundamental;
  cv::cv2eigen(cv::Mat(found.rowRange(0, 3)), fundamental.matrix);
  fundamental.inliers = IndicesOf(mask);
  if (!fundamental.matrix.allFinite() || fundamental.inliers.size() < kMinPairs) {
    return std::nullopt;
  }
  return fundamental;
}

Turning EstimateTurning(const PointPairs& plane_points) {
  CHECK(plane_points.size() > 0);
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
  std::vector<uint32_t> all;
  for (uint32_t i = 0; i < plane_points.size(); ++i) {
    correlation += plane_points.b[i].homogeneous().normalized() *
                   plane_points.a[i].homogeneous().normalized().transpose();
    all.push_back(i);
  }
  const Eigen::Quaterniond rotation = geometry::ClosestRotation(correlation);
  return {rotation, MedianAngle(plane_points, all, rotation.toRotationMatrix())};
}

PlanarGeometry EstimatePlanarGeometry(const PointPairs& plane_points, double threshold) {
  PlanarGeometry geometry;
  if (plane_points.size() < kMinPairs) {
    return geometry;
  }
  cv::Mat mask;
  std::vector<cv::Mat> rotations;
  std::vector<cv::Mat> translations;
  std::vector<cv::Mat> normals;
  try {
    const cv::Mat homography = cv::findHomography(
        ToOpenCv(plane_points.a), ToOpenCv(plane_points.b), cv::RANSAC, threshold, mask);
    if (homography.empty()) {
      return geometry;
    }
    cv::decomposeHomographyMat(homography, cv::Mat::eye(3, 3, CV_64F), rotations, translations,
                               normals);
  } catch (const cv::Exception&) {
    return geometry;  // No sample of four points has a solution.
  }
  const std::vector<uint32_t> inliers = IndicesOf(mask);
  geometry.share = static_cast<double>(inliers.size()) / static_cast<double>(plane_points.size());
  for (size_t i = 0; i < rotations.size(); ++i) {
    Eigen::Matrix3d rotation;
    Eigen::Vector3d translation;
    cv::cv2eigen(rotations[i], rotation);
    cv::cv2eigen(translations[i], translation);
    if (!(translation.norm() > 1e-6) || !rotation.allFinite()) {
      continue;  // The camera only turned.
    }
    const Rigid3 pose = Rigid3::FromMatrix(rotation, translation.normalized());
    if (2 * Cheiral(plane_points, inliers, pose).size() > inliers.size()) {
      geometry.b_from_a.push_back(pose);
    }
  }
  return geometry;
}

std::optional<double> EstimateFocal(std::span<const Fundamental> pairs) {
  constexpr int kSteps = 120;
  std::vector<double> costs(kSteps + 1, 0.0);
  const auto focal_at = [&](int step) {
    return 0.4 * std::pow(2.5 / 0.4, static_cast<double>(step) / kSteps);
  };
  for (int step = 0; step <= kSteps; ++step) {
    const Eigen::DiagonalMatrix<double, 3> k(focal_at(step), focal_at(step), 1.0);
    for (const Fundamental& pair : pairs) {
      const Eigen::Vector3d singular =
          Eigen::JacobiSVD<Eigen::Matrix3d>(k * pair.matrix * k).singularValues();
      const double difference = (singular[0] - singular[1]) / singular[1];
      constexpr double kTolerance = 0.05;
      const double ratio = difference / kTolerance;
      costs[step] += static_cast<double>(pair.inliers.size()) * ratio * ratio / (1 + ratio * ratio);
    }
  }
  const auto best = std::min_element(costs.begin(), costs.end());
  const auto worst = std::max_element(costs.begin(), costs.end());
  // A minimum at the border of the grid, or one that hardly differs from the rest, does not count.
  if (pairs.empty() || best == costs.begin() || best == costs.end() - 1 || *best > 0.8 * *worst) {
    return std::nullopt;
  }
  return focal_at(static_cast<int>(best - costs.begin()));
}

}  // namespace lararium::train
