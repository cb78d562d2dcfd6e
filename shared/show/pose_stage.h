#pragma once

// Turns the poses of a tracker into the camera with which frames are drawn: through losses of
// tracking, with the camera's motion and a steady gain.

#include <array>
#include <optional>

#include "shared/show/camera_motion.h"
#include "shared/show/gain_filter.h"
#include "shared/show/lost_guide.h"
#include "shared/show/tracking_loss_fader.h"
#include "shared/vision/scene_database.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::show {

// The camera with which a frame is drawn.
struct StagedCamera {
  // Index into ShowContent::places. Without a pose it is the place of the last pose.
  uint32_t place = 0;
  // Rigid, in metres. Set while tracking, and while the fader holds people without a pose
  // (tracking_loss_fader.h).
  std::optional<geometry::Rigid3> camera_from_stage = {};
  float opacity = 1.0f;  // Opacity of people and of their effect on light.
  TrackingLossFader::State state = TrackingLossFader::State::kShown;
  double lost_seconds = 0.0;  // Time since the last pose; 0 while there is one.
  StagedGuide guide = {};     // Guide for a visitor whose tracking is lost.
  // The tracker's gain after GainFilter; linear R, G, B.
  std::array<float, 3> gain = {1.0f, 1.0f, 1.0f};
  std::optional<CameraMotion> motion = {};  // Empty: unknown.
};

class PoseStage {
 public:
  // The pose of a tracked frame on the stage, if it has one, and its place.
  struct Located {
    std::optional<geometry::Rigid3> camera_from_stage;
    uint32_t place = 0;  // Equals place() without a pose.
  };

  // From now on people fade while tracking is lost. Before, they vanish together with the pose.
  void SetFader(const TrackingLossFaderOptions& options) { fader_.emplace(options); }

  // The camera of the next frame. map: map of the located place; nullptr: none. glides: see
  // TrackingLossFader::SetGlides.
  StagedCamera Next(const vision::TrackedFrame& tracked,
                    const Located& located,
                    const vision::SceneDatabase* map,
                    bool glides);

  uint32_t place() const { return place_; }  // Place of the last pose.

  // Call for another visitor, or if the next pose is unrelated to the previous ones.
  void Reset();
  // Call if the stage has moved: earlier poses are relative to another stage.
  void ResetMotion() { camera_motion_.Reset(); }

 private:
  TrackingLossFader::View Fade(const vision::TrackedFrame& tracked,
                               const Located& located,
                               bool glides);

  uint32_t place_ = 0;
  std::optional<TrackingLossFader> fader_;
  LostGuide guide_;
  CameraMotionTracker camera_motion_;
  GainFilter gain_filter_;
  std::array<float, 3> gain_ = {1.0f, 1.0f, 1.0f};  // Gain of the last frame with a pose.
};

}  // namespace lararium::show
