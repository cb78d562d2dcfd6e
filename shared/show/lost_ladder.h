#pragma once

// What is drawn while tracking is lost, and how it comes back: people stay for a moment where
// they were, their motion through the picture going on; fade; the visitor is guided; and they
// appear again where they are by then. Nothing that is seen ever jumps.

#include <cstdint>
#include <optional>

#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"

namespace lararium::show {

// Seconds.
struct LostLadderOptions {
  double hold = 0.25;        // people stay
  double fade = 0.5;         // and then go
  double appear = 0.3;       // and come back
  double guide_after = 2.0;  // of a loss, or of a search: the visitor is told where to look
  double guide_fade = 0.4;   // how the guide comes; it goes in half of that
  // What moves the picture by no more is made good while people are seen; four times as much
  // where the camera moves.
  double most_shift_px = 6.0;

  Status Validate() const;
};

class LostLadder {
 public:
  enum class Rung {
    kSearching,  // no pose yet: nobody was seen
    kShown,      // there is a pose
    kHeld,       // people stay although there is none
    kFading,     // they go
    kGone,       // they went; later the visitor is guided
  };

  // What is to be drawn of a frame.
  struct View {
    Rung rung = Rung::kSearching;
    // With which pose people are drawn; none: they are not.
    std::optional<geometry::Rigid3> camera_from_stage;
    uint32_t place = 0;  // that the pose lies in
    float opacity = 0.0f;
    float guide = 0.0f;         // opacity of what tells the visitor where to look
    double lost_seconds = 0.0;  // without a pose; 0 while there is one
  };

  explicit LostLadder(const LostLadderOptions& options = {}) : options_(options) {}

  // The next frame: its capture time in seconds, its pose, and the camera that it is drawn with.
  // Time that goes back, or leaps by more than a second, begins anew with the frame as it is.
  // dark: nothing is seen in its image. Where it has no pose either, people go at once, as all
  // that they stood among did.
  View Update(double time,
              const std::optional<geometry::Rigid3>& camera_from_stage,
              uint32_t place,
              const geometry::CameraModel& display,
              bool dark = false);

  // The pose of the last frame that had one; where it was before anybody was lost.
  const std::optional<geometry::Rigid3>& last_pose() const { return last_pose_; }

  // false: where the pose comes back elsewhere than people are shown, they go and come again
  // instead of moving there.
  void SetGlides(bool glides) { glides_ = glides; }

  // Another visitor: as if nothing had been seen.
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

  LostLadderOptions options_;
  bool glides_ = true;
  std::optional<double> time_;                 // of the last frame
  std::optional<double> lost_since_;           // none: it had a pose
  std::optional<geometry::Rigid3> last_pose_;  // that a frame had
  double last_pose_time_ = 0.0;
  Twist velocity_ = Twist::Zero();         // of the camera then, per second
  std::optional<geometry::Rigid3> shown_;  // with which people are drawn
  uint32_t place_ = 0;                     // of shown_
  Twist offset_ = Twist::Zero();           // from the tracker's pose to shown_, when it was found
  double found_time_ = 0.0;
  bool leaving_ = false;  // found elsewhere: people go before they come there
  bool seen_ = false;     // there was a pose once
  float opacity_ = 0.0f;
  float guide_ = 0.0f;
};

// The most that a picture of things three metres away moves between two poses, in pixels.
double PictureShiftOf(const geometry::CameraModel& display,
                      const geometry::Rigid3& before_from_stage,
                      const geometry::Rigid3& after_from_stage);

}  // namespace lararium::show
