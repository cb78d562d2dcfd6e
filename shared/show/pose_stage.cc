#include "shared/show/pose_stage.h"

namespace lararium::show {

TrackingLossFader::View PoseStage::Fade(const vision::TrackedFrame& tracked,
                                        const Located& located,
                                        bool glides) {
  if (fader_) {
    fader_->SetGlides(glides);
    return fader_->Update(tracked.frame.capture_time, located.camera_from_stage, located.place,
                          tracked.camera, tracked.reason == vision::TrackReason::kTooDark);
  }
  TrackingLossFader::View view;
  view.state = located.camera_from_stage ? TrackingLossFader::State::kShown
                                         : TrackingLossFader::State::kGone;
  view.camera_from_stage = located.camera_from_stage;
  view.place = located.place;
  view.opacity = 1.0f;
  return view;
}

StagedCamera PoseStage::Next(const vision::TrackedFrame& tracked,
                             const Located& located,
                             const vision::SceneDatabase* map,
                             bool glides) {
  const TrackingLossFader::View view = Fade(tracked, located, glides);
  if (view.place != place_) {
    gain_filter_.Reset();
    camera_motion_.Reset();
  }
  place_ = view.place;
  StagedCamera camera = {.place = place_,
                         .camera_from_stage = view.camera_from_stage ? view.camera_from_stage
                                                                     : located.camera_from_stage,
                         .opacity = view.opacity,
                         .state = view.state,
                         .lost_seconds = view.lost_seconds};
  if (located.camera_from_stage && located.place == place_) {
    camera.motion = camera_motion_.Update(tracked.frame.index, *camera.camera_from_stage);
    gain_ = gain_filter_.Update(tracked.gain, tracked.frame.capture_time);
  } else {
    gain_filter_.Reset();
    camera_motion_.Reset();
  }
  camera.gain = gain_;
  guide_.Update(view.guide, tracked, map, camera.guide);
  return camera;
}

void PoseStage::Reset() {
  gain_filter_.Reset();
  camera_motion_.Reset();
  if (fader_) {
    fader_->Reset();
  }
}

}  // namespace lararium::show
