#pragma once

// Decides what is drawn while tracking is lost and when it returns. People stay for a moment where
// they were and keep their motion in the picture; then they fade, and the visitor is guided. When
// the pose returns, they appear at their present positions. Nothing visible ever jumps.

#include <cstdint>
#include <optional>

#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"

namespace lararium::show {

// Durations in seconds.
struct TrackingLossFaderOptions {
  double hold = 0.25;        // People stay for this long after the loss.
  double fade = 0.5;         // Fade-out after that.
  double appear = 0.3;       // Fade-in when the pose returns.
  double guide_after = 2.0;  // Time without a pose after which the guide appears.
  double guide_fade = 0.4;   // Fade-in of the guide; its fade-out takes half of that.
  // Largest jump of the picture (pixels) that is corrected gradually while people are visible.
  // While the camera moves, up to four times as much is corrected.
  double most_shift_px = 6.0;

  Status Validate() const;
};

class TrackingLossFader {
 public:
  enum class State {
    kSearching,  // No pose yet; no person was visible.
    kShown,      // Tracking has a pose.
    kHeld,       // The pose is lost; people stay.
    kFading,     // People fade out.
    kGone,       // People are invisible; later the guide appears.
  };

  // What to draw in a frame.
  struct View {
    State state = State::kSearching;
    // Pose with which people are drawn; empty: they are not drawn.
    std::optional<geometry::Rigid3> camera_from_stage;
    uint32_t place = 0;  // Place in which the pose lies.
    float opacity = 0.0f;
    float guide = 0.0f;         // Opacity of the guide.
    double lost_seconds = 0.0;  // Time without a pose; 0 while there is one.
  };

  explicit TrackingLossFader(const TrackingLossFaderOptions& options = {}) : options_(options) {}

  // Processes the next frame. time: capture time in seconds; after a step back, or a jump of more
  // than a second, the fader restarts with this frame. display: the camera with which the frame is
  // drawn. dark: the image is too dark to see anything; if there is no pose either, people vanish
  // at once, because their surroundings are invisible too.
  View Update(double time,
              const std::optional<geometry::Rigid3>& camera_from_stage,
              uint32_t place,
              const geometry::CameraModel& display,
              bool dark = false);

  // The last pose that a frame had.
  const std::optional<geometry::Rigid3>& last_pose() const { return last_pose_; }

  // False: if the pose returns at a different position, people fade out and in instead of gliding
  // there.
  void SetGlides(bool glides) { glides_ = glides; }

  // Restarts for another visitor, as if no pose had been seen.
  void Reset();

 private:
  using Twist = Eigen::Matrix<double, 6, 1>;

  void Begin(double time, const std::optional<geometry::Rigid3>& pose, uint32_t place);
  void Track(double step,
             double time,
             const geometry::Rigid3& pose,
             uint32_t place,
             const geometry::CameraModel& display);
  void Lose(double step, double time, bool dark);
  geometry::Rigid3 Continued(double time) const;
  bool IsElsewhere(const geometry::Rigid3& pose,
                   const geometry::Rigid3& continued,
                   const geometry::CameraModel& display) const;
  View MakeView(double time) const;

  TrackingLossFaderOptions options_;
  bool glides_ = true;
  std::optional<double> time_;                 // Time of the last frame.
  std::optional<double> lost_since_;           // Empty: the last frame had a pose.
  std::optional<geometry::Rigid3> last_pose_;  // The last pose of any frame.
  double last_pose_time_ = 0.0;
  Twist velocity_ = Twist::Zero();         // Velocity of the camera at that time, per second.
  std::optional<geometry::Rigid3> shown_;  // Pose with which people are drawn.
  uint32_t place_ = 0;                     // Place of shown_.
  // Difference between the tracker's pose and shown_ when tracking was regained.
  Twist offset_ = Twist::Zero();
  double found_time_ = 0.0;
  // Tracking was regained elsewhere; people fade out before they appear there.
  bool leaving_ = false;
  bool seen_ = false;  // True after the first pose.
  float opacity_ = 0.0f;
  float guide_ = 0.0f;
};

// The largest motion, in pixels, of a picture of points three metres away between two poses.
double PictureShiftOf(const geometry::CameraModel& display,
                      const geometry::Rigid3& before_from_stage,
                      const geometry::Rigid3& after_from_stage);

}  // namespace lararium::show
