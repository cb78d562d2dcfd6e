#pragma once

// Guides the person who films a place: reports while filming what has been covered well enough for
// training, and what to do next. Works on tracked corners alone; there is no map yet and none is
// built. Directions are relative to the first camera; distances are shares of the median distance
// of the scene. Both drift along a walk until an earlier view is recognised.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "editor/train/two_view.h"
#include "shared/vision/features.h"

namespace lararium::train {

// The current position of a corner that is tracked from frame to frame.
struct CoverageTrack {
  uint32_t id = 0;  // The same in every frame that shows the corner.
  // Position on the camera's plane z = 1, x right, y down.
  Eigen::Vector2d on_plane = Eigen::Vector2d::Zero();
};

// The features by which a view is recognised; positions are on the plane z = 1.
struct CoverageFeatures {
  std::vector<Eigen::Vector2d> on_plane;
  std::vector<vision::Descriptor> descriptors;
};

struct CoverageFrame {
  double time = 0.0;        // seconds
  double shift = 0.0;       // See FrameMotion.
  double sharpness = 0.0;   // See FrameMotion.
  double brightness = 0.5;  // Mean of the image, 0 to 1.
  double clipped = 0.0;     // Share of the pixels that are white or black.
  std::vector<CoverageTrack> tracks;
  // Extracts the frame's features. It takes milliseconds, so it is called for some frames only. It
  // is valid as long as the source of the frame lives. Without it no view is recognised.
  std::function<CoverageFeatures()> describe;
};

// Problems of the current frame, the most urgent first.
enum class CoverageFault {
  kNone,
  kDark,
  kBright,
  kBlurred,
  kFast,
  kBare,  // Too few corners.
  kStanding,
  kTurning,  // The camera only turns on the spot.
};

enum class CoverageAdvice {
  kStepLeft,
  kStepRight,
  kLookLeft,
  kLookRight,
  kLookDown,
  kGoNearer,
  kStepBack,
  kEnough,
};

// How much of the coverage that visitors need has been reached; each share is 0 to 1.
struct CoverageShares {
  double ahead = 0.0;     // Level directions up to 45 degrees to either side of the first view.
  double floor = 0.0;     // Directions below these, up to 30 degrees to either side.
  double sideways = 0.0;  // Steps to the left and right.
  double depth = 0.0;     // Steps nearer and farther.

  double all() const { return (ahead + floor + sideways + depth) / 4.0; }
};

struct CoverageState {
  CoverageFault fault = CoverageFault::kNone;
  CoverageAdvice advice = CoverageAdvice::kStepRight;
  CoverageShares shares;
  double heading = 0.0;  // Radians to the right of the first view.
  double pitch = 0.0;    // Radians above the first view.
  // Position relative to the first camera, right and ahead, as shares of the median distance.
  Eigen::Vector2d moved = Eigen::Vector2d::Zero();
};

class CoverageGuide {
 public:
  // Grid of directions relative to the first view. A column spans 15 degrees of yaw; column 0
  // begins 180 degrees to the left. A row spans 30 degrees of pitch; row 0 begins 45 degrees below.
  static constexpr int kColumns = 24;
  static constexpr int kRows = 3;
  enum class Cell : uint8_t {
    kUnseen,
    kSeen,     // Seen from one position only.
    kCovered,  // Seen from positions far enough apart.
    kBare,     // Has too few corners.
  };
  using Cells = std::array<std::array<Cell, kColumns>, kRows>;

  // half_view is half the image's width and height on the plane z = 1.
  explicit CoverageGuide(const Eigen::Vector2d& half_view) : half_view_(half_view) {}

  CoverageState Add(const CoverageFrame& frame);
  const Cells& cells() const { return cells_; }

 private:
  // A track's first ray in world axes (those of the first camera), and the widest angle between
  // that ray and later ones.
  struct Observation {
    Eigen::Vector3d first = Eigen::Vector3d::UnitZ();
    double parallax = 0.0;  // radians
  };
  struct CellCount {
    int frames = 0;               // Number of frames with the cell's centre in view.
    std::set<uint32_t> seen;      // Ids of tracks in the cell.
    std::set<uint32_t> parallax;  // Ids of tracks seen from positions far enough apart.
  };
  struct Step {
    double time = 0.0;
    double shift = 0.0;
    double turn = 0.0;  // Radians since the frame before.
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
  };

  // Where and when the camera last got on while steps are advised.
  struct Stretch {
    int axis = -1;  // Index into at_; -1 while no steps are advised.
    double at = 0.0;
    double time = 0.0;
  };

  // The steps along an axis of at_ that are advised.
  struct Course {
    double sign = 1.0;
    bool blocked_behind = false;  // The camera did not get on the other way.
  };

  // A reference frame from which motion was measured.
  struct KnownView {
    CoverageFeatures features;
    Eigen::Quaterniond world_from_view = Eigen::Quaterniond::Identity();
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    int links = 0;  // Number of measured motions that lead from the first frame to the view.
  };
  // The camera's pose according to one recognised view.
  struct PoseFromView {
    Eigen::Quaterniond world_from_camera = Eigen::Quaterniond::Identity();
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    int links = 0;  // See KnownView::links.
  };

  // The motion from the current view to the camera.
  struct Way {
    bool known = false;  // Enough tracks connect the view and the camera.
    bool moved = false;  // The camera also changed its position.
    bool far = false;    // The camera is far enough away for a new view.
  };

  CoverageFault FindFault(const CoverageFrame& frame);
  Way Follow(const CoverageFrame& frame);
  bool Leaps(const Eigen::Quaterniond& camera_from_view, double shift) const;
  std::vector<const KnownView*> ViewsToRecognise(bool lost) const;
  static std::optional<PoseFromView> ViewFrom(const KnownView& view, const CoverageFeatures& seen);
  bool Recognise(const CoverageFeatures& seen, bool lost);
  void BeginView(const CoverageFrame& frame, bool lost);
  void NoteObservations(const CoverageFrame& frame, bool moved);
  void JudgeCells();
  CoverageShares Shares() const;
  CoverageAdvice Advise(const CoverageShares& shares, double time);
  double AdviseAlong(int axis, double range, double time);
  CoverageAdvice StepAside(double time);
  double Heading() const;
  double Pitch() const;

  Eigen::Vector2d half_view_;
  int64_t frames_ = 0;
  std::deque<double> sharpness_;
  std::deque<Step> steps_;
  std::map<uint32_t, Eigen::Vector2d> view_;  // Track positions in the current view, by id.
  std::vector<KnownView> known_views_;
  int links_ = 0;  // KnownView::links of the current view.
  Eigen::Quaterniond world_from_view_ = Eigen::Quaterniond::Identity();
  Eigen::Quaterniond world_from_camera_ = Eigen::Quaterniond::Identity();
  Eigen::Vector2d view_at_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d at_ = Eigen::Vector2d::Zero();      // Right and ahead.
  Eigen::Vector2d lowest_ = Eigen::Vector2d::Zero();  // Range of at_ in the views so far.
  Eigen::Vector2d highest_ = Eigen::Vector2d::Zero();
  bool moved_ = false;             // Way::moved of the last frame.
  std::array<Course, 2> courses_;  // Along each axis of at_.
  Stretch stretch_;
  std::map<uint32_t, Observation> observations_;
  std::array<std::array<CellCount, kColumns>, kRows> counts_;
  Cells cells_ = {};
};

}  // namespace lararium::train
