#include "editor/train/shutter.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lararium::train {
namespace {

using geometry::Rigid3;

constexpr int64_t kReach = 2;  // Frames before and after, whose poses tell the motion.

void FilterAll(Reconstruction& reconstruction, const TriangulationOptions& limits) {
  for (const uint32_t track : reconstruction.TracksWithPoints()) {
    reconstruction.Complete(track, limits.max_error_px);
    reconstruction.Filter(track, limits);
  }
}

}  // namespace

std::vector<ImageMotion> EstimateMotions(std::span<const TimedPose> poses) {
  std::vector<ImageMotion> motions(poses.size(), ImageMotion::Zero());
  for (size_t i = 0; i < poses.size(); ++i) {
    const Rigid3 map_from_camera = poses[i].camera_from_map.Inverse();
    // Least squares for the linear part of a cubic: hands tremble so fast that a line through the
    // poses of five frames has a third less of the motion.
    ImageMotion first = ImageMotion::Zero();  // Sums over time^1 and time^3 times the way.
    ImageMotion third = ImageMotion::Zero();
    double second = 0.0;  // Sum of time^2; the next two are those of time^4 and time^6.
    double fourth = 0.0;
    double sixth = 0.0;
    // Frames before and after count in equal numbers, so that an acceleration cancels.
    for (int64_t gap = 1; gap <= kReach; ++gap) {
      const auto step = static_cast<size_t>(gap);
      if (i < step || i + step >= poses.size() ||
          poses[i].frame_index - poses[i - step].frame_index > kReach ||
          poses[i + step].frame_index - poses[i].frame_index > kReach) {
        break;
      }
      for (const TimedPose& other : {poses[i - step], poses[i + step]}) {
        const auto time = static_cast<double>(other.frame_index - poses[i].frame_index);
        const Rigid3 since = other.camera_from_map * map_from_camera;
        ImageMotion moved;
        moved << geometry::VectorFromRotation(since.rotation), since.translation;
        const double square = time * time;
        first += time * moved;
        third += time * square * moved;
        second += square;
        fourth += square * square;
        sixth += square * square * square;
      }
    }
    const double determinant = second * sixth - fourth * fourth;
    if (determinant > 1e-9) {
      motions[i] = (sixth * first - fourth * third) / determinant;
    } else if (second > 0.0) {
      motions[i] = first / second;  // The frames nearest in time only.
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
  TriangulationOptions limits = mapper.triangulation;
  limits.max_error_px = mapper.final_max_error_px;
  bool adjusted = true;
  for (const size_t points : {size_t{600}, kFinalPointsPerImage}) {
    options.points_per_image = points;
    adjusted = adjusted && AdjustAll(reconstruction, anchors, options);
    FilterAll(reconstruction, limits);
  }
  Shutter shutter{reconstruction.readout()};
  if (adjusted) {
    const IntrinsicsDeviation deviation = EstimateDeviation(reconstruction, anchors[0], options);
    shutter.deviation = {deviation.readout_x, deviation.readout_y};
  }
  const double longest = shutter.readout.cwiseAbs().maxCoeff();
  const bool rolls = adjusted && longest > kLeast && longest < kMost &&
                     longest > kSignificant * shutter.deviation.maxCoeff();
  log.info("readout time along x {:.3f} +- {:.3f}, along y {:.3f} +- {:.3f} of the frame time: {}",
           shutter.readout.x(), shutter.deviation.x(), shutter.readout.y(), shutter.deviation.y(),
           rolls ? "a rolling shutter" : "not taken");
  if (!rolls) {
    reconstruction = before;
    return std::nullopt;
  }
  return shutter;
}

}  // namespace lararium::train
