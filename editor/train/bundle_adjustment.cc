#include "editor/train/bundle_adjustment.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>
#include <utility>

#include "shared/core/check.h"
#include "shared/vision/rolling_shutter.h"

namespace lararium::train {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;
using PoseManifold =
    ceres::ProductManifold<ceres::EigenQuaternionManifold, ceres::EuclideanManifold<3>>;

// Standard deviations of what is assumed of a camera: of the principal point where it is not
// estimated, as a share of the longer side, and of the ratio of the focal lengths.
constexpr double kCentreDoubt = 0.005;
constexpr double kAspectDoubt = 0.0005;

using Matrix2xIntrinsics = Eigen::Matrix<double, 2, kIntrinsics, Eigen::RowMajor>;
using Matrix2x3 = Eigen::Matrix<double, 2, 3, Eigen::RowMajor>;
using Matrix2x7 = Eigen::Matrix<double, 2, 7, Eigen::RowMajor>;

CameraModel WithIntrinsics(CameraModel camera, const IntrinsicsBlock& block) {
  camera.fy *= block[0] / camera.fx;
  camera.fx = block[0];
  camera.k1 = block[1];
  camera.k2 = block[2];
  camera.cx = block[3];
  camera.cy = block[4];
  return camera;
}

// Indices of the parameters that are not adjusted.
std::vector<int> ConstantIntrinsics(const TrainingCamera& camera, const BundleOptions& options) {
  std::vector<int> constant;
  const bool refine_lens = options.refine_intrinsics && !camera.given;
  for (int i = 0; i < kIntrinsics; ++i) {
    const bool refined = i < 1   ? refine_lens
                         : i < 3 ? refine_lens && options.refine_radial
                         : i < 5 ? refine_lens && options.refine_centre
                                 : options.refine_readout;
    if (!refined) {
      constant.push_back(i);
    }
  }
  return constant;
}

class ReprojectionCost : public ceres::SizedCostFunction<2, kIntrinsics, 7, 3> {
 public:
  ReprojectionCost(const CameraModel& fixed,
                   const ImageMotion& motion,
                   const Eigen::Vector2d& pixel)
      : fixed_(fixed), motion_(motion), pixel_(pixel) {}

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    return ReprojectionResidual(fixed_, motion_, pixel_, parameters[0], parameters[1],
                                parameters[2], residuals,
                                jacobians != nullptr ? jacobians[0] : nullptr,
                                jacobians != nullptr ? jacobians[1] : nullptr,
                                jacobians != nullptr ? jacobians[2] : nullptr);
  }

 private:
  const CameraModel& fixed_;
  ImageMotion motion_;
  Eigen::Vector2d pixel_;
};

// Like ReprojectionCost, for an image that the camera of the intrinsics took in another way: pixel
// and pose are turned to how that camera sees.
class TurnedReprojectionCost : public ceres::SizedCostFunction<2, kIntrinsics, 7, 3> {
 public:
  // pixel: of an image of the camera `turned`, which has the lens of `camera`.
  TurnedReprojectionCost(const TrainingCamera& camera,
                         const TrainingCamera& turned,
                         const Eigen::Vector2d& pixel)
      : fixed_(camera.model), pixel_(TurnedPixel(turned, camera, pixel)) {
    const double angle = 0.5 * std::numbers::pi * QuarterTurns(turned, camera);
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
    for (int i = 0; i < 4; ++i) {  // The product with a quaternion is linear in it.
      Eigen::Quaterniond unit(Eigen::Vector4d(Eigen::Vector4d::Unit(i)));
      turn_.block<4, 1>(0, i) = (turn * unit).coeffs();
    }
    turn_.bottomRightCorner<3, 3>() = turn.toRotationMatrix();
  }

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    const Vector7 pose = turn_ * Eigen::Map<const Vector7>(parameters[1]);
    Matrix2x7 by_pose;
    double* const wanted = jacobians != nullptr ? jacobians[1] : nullptr;
    const bool possible = ReprojectionResidual(
        fixed_, ImageMotion::Zero(), pixel_, parameters[0], pose.data(), parameters[2], residuals,
        jacobians != nullptr ? jacobians[0] : nullptr, wanted != nullptr ? by_pose.data() : nullptr,
        jacobians != nullptr ? jacobians[2] : nullptr);
    if (possible && wanted != nullptr) {
      Eigen::Map<Matrix2x7> jacobian(wanted);
      jacobian = by_pose * turn_;
    }
    return possible;
  }

 private:
  using Vector7 = Eigen::Matrix<double, 7, 1>;

  const CameraModel& fixed_;
  Eigen::Vector2d pixel_;
  // Turns a PoseBlock.
  Eigen::Matrix<double, 7, 7> turn_ = Eigen::Matrix<double, 7, 7>::Zero();
};

// ReprojectionCost for an image in which autofocus has moved the lens. The second block is
// the logarithm of the ratio of the focal lengths.
class BreathingReprojectionCost : public ceres::SizedCostFunction<2, kIntrinsics, 1, 7, 3> {
 public:
  BreathingReprojectionCost(const CameraModel& fixed,
                            const ImageMotion& motion,
                            const Eigen::Vector2d& pixel)
      : of_moved_lens_(fixed, motion, pixel) {}

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    IntrinsicsBlock moved;
    std::copy_n(parameters[0], kIntrinsics, moved.begin());
    const double ratio = std::exp(parameters[1][0]);
    moved[0] *= ratio;
    const std::array<const double*, 3> blocks = {moved.data(), parameters[2], parameters[3]};
    if (jacobians == nullptr) {
      return of_moved_lens_.Evaluate(blocks.data(), residuals, nullptr);
    }
    Matrix2xIntrinsics by_moved;
    std::array<double*, 3> by_blocks = {by_moved.data(), jacobians[2], jacobians[3]};
    if (!of_moved_lens_.Evaluate(blocks.data(), residuals, by_blocks.data())) {
      return false;
    }
    if (jacobians[1] != nullptr) {
      Eigen::Map<Eigen::Vector2d> by_breath(jacobians[1]);
      by_breath = moved[0] * by_moved.col(0);
    }
    if (jacobians[0] != nullptr) {
      Eigen::Map<Matrix2xIntrinsics> by_lens(jacobians[0]);
      by_lens = by_moved;
      by_lens.col(0) *= ratio;
    }
    return true;
  }

 private:
  ReprojectionCost of_moved_lens_;
};

// Between two images, autofocus moves little: a random walk.
class BreathingStepCost : public ceres::SizedCostFunction<1, 1, 1> {
 public:
  explicit BreathingStepCost(double frames) {
    constexpr double kStep = 0.004;  // Standard deviation of the change in one frame time.
    weight_ = 1.0 / (kStep * std::sqrt(std::max(frames, 1.0)));
  }

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    residuals[0] = weight_ * (parameters[1][0] - parameters[0][0]);
    for (const int i : {0, 1}) {
      if (jacobians != nullptr && jacobians[i] != nullptr) {
        jacobians[i][0] = i == 0 ? -weight_ : weight_;
      }
    }
    return true;
  }

 private:
  double weight_ = 0.0;
};

// The intrinsics are those of the mean focal length.
class MeanBreathCost : public ceres::CostFunction {
 public:
  explicit MeanBreathCost(size_t images) {
    set_num_residuals(1);
    mutable_parameter_block_sizes()->assign(images, 1);
  }

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    const size_t images = parameter_block_sizes().size();
    const double weight = 1.0 / (kDoubt * static_cast<double>(images));
    residuals[0] = 0.0;
    for (size_t i = 0; i < images; ++i) {
      residuals[0] += weight * parameters[i][0];
      if (jacobians != nullptr && jacobians[i] != nullptr) {
        jacobians[i][0] = weight;
      }
    }
    return true;
  }

 private:
  static constexpr double kDoubt = 1e-5;
};

// What is known of a camera without looking at the images: its focal length to a share, and that
// lenses distort little. Keeps the intrinsics of a camera plausible that took only few images.
class PriorCost : public ceres::SizedCostFunction<3, kIntrinsics> {
 public:
  explicit PriorCost(const TrainingCamera& camera) {
    constexpr double kUnknownFocalDoubt = 0.4;
    known_focal_ = camera.FocalKnown() ? camera.known_focal_px : camera.model.fx;
    focal_weight_ = 1.0 / (camera.FocalKnown() ? camera.focal_doubt : kUnknownFocalDoubt);
  }

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    constexpr double kRadialWeight = 1.0 / 0.15;
    const double* intrinsics = parameters[0];
    if (!(intrinsics[0] > 0.0)) {
      return false;
    }
    residuals[0] = focal_weight_ * std::log(intrinsics[0] / known_focal_);
    residuals[1] = kRadialWeight * intrinsics[1];
    residuals[2] = kRadialWeight * intrinsics[2];
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, 3, kIntrinsics, Eigen::RowMajor>> jacobian(jacobians[0]);
      jacobian.setZero();
      jacobian(0, 0) = focal_weight_ / intrinsics[0];
      jacobian(1, 1) = jacobian(2, 2) = kRadialWeight;
    }
    return true;
  }

 private:
  double known_focal_ = 0.0;
  double focal_weight_ = 0.0;
};

// A ceres::Problem together with its parameter blocks.
class Bundle {
 public:
  Bundle(std::span<const TrainingCamera> cameras,
         const Eigen::Vector2d& readout,
         const BundleOptions& options)
      : options_(options),
        cameras_(cameras.begin(), cameras.end()),
        loss_(options.loss_scale_px),
        problem_(BorrowingOptions()),
        manifolds_(cameras.size()) {
    for (const TrainingCamera& camera : cameras_) {
      intrinsics_.push_back(ToIntrinsicsBlock(camera.model, readout));
    }
    for (size_t i = 0; i < cameras_.size(); ++i) {
      double* block = intrinsics_[i].data();
      problem_.AddParameterBlock(block, kIntrinsics);
      const std::vector<int> constant = ConstantIntrinsics(cameras_[i], options);
      if (cameras_[i].lens_of || constant.size() == kIntrinsics) {
        problem_.SetParameterBlockConstant(block);
      } else if (!constant.empty()) {
        manifolds_[i].emplace(kIntrinsics, constant);
        problem_.SetManifold(block, &*manifolds_[i]);
      }
    }
    breaths_.reserve(cameras_.size());
    for (const TrainingCamera& camera : cameras_) {
      breaths_.push_back(std::log(camera.focal_ratio.value_or(1.0)));
      if (camera.focal_ratio) {
        double* block = &breaths_.back();
        problem_.AddParameterBlock(block, 1);
        if (!options.refine_breathing) {
          problem_.SetParameterBlockConstant(block);
        }
      }
    }
  }
  Bundle(const Bundle&) = delete;
  Bundle& operator=(const Bundle&) = delete;

  // Must be called before blocks are added, so that pointers to blocks stay valid.
  void Reserve(size_t poses, size_t points) {
    poses_.reserve(poses);
    points_.reserve(points);
  }

  double* AddPose(const Rigid3& pose, bool variable) {
    CHECK(poses_.size() < poses_.capacity());
    double* block = poses_.emplace_back(ToPoseBlock(pose)).data();
    problem_.AddParameterBlock(block, 7, &pose_manifold_);
    if (!variable) {
      problem_.SetParameterBlockConstant(block);
    }
    return block;
  }

  double* AddPoint(const Eigen::Vector3d& point, bool variable) {
    CHECK(points_.size() < points_.capacity());
    double* block = points_.emplace_back(point).data();
    problem_.AddParameterBlock(block, 3);
    if (!variable) {
      problem_.SetParameterBlockConstant(block);
    }
    return block;
  }

  // The problem owns its cost functions.
  void AddObservation(uint32_t camera,
                      const ImageMotion& motion,
                      const Eigen::Vector2d& pixel,
                      double* pose,
                      double* point) {
    const uint32_t lens = LensOf(cameras_, camera);
    if (cameras_[camera].focal_ratio) {
      problem_.AddResidualBlock(new BreathingReprojectionCost(cameras_[lens].model, motion, pixel),
                                &loss_, intrinsics_[lens].data(), &breaths_[camera], pose, point);
      return;
    }
    ceres::CostFunction* cost = nullptr;
    if (lens == camera) {
      cost = new ReprojectionCost(cameras_[camera].model, motion, pixel);
    } else {
      cost = new TurnedReprojectionCost(cameras_[lens], cameras_[camera], pixel);
    }
    problem_.AddResidualBlock(cost, &loss_, intrinsics_[lens].data(), pose, point);
  }

  // Adds what is known of the cameras whose intrinsics are adjusted.
  void AddPriors() {
    for (size_t i = 0; i < cameras_.size(); ++i) {
      if (!problem_.IsParameterBlockConstant(intrinsics_[i].data())) {
        problem_.AddResidualBlock(new PriorCost(cameras_[i]), nullptr, intrinsics_[i].data());
      }
    }
  }

  // Adds what is known of how autofocus moves between images; cameras and their times are in the
  // order of the film. Intrinsics that are adjusted are those of the mean focal length.
  void AddBreathing(std::span<const uint32_t> cameras, std::span<const double> times) {
    std::vector<double*> blocks;
    for (size_t i = 0; i < cameras.size(); ++i) {
      blocks.push_back(&breaths_[cameras[i]]);
      if (i > 0) {
        problem_.AddResidualBlock(new BreathingStepCost(times[i] - times[i - 1]), nullptr,
                                  blocks[i - 1], blocks[i]);
      }
    }
    if (options_.refine_intrinsics) {
      problem_.AddResidualBlock(new MeanBreathCost(blocks.size()), nullptr, blocks);
    }
  }

  bool Solve() {
    ceres::Solver::Options options;
    options.max_num_iterations = options_.max_iterations;
    options.function_tolerance = options_.function_tolerance;
    options.num_threads = 1;  // Several threads would not give reproducible bits.
    options.logging_type = ceres::SILENT;
    constexpr size_t kMaxDensePoses = 250;
    options.linear_solver_type = poses_.size() == 1                ? ceres::DENSE_QR
                                 : poses_.size() <= kMaxDensePoses ? ceres::DENSE_SCHUR
                                                                   : ceres::SPARSE_SCHUR;
    if (poses_.size() > 1) {
      options.linear_solver_ordering = PointsFirst();
    }
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    return summary.IsSolutionUsable();
  }

  std::span<const TrainingCamera> cameras() const { return cameras_; }
  // The intrinsics of a camera with a lens of its own.
  double* intrinsics(size_t camera) { return intrinsics_[camera].data(); }
  CameraModel camera(size_t i) const { return WithIntrinsics(cameras_[i].model, intrinsics_[i]); }
  // Whether the intrinsics are those of a camera, where it has images.
  bool Possible(size_t i) const {
    TrainingCamera adjusted = cameras_[i];
    adjusted.model = camera(i);
    return ModelOfArea(adjusted).Validate().ok();
  }
  // A rolling shutter is that of the only camera.
  Eigen::Vector2d readout() const { return {intrinsics_[0][5], intrinsics_[0][6]}; }
  double focal_ratio(size_t camera) const { return std::exp(breaths_[camera]); }
  Rigid3 pose(size_t i) const { return ToPose(poses_[i]); }
  const Eigen::Vector3d& point(size_t i) const { return points_[i]; }
  ceres::Problem& problem() { return problem_; }
  // All blocks that are not constant: intrinsics, breathing, poses, points.
  std::vector<double*> VariableBlocks() {
    std::vector<double*> blocks;
    for (IntrinsicsBlock& camera : intrinsics_) {
      blocks.push_back(camera.data());
    }
    for (size_t i = 0; i < cameras_.size(); ++i) {
      if (cameras_[i].focal_ratio) {
        blocks.push_back(&breaths_[i]);
      }
    }
    for (PoseBlock& pose : poses_) {
      blocks.push_back(pose.data());
    }
    for (Eigen::Vector3d& point : points_) {
      blocks.push_back(point.data());
    }
    std::erase_if(blocks, [&](double* block) { return problem_.IsParameterBlockConstant(block); });
    return blocks;
  }

 private:
  static ceres::Problem::Options BorrowingOptions() {
    ceres::Problem::Options options;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.disable_all_safety_checks = true;
    return options;
  }

  // Elimination order: points first. Within a group, Ceres orders blocks by address, which follows
  // the index in a vector. The intrinsics get a group of their own.
  std::shared_ptr<ceres::ParameterBlockOrdering> PointsFirst() {
    auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    for (Eigen::Vector3d& point : points_) {
      ordering->AddElementToGroup(point.data(), 0);
    }
    for (PoseBlock& pose : poses_) {
      ordering->AddElementToGroup(pose.data(), 1);
    }
    for (size_t i = 0; i < cameras_.size(); ++i) {
      if (cameras_[i].focal_ratio) {
        ordering->AddElementToGroup(&breaths_[i], 1);
      }
      ordering->AddElementToGroup(intrinsics_[i].data(), 2);
    }
    return ordering;
  }

  BundleOptions options_;
  std::vector<TrainingCamera> cameras_;
  ceres::CauchyLoss loss_;
  PoseManifold pose_manifold_;
  ceres::Problem problem_;
  // [camera]: Set if some of its intrinsics are not adjusted.
  std::vector<std::optional<ceres::SubsetManifold>> manifolds_;
  std::vector<IntrinsicsBlock> intrinsics_;  // [camera]
  // [camera]: Logarithm of its focal_ratio. Blocks of the problem only where that is set.
  std::vector<double> breaths_;
  std::vector<PoseBlock> poses_;
  std::vector<Eigen::Vector3d> points_;
};

// The most observed of the tracks, as many as each image needs to see points_per_image of them; in
// order of index.
std::vector<uint32_t> ThinOut(const Reconstruction& reconstruction,
                              std::vector<uint32_t> tracks,
                              size_t points_per_image) {
  std::stable_sort(tracks.begin(), tracks.end(), [&](uint32_t a, uint32_t b) {
    return reconstruction.ObservationCount(a) > reconstruction.ObservationCount(b);
  });
  std::vector<size_t> seen(reconstruction.image_count(), 0);
  std::erase_if(tracks, [&](uint32_t track) {
    const std::vector<uint32_t> observations = reconstruction.Observations(track);
    const bool needed = std::any_of(observations.begin(), observations.end(), [&](uint32_t e) {
      return seen[reconstruction.ImageOf(e)] < points_per_image;
    });
    for (const uint32_t element : observations) {
      seen[reconstruction.ImageOf(element)] += needed ? 1 : 0;
    }
    return !needed;
  });
  std::sort(tracks.begin(), tracks.end());
  return tracks;
}

// A bundle of the points of tracks and of all images that observe them. Only the poses of the
// images in `variable` may change. Points with more than firm_observations observations stay fixed,
// too.
struct ReconstructionBundle {
  ReconstructionBundle(const Reconstruction& reconstruction,
                       std::vector<uint32_t> bundled_tracks,
                       const std::vector<bool>& variable,  // [image]
                       const BundleOptions& options,
                       size_t firm_observations = std::numeric_limits<size_t>::max())
      : bundle(reconstruction.cameras(), reconstruction.readout(), options),
        tracks(std::move(bundled_tracks)) {
    bundle.Reserve(reconstruction.image_count(), tracks.size());
    std::vector<double*> poses(reconstruction.image_count(), nullptr);
    for (const uint32_t track : tracks) {
      const std::vector<uint32_t> observations = reconstruction.Observations(track);
      const bool firm = observations.size() > firm_observations;
      double* point = bundle.AddPoint(reconstruction.Point(track), !firm);
      for (const uint32_t element : observations) {
        const uint32_t image = reconstruction.ImageOf(element);
        if (firm && !variable[image]) {
          continue;
        }
        if (poses[image] == nullptr) {
          poses[image] = bundle.AddPose(reconstruction.camera_from_map(image), variable[image]);
          images.push_back(image);
        }
        elements.push_back(element);
        bundle.AddObservation(reconstruction.CameraOf(image), reconstruction.motion(image),
                              reconstruction.Pixel(element), poses[image], point);
      }
    }
    if (options.refine_breathing) {
      bundle.AddBreathing(reconstruction.camera_of_image(), reconstruction.times());
    }
    // One camera that took all images needs no help.
    if (LensCount(bundle.cameras()) > 1) {
      bundle.AddPriors();
    }
  }

  void WriteTo(Reconstruction& reconstruction) const {
    for (size_t i = 0; i < images.size(); ++i) {
      reconstruction.Locate(images[i], bundle.pose(i));
    }
    for (size_t i = 0; i < tracks.size(); ++i) {
      reconstruction.MovePoint(tracks[i], bundle.point(i));
    }
  }

  Bundle bundle;
  std::vector<uint32_t> tracks;
  std::vector<uint32_t> images;    // Parallel to the bundle's poses.
  std::vector<uint32_t> elements;  // Track elements in the order of their residuals.
};

// The normal equations of a Jacobian without its points (Schur complement), which are small; their
// lower triangle. The columns up to `kept` are intrinsics and poses; three for each point follow.
// The rows of a point follow one another.
Eigen::MatrixXd WithoutPoints(const ceres::CRSMatrix& jacobian, int kept) {
  constexpr int kPose = 6;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(kept, kept);
  // The normal matrix of the present point, and its rows of the normal equations, by kept columns.
  // A block is a run of columns, as those of a pose.
  struct Block {
    int column = 0;
    int index = 0;  // Index of its first row in across.
    int size = 0;
  };
  int point = -1;
  Eigen::Matrix3d of_point = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, Eigen::Dynamic, 3> across(kept, 3);
  std::vector<Block> blocks;
  std::vector<int> place(static_cast<size_t>(kept), -1);  // [column]: Row of across.
  int used = 0;  // The number of rows of across that are in use.
  const auto eliminate = [&] {
    const Eigen::Matrix3d inverse = of_point.inverse();
    if (inverse.allFinite()) {
      const Eigen::Matrix<double, Eigen::Dynamic, 3> solved = across.topRows(used) * inverse;
      for (const Block& i : blocks) {
        for (const Block& j : blocks) {
          if (i.column < j.column) {
            continue;
          }
          if (i.size == kPose && j.size == kPose) {  // The compiler knows this size.
            normal.block<kPose, kPose>(i.column, j.column).noalias() -=
                solved.middleRows<kPose>(i.index) * across.middleRows<kPose>(j.index).transpose();
          } else {
            normal.block(i.column, j.column, i.size, j.size) -=
                solved.middleRows(i.index, i.size)
                    .lazyProduct(across.middleRows(j.index, j.size).transpose());
          }
        }
      }
    }
    for (const Block& block : blocks) {
      std::fill_n(place.begin() + block.column, block.size, -1);
    }
    blocks.clear();
    used = 0;
    of_point.setZero();
  };
  for (int row = 0; row < jacobian.num_rows; ++row) {
    const auto begin = static_cast<size_t>(jacobian.rows[row]);
    const auto end = static_cast<size_t>(jacobian.rows[row + 1]);
    Eigen::RowVector3d by_point = Eigen::RowVector3d::Zero();
    int of_row = -1;
    for (size_t i = begin; i < end; ++i) {
      if (jacobian.cols[i] >= kept) {
        of_row = (jacobian.cols[i] - kept) / 3;
        by_point[(jacobian.cols[i] - kept) % 3] = jacobian.values[i];
      }
    }
    if (of_row != point) {
      CHECK(of_row > point || of_row < 0);
      eliminate();
      point = of_row;
    }
    of_point += by_point.transpose() * by_point;
    for (size_t i = begin; i < end; ++i) {
      const int column = jacobian.cols[i];
      if (column >= kept) {
        continue;
      }
      for (size_t j = begin; j < end; ++j) {
        if (jacobian.cols[j] <= column) {
          normal(column, jacobian.cols[j]) += jacobian.values[i] * jacobian.values[j];
        }
      }
      int& index = place[static_cast<size_t>(column)];
      if (index < 0) {
        index = used++;
        across.row(index).setZero();
        if (!blocks.empty() && blocks.back().size < kPose &&
            column == blocks.back().column + blocks.back().size) {
          ++blocks.back().size;
        } else {
          blocks.push_back({column, index, 1});
        }
      }
      across.row(index) += jacobian.values[i] * by_point;
    }
  }
  eliminate();
  // The unit of length is not determined. It does not affect the intrinsics, so a little damping
  // makes the equations solvable without changing the result.
  normal.diagonal() *= 1.0 + 1e-9;
  return normal;
}

// By how much each residual moves the estimates of parameters, [residual][parameter]: the product
// of the Jacobian and columns of the inverse normal equations. columns hold the part of these that
// belongs to intrinsics and poses; that of the points follows from it. The rows of a point follow
// one another.
Eigen::MatrixXd Influences(const ceres::CRSMatrix& jacobian, const Eigen::MatrixXd& columns) {
  const auto kept = static_cast<int>(columns.rows());
  Eigen::MatrixXd influences = Eigen::MatrixXd::Zero(jacobian.num_rows, columns.cols());
  Eigen::Matrix<double, Eigen::Dynamic, 3> by_point =
      Eigen::Matrix<double, Eigen::Dynamic, 3>::Zero(jacobian.num_rows, 3);
  std::vector<int> point(static_cast<size_t>(jacobian.num_rows), -1);
  for (int row = 0; row < jacobian.num_rows; ++row) {
    const auto index = static_cast<size_t>(row);
    for (auto i = static_cast<size_t>(jacobian.rows[index]);
         i < static_cast<size_t>(jacobian.rows[index + 1]); ++i) {
      if (jacobian.cols[i] < kept) {
        influences.row(row) += jacobian.values[i] * columns.row(jacobian.cols[i]);
      } else {
        point[index] = (jacobian.cols[i] - kept) / 3;
        by_point(row, (jacobian.cols[i] - kept) % 3) = jacobian.values[i];
      }
    }
  }
  for (int begin = 0; begin < jacobian.num_rows;) {
    int end = begin + 1;
    while (end < jacobian.num_rows &&
           point[static_cast<size_t>(end)] == point[static_cast<size_t>(begin)]) {
      ++end;
    }
    const auto rows = by_point.middleRows(begin, end - begin);
    const Eigen::Matrix3d inverse = (rows.transpose() * rows).inverse();
    if (point[static_cast<size_t>(begin)] >= 0 && inverse.allFinite()) {
      auto of_point = influences.middleRows(begin, end - begin);
      const Eigen::MatrixXd moved = inverse * (rows.transpose() * of_point);
      of_point -= rows * moved;
    }
    begin = end;
  }
  return influences;
}

// The normal equations of a map, and which column is which parameter of a camera.
struct MapEquations {
  MapEquations(const Reconstruction& reconstruction, uint32_t anchor, BundleOptions options)
      : bundle(reconstruction,
               reconstruction.TracksWithPoints(),
               AllBut(reconstruction.image_count(), anchor),
               WithAllPoints(options)) {
    ceres::Problem& problem = bundle.bundle.problem();
    ceres::Problem::EvaluateOptions evaluate;
    evaluate.parameter_blocks = bundle.bundle.VariableBlocks();
    double cost = 0.0;
    if (!problem.Evaluate(evaluate, &cost, &residuals, nullptr, &jacobian) ||
        jacobian.num_rows <= jacobian.num_cols) {
      return;
    }
    variance = 2.0 * cost / (jacobian.num_rows - jacobian.num_cols);
    normal.compute(
        WithoutPoints(jacobian, jacobian.num_cols - 3 * static_cast<int>(bundle.tracks.size())));
    solved = normal.info() == Eigen::Success;
    // The intrinsics are the first blocks.
    for (size_t camera = 0; camera < reconstruction.cameras().size(); ++camera) {
      if (problem.IsParameterBlockConstant(bundle.bundle.intrinsics(camera))) {
        continue;
      }
      const std::vector<int> constant =
          ConstantIntrinsics(reconstruction.cameras()[camera], options);
      for (int i = 0; i < kIntrinsics; ++i) {
        if (std::find(constant.begin(), constant.end(), i) == constant.end()) {
          parameters.push_back({camera, static_cast<size_t>(i)});
        }
      }
    }
  }

  // A column of the inverse, without the rows of points.
  Eigen::VectorXd Column(size_t parameter) const {
    return normal.solve(Eigen::VectorXd::Unit(normal.rows(), static_cast<Eigen::Index>(parameter)));
  }

  struct Parameter {
    size_t camera = 0;
    size_t intrinsic = 0;  // Index into an IntrinsicsBlock.
  };

  ReconstructionBundle bundle;
  ceres::CRSMatrix jacobian;
  std::vector<double> residuals;
  std::vector<Parameter> parameters;  // The first columns are their derivatives.
  Eigen::LDLT<Eigen::MatrixXd> normal;
  double variance = 0.0;  // The variance of the residuals.
  bool solved = false;

 private:
  static std::vector<bool> AllBut(size_t images, uint32_t anchor) {
    std::vector<bool> variable(images, true);
    variable[anchor] = false;
    return variable;
  }
  static BundleOptions WithAllPoints(BundleOptions options) {
    options.points_per_image = 0;
    return options;
  }
};

double& DeviationOf(IntrinsicsDeviation& deviation, size_t intrinsic) {
  const std::array<double*, kIntrinsics> all = {
      &deviation.focal_px, &deviation.k1,        &deviation.k2,       &deviation.cx_px,
      &deviation.cy_px,    &deviation.readout_x, &deviation.readout_y};
  return *all[intrinsic];
}

// Triangulates all points again except those of tracks, which are ascending.
void IntersectOthers(Reconstruction& reconstruction, std::span<const uint32_t> tracks) {
  for (const uint32_t track : reconstruction.TracksWithPoints()) {
    if (!std::binary_search(tracks.begin(), tracks.end(), track)) {
      reconstruction.Reintersect(track);
    }
  }
}

// Scales the map about the first anchor's camera, so that the second one is at the given distance.
void RestoreUnit(Reconstruction& reconstruction,
                 const std::array<uint32_t, 2>& anchors,
                 double distance) {
  const Eigen::Vector3d center = reconstruction.camera_from_map(anchors[0]).Center();
  const double now = (reconstruction.camera_from_map(anchors[1]).Center() - center).norm();
  if (!(now > 0.0)) {
    return;
  }
  geometry::Similarity3 restored_from_map;
  restored_from_map.scale = distance / now;
  restored_from_map.translation = (1.0 - restored_from_map.scale) * center;
  reconstruction.Transform(restored_from_map);
}

}  // namespace

PoseBlock ToPoseBlock(const Rigid3& pose) {
  PoseBlock block;
  Eigen::Map<Eigen::Vector4d>(block.data()) = pose.rotation.coeffs();
  Eigen::Map<Eigen::Vector3d>(block.data() + 4) = pose.translation;
  return block;
}

Rigid3 ToPose(const PoseBlock& block) {
  Rigid3 pose;
  pose.rotation.coeffs() = Eigen::Map<const Eigen::Vector4d>(block.data());
  pose.rotation.normalize();
  pose.translation = Eigen::Map<const Eigen::Vector3d>(block.data() + 4);
  return pose;
}

IntrinsicsBlock ToIntrinsicsBlock(const CameraModel& camera, const Eigen::Vector2d& readout) {
  return {camera.fx, camera.k1, camera.k2, camera.cx, camera.cy, readout.x(), readout.y()};
}

bool ReprojectionResidual(const CameraModel& fixed,
                          const ImageMotion& motion,
                          const Eigen::Vector2d& pixel,
                          const double* intrinsics,
                          const double* pose,
                          const double* point,
                          double* residual,
                          double* by_intrinsics,
                          double* by_pose,
                          double* by_point) {
  const Eigen::Map<const Eigen::Vector3d> v(pose);  // The quaternion is (v, w).
  const double w = pose[3];
  const Eigen::Map<const Eigen::Vector3d> translation(pose + 4);
  const Eigen::Map<const Eigen::Vector3d> in_map(point);
  const Eigen::Vector3d cross = v.cross(in_map);
  const Eigen::Vector3d of_middle = in_map + 2.0 * (w * cross + v.cross(cross)) + translation;
  // The point when its pixel was exposed, by the motion to second order.
  const Eigen::Vector2d order = vision::ReadoutOrder(fixed, pixel);
  const double time = intrinsics[5] * order.x() + intrinsics[6] * order.y();
  const Eigen::Matrix3d turning = geometry::Skew(motion.head<3>());
  const Eigen::Matrix3d turned =
      Eigen::Matrix3d::Identity() + time * turning + 0.5 * time * time * turning * turning;
  const Eigen::Vector3d in_camera = turned * of_middle + time * motion.tail<3>();
  if (!(in_camera.z() > 1e-9)) {
    return false;
  }
  const double inverse_z = 1.0 / in_camera.z();
  const double x = in_camera.x() * inverse_z;
  const double y = in_camera.y() * inverse_z;
  const double fx = intrinsics[0];
  const double fy = fx * (fixed.fy / fixed.fx);
  const CameraModel lens = {.fx = 1.0,
                            .fy = 1.0,
                            .k1 = intrinsics[1],
                            .k2 = intrinsics[2],
                            .p1 = fixed.p1,
                            .p2 = fixed.p2};
  Eigen::Matrix2d by_plane;
  const Eigen::Vector2d distorted = lens.PixelFromPlane({x, y}, by_plane);
  residual[0] = fx * distorted.x() + intrinsics[3] - pixel.x();
  residual[1] = fy * distorted.y() + intrinsics[4] - pixel.y();

  if (by_intrinsics == nullptr && by_pose == nullptr && by_point == nullptr) {
    return true;
  }
  by_plane.row(0) *= fx;
  by_plane.row(1) *= fy;
  Matrix2x3 by_camera;
  by_camera.leftCols<2>() = by_plane * inverse_z;
  by_camera.col(2) = by_plane * Eigen::Vector2d(-x, -y) * inverse_z;
  if (by_intrinsics != nullptr) {
    Eigen::Map<Matrix2xIntrinsics> jacobian(by_intrinsics);
    const double r2 = x * x + y * y;
    jacobian.leftCols<5>() << distorted.x(), fx * x * r2, fx * x * r2 * r2, 1.0, 0.0,  //
        fy / fx * distorted.y(), fy * y * r2, fy * y * r2 * r2, 0.0, 1.0;
    const Eigen::Vector3d speed =
        (turning + time * turning * turning) * of_middle + motion.tail<3>();
    jacobian.rightCols<2>() = by_camera * speed * order.transpose();
  }
  // From here on the derivative is that by the point when the middle of the image was exposed.
  by_camera = (by_camera * turned).eval();
  if (by_pose != nullptr) {
    // R X = X + 2 w (v x X) + 2 v x (v x X), and v x (v x X) = v (v.X) - X (v.v).
    Eigen::Map<Matrix2x7> jacobian(by_pose);
    const Eigen::Matrix3d by_v =
        2.0 * (v.dot(in_map) * Eigen::Matrix3d::Identity() + v * in_map.transpose() -
               2.0 * in_map * v.transpose() - w * geometry::Skew(in_map));
    jacobian.leftCols<3>() = by_camera * by_v;
    jacobian.col(3) = by_camera * (2.0 * cross);
    jacobian.rightCols<3>() = by_camera;
  }
  if (by_point != nullptr) {
    const Eigen::Matrix3d rotation = Eigen::Map<const Eigen::Quaterniond>(pose).toRotationMatrix();
    Eigen::Map<Matrix2x3> jacobian(by_point);
    jacobian = by_camera * rotation;
  }
  return true;
}

bool AdjustAll(Reconstruction& reconstruction,
               const std::array<uint32_t, 2>& anchors,
               const BundleOptions& options) {
  std::vector<bool> variable(reconstruction.image_count(), true);
  variable[anchors[0]] = false;
  const double distance = (reconstruction.camera_from_map(anchors[0]).Center() -
                           reconstruction.camera_from_map(anchors[1]).Center())
                              .norm();
  std::vector<uint32_t> tracks = reconstruction.TracksWithPoints();
  if (options.points_per_image > 0) {
    tracks = ThinOut(reconstruction, std::move(tracks), options.points_per_image);
  }
  ReconstructionBundle adjusted(reconstruction, std::move(tracks), variable, options);
  if (adjusted.tracks.empty() || !adjusted.bundle.Solve()) {
    return false;
  }
  if (options.refine_intrinsics) {
    std::vector<uint32_t> lenses;
    for (uint32_t i = 0; i < adjusted.bundle.cameras().size(); ++i) {
      if (LensOf(adjusted.bundle.cameras(), i) == i) {
        lenses.push_back(i);
      }
    }
    for (const uint32_t lens : lenses) {
      if (!adjusted.bundle.Possible(lens)) {
        return false;
      }
    }
    for (const uint32_t lens : lenses) {
      reconstruction.SetCamera(lens, adjusted.bundle.camera(lens));
    }
  }
  if (options.refine_breathing) {
    std::vector<double> ratios;
    for (uint32_t image = 0; image < reconstruction.image_count(); ++image) {
      ratios.push_back(adjusted.bundle.focal_ratio(reconstruction.CameraOf(image)));
    }
    reconstruction.SetFocalRatios(ratios);
  }
  if (options.refine_readout) {
    reconstruction.SetReadout(adjusted.bundle.readout());
  }
  adjusted.WriteTo(reconstruction);
  if (options.points_per_image > 0) {
    IntersectOthers(reconstruction, adjusted.tracks);
  }
  RestoreUnit(reconstruction, anchors, distance);
  return true;
}

bool AdjustLocally(Reconstruction& reconstruction,
                   std::span<const uint32_t> images,
                   const BundleOptions& options) {
  CHECK(!images.empty() && !options.refine_intrinsics && !options.refine_readout);
  std::vector<bool> variable(reconstruction.image_count(), false);
  for (const uint32_t image : images) {
    variable[image] = true;
  }
  std::vector<uint32_t> tracks;
  for (const uint32_t element : reconstruction.ElementsOf(images.front())) {
    if (reconstruction.Observed(element)) {
      tracks.push_back(reconstruction.TrackOf(element));
    }
  }
  if (options.points_per_image > 0 && tracks.size() > options.points_per_image) {
    std::stable_sort(tracks.begin(), tracks.end(), [&](uint32_t a, uint32_t b) {
      return reconstruction.ObservationCount(a) > reconstruction.ObservationCount(b);
    });
    tracks.resize(options.points_per_image);
    std::sort(tracks.begin(), tracks.end());
  }
  // One more image hardly moves a point with this many observations.
  constexpr size_t kFirmObservations = 10;
  ReconstructionBundle adjusted(reconstruction, std::move(tracks), variable, options,
                                kFirmObservations);
  if (adjusted.tracks.empty() || !adjusted.bundle.Solve()) {
    return false;
  }
  adjusted.WriteTo(reconstruction);
  return true;
}

std::optional<PosedView> AdjustView(const TrainingCamera& camera,
                                    std::span<const Eigen::Vector2d> pixels,
                                    std::span<const Eigen::Vector3d> points,
                                    const Rigid3& start,
                                    const BundleOptions& options) {
  CHECK(pixels.size() == points.size());
  TrainingCamera alone = camera;
  alone.lens_of.reset();
  Bundle bundle(std::span(&alone, 1), Eigen::Vector2d::Zero(), options);
  bundle.Reserve(1, points.size());
  double* pose = bundle.AddPose(start, true);
  for (size_t i = 0; i < pixels.size(); ++i) {
    if ((start * points[i]).z() > 1e-6) {
      bundle.AddObservation(0, ImageMotion::Zero(), pixels[i], pose,
                            bundle.AddPoint(points[i], false));
    }
  }
  bundle.AddPriors();
  if (!bundle.Solve() || !bundle.Possible(0)) {
    return std::nullopt;
  }
  return PosedView{bundle.pose(0), bundle.camera(0)};
}

std::vector<IntrinsicsDeviation> EstimateDeviations(const Reconstruction& reconstruction,
                                                    uint32_t anchor,
                                                    const BundleOptions& options) {
  std::vector<IntrinsicsDeviation> deviations(reconstruction.cameras().size());
  const MapEquations equations(reconstruction, anchor, options);
  for (size_t i = 0; equations.solved && i < equations.parameters.size(); ++i) {
    const auto [camera, intrinsic] = equations.parameters[i];
    const double variance = equations.Column(i)[static_cast<Eigen::Index>(i)] * equations.variance;
    DeviationOf(deviations[camera], intrinsic) = variance > 0.0 ? std::sqrt(variance) : 0.0;
  }
  for (uint32_t camera = 0; camera < deviations.size(); ++camera) {
    const uint32_t lens = LensOf(reconstruction.cameras(), camera);
    if (lens != camera) {
      IntrinsicsDeviation& turned = deviations[camera] = deviations[lens];
      if (QuarterTurns(reconstruction.cameras()[lens], reconstruction.cameras()[camera]) % 2 == 1) {
        std::swap(turned.cx_px, turned.cy_px);
      }
    }
  }
  return deviations;
}

IntrinsicsDeviation EstimateDeviation(const Reconstruction& reconstruction,
                                      uint32_t anchor,
                                      const BundleOptions& options) {
  IntrinsicsDeviation deviation;
  const MapEquations equations(reconstruction, anchor, options);
  const size_t main = LensOf(reconstruction.cameras(), reconstruction.MainCamera());
  const CameraModel& camera = reconstruction.cameras()[main].model;
  const double centre_doubt =
      options.refine_centre ? 0.0 : kCentreDoubt * std::max(camera.width, camera.height);
  for (size_t i = 0; equations.solved && i < equations.parameters.size(); ++i) {
    if (equations.parameters[i].camera != main) {
      continue;
    }
    const Eigen::VectorXd influences = Influences(equations.jacobian, equations.Column(i));
    // Sums over the observations of each image and each track, and over all of them for each
    // doubted parameter.
    std::vector<double> by_image(reconstruction.image_count(), 0.0);
    std::vector<double> by_track(reconstruction.tracks().size(), 0.0);
    double independent = 0.0;
    Eigen::Vector2d by_centre = Eigen::Vector2d::Zero();
    double by_aspect = 0.0;
    for (size_t o = 0; o < equations.bundle.elements.size(); ++o) {
      const uint32_t element = equations.bundle.elements[o];
      const uint32_t image = reconstruction.ImageOf(element);
      const Eigen::Vector2d influence(influences[static_cast<Eigen::Index>(2 * o)],
                                      influences[static_cast<Eigen::Index>(2 * o + 1)]);
      const Eigen::Vector2d residual(equations.residuals[2 * o], equations.residuals[2 * o + 1]);
      const double moved = influence.dot(residual);
      by_image[image] += moved;
      by_track[reconstruction.TrackOf(element)] += moved;
      independent += moved * moved;
      if (MeanCamera(reconstruction.cameras(), reconstruction.CameraOf(image)) == main) {
        // Cauchy's loss has scaled residuals and Jacobian by this.
        const double weight = std::sqrt(std::max(
            1.0 - residual.squaredNorm() / (options.loss_scale_px * options.loss_scale_px), 0.0));
        by_centre += weight * influence;
        by_aspect += weight * influence.y() * (reconstruction.Pixel(element).y() - camera.cy);
      }
    }
    const auto square = [](std::span<const double> sums) {
      return std::inner_product(sums.begin(), sums.end(), sums.begin(), 0.0);
    };
    const double shared = square(by_image) + square(by_track) - independent;
    const double variance = std::max(shared, independent) +
                            centre_doubt * centre_doubt * by_centre.squaredNorm() +
                            kAspectDoubt * kAspectDoubt * by_aspect * by_aspect;
    DeviationOf(deviation, equations.parameters[i].intrinsic) = std::sqrt(variance);
  }
  return deviation;
}

}  // namespace lararium::train
