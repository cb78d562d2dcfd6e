#include "editor/train/coverage_guide.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "editor/train/keyframes.h"
#include "editor/train/matching.h"
#include "shared/core/median.h"
#include "shared/core/units.h"

namespace lararium::train {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Parallax of a covered track; the capture report asks for the same.
constexpr double kParallax = 5.0 * kRadiansPerDegree;
constexpr size_t kTracksOfCell = 6;  // Tracks with parallax that cover a cell; with fewer, bare.
constexpr int kLook = 30;            // Frames in view after which a cell may count as bare.

// The coverage that is needed: angles to either side, and distances as shares of the median one.
constexpr double kAhead = 45.0 * kRadiansPerDegree;
constexpr double kFloor = 30.0 * kRadiansPerDegree;
constexpr double kSideways = 0.5;
constexpr double kDepth = 0.3;

constexpr size_t kFewestPairs = 15;  // Minimum number of tracks that connect two frames.
constexpr double kSampson = 0.004;   // Plane z = 1; about a pixel at 320 pixels width.
// Residual of a pure rotation by noise (radians) and by a wrong focal length (share of the turn).
constexpr double kNoise = 0.004;
constexpr double kShareOfTurn = 0.05;

double AngleBetween(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

double Wrapped(double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); }

// Yaw and pitch of a ray in world axes, which are those of the first camera.
double YawOf(const Vector3d& ray) { return std::atan2(ray.x(), ray.z()); }
double PitchOf(const Vector3d& ray) { return std::atan2(-ray.y(), std::hypot(ray.x(), ray.z())); }

struct CellIndex {
  size_t row = 0;
  size_t column = 0;
};

double YawOfColumn(size_t column) {
  return (2.0 * (static_cast<double>(column) + 0.5) / CoverageGuide::kColumns - 1.0) *
         std::numbers::pi;
}

double PitchOfRow(size_t row) {
  return (30.0 * static_cast<double>(row) - 30.0) * kRadiansPerDegree;
}

std::optional<CellIndex> CellOf(const Vector3d& ray) {
  const double row = std::floor((PitchOf(ray) / kRadiansPerDegree + 45.0) / 30.0);
  const double column =
      std::floor((YawOf(ray) / std::numbers::pi + 1.0) * 0.5 * CoverageGuide::kColumns);
  if (row < 0.0 || row >= CoverageGuide::kRows) {
    return std::nullopt;
  }
  return CellIndex{static_cast<size_t>(row),
                   static_cast<size_t>(std::clamp(column, 0.0, CoverageGuide::kColumns - 1.0))};
}

double ShareOfRow(const CoverageGuide::Cells& cells, size_t row, double reach) {
  int wanted = 0;
  int covered = 0;
  for (size_t column = 0; column < cells[row].size(); ++column) {
    if (std::abs(YawOfColumn(column)) < reach && cells[row][column] != CoverageGuide::Cell::kBare) {
      ++wanted;
      covered += cells[row][column] == CoverageGuide::Cell::kCovered ? 1 : 0;
    }
  }
  return wanted == 0 ? 0.0 : static_cast<double>(covered) / wanted;
}

// The yaw of the uncovered cell of a row that is nearest to a heading.
std::optional<double> NearestMissing(const CoverageGuide::Cells& cells,
                                     size_t row,
                                     double reach,
                                     double heading) {
  std::optional<double> nearest;
  for (size_t column = 0; column < cells[row].size(); ++column) {
    const double yaw = YawOfColumn(column);
    const bool missing = cells[row][column] == CoverageGuide::Cell::kUnseen ||
                         cells[row][column] == CoverageGuide::Cell::kSeen;
    if (std::abs(yaw) < reach && missing &&
        (!nearest || std::abs(Wrapped(yaw - heading)) < std::abs(Wrapped(*nearest - heading)))) {
      nearest = yaw;
    }
  }
  return nearest;
}

// Returns whether the relative pose is credible. After a short motion the essential matrix is
// mostly noise and may contain a rotation by degrees that did not happen. Its parallax must
// therefore also show in the residual of a pure rotation.
bool Explains(const RelativePose& pose, const Turning& turning, const PointPairs& pairs) {
  constexpr double kMostTimes = 8.0;   // A wall seen head-on leaves an eighth of the parallax.
  constexpr double kMostOfWay = 16.0;  // After a longer motion, such as a walk around a wall.
  constexpr double kLeastShare = 0.6;
  const double times = turning.median_angle > 3.0 * kNoise ? kMostOfWay : kMostTimes;
  const bool shows = pose.median_angle < times * turning.median_angle;
  const auto inliers = static_cast<double>(pose.inliers.size());
  return shows && inliers > kLeastShare * static_cast<double>(pairs.size());
}

// The camera's motion to the right and ahead, as shares of the median distance. The baseline
// follows from the parallax angle by the law of sines for small angles.
Vector2d MovedBy(const Quaterniond& world_from_view,
                 const PointPairs& pairs,
                 const RelativePose& pose) {
  constexpr double kLeastSine = 0.1;
  const Vector3d centre = pose.b_from_a.Center();  // The camera in the view's frame; length 1.
  std::vector<double> sines;
  for (const uint32_t i : pose.inliers) {
    const Vector3d ray = pairs.a[i].homogeneous();
    sines.push_back(std::sin(AngleBetween(ray, centre)));
  }
  const double sine = std::max(Median(std::move(sines)), kLeastSine);
  const Vector3d moved = world_from_view * centre * (std::sin(pose.median_angle) / sine);
  return {moved.x(), moved.z()};
}

// Returns whether the residual of a pure rotation shows that the camera also moved.
bool HasMoved(const Turning& turning) {
  const double turn = Quaterniond::Identity().angularDistance(turning.b_from_a);
  return turning.median_angle > kNoise + kShareOfTurn * turn;
}

}  // namespace

CoverageState CoverageGuide::Add(const CoverageFrame& frame) {
  const Quaterniond before = world_from_camera_;
  if (frames_ == 0) {
    BeginView(frame, false);
  }
  const Vector2d was_at = at_;
  const Way way = Follow(frame);
  moved_ = way.moved;
  const double turn = before.angularDistance(world_from_camera_);
  NoteObservations(frame, way.moved);
  if (!way.known || way.far) {
    BeginView(frame, !way.known);
  }
  steps_.push_back({frame.time, frame.shift, turn, was_at});
  ++frames_;
  JudgeCells();

  CoverageState state;
  state.fault = FindFault(frame);
  state.shares = Shares();
  state.advice = Advise(state.shares, frame.time);
  state.heading = Heading();
  state.pitch = Pitch();
  state.moved = at_;
  return state;
}

CoverageFault CoverageGuide::FindFault(const CoverageFrame& frame) {
  constexpr double kDarkest = 0.12;
  constexpr double kMostClipped = 0.3;
  constexpr size_t kFewCorners = 40;
  constexpr size_t kRemembered = 60;  // frames
  constexpr size_t kEnoughToCompare = 10;
  constexpr double kStill = 2.0;        // seconds
  constexpr double kStillShift = 0.01;  // Total shift within kStill, as a share of the diagonal.
  constexpr double kTurnFor = 3.0;      // seconds
  constexpr double kTurned = 12.0 * kRadiansPerDegree;
  constexpr double kNoMove = 0.02;
  const double sharpness_around =
      sharpness_.empty() ? 0.0 : Median(std::vector<double>(sharpness_.begin(), sharpness_.end()));
  const bool compares = sharpness_.size() >= kEnoughToCompare;
  sharpness_.push_back(frame.sharpness);
  if (sharpness_.size() > kRemembered) {
    sharpness_.pop_front();
  }
  while (steps_.front().time < frame.time - kTurnFor) {
    steps_.pop_front();
  }
  if (frame.brightness < kDarkest) {
    return CoverageFault::kDark;
  }
  if (frame.clipped > kMostClipped) {
    return CoverageFault::kBright;
  }
  if (compares && frame.sharpness < kBlurredShare * sharpness_around) {
    return CoverageFault::kBlurred;
  }
  if (frame.shift > kFastShift) {
    return CoverageFault::kFast;
  }
  if (frame.tracks.size() < kFewCorners) {
    return CoverageFault::kBare;
  }
  double shift = 0.0;
  double turn = 0.0;
  for (const Step& step : steps_) {
    shift += step.time > frame.time - kStill ? step.shift : 0.0;
    turn += step.turn;
  }
  const double known = frame.time - steps_.front().time;
  if (known >= 0.9 * kStill && shift < kStillShift) {
    return CoverageFault::kStanding;
  }
  const bool on_the_spot = (at_ - steps_.front().at).norm() < kNoMove;
  return turn > kTurned && on_the_spot ? CoverageFault::kTurning : CoverageFault::kNone;
}

CoverageGuide::Way CoverageGuide::Follow(const CoverageFrame& frame) {
  constexpr double kFarTurn = 15.0 * kRadiansPerDegree;
  constexpr double kKeptShare = 0.6;  // Share of the view's tracks below which a new view begins.
  PointPairs pairs;
  for (const CoverageTrack& track : frame.tracks) {
    if (const auto known = view_.find(track.id); known != view_.end()) {
      pairs.a.push_back(known->second);
      pairs.b.push_back(track.on_plane);
    }
  }
  Way way;
  way.known = pairs.size() >= kFewestPairs;
  if (!way.known) {
    return way;
  }
  const Turning turning = EstimateTurning(pairs);
  Quaterniond camera_from_view = turning.b_from_a;
  const double turn = Quaterniond::Identity().angularDistance(camera_from_view);
  at_ = view_at_;
  double parallax = 0.0;
  if (HasMoved(turning)) {
    const auto pose = EstimateRelativePose(pairs, kSampson);
    if (pose && Explains(*pose, turning, pairs) && !Leaps(pose->b_from_a.rotation, frame.shift)) {
      camera_from_view = pose->b_from_a.rotation;
      parallax = pose->median_angle;
      way.moved = true;
      at_ = view_at_ + MovedBy(world_from_view_, pairs, *pose);
    }
  }
  world_from_camera_ = (world_from_view_ * camera_from_view.conjugate()).normalized();
  const bool few =
      static_cast<double>(pairs.size()) < kKeptShare * static_cast<double>(view_.size());
  way.far = few || turn > kFarTurn || parallax > kParallax;
  return way;
}

// Returns whether the rotation differs from that of the frame before by more than the shift of the
// corners allows. A flat scene has two possible poses, and noise decides between them.
bool CoverageGuide::Leaps(const Quaterniond& camera_from_view, double shift) const {
  constexpr double kSteady = 2.0 * kRadiansPerDegree;
  // Before the first measured motion, a step may have been mistaken for a rotation.
  constexpr double kBegin = 10.0 * kRadiansPerDegree;
  constexpr double kTimes = 3.0;
  const double diagonal = 2.0 * half_view_.norm();  // Approximately an angle.
  const Quaterniond world_from_camera = world_from_view_ * camera_from_view.conjugate();
  return world_from_camera.angularDistance(world_from_camera_) >
         (moved_ ? kSteady : kBegin) + kTimes * shift * diagonal;
}

// The known views that probably overlap with the current image, judged by the estimated direction;
// those with the fewest links come first. If tracking is lost, any view may overlap.
std::vector<const CoverageGuide::KnownView*> CoverageGuide::ViewsToRecognise(bool lost) const {
  constexpr double kShare = 40.0 * kRadiansPerDegree;
  constexpr size_t kMost = 6;
  std::vector<const KnownView*> views;
  for (const KnownView& view : known_views_) {
    const double aside = AngleBetween(view.world_from_view * Vector3d::UnitZ(),
                                      world_from_camera_ * Vector3d::UnitZ());
    if (lost || (view.links < links_ && aside < kShare)) {
      views.push_back(&view);
    }
  }
  std::ranges::stable_sort(views, {}, &KnownView::links);
  views.resize(std::min(views.size(), lost ? views.size() : kMost));
  return views;
}

std::optional<CoverageGuide::PoseFromView> CoverageGuide::ViewFrom(const KnownView& view,
                                                                   const CoverageFeatures& seen) {
  constexpr float kRatio = 0.8f;
  constexpr size_t kFewest = 25;
  constexpr double kLeastShare = 0.5;
  PointPairs pairs;
  for (const FeatureMatch& match :
       MatchDescriptors(view.features.descriptors, seen.descriptors, kRatio)) {
    pairs.a.push_back(view.features.on_plane[match.a]);
    pairs.b.push_back(seen.on_plane[match.b]);
  }
  if (pairs.size() < kFewest) {
    return std::nullopt;
  }
  const auto relative = EstimateRelativePose(pairs, kSampson);
  if (!relative || relative->inliers.size() < kFewest ||
      static_cast<double>(relative->inliers.size()) <
          kLeastShare * static_cast<double>(pairs.size())) {
    return std::nullopt;
  }
  PointPairs agreeing;
  for (const uint32_t i : relative->inliers) {
    agreeing.a.push_back(pairs.a[i]);
    agreeing.b.push_back(pairs.b[i]);
  }
  const Turning turning = EstimateTurning(agreeing);
  const bool moved = HasMoved(turning);
  const Quaterniond camera_from_view = moved ? relative->b_from_a.rotation : turning.b_from_a;
  PoseFromView pose;
  pose.world_from_camera = (view.world_from_view * camera_from_view.conjugate()).normalized();
  pose.at = view.at;
  if (moved) {
    pose.at += MovedBy(view.world_from_view, pairs, *relative);
  }
  pose.links = view.links + 1;
  return pose;
}

// Recognises earlier views and corrects the pose. A single view may mislead, because a flat scene
// has two possible poses, so two views must agree.
bool CoverageGuide::Recognise(const CoverageFeatures& seen, bool lost) {
  constexpr double kAgree = 4.0 * kRadiansPerDegree;
  std::vector<PoseFromView> poses;
  for (const KnownView* view : ViewsToRecognise(lost)) {
    if (const auto pose = ViewFrom(*view, seen)) {
      poses.push_back(*pose);
    }
  }
  for (const PoseFromView& pose : poses) {
    const auto agree = std::ranges::count_if(poses, [&](const PoseFromView& other) {
      return other.world_from_camera.angularDistance(pose.world_from_camera) < kAgree;
    });
    if (agree < 2) {
      continue;
    }
    // The first rays are rotated along, so that their angles to the current rays stay the same.
    const Quaterniond corrected = pose.world_from_camera * world_from_camera_.conjugate();
    for (auto& [id, observation] : observations_) {
      observation.first = corrected * observation.first;
    }
    world_from_camera_ = pose.world_from_camera;
    at_ = pose.at;
    links_ = pose.links;
    return true;
  }
  return false;
}

void CoverageGuide::BeginView(const CoverageFrame& frame, bool lost) {
  constexpr size_t kMostViews = 400;
  CoverageFeatures seen = frame.describe ? frame.describe() : CoverageFeatures();
  if (!Recognise(seen, lost) && frames_ > 0) {
    ++links_;
  }
  view_.clear();
  for (const CoverageTrack& track : frame.tracks) {
    view_[track.id] = track.on_plane;
  }
  world_from_view_ = world_from_camera_;
  view_at_ = at_;
  if (known_views_.size() < kMostViews) {
    known_views_.push_back({std::move(seen), world_from_view_, view_at_, links_});
  }
  // The position is accurate only at a new view, where the parallax is wide.
  lowest_ = lowest_.cwiseMin(at_);
  highest_ = highest_.cwiseMax(at_);
}

void CoverageGuide::NoteObservations(const CoverageFrame& frame, bool moved) {
  std::map<uint32_t, Observation> observations;  // Tracks that are still visible.
  for (const CoverageTrack& track : frame.tracks) {
    const Vector3d ray = (world_from_camera_ * track.on_plane.homogeneous()).normalized();
    const auto known = observations_.find(track.id);
    Observation observation = known == observations_.end() ? Observation{ray, 0.0} : known->second;
    if (moved) {  // After a pure rotation the angle only shows the error of the focal length.
      observation.parallax = std::max(observation.parallax, AngleBetween(observation.first, ray));
    }
    observations[track.id] = observation;
    if (const std::optional<CellIndex> cell = CellOf(ray)) {
      CellCount& count = counts_[cell->row][cell->column];
      count.seen.insert(track.id);
      if (observation.parallax > kParallax) {
        count.parallax.insert(track.id);
      }
    }
  }
  observations_ = std::move(observations);
}

void CoverageGuide::JudgeCells() {
  for (size_t row = 0; row < cells_.size(); ++row) {
    for (size_t column = 0; column < cells_[row].size(); ++column) {
      CellCount& count = counts_[row][column];
      const double pitch = PitchOfRow(row);
      const double yaw = YawOfColumn(column);
      const Vector3d centre = world_from_camera_.conjugate() *
                              Vector3d(std::cos(pitch) * std::sin(yaw), -std::sin(pitch),
                                       std::cos(pitch) * std::cos(yaw));
      const bool in_view = centre.z() > 0.0 && std::abs(centre.x()) < half_view_.x() * centre.z() &&
                           std::abs(centre.y()) < half_view_.y() * centre.z();
      count.frames += in_view ? 1 : 0;
      if (count.parallax.size() >= kTracksOfCell) {
        cells_[row][column] = Cell::kCovered;
      } else if (count.frames > kLook && count.seen.size() < kTracksOfCell) {
        cells_[row][column] = Cell::kBare;
      } else if (count.frames > 0) {
        cells_[row][column] = Cell::kSeen;
      }
    }
  }
}

CoverageShares CoverageGuide::Shares() const {
  const Vector2d range = highest_ - lowest_;
  return {ShareOfRow(cells_, 1, kAhead), ShareOfRow(cells_, 0, kFloor),
          std::min(range.x() / kSideways, 1.0), std::min(range.y() / kDepth, 1.0)};
}

// The sign of the steps to advise along an axis of at_: one way until half of the range is covered
// there, then the other way. If the camera does not get on, as before a wall, the advice is the
// other way for good.
double CoverageGuide::AdviseAlong(int axis, double range, double time) {
  constexpr double kPatience = 4.0;  // seconds
  constexpr double kGotOn = 0.04;    // Share of the median distance.
  Course& course = courses_[static_cast<size_t>(axis)];
  const bool gets_on = stretch_.axis != axis || std::abs(at_[axis] - stretch_.at) > kGotOn;
  const bool stuck = !gets_on && time - stretch_.time > kPatience;
  if (stuck) {
    // Without parallax there is no new view, so this is the end of the range.
    lowest_[axis] = std::min(lowest_[axis], at_[axis]);
    highest_[axis] = std::max(highest_[axis], at_[axis]);
  }
  const double there = course.sign > 0.0 ? highest_[axis] : -lowest_[axis];
  const double back = course.sign > 0.0 ? -lowest_[axis] : highest_[axis];
  const bool turns = stuck || (!course.blocked_behind && there > 0.5 * range && there > back);
  if (turns) {
    course = {-course.sign, stuck};
  }
  if (gets_on || turns) {
    stretch_ = {axis, at_[axis], time};
  }
  return course.sign;
}

CoverageAdvice CoverageGuide::StepAside(double time) {
  return AdviseAlong(0, kSideways, time) > 0.0 ? CoverageAdvice::kStepRight
                                               : CoverageAdvice::kStepLeft;
}

CoverageAdvice CoverageGuide::Advise(const CoverageShares& shares, double time) {
  constexpr double kInView = 20.0 * kRadiansPerDegree;
  constexpr double kLookingDown = -8.0 * kRadiansPerDegree;
  const auto look = [&](size_t row, double reach) {
    const std::optional<double> missing = NearestMissing(cells_, row, reach, Heading());
    const double aside = missing ? Wrapped(*missing - Heading()) : 0.0;
    if (std::abs(aside) < kInView) {
      return StepAside(time);
    }
    stretch_.axis = -1;
    return aside > 0.0 ? CoverageAdvice::kLookRight : CoverageAdvice::kLookLeft;
  };
  if (shares.ahead < 1.0) {
    return look(1, kAhead);
  }
  if (shares.sideways < 1.0) {
    return StepAside(time);
  }
  if (shares.floor < 1.0 && Pitch() <= kLookingDown) {
    return look(0, kFloor);
  }
  if (shares.floor < 1.0) {
    stretch_.axis = -1;
    return CoverageAdvice::kLookDown;
  }
  if (shares.depth < 1.0) {
    return AdviseAlong(1, kDepth, time) > 0.0 ? CoverageAdvice::kGoNearer
                                              : CoverageAdvice::kStepBack;
  }
  return CoverageAdvice::kEnough;
}

double CoverageGuide::Heading() const { return YawOf(world_from_camera_ * Vector3d::UnitZ()); }
double CoverageGuide::Pitch() const { return PitchOf(world_from_camera_ * Vector3d::UnitZ()); }

}  // namespace lararium::train
