#include "editor/train/session_merge.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <tuple>
#include <utility>

#include "editor/train/budget.h"
#include "editor/train/camera_transfer.h"
#include "editor/train/database_builder.h"
#include "editor/train/lookalikes.h"
#include "editor/train/session_adjustment.h"
#include "editor/train/session_camera.h"
#include "shared/core/check.h"
#include "shared/core/median.h"
#include "shared/core/random.h"
#include "shared/geometry/resampling.h"
#include "shared/vision/guided_matcher.h"
#include "shared/vision/localizer.h"

namespace lararium::train {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;
using geometry::Similarity3;
using vision::Features;
using vision::Observation;
using vision::SceneDatabase;

constexpr std::string_view kSessionPlace = "adding a session";
constexpr std::string_view kMoreInCommon =
    "film the place from where it was filmed before, so that most of each view is known; where the "
    "light differs much, film once more in light between";
constexpr uint32_t kNoPoint = 0xffffffff;
constexpr size_t kLeastLocated = 3;       // Minimum number of agreeing keyframes.
constexpr double kAgreeingAngle = 0.035;  // Largest difference of rotations, radians.
// Largest distances as shares of the median depth: between positions of a camera and of a point.
constexpr double kAgreeingDistance = 0.03;
constexpr double kPointDistance = 0.02;
constexpr double kFirstRadiusPx = 6.0;        // Guided matching before the joint adjustment.
constexpr double kLaterRadiusPx = 3.0;        // Guided matching after the joint adjustment.
constexpr double kLargestMergeErrorPx = 2.5;  // Largest error of a kept observation.

Status NotFound(size_t located, size_t keyframes) {
  return Status::Error(kSessionPlace,
                       std::to_string(located) + " of " + std::to_string(keyframes) +
                           " images of the new video were found in the map",
                       kMoreInCommon);
}

// ------------------------------------------------------------ similarities

double AngleBetween(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return a.angularDistance(b);
}

// A keyframe of the session that was located in the map.
struct LocatedKeyframe {
  uint32_t keyframe = 0;  // Index among the session's keyframes.
  Rigid3 camera_from_session;
  Rigid3 camera_from_map;

  // The rotation map_from_session according to this keyframe.
  Eigen::Quaterniond Rotation() const {
    return camera_from_map.rotation.conjugate() * camera_from_session.rotation;
  }
};

std::optional<Similarity3> SimilarityOfTwo(const LocatedKeyframe& a, const LocatedKeyframe& b) {
  if (AngleBetween(a.Rotation(), b.Rotation()) > kAgreeingAngle) {
    return std::nullopt;
  }
  const Eigen::Vector3d in_session =
      b.camera_from_session.Center() - a.camera_from_session.Center();
  const Eigen::Vector3d in_map = b.camera_from_map.Center() - a.camera_from_map.Center();
  if (in_session.norm() < 1e-9 || in_map.norm() < 1e-9) {
    return std::nullopt;
  }
  Similarity3 map_from_session;
  map_from_session.scale = in_map.norm() / in_session.norm();
  map_from_session.rotation = a.Rotation().slerp(0.5, b.Rotation());
  map_from_session.translation =
      a.camera_from_map.Center() -
      map_from_session.scale * (map_from_session.rotation * a.camera_from_session.Center());
  return map_from_session;
}

std::vector<LocatedKeyframe> Agreeing(std::span<const LocatedKeyframe> located,
                                      const Similarity3& map_from_session,
                                      double depth) {
  std::vector<LocatedKeyframe> agreeing;
  for (const LocatedKeyframe& k : located) {
    const double distance =
        (map_from_session * k.camera_from_session.Center() - k.camera_from_map.Center()).norm();
    if (distance < kAgreeingDistance * depth &&
        AngleBetween(map_from_session.rotation, k.Rotation()) < kAgreeingAngle) {
      agreeing.push_back(k);
    }
  }
  return agreeing;
}

// The largest set of keyframes that one similarity explains, by RANSAC over pairs of keyframes.
std::vector<LocatedKeyframe> LargestAgreement(std::span<const LocatedKeyframe> located,
                                              double depth,
                                              uint64_t seed) {
  constexpr int kSamples = 2000;
  std::vector<LocatedKeyframe> best;
  Random random(seed);
  const auto count = static_cast<uint32_t>(located.size());
  for (int i = 0; i < kSamples && count >= 2; ++i) {
    const uint32_t a = random.Below(count);
    const uint32_t b = random.Below(count);
    const auto similarity = a == b ? std::nullopt : SimilarityOfTwo(located[a], located[b]);
    if (!similarity) {
      continue;
    }
    std::vector<LocatedKeyframe> agreeing = Agreeing(located, *similarity, depth);
    if (agreeing.size() > best.size()) {
      best = std::move(agreeing);
    }
  }
  return best;
}

// The positions of one point in both maps.
struct PointPair {
  Eigen::Vector3d in_map;
  Eigen::Vector3d in_session;
};

std::optional<Similarity3> FitSimilarity(std::span<const PointPair> pairs) {
  std::vector<Eigen::Vector3d> in_map;
  std::vector<Eigen::Vector3d> in_session;
  for (const PointPair& pair : pairs) {
    in_map.push_back(pair.in_map);
    in_session.push_back(pair.in_session);
  }
  const Result<Similarity3> fitted = geometry::EstimateSimilarity(in_map, in_session);
  return fitted.ok() ? std::optional(*fitted) : std::nullopt;
}

// Estimates a similarity by RANSAC with samples of three pairs, then from all pairs that agree.
std::optional<Similarity3> RobustSimilarity(std::span<const PointPair> pairs,
                                            double tolerance,
                                            uint64_t seed) {
  constexpr int kSamples = 300;
  constexpr size_t kLeastPairs = 12;
  if (pairs.size() < kLeastPairs) {
    return std::nullopt;
  }
  const auto agreeing = [&](const Similarity3& similarity) {
    std::vector<PointPair> inliers;
    for (const PointPair& pair : pairs) {
      if ((similarity * pair.in_session - pair.in_map).norm() < tolerance) {
        inliers.push_back(pair);
      }
    }
    return inliers;
  };
  Random random(seed);
  const auto count = static_cast<uint32_t>(pairs.size());
  std::vector<PointPair> best;
  for (int i = 0; i < kSamples; ++i) {
    const std::array<PointPair, 3> triple = {pairs[random.Below(count)], pairs[random.Below(count)],
                                             pairs[random.Below(count)]};
    if (const auto similarity = FitSimilarity(triple)) {
      std::vector<PointPair> inliers = agreeing(*similarity);
      if (inliers.size() > best.size()) {
        best = std::move(inliers);
      }
    }
  }
  std::optional<Similarity3> similarity = FitSimilarity(best);
  if (similarity) {
    best = agreeing(*similarity);
    similarity = FitSimilarity(best);
  }
  return best.size() < kLeastPairs ? std::nullopt : similarity;
}

double MedianDepth(const SceneDatabase& db) {
  std::vector<double> depths;
  for (const Observation& o : db.observations) {
    depths.push_back(
        (db.keyframes[o.keyframe].camera_from_map * db.points[o.point].cast<double>()).z());
  }
  return depths.empty() ? 1.0 : Median(std::move(depths));
}

// ------------------------------------------------------------ merging

class Merger {
 public:
  Merger(const SceneDatabase& map,
         const SceneDatabase& session,
         std::span<const Features> features,
         const MergeOptions& options,
         Log& log)
      : map_(map),
        session_(session),
        options_(options),
        log_(log),
        guided_(map),
        cameras_(CamerasOf(map)) {
    for (const Features& of_keyframe : features) {
      features_.push_back(FeaturesIn(map.camera, session.camera, of_keyframe));
    }
    observations_ = ObservationsIn(map.camera, session.camera, session.observations);
    first_observation_.push_back(0);
    for (uint32_t k = 0; k < session.keyframes.size(); ++k) {
      size_t end = first_observation_.back();
      while (end < observations_.size() && observations_[end].keyframe == k) {
        ++end;
      }
      first_observation_.push_back(end);
    }
    report_.keyframes = static_cast<int>(session.keyframes.size());
  }

  Result<MergedMap> Run() {
    LARARIUM_RETURN_IF_ERROR(Align());
    MatchPoints(kFirstRadiusPx);
    Adjust();
    MatchPoints(kLaterRadiusPx);
    Adjust();
    DropPoorObservations();
    Adjust();
    MergedMap merged;
    merged.database = Build();
    merged.report = report_;
    return merged;
  }

 private:
  size_t MapKeyframes() const { return map_.keyframes.size(); }
  size_t MapPoints() const { return map_.points.size(); }

  std::span<const Observation> ObservationsOf(uint32_t keyframe) const {
    return std::span(observations_)
        .subspan(first_observation_[keyframe],
                 first_observation_[keyframe + 1] - first_observation_[keyframe]);
  }

  std::vector<LocatedKeyframe> LocateKeyframes() const {
    vision::LocalizerOptions options;
    options.seed = options_.seed;
    vision::Localizer localizer(map_, options);
    std::vector<LocatedKeyframe> located;
    for (uint32_t k = 0; k < features_.size(); ++k) {
      const vision::Location location = localizer.Locate(features_[k], map_.camera);
      if (location.camera_from_map) {
        located.push_back({k, session_.keyframes[k].camera_from_map, *location.camera_from_map});
      }
    }
    return located;
  }

  // Estimates map_from_session: first from the keyframes located in the map, then from points that
  // both maps contain.
  Status Align() {
    const double depth = MedianDepth(map_);
    const std::vector<LocatedKeyframe> located = LocateKeyframes();
    const std::vector<LocatedKeyframe> agreeing = LargestAgreement(located, depth, options_.seed);
    report_.located = static_cast<int>(agreeing.size());
    log_.Info("{} of {} images of the session were found in the map, {} of them agree",
              located.size(), features_.size(), agreeing.size());
    if (agreeing.size() < kLeastLocated) {
      return NotFound(agreeing.size(), features_.size());
    }
    poses_.assign(session_.keyframes.size(), Rigid3());
    std::vector<bool> known(poses_.size(), false);
    for (const LocatedKeyframe& k : agreeing) {
      poses_[k.keyframe] = k.camera_from_map;
      known[k.keyframe] = true;
    }
    CastVotes(known, kLaterRadiusPx);
    std::vector<PointPair> pairs;
    for (uint32_t q = 0; q < session_.points.size(); ++q) {
      if (const uint32_t p = Elected(q); p != kNoPoint) {
        pairs.push_back({map_.points[p].cast<double>(), session_.points[q].cast<double>()});
      }
    }
    const auto similarity = RobustSimilarity(pairs, kPointDistance * depth, options_.seed);
    if (!similarity) {
      return Status::Error(kSessionPlace,
                           "only " + std::to_string(pairs.size()) +
                               " points of the new video are known to be points of the map",
                           kMoreInCommon);
    }
    report_.map_from_session = *similarity;
    for (size_t k = 0; k < poses_.size(); ++k) {
      poses_[k] = geometry::CameraFromB(session_.keyframes[k].camera_from_map,
                                        report_.map_from_session.Inverse());
    }
    AddMotions();
    points_.clear();
    for (const Eigen::Vector3f& point : map_.points) {
      points_.push_back(point.cast<double>());
    }
    for (const Eigen::Vector3f& point : session_.points) {
      points_.push_back(report_.map_from_session * point.cast<double>());
    }
    return Status();
  }

  // Adds the motions of the session's images. The merged map has one readout time: that of the map
  // or, if the map's shutter is a global one, that of the session. A session of another readout
  // time along the same axis gets faster or slower motions, because only the products of times and
  // motions matter.
  void AddMotions() {
    constexpr double kOtherAxis = 0.1;
    // The extent of an image on the plane z = 1, along which it is read.
    const auto extent = [](const CameraModel& camera) {
      return Eigen::Vector2d(camera.width / camera.fx, camera.height / camera.fy);
    };
    const Eigen::Vector2d of_session =
        session_.readout.cwiseProduct(extent(map_.camera).cwiseQuotient(extent(session_.camera)));
    if (map_.readout.isZero(0.0)) {
      cameras_.readout = of_session;
      cameras_.motions.assign(MapKeyframes(), ImageMotion::Zero());
    }
    const double square = cameras_.readout.squaredNorm();
    const double ratio = square > 0.0 ? of_session.dot(cameras_.readout) / square : 0.0;
    const bool same_axis =
        (of_session - ratio * cameras_.readout).norm() <= kOtherAxis * of_session.norm();
    for (const vision::Keyframe& keyframe : session_.keyframes) {
      ImageMotion& motion = cameras_.motions.emplace_back(ImageMotion::Zero());
      if (same_axis) {
        motion = ratio * keyframe.motion;
        motion.tail<3>() *= report_.map_from_session.scale;
      }
    }
  }

  // Searches for the map's points in keyframes of the session. A point of the session that was
  // observed at the same feature gets a vote for being the same point.
  void CastVotes(const std::vector<bool>& keyframes, double radius_px) {
    votes_.assign(session_.points.size(), {});
    guided_observations_.clear();
    std::vector<vision::FeatureMatch> matches;
    for (uint32_t k = 0; k < features_.size(); ++k) {
      if (!keyframes[k]) {
        continue;
      }
      std::map<std::pair<float, float>, uint32_t> point_at;
      for (const Observation& o : ObservationsOf(k)) {
        point_at.emplace(std::pair(o.x, o.y), o.point);
      }
      guided_.Match(map_.camera, poses_[k], features_[k], radius_px, matches);
      for (const vision::FeatureMatch& match : matches) {
        const vision::Keypoint& keypoint = features_[k].keypoints[match.feature];
        guided_observations_.push_back(
            {{match.point, k, keypoint.x, keypoint.y, keypoint.scale}, match.feature});
        if (const auto found = point_at.find({keypoint.x, keypoint.y}); found != point_at.end()) {
          votes_[found->second].push_back(match.point);
        }
      }
    }
  }

  // The map's point that got most votes of a session's point; kNoPoint if it got fewer than two
  // votes or no majority.
  uint32_t Elected(uint32_t session_point) const {
    std::vector<uint32_t> votes = votes_[session_point];
    std::sort(votes.begin(), votes.end());
    for (size_t begin = 0; begin < votes.size();) {
      const auto end = static_cast<size_t>(
          std::upper_bound(votes.begin(), votes.end(), votes[begin]) - votes.begin());
      if (end - begin >= 2 && 2 * (end - begin) > votes.size()) {
        return votes[begin];
      }
      begin = end;
    }
    return kNoPoint;
  }

  // Index of a session's point in the merged map.
  uint32_t Joined(uint32_t session_point) const {
    const uint32_t elected = joined_[session_point];
    return elected != kNoPoint ? elected : static_cast<uint32_t>(MapPoints() + session_point);
  }

  // Collects all observations of the session: those of its own points, which are joined to the
  // map's points if elected, and those of the map's points from guided matching.
  void MatchPoints(double radius_px) {
    CastVotes(std::vector<bool>(poses_.size(), true), radius_px);
    joined_.assign(session_.points.size(), kNoPoint);
    for (uint32_t q = 0; q < session_.points.size(); ++q) {
      joined_[q] = Elected(q);
    }
    joint_.clear();
    for (const Observation& o : observations_) {
      joint_.push_back({Joined(o.point), o.keyframe, o.x, o.y, o.scale});
    }
    for (const GuidedObservation& guided : guided_observations_) {
      joint_.push_back(guided.observation);
    }
    KeepNearestObservations();
  }

  double ErrorPx(const Observation& o) const {
    const Eigen::Vector2d observed(o.x, o.y);
    const auto pixel = cameras_.PixelOf(MapKeyframes() + o.keyframe, poses_[o.keyframe],
                                        points_[o.point], observed);
    return pixel ? (*pixel - observed).norm() : 1e9;
  }

  // Keeps at most one observation per keyframe and point and one point per feature: those with the
  // smallest error.
  void KeepNearestObservations() {
    const auto keep_first = [&](const auto& key) {
      std::stable_sort(joint_.begin(), joint_.end(), [&](const auto& a, const auto& b) {
        return key(a) != key(b) ? key(a) < key(b) : ErrorPx(a) < ErrorPx(b);
      });
      joint_.erase(std::unique(joint_.begin(), joint_.end(),
                               [&](const auto& a, const auto& b) { return key(a) == key(b); }),
                   joint_.end());
    };
    keep_first([](const Observation& o) { return std::tuple(o.keyframe, o.x, o.y); });
    keep_first([](const Observation& o) { return std::tuple(o.keyframe, o.point, 0u); });
  }

  void Adjust() {
    std::vector<Rigid3> poses;
    for (const vision::Keyframe& keyframe : map_.keyframes) {
      poses.push_back(keyframe.camera_from_map);
    }
    poses.insert(poses.end(), poses_.begin(), poses_.end());
    if (!AdjustSession(cameras_, AllObservations(), MapKeyframes(), poses, points_)) {
      log_.Warn("the joint adjustment found no solution");
      return;
    }
    std::copy(poses.begin() + static_cast<ptrdiff_t>(MapKeyframes()), poses.end(), poses_.begin());
  }

  // The observations of the map and the session with the indices of the merged map, sorted.
  std::vector<Observation> AllObservations() const {
    std::vector<Observation> all = map_.observations;
    for (Observation o : joint_) {
      o.keyframe += static_cast<uint32_t>(MapKeyframes());
      all.push_back(o);
    }
    return all;
  }

  void DropPoorObservations() {
    std::erase_if(joint_, [&](const Observation& o) { return ErrorPx(o) > kLargestMergeErrorPx; });
    std::vector<int> counts(points_.size(), 0);
    for (const Observation& o : joint_) {
      ++counts[o.point];
    }
    std::erase_if(joint_, [&](const Observation& o) {
      return o.point >= MapPoints() && counts[o.point] < 2;
    });
  }

  // ---------------------------------------------------------- the database

  SceneDatabase Build() {
    SceneDatabase db;
    db.camera = map_.camera;
    db.readout = cameras_.readout;
    db.keyframes = map_.keyframes;
    const std::array<float, 3> exposure = ReferenceRatio();
    for (size_t k = 0; k < poses_.size(); ++k) {
      vision::Keyframe& keyframe = db.keyframes.emplace_back(session_.keyframes[k]);
      keyframe.camera_from_map = poses_[k];
      keyframe.motion = cameras_.motions[MapKeyframes() + k];
      Resample(session_.camera, map_.camera, std::array{&keyframe.grey});
      for (size_t c = 0; c < 3; ++c) {
        keyframe.gain[c] *= exposure[c];
      }
    }
    AddPoints(db, exposure);
    double error_sum = 0.0;
    for (const Observation& o : db.observations) {
      const auto pixel = db.PixelIn(o.keyframe, db.points[o.point].cast<double>());
      error_sum += pixel ? (*pixel - Eigen::Vector2d(o.x, o.y)).norm() : 0.0;
    }
    db.mean_reprojection_error_px =
        error_sum / static_cast<double>(std::max<size_t>(1, db.observations.size()));
    vision::ForestOptions forest;
    forest.seed = options_.seed;
    db.forest = vision::BuildForest(db.descriptors, forest);
    db.lookalikes = FindLookalikes(db, options_.seed);
    return db;
  }

  // Brightness of the session's photometric reference over that of the map, from common points. The
  // session's gains are multiplied by this ratio, and its colours are divided by it.
  std::array<float, 3> ReferenceRatio() const {
    std::array<float, 3> ratio = {1.0f, 1.0f, 1.0f};
    for (int c = 0; c < 3; ++c) {
      std::vector<float> ratios;
      for (uint32_t q = 0; q < session_.colours.size() && !map_.colours.empty(); ++q) {
        const float of_session = session_.colours[q][c];
        if (joined_[q] != kNoPoint && of_session > 0.0f && map_.colours[joined_[q]][c] > 0.0f) {
          ratios.push_back(of_session / map_.colours[joined_[q]][c]);
        }
      }
      if (!ratios.empty()) {
        const auto middle = ratios.begin() + static_cast<ptrdiff_t>(ratios.size() / 2);
        std::nth_element(ratios.begin(), middle, ratios.end());
        ratio[static_cast<size_t>(c)] = *middle;
      }
    }
    return ratio;
  }

  void AddPoints(SceneDatabase& db, const std::array<float, 3>& exposure) {
    const std::vector<Observation> all = AllObservations();
    std::vector<Eigen::Vector3d> towards(points_.size(), Eigen::Vector3d::Zero());
    std::vector<uint32_t> counts(points_.size(), 0);
    for (const Observation& o : joint_) {
      ++counts[o.point];
      towards[o.point] += (poses_[o.keyframe].Center() - points_[o.point]).stableNormalized();
    }
    std::vector<std::vector<vision::Descriptor>> fresh = FreshDescriptors();
    const bool coloured = !map_.colours.empty() || !session_.colours.empty();
    std::vector<uint32_t> new_index(points_.size(), kNoPoint);
    db.descriptor_begin.push_back(0);
    for (uint32_t i = 0; i < points_.size(); ++i) {
      const bool old = i < MapPoints();
      if (!old && counts[i] == 0) {
        continue;
      }
      new_index[i] = static_cast<uint32_t>(db.points.size());
      report_.shared_points += old && counts[i] > 0;
      report_.added_points += !old;
      const Eigen::Vector3d before =
          old ? Eigen::Vector3d(map_.observation_counts[i] * map_.normals[i].cast<double>())
              : Eigen::Vector3d::Zero();
      const Eigen::Vector3d normal = before + towards[i];
      db.points.push_back(points_[i].cast<float>());
      db.normals.push_back(normal.norm() > 1e-9 ? Eigen::Vector3f(normal.normalized().cast<float>())
                                                : Eigen::Vector3f(0.0f, 0.0f, 1.0f));
      db.observation_counts.push_back(counts[i] + (old ? map_.observation_counts[i] : 0));
      const uint32_t bit = counts[i] > 0 ? 1u << session_.keyframes.front().session : 0u;
      db.session_masks.push_back(bit | (old ? map_.session_masks[i] : 0u));
      if (counts[i] == 0) {
        fresh[i].clear();  // The observations turned out to be wrong.
      }
      if (coloured) {
        db.colours.push_back(Colour(i, exposure));
      }
      AddDescriptors(db, i, fresh[i]);
    }
    for (Observation o : all) {
      o.point = new_index[o.point];
      db.observations.push_back(o);
    }
    std::sort(db.observations.begin(), db.observations.end(),
              [](const Observation& a, const Observation& b) {
                return a.keyframe != b.keyframe ? a.keyframe < b.keyframe : a.point < b.point;
              });
  }

  Eigen::Vector3f Colour(uint32_t point, const std::array<float, 3>& exposure) const {
    Eigen::Vector3f colour = Eigen::Vector3f::Constant(-1.0f);
    if (point < MapPoints()) {
      return map_.colours.empty() ? colour : map_.colours[point];
    }
    if (!session_.colours.empty()) {
      const Eigen::Vector3f& of_session = session_.colours[point - MapPoints()];
      for (int c = 0; c < 3; ++c) {
        colour[c] = of_session[c] > 0.0f ? of_session[c] / exposure[static_cast<size_t>(c)] : -1.0f;
      }
    }
    return colour;
  }

  // [points]: The session's descriptors of each point.
  std::vector<std::vector<vision::Descriptor>> FreshDescriptors() const {
    std::vector<std::vector<vision::Descriptor>> fresh(points_.size());
    for (uint32_t q = 0; q < session_.points.size(); ++q) {
      for (uint32_t d = session_.descriptor_begin[q]; d < session_.descriptor_begin[q + 1]; ++d) {
        fresh[Joined(q)].push_back(session_.descriptors[d]);
      }
    }
    for (const GuidedObservation& guided : guided_observations_) {
      if (ErrorPx(guided.observation) < kLargestMergeErrorPx) {
        fresh[guided.observation.point].push_back(
            features_[guided.observation.keyframe].descriptors[guided.feature]);
      }
    }
    return fresh;
  }

  // Adds a point's descriptors. Those of the map are kept; they are also marked for the session if
  // it has a similar one.
  void AddDescriptors(SceneDatabase& db,
                      uint32_t point,
                      const std::vector<vision::Descriptor>& fresh) const {
    const uint32_t bit = 1u << session_.keyframes.front().session;
    std::vector<vision::Descriptor> kept;
    std::vector<uint32_t> sessions;
    if (point < MapPoints()) {
      for (uint32_t d = map_.descriptor_begin[point]; d < map_.descriptor_begin[point + 1]; ++d) {
        const vision::Descriptor& known = map_.descriptors[d];
        const bool seen = std::any_of(fresh.begin(), fresh.end(),
                                      [&](const auto& f) { return LookAlike(f, known); });
        kept.push_back(known);
        sessions.push_back(map_.SessionsOf(d) | (seen ? bit : 0u));
      }
    }
    const size_t most = kept.size() + static_cast<size_t>(options_.max_descriptors_per_point);
    AddDistinctDescriptors(fresh, most, kept);
    sessions.resize(kept.size(), bit);
    const auto index = static_cast<uint32_t>(db.points.size() - 1);
    db.descriptors.insert(db.descriptors.end(), kept.begin(), kept.end());
    db.descriptor_point.resize(db.descriptors.size(), index);
    db.descriptor_sessions.insert(db.descriptor_sessions.end(), sessions.begin(), sessions.end());
    db.descriptor_begin.push_back(static_cast<uint32_t>(db.descriptors.size()));
  }

  struct GuidedObservation {
    Observation observation;  // A map point in a keyframe of the session.
    uint32_t feature = 0;
  };

  const SceneDatabase& map_;
  const SceneDatabase& session_;
  MergeOptions options_;
  Log& log_;
  vision::GuidedMatcher guided_;
  PosedCameras cameras_;                      // The map's keyframes come first.
  std::vector<Features> features_;            // [session's keyframes]: In the map's camera.
  std::vector<Observation> observations_;     // The session's, in the map's camera.
  std::vector<size_t> first_observation_;     // [keyframes + 1]: Ranges of observations_.
  std::vector<Rigid3> poses_;                 // [session's keyframes]: camera_from_map.
  std::vector<Eigen::Vector3d> points_;       // Points of the map, then those of the session.
  std::vector<std::vector<uint32_t>> votes_;  // [session's points]: Voted points of the map.
  std::vector<GuidedObservation> guided_observations_;
  std::vector<uint32_t> joined_;    // [session's points]: Point of the map, or kNoPoint.
  std::vector<Observation> joint_;  // Indices into poses_ and points_.
  MergeReport report_;
};

// ------------------------------------------------------------ the video

// Moves the poses of the session's frames along with the nearest keyframe in the video.
class PoseMover {
 public:
  PoseMover(const SceneDatabase& session, const MergedMap& merged)
      : session_(session), merged_(merged) {}

  Rigid3 Moved(int64_t frame_index, const Rigid3& camera_from_session) const {
    size_t nearest = 0;
    for (size_t k = 1; k < session_.keyframes.size(); ++k) {
      const auto distance = [&](size_t i) {
        return std::abs(session_.keyframes[i].frame_index - frame_index);
      };
      nearest = distance(k) < distance(nearest) ? k : nearest;
    }
    const Rigid3& before = session_.keyframes[nearest].camera_from_map;
    const size_t first = merged_.database.keyframes.size() - session_.keyframes.size();
    const Rigid3& after = merged_.database.keyframes[first + nearest].camera_from_map;
    const double scale = merged_.report.map_from_session.scale;
    // The motion from the keyframe to the frame, scaled to the map's unit.
    Rigid3 frame_from_keyframe = camera_from_session * before.Inverse();
    frame_from_keyframe.translation *= scale;
    return frame_from_keyframe * after;
  }

 private:
  const SceneDatabase& session_;
  const MergedMap& merged_;
};

void MoveReport(const SceneDatabase& session, const MergedMap& merged, TrainReport& report) {
  const PoseMover mover(session, merged);
  for (LocatedFrame& frame : report.located) {
    frame.camera_from_map = mover.Moved(frame.frame_index, frame.camera_from_map);
  }
  for (FrameReport& frame : report.frame_reports) {
    if (frame.camera_from_map) {
      frame.camera_from_map = mover.Moved(frame.frame_index, *frame.camera_from_map);
    }
  }
  report.points = static_cast<int>(merged.database.points.size());
  report.observations = static_cast<int>(merged.database.observations.size());
  report.mean_reprojection_error_px = merged.database.mean_reprojection_error_px;
}

}  // namespace

uint32_t NextSession(const SceneDatabase& map) {
  uint32_t next = 0;
  for (const vision::Keyframe& keyframe : map.keyframes) {
    next = std::max(next, keyframe.session + 1);
  }
  return next;
}

Result<MergedMap> MergeSession(const SceneDatabase& map,
                               const SceneDatabase& session,
                               std::span<const Features> features,
                               const MergeOptions& options,
                               Log& log) {
  CHECK(features.size() == session.keyframes.size());
  if (map.points.empty() || session.keyframes.empty()) {
    return NotFound(0, session.keyframes.size());
  }
  LARARIUM_ASSIGN_OR_RETURN(MergedMap merged, Merger(map, session, features, options, log).Run());
  BudgetOptions budget;
  budget.max_points = options.max_points;
  budget.seed = options.seed;
  merged.database = Prune(merged.database, budget);
  log.Info("the session sees {} points of the map and adds {}", merged.report.shared_points,
           merged.report.added_points);
  return merged;
}

Result<TrainResult> AddSession(const SceneDatabase& map,
                               capture::FrameSource& source,
                               const TrainOptions& options,
                               Progress& progress,
                               Log& log) {
  constexpr uint32_t kSessions = 32;
  TrainOptions of_session = options;
  of_session.session = NextSession(map);
  if (of_session.session >= kSessions) {
    return Status::Error(kSessionPlace, "the map already has 32 sessions, the maximum",
                         "remove a session, or train the place again");
  }
  if (!options.intrinsics) {
    LARARIUM_ASSIGN_OR_RETURN(of_session.intrinsics,
                              RecogniseCamera(map, source, options.seed, progress, log));
  }
  of_session.keep_features = true;
  LARARIUM_ASSIGN_OR_RETURN(TrainResult trained, Train(source, of_session, progress, log));
  progress.Report("merging", 0.0);
  const auto start = std::chrono::steady_clock::now();
  MergeOptions merging;
  merging.max_points = options.max_points;
  merging.seed = options.seed;
  LARARIUM_ASSIGN_OR_RETURN(MergedMap merged,
                            MergeSession(map, trained.database, trained.features, merging, log));
  trained.features.clear();
  if (progress.Cancelled()) {
    return Status::Error(kSessionPlace, "cancelled");
  }
  MoveReport(trained.database, merged, trained.report);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  trained.report.seconds.emplace_back("merging", seconds.count());
  LARARIUM_RETURN_IF_ERROR(merged.database.Validate());
  trained.database = std::move(merged.database);
  return trained;
}

}  // namespace lararium::train
