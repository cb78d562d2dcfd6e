#include "editor/train/session_adjustment.h"

#include <ceres/ceres.h>

#include <memory>

#include "editor/train/bundle_adjustment.h"
#include "shared/vision/rolling_shutter.h"

namespace lararium::train {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;
using SessionPoseManifold =
    ceres::ProductManifold<ceres::EigenQuaternionManifold, ceres::EuclideanManifold<3>>;

class ObservationCost : public ceres::SizedCostFunction<2, 7, 3> {
 public:
  ObservationCost(const PosedCameras& cameras, const vision::Observation& observation)
      : camera_(cameras.model),
        intrinsics_(ToIntrinsicsBlock(cameras.model, cameras.readout)),
        motion_(cameras.motions[observation.keyframe]),
        pixel_(observation.x, observation.y) {}

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    return ReprojectionResidual(camera_, motion_, pixel_, intrinsics_.data(), parameters[0],
                                parameters[1], residuals, nullptr,
                                jacobians != nullptr ? jacobians[0] : nullptr,
                                jacobians != nullptr ? jacobians[1] : nullptr);
  }

 private:
  const CameraModel& camera_;
  IntrinsicsBlock intrinsics_;
  ImageMotion motion_;
  Eigen::Vector2d pixel_;
};

// [points]: Whether a free pose observes the point.
std::vector<bool> FreePoints(std::span<const vision::Observation> observations,
                             size_t first_free,
                             size_t count) {
  std::vector<bool> free(count, false);
  for (const vision::Observation& o : observations) {
    if (o.keyframe >= first_free) {
      free[o.point] = true;
    }
  }
  return free;
}

ceres::Problem::Options BorrowingOptions() {
  ceres::Problem::Options options;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  return options;
}

ceres::Solver::Options SolverOptions(size_t free_poses) {
  ceres::Solver::Options options;
  options.max_num_iterations = 20;
  options.num_threads = 1;  // Several threads would not give reproducible bits.
  options.logging_type = ceres::SILENT;
  constexpr size_t kMaxDensePoses = 250;
  options.linear_solver_type = free_poses == 0                ? ceres::SPARSE_NORMAL_CHOLESKY
                               : free_poses <= kMaxDensePoses ? ceres::DENSE_SCHUR
                                                              : ceres::SPARSE_SCHUR;
  return options;
}

// Adjusts the poses from first_free on and the points in free_points.
bool Solve(const PosedCameras& cameras,
           std::span<const vision::Observation> observations,
           const std::vector<bool>& free_points,
           size_t first_free,
           std::span<Rigid3> camera_from_map,
           std::span<Eigen::Vector3d> points) {
  constexpr double kLossScalePx = 1.5;
  ceres::CauchyLoss loss(kLossScalePx);
  SessionPoseManifold manifold;
  std::vector<PoseBlock> poses;
  for (const Rigid3& pose : camera_from_map) {
    poses.push_back(ToPoseBlock(pose));
  }
  std::vector<Eigen::Vector3d> moved(points.begin(), points.end());

  ceres::Problem problem(BorrowingOptions());
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (const vision::Observation& o : observations) {
    if (free_points[o.point]) {
      problem.AddResidualBlock(new ObservationCost(cameras, o), &loss, poses[o.keyframe].data(),
                               moved[o.point].data());
    }
  }
  size_t free_poses = 0;
  for (size_t k = 0; k < poses.size(); ++k) {
    double* block = poses[k].data();
    if (!problem.HasParameterBlock(block)) {
      continue;
    }
    problem.SetManifold(block, &manifold);
    ordering->AddElementToGroup(block, 1);
    if (k < first_free) {
      problem.SetParameterBlockConstant(block);
    } else {
      ++free_poses;
    }
  }
  for (Eigen::Vector3d& point : moved) {
    if (problem.HasParameterBlock(point.data())) {
      ordering->AddElementToGroup(point.data(), 0);
    }
  }
  ceres::Solver::Options options = SolverOptions(free_poses);
  if (free_poses > 0) {  // Only then points are eliminated first.
    options.linear_solver_ordering = ordering;
  }
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) {
    return false;
  }
  for (size_t k = first_free; k < poses.size(); ++k) {
    camera_from_map[k] = ToPose(poses[k]);
  }
  std::copy(moved.begin(), moved.end(), points.begin());
  return true;
}

}  // namespace

std::optional<Eigen::Vector2d> PosedCameras::PixelOf(size_t pose,
                                                     const Rigid3& camera_from_map,
                                                     const Eigen::Vector3d& point,
                                                     const Eigen::Vector2d& observed) const {
  const double time = readout.dot(vision::ReadoutOrder(model, observed));
  return model.Project(vision::PoseAfter(camera_from_map, motions[pose], time) * point);
}

PosedCameras CamerasOf(const vision::SceneDatabase& map) {
  PosedCameras cameras{map.camera, map.readout, {}};
  for (const vision::Keyframe& keyframe : map.keyframes) {
    cameras.motions.push_back(keyframe.motion);
  }
  return cameras;
}

bool AdjustSession(const PosedCameras& cameras,
                   std::span<const vision::Observation> observations,
                   size_t first_free,
                   std::span<Rigid3> camera_from_map,
                   std::span<Eigen::Vector3d> points) {
  return Solve(cameras, observations, FreePoints(observations, first_free, points.size()),
               first_free, camera_from_map, points);
}

bool AdjustPoints(const PosedCameras& cameras,
                  std::span<const vision::Observation> observations,
                  std::span<const Rigid3> camera_from_map,
                  const std::vector<bool>& moves,
                  std::span<Eigen::Vector3d> points) {
  std::vector<Rigid3> poses(camera_from_map.begin(), camera_from_map.end());
  return Solve(cameras, observations, moves, poses.size(), poses, points);
}

}  // namespace lararium::train
