#include "editor/train/session_removal.h"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "editor/train/session_adjustment.h"

namespace lararium::train {
namespace {

using vision::Observation;
using vision::SceneDatabase;

constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
constexpr uint32_t kLeastViews = 2;  // that a point is kept for

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
    removed_.database = std::move(db_);
    return std::move(removed_);
  }

 private:
  void TakeKeyframes() {
    db_.camera = map_.camera;
    for (const vision::Keyframe& keyframe : map_.keyframes) {
      new_keyframe_.push_back(kNone);
      if (keyframe.session != session_) {
        new_keyframe_.back() = static_cast<uint32_t>(db_.keyframes.size());
        db_.keyframes.push_back(keyframe);
        db_.keyframes.back().session -= keyframe.session > session_ ? 1 : 0;
      }
    }
  }

  // Without the session, those after it moved up; 0: it was the only one.
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

  // Whether anything of its looks was not of the session alone.
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
      views[o.point] += new_keyframe_[o.keyframe] != kNone;
    }
    db_.descriptor_begin.push_back(0);
    for (uint32_t point = 0; point < map_.points.size(); ++point) {
      new_point_.push_back(kNone);
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

  // They stay in the order of keyframes and points.
  void TakeObservations() {
    for (Observation o : map_.observations) {
      o.keyframe = new_keyframe_[o.keyframe];
      o.point = new_point_[o.point];
      if (o.keyframe != kNone && o.point != kNone) {
        db_.observations.push_back(o);
      }
    }
  }

  // Points that the session saw lie where the sights that stay say. Where that finds nothing they
  // stay where they were.
  void LocateAgain() {
    std::vector<bool> moves(db_.points.size(), false);
    for (uint32_t point = 0; point < map_.points.size(); ++point) {
      if (new_point_[point] != kNone) {
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
    if (!AdjustPoints(db_.camera, db_.observations, poses, moves, points)) {
      return;
    }
    for (size_t i = 0; i < points.size(); ++i) {
      if (moves[i]) {
        db_.points[i] = points[i].cast<float>();
      }
    }
  }

  // What follows from the observations.
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
      if (towards[i].norm() > 1e-9) {  // else it is seen from opposite sides
        db_.normals[i] = towards[i].normalized().cast<float>();
      }
    }
    db_.mean_reprojection_error_px =
        error_sum / static_cast<double>(std::max<size_t>(1, db_.observations.size()));
  }

  // Where one session is left all descriptors are its own: nothing is to be said.
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
  std::vector<uint32_t> new_keyframe_;  // [keyframes of the map]
  std::vector<uint32_t> new_point_;     // [points of the map]
};

}  // namespace

Result<RemovedSession> RemoveSession(const SceneDatabase& map, uint32_t session, uint64_t seed) {
  const std::string place = "session " + std::to_string(session);
  if (session == 0) {
    return Status::Error(place, "is the training itself, which the map is made of",
                         "train the place anew from another recording");
  }
  const bool known =
      std::any_of(map.keyframes.begin(), map.keyframes.end(),
                  [&](const vision::Keyframe& keyframe) { return keyframe.session == session; });
  if (!known) {
    return Status::Error(place, "is not in the map", "train the place again");
  }
  RemovedSession removed = Remover(map, session).Run(seed);
  if (removed.database.points.empty()) {
    return Status::Error(place, "is all that the map stands on", "train the place anew");
  }
  LARARIUM_RETURN_IF_ERROR(removed.database.Validate());
  return removed;
}

}  // namespace lararium::train
