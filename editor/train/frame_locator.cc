#include "editor/train/frame_locator.h"

#include <algorithm>
#include <cmath>

#include "shared/core/median.h"
#include "shared/core/parallel.h"
#include "shared/vision/guided_matcher.h"
#include "shared/vision/localizer.h"
#include "shared/vision/patch_pose.h"
#include "shared/vision/rolling_shutter.h"

namespace lararium::train {
namespace {

constexpr size_t kWorkers = 8;
constexpr double kLargestErrorPx = 2.0;   // Largest error of an observation.
constexpr double kMatchingReachPx = 4.0;  // Points are looked for while the shutter is ignored.

}  // namespace

LocatedView DescribeImage(const Reconstruction& reconstruction, uint32_t image) {
  LocatedView view;
  if (!reconstruction.Located(image)) {
    return view;
  }
  view.camera_from_map = reconstruction.camera_from_map(image);
  view.camera = reconstruction.camera(image);
  std::vector<double> errors;
  for (const uint32_t element : reconstruction.ElementsOf(image)) {
    if (reconstruction.Observed(element)) {
      const Eigen::Vector3d& point = reconstruction.Point(reconstruction.TrackOf(element));
      errors.push_back(std::sqrt(reconstruction.SquaredErrorPx(element, point)));
    }
  }
  view.observations = static_cast<int>(errors.size());
  view.median_error_px = Median(std::move(errors));
  return view;
}

// Locates one image at a time and reuses its memory.
class FrameLocator::Worker {
 public:
  explicit Worker(const vision::SceneDatabase& database)
      : database_(database), localizer_(database, {}), matcher_(database) {}

  LocatedView Locate(const FrameToLocate& wanted) {
    const ImageMotion& motion = wanted.motion;
    vision::FeatureOptions options;
    options.first_octave = 0;
    options.max_features = 1500;
    LocatedView view;
    if (!extractor_.Extract(wanted.frame->grey, options, features_).ok()) {
      return view;
    }
    view.features = static_cast<int>(features_.size());
    const vision::Location location = localizer_.Locate(features_, wanted.camera);
    view.camera_from_map = location.camera_from_map;
    view.camera = location.camera.model;
    if (view.camera_from_map) {
      if (!database_.readout.isZero(0.0) && !motion.isZero(0.0)) {
        view.camera_from_map = WhileReading(view.camera, *view.camera_from_map, motion);
      }
      std::vector<double> errors = ErrorsOfObservations(view.camera, *view.camera_from_map, motion);
      view.observations = static_cast<int>(errors.size());
      view.median_error_px = Median(std::move(errors));
    }
    return view;
  }

 private:
  // Refines a pose by the points that support it, each at the time of its pixel.
  geometry::Rigid3 WhileReading(const geometry::CameraModel& camera,
                                const geometry::Rigid3& camera_from_map,
                                const ImageMotion& motion) {
    std::vector<vision::PatchMatch> matches;
    for (const vision::LocatedPoint& located : localizer_.points()) {
      matches.push_back({database_.points[located.point].cast<double>(),
                         located.pixel.cast<double>(),
                         Eigen::Matrix2d::Identity() / std::max(located.sigma_px, 1e-3f)});
    }
    vision::CameraPrior prior{vision::ExactCamera(camera), &motion};
    prior.camera.readout = database_.readout;
    // As good as known; an unknown readout is what makes the estimation look at the time.
    prior.camera.covariance(vision::kReadoutX, vision::kReadoutX) = 1e-12;
    prior.camera.covariance(vision::kReadoutY, vision::kReadoutY) = 1e-12;
    vision::PatchPose pose;
    return vision::EstimatePatchPose(matches, prior, {camera_from_map, prior.camera}, 0.1, pose)
               ? pose.posed.camera_from_map
               : camera_from_map;
  }

  std::vector<double> ErrorsOfObservations(const geometry::CameraModel& camera,
                                           const geometry::Rigid3& camera_from_map,
                                           const ImageMotion& motion) {
    matcher_.Match(camera, camera_from_map, features_, kMatchingReachPx, matches_);
    std::vector<double> errors;
    for (const vision::FeatureMatch& match : matches_) {
      const vision::Keypoint& keypoint = features_.keypoints[match.feature];
      const Eigen::Vector2d pixel(keypoint.x, keypoint.y);
      const double time = database_.readout.dot(vision::ReadoutOrder(camera, pixel));
      const auto projected = camera.Project(vision::PoseAfter(camera_from_map, motion, time) *
                                            database_.points[match.point].cast<double>());
      if (projected && (*projected - pixel).norm() < kLargestErrorPx) {
        errors.push_back((*projected - pixel).norm());
      }
    }
    return errors;
  }

  const vision::SceneDatabase& database_;
  vision::FeatureExtractor extractor_;
  vision::Features features_;
  vision::Localizer localizer_;
  vision::GuidedMatcher matcher_;
  std::vector<vision::FeatureMatch> matches_;
};

FrameLocator::FrameLocator(const vision::SceneDatabase& database) {
  for (size_t i = 0; i < kWorkers; ++i) {
    workers_.push_back(std::make_unique<Worker>(database));
  }
}

FrameLocator::~FrameLocator() = default;

std::vector<LocatedView> FrameLocator::Locate(std::span<const FrameToLocate> frames) {
  std::vector<LocatedView> views(frames.size());
  ParallelFor(kWorkers, [&](size_t worker) {
    for (size_t i = worker; i < frames.size(); i += kWorkers) {
      views[i] = workers_[worker]->Locate(frames[i]);
    }
  });
  return views;
}

}  // namespace lararium::train
