#include "editor/train/shutter.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>

namespace lararium::train {
namespace {

using geometry::Rigid3;

constexpr double kReach = 4.0;  // Frame times before and after, whose poses tell the motion.
constexpr int kDegree = 4;

}  // namespace

void FitAgain(Reconstruction& reconstruction, const MapperOptions& mapper) {
  TriangulationOptions limits = mapper.triangulation;
  limits.max_error_px = mapper.final_max_error_px;
  for (const uint32_t track : reconstruction.TracksWithPoints()) {
    reconstruction.Complete(track, limits.max_error_px);
    reconstruction.Filter(track, limits);
  }
}

std::vector<ImageMotion> EstimateMotions(std::span<const TimedPose> poses) {
  std::vector<ImageMotion> motions(poses.size(), ImageMotion::Zero());
  for (size_t i = 0; i < poses.size(); ++i) {
    const Rigid3 map_from_camera = poses[i].camera_from_map.Inverse();
    // The linear term of the polynomial through the poses around: hands tremble so fast that a line
    // through the poses of five frames has a third less of the motion. The rows are powers of the
    // time and the way of each pose.
    Eigen::Matrix<double, Eigen::Dynamic, kDegree, 0, 4, kDegree> powers(0, kDegree);
    Eigen::Matrix<double, Eigen::Dynamic, 6, 0, 4, 6> ways(0, 6);
    // Frames before and after count in equal numbers.
    for (size_t step = 1; step <= 2; ++step) {
      if (i < step || i + step >= poses.size() || poses[i].time - poses[i - step].time > kReach ||
          poses[i + step].time - poses[i].time > kReach) {
        break;
      }
      for (const TimedPose& other : {poses[i - step], poses[i + step]}) {
        const double time = other.time - poses[i].time;
        const Rigid3 since = other.camera_from_map * map_from_camera;
        powers.conservativeResize(powers.rows() + 1, kDegree);
        ways.conservativeResize(ways.rows() + 1, 6);
        powers.bottomRows<1>() << time, time * time, std::pow(time, 3), std::pow(time, 4);
        ways.bottomRows<1>() << geometry::VectorFromRotation(since.rotation).transpose(),
            since.translation.transpose();
      }
    }
    if (powers.rows() > 0) {
      const Eigen::Index degree = powers.rows();
      const Eigen::MatrixXd solved =
          powers.leftCols(degree).colPivHouseholderQr().solve(Eigen::MatrixXd(ways));
      motions[i] = solved.row(0).transpose();
    }
  }
  return motions;
}

std::optional<Shutter> AdjustToShutter(Reconstruction& reconstruction,
                                       const InitialPair& anchors,
                                       std::vector<ImageMotion> motions,
                                       const MapperOptions& mapper,
                                       BundleOptions options,
                                       Log& log) {
  // Observations share errors, so that deviations are several times those of independent ones. No
  // sensor takes longer than a frame time, and the fastest hardly distort.
  constexpr double kSignificant = 20.0;
  constexpr double kLeast = 0.05;
  constexpr double kMost = 1.2;
  const Reconstruction before = reconstruction;
  reconstruction.SetShutter(Eigen::Vector2d::Zero(), std::move(motions));
  options.refine_readout = true;
  options.max_iterations = 50;
  bool adjusted = true;
  for (const size_t points : {size_t{600}, kFinalPointsPerImage}) {
    options.points_per_image = points;
    adjusted = adjusted && AdjustAll(reconstruction, anchors, options);
    FitAgain(reconstruction, mapper);
  }
  Shutter shutter{reconstruction.readout()};
  if (adjusted) {
    const IntrinsicsDeviation deviation =
        EstimateDeviations(reconstruction, anchors[0], options).front();
    shutter.deviation = {deviation.readout_x, deviation.readout_y};
  }
  const double longest = shutter.readout.cwiseAbs().maxCoeff();
  const bool rolls = adjusted && longest > kLeast && longest < kMost &&
                     longest > kSignificant * shutter.deviation.maxCoeff();
  log.Info("readout time along x {:.3f} +- {:.3f}, along y {:.3f} +- {:.3f} of the frame time: {}",
           shutter.readout.x(), shutter.deviation.x(), shutter.readout.y(), shutter.deviation.y(),
           rolls ? "a rolling shutter" : "not taken");
  if (!rolls) {
    reconstruction = before;
    return std::nullopt;
  }
  return shutter;
}

std::optional<double> AdjustToBreathing(Reconstruction& reconstruction,
                                        const InitialPair& anchors,
                                        std::vector<double> times,
                                        const MapperOptions& mapper,
                                        BundleOptions options,
                                        Log& log) {
  constexpr double kLeast = 0.002;
  constexpr int kRounds = 4;  // The points were made for a lens that stands still.
  const auto breath = [&] {
    const std::vector<uint32_t> images = reconstruction.LocatedImages();
    Eigen::VectorXd changes(std::ssize(images));
    for (Eigen::Index i = 0; i < changes.size(); ++i) {
      const uint32_t camera = reconstruction.CameraOf(images[static_cast<size_t>(i)]);
      changes[i] = std::log(*reconstruction.cameras()[camera].focal_ratio);
    }
    return std::sqrt((changes.array() - changes.mean()).square().mean());
  };
  const Reconstruction before = reconstruction;
  reconstruction.LetBreathe(std::move(times));
  options.refine_breathing = true;
  options.points_per_image = 150;
  options.max_iterations = 15;
  bool breathes = AdjustAll(reconstruction, anchors, options) && breath() > kLeast;
  options.max_iterations = 50;
  for (int round = 0; round < kRounds && breathes; ++round) {
    FitAgain(reconstruction, mapper);
    options.points_per_image = round + 1 == kRounds ? kFinalPointsPerImage : 600;
    breathes = AdjustAll(reconstruction, anchors, options) && breath() > kLeast;
  }
  const double change = breath();
  log.Info("autofocus has moved the focal length by {:.2f} % (root mean square): {}",
           100.0 * change, breathes ? "taken" : "not taken");
  if (!breathes) {
    reconstruction = before;
    return std::nullopt;
  }
  FitAgain(reconstruction, mapper);
  return change;
}

}  // namespace lararium::train
