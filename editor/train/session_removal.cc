#include "editor/train/session_removal.h"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "editor/train/lookalikes.h"
#include "editor/train/session_adjustment.h"

namespace lararium::train {
namespace {

using vision::Observation;
using vision::SceneDatabase;

constexpr uint32_t kDropped = std::numeric_limits<uint32_t>::max();
constexpr uint32_t kLeastViews = 2;  // Minimum number of observations of a kept point.

class Remover {
 public:
  Remover(const SceneDatabase& map, uint32_t session) : map_(map), session_(session) {}

  RemovedSession Run(uint64_t seed) {
    TakeKeyframes();
    TakePoints();
    TakeObservations();
    LocateAgain();
    Describe();
    removed_.keyframes = map_.keyframes.size() - db_.keyframes.size();
    removed_.observations = map_.observations.size() - db_.observations.size();
    removed_.points = map_.points.size() - db_.points.size();
    ForgetTheOnlySession();
    vision::ForestOptions forest;
    forest.seed = seed;
    db_.forest = vision::BuildForest(db_.descriptors, forest);
    db_.lookalikes = FindLookalikes(db_, seed);
    removed_.database = std::move(db_);
    return std::move(removed_);
  }

 private:
  void TakeKeyframes() {
    db_.camera = map_.camera;
    db_.readout = map_.readout;
    for (const vision::Keyframe& keyframe : map_.keyframes) {
      new_keyframe_.push_back(kDropped);
      if (keyframe.session != session_) {
        new_keyframe_.back() = static_cast<uint32_t>(db_.keyframes.size());
        db_.keyframes.push_back(keyframe);
        db_.keyframes.back().session -= keyframe.session > session_ ? 1 : 0;
      }
    }
  }

  // Removes the session from a bit mask and shifts later sessions down. 0 if it was the only one.
  uint32_t WithoutSession(uint32_t sessions) const {
    const uint32_t before = sessions & ((1u << session_) - 1u);
    return before | (sessions >> 1 & ~((1u << session_) - 1u));
  }

  void TakeDescriptors(uint32_t point) {
    for (uint32_t d = map_.descriptor_begin[point]; d < map_.descriptor_begin[point + 1]; ++d) {
      if (const uint32_t sessions = WithoutSession(map_.SessionsOf(d)); sessions != 0) {
        db_.descriptors.push_back(map_.descriptors[d]);
        db_.descriptor_point.push_back(new_point_[point]);
        db_.descriptor_sessions.push_back(sessions);
      }
    }
    db_.descriptor_begin.push_back(static_cast<uint32_t>(db_.descriptors.size()));
  }

  // Returns whether the point has a descriptor that does not belong to the removed session alone.
  bool LooksLikeSomething(uint32_t point) const {
    for (uint32_t d = map_.descriptor_begin[point]; d < map_.descriptor_begin[point + 1]; ++d) {
      if (WithoutSession(map_.SessionsOf(d)) != 0) {
        return true;
      }
    }
    return false;
  }

  void TakePoints() {
    std::vector<uint32_t> views(map_.points.size(), 0);
    for (const Observation& o : map_.observations) {
      views[o.point] += new_keyframe_[o.keyframe] != kDropped;
    }
    db_.descriptor_begin.push_back(0);
    for (uint32_t point = 0; point < map_.points.size(); ++point) {
      new_point_.push_back(kDropped);
      if (views[point] < kLeastViews || !LooksLikeSomething(point)) {
        continue;
      }
      new_point_.back() = static_cast<uint32_t>(db_.points.size());
      db_.points.push_back(map_.points[point]);
      db_.normals.push_back(map_.normals[point]);
      if (!map_.colours.empty()) {
        db_.colours.push_back(map_.colours[point]);
      }
      TakeDescriptors(point);
    }
  }

  // Copies the remaining observations; they stay sorted by keyframe and point.
  void TakeObservations() {
    for (Observation o : map_.observations) {
      o.keyframe = new_keyframe_[o.keyframe];
      o.point = new_point_[o.point];
      if (o.keyframe != kDropped && o.point != kDropped) {
        db_.observations.push_back(o);
      }
    }
  }

  // Adjusts the points that the session observed to the remaining observations. Without a solution
  // they keep their position.
  void LocateAgain() {
    std::vector<bool> moves(db_.points.size(), false);
    for (uint32_t point = 0; point < map_.points.size(); ++point) {
      if (new_point_[point] != kDropped) {
        moves[new_point_[point]] = (map_.session_masks[point] >> session_ & 1u) != 0;
      }
    }
    std::vector<geometry::Rigid3> poses;
    for (const vision::Keyframe& keyframe : db_.keyframes) {
      poses.push_back(keyframe.camera_from_map);
    }
    std::vector<Eigen::Vector3d> points;
    for (const Eigen::Vector3f& point : db_.points) {
      points.push_back(point.cast<double>());
    }
    if (!AdjustPoints(CamerasOf(db_), db_.observations, poses, moves, points)) {
      return;
    }
    for (size_t i = 0; i < points.size(); ++i) {
      if (moves[i]) {
        db_.points[i] = points[i].cast<float>();
      }
    }
  }

  // Computes the properties that depend on the observations.
  void Describe() {
    std::vector<Eigen::Vector3d> towards(db_.points.size(), Eigen::Vector3d::Zero());
    db_.observation_counts.assign(db_.points.size(), 0);
    db_.session_masks.assign(db_.points.size(), 0);
    double error_sum = 0.0;
    for (const Observation& o : db_.observations) {
      const vision::Keyframe& keyframe = db_.keyframes[o.keyframe];
      const Eigen::Vector3d point = db_.points[o.point].cast<double>();
      ++db_.observation_counts[o.point];
      db_.session_masks[o.point] |= 1u << keyframe.session;
      towards[o.point] += (keyframe.camera_from_map.Center() - point).stableNormalized();
      const auto pixel = db_.camera.Project(keyframe.camera_from_map * point);
      error_sum += pixel ? (*pixel - Eigen::Vector2d(o.x, o.y)).norm() : 0.0;
    }
    for (size_t i = 0; i < towards.size(); ++i) {
      if (towards[i].norm() > 1e-9) {  // Not seen from opposite sides only.
        db_.normals[i] = towards[i].normalized().cast<float>();
      }
    }
    db_.mean_reprojection_error_px =
        error_sum / static_cast<double>(std::max<size_t>(1, db_.observations.size()));
  }

  // If only one session is left, all descriptors belong to it and need not be marked.
  void ForgetTheOnlySession() {
    const bool only = std::all_of(
        db_.keyframes.begin(), db_.keyframes.end(),
        [&](const vision::Keyframe& k) { return k.session == db_.keyframes.front().session; });
    if (only) {
      db_.descriptor_sessions.clear();
    }
  }

  const SceneDatabase& map_;
  uint32_t session_;
  SceneDatabase db_;
  RemovedSession removed_;
  // [keyframes of the map] and [points of the map]: New indices, or kDropped.
  std::vector<uint32_t> new_keyframe_;
  std::vector<uint32_t> new_point_;
};

}  // namespace

Result<RemovedSession> RemoveSession(const SceneDatabase& map, uint32_t session, uint64_t seed) {
  const std::string place = "session " + std::to_string(session);
  if (session == 0) {
    return Status::Error(
        place, "is the first recording, from which the map was made, and cannot be removed",
        "train the place again from another recording");
  }
  const bool known =
      std::any_of(map.keyframes.begin(), map.keyframes.end(),
                  [&](const vision::Keyframe& keyframe) { return keyframe.session == session; });
  if (!known) {
    return Status::Error(place, "is not in the map", "choose one of the map's sessions");
  }
  RemovedSession removed = Remover(map, session).Run(seed);
  if (removed.database.points.empty()) {
    return Status::Error(place, "supports the whole map; nothing would be left without it",
                         "train the place again");
  }
  LARARIUM_RETURN_IF_ERROR(removed.database.Validate());
  return removed;
}

}  // namespace lararium::train
