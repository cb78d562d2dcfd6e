#include "editor/train/session_camera.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "editor/train/training_status.h"
#include "shared/core/median.h"
#include "shared/vision/camera_filter.h"
#include "shared/vision/features.h"
#include "shared/vision/localizer.h"

namespace lararium::train {
namespace {

using geometry::CameraModel;

constexpr int64_t kImagesTried = 24;  // Number of images that are tried, at least.
constexpr size_t kLeastFound = 5;     // Fewer images prove nothing.
constexpr double kFocalDeviations =
    3.0;  // The largest difference of focal lengths that are the same.
constexpr double kMapFocalError = 5e-4;  // Relative error of the map's own focal length.

// What images tell of the focal length of the camera that took them.
struct FocalEvidence {
  std::vector<double> log_ratios;  // Logarithms of the focal length over that of the map's camera.
  size_t recognised = 0;           // Number of images whose whole lens is that of the map's camera.

  double Mean() const { return Median(log_ratios); }
  // The standard deviation of the median, from the median deviation of normal values.
  double Deviation() const {
    constexpr double kOfNormal = 1.4826;
    constexpr double kMedianOverMean = 1.2533;
    std::vector<double> off;
    for (const double ratio : log_ratios) {
      off.push_back(std::abs(ratio - Mean()));
    }
    return std::hypot(kMapFocalError, kMedianOverMean * kOfNormal * Median(std::move(off)) /
                                          std::sqrt(static_cast<double>(log_ratios.size())));
  }
  bool SameCamera() const {
    return 2 * recognised > log_ratios.size() && std::abs(Mean()) < kFocalDeviations * Deviation();
  }
};

}  // namespace

Result<std::optional<CameraModel>> RecogniseCamera(const vision::SceneDatabase& map,
                                                   capture::FrameSource& source,
                                                   uint64_t seed,
                                                   Progress& progress,
                                                   Log& log) {
  const std::optional<CameraModel> none;
  const Result<CameraModel> camera = map.camera.ForImages(source.width(), source.height());
  if (!camera.ok() || source.Cameras().size() != 1) {
    log.Info("the images have another shape than the map's; their intrinsics are estimated");
    return none;
  }
  vision::LocalizerOptions locating;
  locating.seed = seed;
  vision::Localizer localizer(map, locating);
  vision::FeatureExtractor extractor;
  vision::Features features;
  vision::FeatureOptions detail;
  detail.first_octave = 0;
  detail.max_features = 1500;
  constexpr int kMaxFailures = 10;
  int failures = 0;
  const int64_t step = std::max<int64_t>(source.estimated_frame_count() / kImagesTried, 1);
  FocalEvidence evidence;
  LARARIUM_RETURN_IF_ERROR(source.Seek(0));
  progress.Report("recognising the camera", 0.0);
  while (true) {
    if (progress.Cancelled()) {
      return CancelledStatus();
    }
    const Result<std::optional<geometry::Frame>> frame = source.Next();
    if (!frame.ok()) {  // Training names the images that cannot be read.
      if (++failures > kMaxFailures) {
        return frame.status();
      }
      continue;
    }
    failures = 0;
    if (!*frame) {
      break;
    }
    if ((*frame)->index % step != 0 || !extractor.Extract((*frame)->grey, detail, features).ok()) {
      continue;
    }
    vision::CameraFilter filter(*camera, false);
    const vision::Location location = localizer.Locate(features, filter.Guess());
    if (location.camera_from_map) {
      evidence.log_ratios.push_back(std::log(location.camera.model.Focal() / camera->Focal()));
      filter.Found(location.camera);
      evidence.recognised += filter.held() ? 1 : 0;
    }
  }
  if (evidence.log_ratios.size() < kLeastFound) {
    log.Info(
        "too few images were found in the map to tell whether its camera took them; their "
        "intrinsics are estimated");
    return none;
  }
  const bool same = evidence.SameCamera();
  log.Info("in the map, the images have {:.4f} +- {:.4f} times the focal length of its camera: {}",
           std::exp(evidence.Mean()), evidence.Deviation(),
           same ? "it took them" : "another camera took them, whose intrinsics are estimated");
  return same ? std::optional(*camera) : none;
}

}  // namespace lararium::train
