#pragma once

// What of a place has been filmed as training needs it, while it is being filmed, and what to do
// next. Judged by tracked corners alone: there is no map yet, and none is made up. Directions are
// those of the camera's turning since the beginning; distances are shares of the median distance of
// what is seen. Both add up errors along a walk, until something is recognised that was seen nearer
// to its beginning.

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

// A corner that is followed from frame to frame, where it is now.
struct CoverageTrack {
  uint32_t id = 0;                                     // the same in each frame that sees it
  Eigen::Vector2d on_plane = Eigen::Vector2d::Zero();  // z = 1, x right, y down
};

// What is recognised when it is seen again: on the plane z = 1, and as many descriptors.
struct CoverageFeatures {
  std::vector<Eigen::Vector2d> on_plane;
  std::vector<vision::Descriptor> descriptors;
};

struct CoverageFrame {
  double time = 0.0;        // seconds
  double shift = 0.0;       // see FrameMotion
  double sharpness = 0.0;   // likewise
  double brightness = 0.5;  // mean of the image, 0 to 1
  double clipped = 0.0;     // share of its pixels that are white or black
  std::vector<CoverageTrack> tracks;
  // Of some frames only, for it takes milliseconds; while what the frame is from lives. None:
  // nothing is recognised.
  std::function<CoverageFeatures()> describe;
};

// What is wrong now, the most urgent first.
enum class CoverageFault {
  kNone,
  kDark,
  kBright,
  kBlurred,
  kFast,
  kBare,  // too few corners
  kStanding,
  kTurning,  // on the spot
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

// What visitors need, each as the share of it that is there, 0 to 1.
struct CoverageShares {
  double ahead = 0.0;     // what is ahead of the beginning and 45 degrees to either side
  double floor = 0.0;     // what is below that
  double sideways = 0.0;  // steps to either side
  double depth = 0.0;     // nearer and farther

  double all() const { return (ahead + floor + sideways + depth) / 4.0; }
};

struct CoverageState {
  CoverageFault fault = CoverageFault::kNone;
  CoverageAdvice advice = CoverageAdvice::kStepRight;
  CoverageShares shares;
  double heading = 0.0;  // radians to the right of where the camera looked first
  double pitch = 0.0;    // radians above that
  Eigen::Vector2d moved = Eigen::Vector2d::Zero();  // right and ahead, of the median distance
};

class CoverageGuide {
 public:
  // Directions around the beginning.
  static constexpr int kColumns = 24;  // of 15 degrees; the first begins 180 degrees to the left
  static constexpr int kRows = 3;      // from 45 to 15 degrees below it, level with it, and above
  enum class Cell : uint8_t {
    kUnseen,
    kSeen,     // but from one place only
    kCovered,  // from places well apart
    kBare,     // there is nothing to hold on to
  };
  using Cells = std::array<std::array<Cell, kColumns>, kRows>;

  // half_view: of the image's width and height, on the plane z = 1.
  explicit CoverageGuide(const Eigen::Vector2d& half_view) : half_view_(half_view) {}

  CoverageState Add(const CoverageFrame& frame);
  const Cells& cells() const { return cells_; }

 private:
  // What is known of a track: the ray of its first frame in world axes (those of the first camera),
  // and the widest angle that later ones had to it.
  struct Sight {
    Eigen::Vector3d first = Eigen::Vector3d::UnitZ();
    double parallax = 0.0;  // radians
  };
  struct CellCount {
    int frames = 0;               // that looked at it
    std::set<uint32_t> seen;      // tracks
    std::set<uint32_t> parallax;  // those from places well apart
  };
  struct Step {
    double time = 0.0;
    double shift = 0.0;
    double turn = 0.0;  // radians, since the frame before
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
  };

  // A frame that motion was measured from.
  struct KnownView {
    CoverageFeatures features;
    Eigen::Quaterniond world_from_view = Eigen::Quaterniond::Identity();
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    int links = 0;  // motions that were measured between the beginning and it
  };
  // Where the camera is by one of them.
  struct Sighting {
    Eigen::Quaterniond world_from_camera = Eigen::Quaterniond::Identity();
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    int links = 0;  // to the camera
  };

  // How the camera comes to be where it is from the view.
  struct Way {
    bool known = false;  // enough tracks connect the two
    bool moved = false;  // it did not only turn
    bool far = false;    // time for a new view
  };

  CoverageFault FindFault(const CoverageFrame& frame);
  Way Follow(const CoverageFrame& frame);
  bool Leaps(const Eigen::Quaterniond& camera_from_view, double shift) const;
  std::vector<const KnownView*> ViewsToRecognise(bool lost) const;
  static std::optional<Sighting> SightingFrom(const KnownView& view, const CoverageFeatures& seen);
  bool Recognise(const CoverageFeatures& seen, bool lost);
  void BeginView(const CoverageFrame& frame, bool lost);
  void NoteSights(const CoverageFrame& frame, bool moved);
  void JudgeCells();
  CoverageShares Shares() const;
  CoverageAdvice Advise(const CoverageShares& shares);
  CoverageAdvice StepAside();
  double Heading() const;
  double Pitch() const;

  Eigen::Vector2d half_view_;
  int64_t frames_ = 0;
  std::deque<double> sharpness_;
  std::deque<Step> steps_;
  std::map<uint32_t, Eigen::Vector2d> view_;  // tracks of the frame that motion is measured from
  std::vector<KnownView> known_views_;
  int links_ = 0;  // of the view
  Eigen::Quaterniond world_from_view_ = Eigen::Quaterniond::Identity();
  Eigen::Quaterniond world_from_camera_ = Eigen::Quaterniond::Identity();
  Eigen::Vector2d view_at_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d at_ = Eigen::Vector2d::Zero();      // right and ahead
  Eigen::Vector2d lowest_ = Eigen::Vector2d::Zero();  // of at_
  Eigen::Vector2d highest_ = Eigen::Vector2d::Zero();
  bool moved_ = false;  // the last frame had, from the view
  double side_ = 1.0;   // that is asked for: 1 right, -1 left
  std::map<uint32_t, Sight> sights_;
  std::array<std::array<CellCount, kColumns>, kRows> counts_;
  Cells cells_ = {};
};

}  // namespace lararium::train
