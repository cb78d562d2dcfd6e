#include "player/staff/staff_reporter.h"

#include <utility>

namespace lararium::player {
namespace {

// Intervals in seconds.
constexpr double kTellEvery = 0.5;
constexpr double kMirrorEvery = 1.9;  // the page asks every two seconds

}  // namespace

void StaffReporter::AfterFrame(const show::StagedFrame& staged,
                               const render::RenderTarget& picture,
                               const std::function<void(StaffState&)>& fill) {
  const double now = StaffLink::Now();
  const vision::TrackedFrame& tracked = staged.tracked;
  tally_.Add(now, tracked.camera_from_map.has_value(),
             staged.camera.state == show::TrackingLossFader::State::kGone);
  Mirror(now, picture);
  if (now - told_ < kTellEvery) {
    return;
  }
  told_ = now;
  StaffState state;
  state.seconds = staged.time;
  state.tracking = tracked.state;
  state.reason = tracked.reason;
  if (tracked.camera_from_map && staged.camera.camera_from_stage) {
    const Eigen::Vector3d position = staged.camera.camera_from_stage->Inverse().translation;
    state.position = {position.x(), position.y(), position.z()};
  }
  state.lost_seconds = staged.camera.lost_seconds;
  state.confidence = tracked.confidence;
  state.tracked = tally_.since_start();
  state.tracked_minute = tally_.last_minute();
  state.losses = tally_.losses();
  state.frames_per_second = tally_.frames_per_second();
  fill(state);
  link_.Tell(std::move(state));
}

void StaffReporter::Mirror(double now, const render::RenderTarget& picture) {
  if (mirror_.under_way()) {
    cv::Mat rgba;
    if (mirror_.TryFinish(rgba)) {
      link_.Show(std::move(rgba));
    }
  } else if (now - mirrored_ >= kMirrorEvery && link_.PictureWanted(now)) {
    mirrored_ = now;
    mirror_.Begin(picture);
  }
}

}  // namespace lararium::player
