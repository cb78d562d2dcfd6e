#include "editor/train/capture_analysis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "shared/core/median.h"
#include "shared/core/parallel.h"
#include "shared/core/units.h"

namespace lararium::train {
namespace {

using geometry::Rigid3;
using vision::Observation;
using AdviceKind = CaptureAdvice::Kind;
constexpr double kGlance = 30.0 * kRadiansPerDegree;  // Visitors look this far to either side.

// ------------------------------------------------------------ histograms

// Counts values in bins; bin i ends below edges[i], and one more bin takes the rest.
Histogram Bin(std::span<const double> values,
              std::span<const double> edges,
              std::vector<std::string> labels) {
  Histogram histogram{std::move(labels), std::vector<size_t>(edges.size() + 1, 0)};
  for (const double value : values) {
    const auto bin = std::upper_bound(edges.begin(), edges.end(), value) - edges.begin();
    ++histogram.counts[static_cast<size_t>(bin)];
  }
  return histogram;
}

Histogram BinErrors(const vision::SceneDatabase& database) {
  std::vector<double> errors;
  for (const Observation& o : database.observations) {
    const auto pixel = database.camera.Project(database.keyframes[o.keyframe].camera_from_map *
                                               database.points[o.point].cast<double>());
    if (pixel) {
      errors.push_back((*pixel - Eigen::Vector2d(o.x, o.y)).norm());
    }
  }
  const std::vector<double> edges = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.5, 2.0, 3.0};
  return Bin(errors, edges,
             {"0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.8", "1.0", "1.5", "2.0", "3.0", "more"});
}

Histogram BinTracks(const vision::SceneDatabase& database) {
  const std::vector<double> lengths(database.observation_counts.begin(),
                                    database.observation_counts.end());
  const std::vector<double> edges = {3, 4, 5, 7, 11, 21, 41, 81};
  return Bin(lengths, edges, {"2", "3", "4", "5-6", "7-10", "11-20", "21-40", "41-80", "more"});
}

// [points]: The widest angle between the rays to two observing keyframes, radians. Of many
// keyframes an even selection is used.
std::vector<float> PointParallax(const vision::SceneDatabase& database) {
  constexpr size_t kMaxViews = 24;
  std::vector<std::vector<uint32_t>> viewers(database.points.size());
  for (const Observation& o : database.observations) {
    viewers[o.point].push_back(o.keyframe);
  }
  std::vector<Eigen::Vector3d> centers;
  for (const vision::Keyframe& keyframe : database.keyframes) {
    centers.push_back(keyframe.camera_from_map.Center());
  }
  std::vector<float> parallax(database.points.size(), 0.0f);
  ParallelFor(parallax.size(), [&](size_t i) {
    const Eigen::Vector3d point = database.points[i].cast<double>();
    const size_t count = viewers[i].size();
    const size_t used = std::min(count, kMaxViews);
    std::array<Eigen::Vector3d, kMaxViews> rays;
    for (size_t v = 0; v < used; ++v) {
      const size_t viewer = used < 2 ? 0 : v * (count - 1) / (used - 1);
      rays[v] = (centers[viewers[i][viewer]] - point).stableNormalized();
    }
    double cosine = 1.0;
    for (size_t a = 0; a < used; ++a) {
      for (size_t b = a + 1; b < used; ++b) {
        cosine = std::min(cosine, rays[a].dot(rays[b]));
      }
    }
    parallax[i] = static_cast<float>(std::acos(std::clamp(cosine, -1.0, 1.0)));
  });
  return parallax;
}

Histogram BinParallax(std::span<const float> parallax) {
  std::vector<double> degrees;
  for (const float angle : parallax) {
    degrees.push_back(angle / kRadiansPerDegree);
  }
  const std::vector<double> edges = {1, 2, 4, 8, 16, 32, 64};
  return Bin(degrees, edges, {"0-1", "1-2", "2-4", "4-8", "8-16", "16-32", "32-64", "more"});
}

// ------------------------------------------------------------ the plan

PlanView MakePlan(const vision::SceneDatabase& database) {
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  Eigen::Vector3d ahead = Eigen::Vector3d::Zero();
  for (const vision::Keyframe& keyframe : database.keyframes) {
    const Eigen::Quaterniond map_from_camera = keyframe.camera_from_map.rotation.conjugate();
    up -= map_from_camera * Eigen::Vector3d::UnitY();
    ahead += map_from_camera * Eigen::Vector3d::UnitZ();
  }
  PlanView plan;
  constexpr double kClear = 0.1;  // Minimum length of the mean of unit vectors.
  const double count = static_cast<double>(std::max<size_t>(1, database.keyframes.size()));
  if (up.norm() > kClear * count) {
    plan.up = up.normalized();
  }
  ahead -= plan.up * plan.up.dot(ahead);
  if (ahead.norm() < kClear * count) {  // The cameras looked in all directions.
    ahead = plan.up.unitOrthogonal();
  }
  plan.ahead = ahead.normalized();
  plan.right = plan.ahead.cross(plan.up).normalized();
  return plan;
}

// ------------------------------------------------------------ standing places

struct Squared {
  Eigen::Vector2d min;
  Eigen::Vector2d max;
};

Squared Bounds(std::span<const Eigen::Vector2d> points, double margin) {
  Squared square{points.front(), points.front()};
  for (const Eigen::Vector2d& point : points) {
    square.min = square.min.cwiseMin(point);
    square.max = square.max.cwiseMax(point);
  }
  square.min.array() -= margin;
  square.max.array() += margin;
  return square;
}

ViewpointPrediction Better(const ViewpointPrediction& a, const ViewpointPrediction& b) {
  const auto rank = [](const ViewpointPrediction& p) { return static_cast<int>(QualityOf(p)); };
  return rank(a) != rank(b) ? (rank(a) < rank(b) ? a : b) : (a.error_px <= b.error_px ? a : b);
}

// The camera moved by offset, which is in map coordinates.
Rigid3 Displaced(const Rigid3& camera_from_map, const Eigen::Vector3d& offset) {
  return {camera_from_map.rotation,
          camera_from_map.translation - camera_from_map.rotation * offset};
}

// The camera turned to its right by angle, in radians, on the spot.
Rigid3 Turned(const Rigid3& camera_from_map, double angle) {
  const Eigen::Vector3d center = camera_from_map.Center();
  Rigid3 turned;
  // If the camera turns to the right, the scene turns to the left in the camera frame.
  turned.rotation =
      (Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitY()) * camera_from_map.rotation).normalized();
  turned.translation = -(turned.rotation * center);
  return turned;
}

void FillPlaces(const vision::SceneDatabase& database,
                const ViewpointPredictor& predictor,
                CaptureAnalysis& analysis) {
  if (database.keyframes.empty() || !(predictor.median_depth() > 0.0)) {
    return;
  }
  std::vector<Eigen::Vector2d> path;
  for (const vision::Keyframe& keyframe : database.keyframes) {
    path.push_back(analysis.plan(keyframe.camera_from_map.Center()));
  }
  const double margin = 0.6 * predictor.median_depth();
  const Squared square = Bounds(path, margin);
  const Eigen::Vector2d extent = square.max - square.min;
  constexpr double kCellsAlong = 28.0;
  analysis.cell = extent.maxCoeff() / kCellsAlong;
  for (double y = square.min.y() + 0.5 * analysis.cell; y < square.max.y(); y += analysis.cell) {
    for (double x = square.min.x() + 0.5 * analysis.cell; x < square.max.x(); x += analysis.cell) {
      const Eigen::Vector2d center(x, y);
      for (const Eigen::Vector2d& at : path) {
        if ((at - center).norm() < margin) {
          analysis.places.push_back({center, {}});
          break;
        }
      }
    }
  }
  ParallelFor(analysis.places.size(), [&](size_t i) {
    StandingPlace& place = analysis.places[i];
    std::vector<std::pair<double, size_t>> nearest;
    for (size_t k = 0; k < path.size(); ++k) {
      nearest.emplace_back((path[k] - place.center).norm(), k);
    }
    constexpr size_t kGazes = 3;
    const size_t count = std::min(kGazes, nearest.size());
    std::partial_sort(nearest.begin(), nearest.begin() + static_cast<ptrdiff_t>(count),
                      nearest.end());
    place.prediction.error_px = std::numeric_limits<double>::infinity();
    for (size_t n = 0; n < count; ++n) {
      const size_t k = nearest[n].second;
      const Eigen::Vector2d step = place.center - path[k];
      const Eigen::Vector3d offset =
          step.x() * analysis.plan.right + step.y() * analysis.plan.ahead;
      const Rigid3 pose = Displaced(database.keyframes[k].camera_from_map, offset);
      ViewpointPrediction worst = predictor.Predict(pose);
      for (const double turn : {-kGlance, kGlance}) {
        const ViewpointPrediction turned = predictor.Predict(Turned(pose, turn));
        worst = Better(worst, turned) == worst ? turned : worst;
      }
      place.prediction = Better(place.prediction, worst);
    }
  });
}

// ------------------------------------------------------------ weak frames

constexpr int kFewFeatures = 150;     // An image with fewer is rarely located.
constexpr int kFewObservations = 60;  // The pose of a frame with fewer is weak.

// [frames]: Median sharpness of the surrounding frames.
std::vector<double> SharpnessAround(std::span<const FrameReport> frames) {
  constexpr size_t kReach = 20;
  std::vector<double> around;
  for (size_t i = 0; i < frames.size(); ++i) {
    const size_t begin = i - std::min(i, kReach);
    const size_t end = std::min(frames.size(), i + kReach + 1);
    std::vector<double> values;
    for (size_t j = begin; j < end; ++j) {
      values.push_back(frames[j].motion.sharpness);
    }
    around.push_back(Median(std::move(values)));
  }
  return around;
}

std::optional<WeakReason> WhyWeak(const FrameReport& frame, double sharpness_around) {
  const bool blurred = frame.motion.sharpness < kBlurredShare * sharpness_around;
  const bool few = frame.features < kFewFeatures;
  if (frame.camera_from_map) {
    if (frame.observations >= kFewObservations) {
      return std::nullopt;
    }
    return blurred ? WeakReason::kBlur : few ? WeakReason::kFewFeatures : WeakReason::kFewPoints;
  }
  if (blurred) {
    return WeakReason::kBlur;
  }
  if (few) {
    return WeakReason::kFewFeatures;
  }
  return frame.motion.shift > kFastShift ? WeakReason::kFastMotion : WeakReason::kNotLocated;
}

std::vector<WeakFrames> FindWeakFrames(std::span<const FrameReport> frames) {
  const std::vector<double> around = SharpnessAround(frames);
  std::vector<WeakFrames> weak;
  for (size_t i = 0; i < frames.size(); ++i) {
    const std::optional<WeakReason> reason = WhyWeak(frames[i], around[i]);
    if (!reason) {
      continue;
    }
    const bool located = frames[i].camera_from_map.has_value();
    if (!weak.empty() && weak.back().last + 1 == i && weak.back().reason == *reason &&
        weak.back().located == located) {
      weak.back().last = i;
    } else {
      weak.push_back({i, i, *reason, located});
    }
  }
  return weak;
}

// ------------------------------------------------------------ advice

// A keyframe on the camera path.
struct Stop {
  std::string name;
  Eigen::Vector2d place;
  size_t keyframe = 0;
};

class Adviser {
 public:
  Adviser(const TrainReport& report,
          const vision::SceneDatabase& database,
          const ViewpointPredictor& predictor,
          std::optional<double> metres_per_unit,
          const CaptureAnalysis& analysis)
      : report_(report),
        database_(database),
        predictor_(predictor),
        metres_per_unit_(metres_per_unit),
        analysis_(analysis) {
    for (size_t k = 0; k < database.keyframes.size(); ++k) {
      const vision::Keyframe& keyframe = database.keyframes[k];
      stops_.push_back({keyframe.name, analysis.plan(keyframe.camera_from_map.Center()), k});
    }
  }

  std::vector<CaptureAdvice> Advise() {
    AdviseOnOrder();
    AdviseOnGaps();
    AdviseOnParallax();
    AdviseOnSteps();
    AdviseOnLookalikes();
    AdviseOnCamera();
    AdviseOnExposure();
    if (advice_.empty()) {
      advice_.push_back({.kind = AdviceKind::kEnough});
    }
    return std::move(advice_);
  }

 private:
  WalkDistance Distance(double units) const {
    return metres_per_unit_ ? WalkDistance{units * *metres_per_unit_, true}
                            : WalkDistance{units / predictor_.median_depth(), false};
  }

  // The end of the plan at which a stretch of stops lies.
  CaptureAdvice::End Where(size_t first, size_t last) const {
    using End = CaptureAdvice::End;
    Eigen::Vector2d low = stops_.front().place;
    Eigen::Vector2d high = low;
    for (const Stop& stop : stops_) {
      low = low.cwiseMin(stop.place);
      high = high.cwiseMax(stop.place);
    }
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (size_t i = first; i <= last; ++i) {
      middle += stops_[i].place / static_cast<double>(last - first + 1);
    }
    const Eigen::Vector2d extent = high - low;
    const int axis = extent.x() >= extent.y() ? 0 : 1;
    if (!(extent[axis] > 0.0) || last - first + 1 == stops_.size()) {
      return End::kNone;
    }
    const double share = (middle[axis] - low[axis]) / extent[axis];
    if (share > 0.25 && share < 0.75) {
      return End::kNone;
    }
    static constexpr std::array<std::array<End, 2>, 2> kEnds = {
        {{End::kLeft, End::kRight}, {End::kNear, End::kFar}}};
    return kEnds[static_cast<size_t>(axis)][share > 0.5 ? 1 : 0];
  }

  // Calls say(first, last) for every run of at least min_run bad stops.
  void ForRuns(const std::vector<bool>& bad,
               size_t min_run,
               const std::function<void(size_t, size_t)>& say) const {
    for (size_t i = 0; i < bad.size(); ++i) {
      size_t end = i;
      while (end < bad.size() && bad[end]) {
        ++end;
      }
      if (end - i >= min_run) {
        say(i, end - 1);
      }
      i = std::max(i, end);
    }
  }

  void AdviseOnGaps() {
    constexpr size_t kShortest = 3;
    size_t shorter = 0;
    for (const WeakFrames& weak : analysis_.weak) {
      if (weak.located) {
        continue;
      }
      if (weak.last - weak.first + 1 < kShortest) {
        ++shorter;
        continue;
      }
      const auto& frames = report_.frame_reports;
      advice_.push_back({.kind = AdviceKind::kNotLocated,
                         .first = frames[weak.first].name,
                         .last = frames[weak.last].name,
                         .reason = weak.reason});
    }
    if (shorter > 0) {
      advice_.push_back({.kind = AdviceKind::kShortGaps, .value = static_cast<double>(shorter)});
    }
  }

  // Advises on stretches whose points are seen from nearly the same direction.
  void AdviseOnParallax() {
    constexpr double kNarrow = 5.0 * kRadiansPerDegree;
    constexpr double kWanted = 15.0 * kRadiansPerDegree;
    std::vector<std::vector<float>> angles(stops_.size());
    for (const Observation& o : database_.observations) {
      angles[o.keyframe].push_back(analysis_.point_parallax[o.point]);
    }
    std::vector<double> medians;
    std::vector<bool> narrow;
    for (std::vector<float>& of_stop : angles) {
      medians.push_back(Median(std::move(of_stop)));
      narrow.push_back(medians.back() < kNarrow);
    }
    ForRuns(narrow, 2, [&](size_t first, size_t last) {
      const double angle =
          Median(std::vector<double>(medians.begin() + static_cast<ptrdiff_t>(first),
                                     medians.begin() + static_cast<ptrdiff_t>(last) + 1));
      advice_.push_back(
          {.kind = AdviceKind::kOneSide,
           .first = stops_[first].name,
           .last = stops_[last].name,
           .end = Where(first, last),
           .value = angle / kRadiansPerDegree,
           .walk = Distance(2.0 * std::tan(0.5 * kWanted) * predictor_.median_depth())});
    });
  }

  // Advises on stretches where a visitor who leaves the path a little is located poorly.
  void AdviseOnSteps() {
    const double step = 0.25 * predictor_.median_depth();
    if (!(step > 0.0)) {
      return;
    }
    struct Way {
      AdviceKind kind;
      Eigen::Vector3d offset;  // The camera's right and ahead along the floor, map units.
      double turn;             // Radians to the right.
    };
    const std::array<Way, 6> ways = {{
        {AdviceKind::kStepLeft, {-step, 0, 0}, 0.0},
        {AdviceKind::kStepRight, {step, 0, 0}, 0.0},
        {AdviceKind::kStepNearer, {0, step, 0}, 0.0},
        {AdviceKind::kStepBack, {0, -step, 0}, 0.0},
        {AdviceKind::kTurnLeft, {0, 0, 0}, -kGlance},
        {AdviceKind::kTurnRight, {0, 0, 0}, kGlance},
    }};
    constexpr size_t kMaxStops = 60;
    const size_t stride = (stops_.size() + kMaxStops - 1) / kMaxStops;
    for (const Way& way : ways) {
      std::vector<size_t> looked_at;
      for (size_t i = 0; i < stops_.size(); i += stride) {
        looked_at.push_back(i);
      }
      std::vector<ViewpointPrediction> predictions(looked_at.size());
      ParallelFor(looked_at.size(), [&](size_t i) {
        predictions[i] = predictor_.Predict(AfterStep(looked_at[i], way.offset, way.turn));
      });
      std::vector<bool> bad;
      for (const ViewpointPrediction& prediction : predictions) {
        bad.push_back(QualityOf(prediction) >= ViewpointQuality::kPoor);
      }
      ForRuns(bad, std::max<size_t>(2, looked_at.size() / 10), [&](size_t first, size_t last) {
        std::vector<double> matches;
        for (size_t i = first; i <= last; ++i) {
          matches.push_back(predictions[i].matches);
        }
        const size_t from = looked_at[first];
        const size_t to = looked_at[last];
        advice_.push_back({.kind = way.kind,
                           .first = stops_[from].name,
                           .last = stops_[to].name,
                           .end = Where(from, to),
                           .value = Median(matches),
                           .walk = way.turn == 0.0 ? Distance(step) : WalkDistance()});
      });
    }
  }

  Rigid3 AfterStep(size_t stop, const Eigen::Vector3d& offset, double turn) const {
    const Rigid3& pose = database_.keyframes[stops_[stop].keyframe].camera_from_map;
    // Directions along the floor as seen from the camera.
    const Eigen::Vector3d axis = pose.rotation.conjugate() * Eigen::Vector3d::UnitX();
    const Eigen::Vector3d up = analysis_.plan.up;
    const Eigen::Vector3d right = (axis - up * up.dot(axis)).stableNormalized();
    const Eigen::Vector3d ahead = up.cross(right);
    return Turned(Displaced(pose, right * offset.x() + ahead * offset.y()), turn);
  }

  // Says that a map of images without an order may have taken equal parts of the place for one.
  void AdviseOnOrder() {
    constexpr double kLittle = 0.05;
    const auto with = std::ranges::count_if(database_.observations, [&](const Observation& o) {
      return database_.HasLookalike(o.point);
    });
    const double share = static_cast<double>(with) /
                         static_cast<double>(std::max<size_t>(database_.observations.size(), 1));
    if (!report_.ordered && share > kLittle) {
      advice_.push_back({.kind = AdviceKind::kUnordered, .value = 100.0 * share});
    }
  }

  // Advises on stretches that show only what other parts of the place have too.
  void AdviseOnLookalikes() {
    constexpr size_t kFew = 15;
    std::vector<size_t> unique(stops_.size(), 0);
    std::vector<size_t> lookalikes(stops_.size(), 0);
    for (const Observation& o : database_.observations) {
      ++(database_.HasLookalike(o.point) ? lookalikes : unique)[o.keyframe];
    }
    std::vector<bool> ambiguous;
    for (size_t i = 0; i < stops_.size(); ++i) {
      ambiguous.push_back(unique[i] < kFew && lookalikes[i] >= kFew);
    }
    ForRuns(ambiguous, 2, [&](size_t first, size_t last) {
      advice_.push_back({.kind = AdviceKind::kLookalikes,
                         .first = stops_[first].name,
                         .last = stops_[last].name,
                         .end = Where(first, last)});
    });
  }

  void AdviseOnCamera() {
    constexpr double kUncertain = 0.01;
    const double focal = report_.camera.Focal();
    if (report_.intrinsics_estimated && report_.focal_deviation_px > kUncertain * focal) {
      advice_.push_back(
          {.kind = AdviceKind::kFocal, .value = 100.0 * report_.focal_deviation_px / focal});
    }
    constexpr size_t kFewKeyframes = 10;
    if (database_.keyframes.size() < kFewKeyframes) {
      advice_.push_back({.kind = AdviceKind::kFewKeyframes,
                         .value = static_cast<double>(database_.keyframes.size())});
    }
  }

  // Advises on exposure changes while filming, which cost matches.
  void AdviseOnExposure() {
    std::vector<std::array<float, 2>> range(32, {0.0f, 0.0f});  // [session]: Photographic stops.
    std::vector<bool> used(32, false);
    for (const vision::Keyframe& keyframe : database_.keyframes) {
      const float stops = std::log2(std::max(1e-6f, keyframe.gain[1]));
      auto& [low, high] = range[keyframe.session % 32];
      low = used[keyframe.session % 32] ? std::min(low, stops) : stops;
      high = used[keyframe.session % 32] ? std::max(high, stops) : stops;
      used[keyframe.session % 32] = true;
    }
    constexpr float kMuch = 2.0f;
    for (size_t session = 0; session < range.size(); ++session) {
      const float spread = range[session][1] - range[session][0];
      if (spread > kMuch) {
        advice_.push_back(
            {.kind = AdviceKind::kExposure, .value = spread, .session = static_cast<int>(session)});
      }
    }
  }

  const TrainReport& report_;
  const vision::SceneDatabase& database_;
  const ViewpointPredictor& predictor_;
  std::optional<double> metres_per_unit_;
  const CaptureAnalysis& analysis_;
  std::vector<Stop> stops_;
  std::vector<CaptureAdvice> advice_;
};

}  // namespace

CaptureAnalysis AnalyseCapture(const TrainReport& report,
                               const vision::SceneDatabase& database,
                               std::optional<double> metres_per_unit) {
  CaptureAnalysis analysis;
  analysis.plan = MakePlan(database);
  analysis.reprojection = BinErrors(database);
  analysis.track_lengths = BinTracks(database);
  analysis.point_parallax = PointParallax(database);
  analysis.parallax = BinParallax(analysis.point_parallax);
  const ViewpointPredictor predictor(database);
  analysis.noise_px = predictor.noise_px();
  analysis.median_depth = predictor.median_depth();
  FillPlaces(database, predictor, analysis);
  analysis.weak = FindWeakFrames(report.frame_reports);
  analysis.advice = Adviser(report, database, predictor, metres_per_unit, analysis).Advise();
  return analysis;
}

}  // namespace lararium::train
