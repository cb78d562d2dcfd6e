#include "editor/train/session_merge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "editor/train/budget.h"
#include "editor/train/session_adjustment.h"
#include "editor/train/session_removal.h"
#include "shared/vision/rolling_shutter.h"
#include "tests/support/synthetic_world.h"

namespace lararium::train {
namespace {

using geometry::Rigid3;
using geometry::Similarity3;
using vision::Observation;
using vision::SceneDatabase;

// A map of a world and a session that was trained by itself: in its own frame and unit, from other
// cameras, and with a part of the descriptors changed by the light.
struct TwoSessions {
  SceneDatabase map;
  SceneDatabase session;
  std::vector<vision::Features> features;  // [session's keyframes]
  Similarity3 map_from_session;
};

struct TwoSessionsOptions {
  double changed_share = 0.5;
  double noise_px = 0.3;
  bool other_camera = false;
  double readout = 0.0;      // The session's readout time along y.
  double map_readout = 0.0;  // The map's, whose camera stood still in each image.
};

// Where a camera with a rolling shutter sees a point, minus where it is in the middle of the image.
Eigen::Vector2d RolledBy(const SceneDatabase& db, uint32_t keyframe, const Eigen::Vector3d& point) {
  const vision::Keyframe& seen = db.keyframes[keyframe];
  const Eigen::Vector2d sharp = *db.camera.Project(seen.camera_from_map * point);
  Eigen::Vector2d rolled = sharp;
  for (int round = 0; round < 10; ++round) {
    const double time = db.readout.dot(vision::ReadoutOrder(db.camera, rolled));
    rolled = *db.camera.Project(vision::PoseAfter(seen.camera_from_map, seen.motion, time) * point);
  }
  return rolled - sharp;
}

void Retake(test::SyntheticWorld& world,
            double noise_px,
            double readout,
            SceneDatabase& db,
            std::vector<vision::Features>& features) {
  db = test::MakeSceneDatabase(world);
  db.observations.clear();
  db.readout.y() = readout;
  Random random(11);
  for (uint32_t k = 0; k < world.cameras_from_world.size(); ++k) {
    for (int i = 0; readout != 0.0 && i < 6; ++i) {
      db.keyframes[k].motion[i] = 0.02 * random.Normal();
    }
    test::SyntheticViewOptions options;
    options.noise_px = noise_px;
    options.seed = 100 + k;
    test::SyntheticView view = test::RenderView(world, world.cameras_from_world[k], options);
    for (size_t f = 0; f < view.features.size(); ++f) {
      vision::Keypoint& keypoint = view.features.keypoints[f];
      const auto point = static_cast<size_t>(view.points[f]);
      const Eigen::Vector2d rolled = RolledBy(db, k, world.points[point]);
      keypoint.x += static_cast<float>(rolled.x());
      keypoint.y += static_cast<float>(rolled.y());
      db.observations.push_back(
          {static_cast<uint32_t>(view.points[f]), k, keypoint.x, keypoint.y, keypoint.scale});
    }
    features.push_back(view.features);
  }
  std::sort(db.observations.begin(), db.observations.end(),
            [](const Observation& a, const Observation& b) {
              return std::tuple(a.keyframe, a.point) < std::tuple(b.keyframe, b.point);
            });
}

TwoSessions MakeTwoSessions(const TwoSessionsOptions& options) {
  TwoSessions sessions;
  test::SyntheticWorld world = test::MakeSyntheticWorld({.points = 300, .cameras = 8});
  std::vector<vision::Features> unused;
  Retake(world, options.noise_px, 0.0, sessions.map, unused);
  sessions.map.readout.y() = options.map_readout;
  sessions.map.colours.assign(300, Eigen::Vector3f(0.4f, 0.2f, 0.1f));

  sessions.map_from_session = {2.5, geometry::RotationFromVector({0.3, -0.8, 0.4}),
                               Eigen::Vector3d(3.0, -1.0, 2.0)};
  const Similarity3 session_from_map = sessions.map_from_session.Inverse();
  Random random(5);
  for (size_t i = 0; i < world.points.size(); ++i) {
    world.points[i] = session_from_map * world.points[i];
    world.normals[i] = session_from_map.rotation * world.normals[i];
    world.sizes[i] *= session_from_map.scale;
    if (random.Uniform() < options.changed_share) {
      world.descriptors[i] = test::RandomDescriptor(random);
    }
  }
  std::vector<Rigid3> cameras;
  for (int i = 0; i < 6; ++i) {
    const double angle = 0.15 * (i - 2.5);
    const Rigid3 camera_from_map =
        test::LookAt({4.2 * std::sin(angle), 0.5, 4.2 * std::cos(angle)}, {0.1, 0, 0});
    cameras.push_back(geometry::CameraFromB(camera_from_map, sessions.map_from_session));
  }
  world.cameras_from_world = cameras;
  if (options.other_camera) {
    world.camera = {.width = 800, .height = 500, .fx = 700, .fy = 700, .cx = 400, .cy = 250};
  }
  Retake(world, options.noise_px, options.readout, sessions.session, sessions.features);
  for (vision::Keyframe& keyframe : sessions.session.keyframes) {
    keyframe.session = 1;
    keyframe.gain = {2.0f, 2.0f, 2.0f};
  }
  // The same points in half the light; the session's own reference hides the difference.
  sessions.session.colours.assign(300, Eigen::Vector3f(0.2f, 0.1f, 0.05f));
  sessions.session.session_masks.assign(300, 2u);
  return sessions;
}

Result<MergedMap> Merge(const TwoSessions& sessions) {
  return MergeSession(sessions.map, sessions.session, sessions.features, MergeOptions(),
                      *MakeSilentLog());
}

double LargestCenterError(const TwoSessions& sessions, const SceneDatabase& merged) {
  double largest = 0.0;
  for (size_t k = 0; k < sessions.session.keyframes.size(); ++k) {
    const Eigen::Vector3d expected =
        sessions.map_from_session * sessions.session.keyframes[k].camera_from_map.Center();
    const Eigen::Vector3d found =
        merged.keyframes[sessions.map.keyframes.size() + k].camera_from_map.Center();
    largest = std::max(largest, (found - expected).norm());
  }
  return largest;
}

TEST(MergeSession, FindsTheSessionsPlaceInTheMap) {
  const TwoSessions sessions = MakeTwoSessions({});
  const Result<MergedMap> merged = Merge(sessions);
  ASSERT_TRUE(merged.ok()) << merged.message();
  ASSERT_TRUE(merged->database.Validate().ok()) << merged->database.Validate().message();
  EXPECT_EQ(merged->report.located, 6);
  EXPECT_EQ(merged->database.keyframes.size(), 14u);
  EXPECT_NEAR(merged->report.map_from_session.scale, 2.5, 0.02);
  EXPECT_LT(LargestCenterError(sessions, merged->database),
            0.02);  // The cameras are at a distance of 4.
}

// The session was filmed by another phone, whose shutter rolls.
TEST(MergeSession, AllowsForTheSessionsRollingShutter) {
  for (const double map_readout : {0.0, 0.5, -0.3}) {
    const TwoSessions sessions =
        MakeTwoSessions({.other_camera = true, .readout = 0.9, .map_readout = map_readout});
    const Result<MergedMap> merged = Merge(sessions);
    ASSERT_TRUE(merged.ok()) << merged.message();
    EXPECT_LT(LargestCenterError(sessions, merged->database), 0.02) << map_readout;
    EXPECT_LT(merged->database.mean_reprojection_error_px, 0.6) << map_readout;
    if (map_readout != 0.0) {
      EXPECT_EQ(merged->database.readout.y(), map_readout);
    }
  }
}

TEST(MergeSession, LeavesTheMapsFrameAndKeyframesAlone) {
  const TwoSessions sessions = MakeTwoSessions({});
  const Result<MergedMap> merged = Merge(sessions);
  ASSERT_TRUE(merged.ok()) << merged.message();
  for (size_t k = 0; k < sessions.map.keyframes.size(); ++k) {
    const Rigid3& before = sessions.map.keyframes[k].camera_from_map;
    const Rigid3& after = merged->database.keyframes[k].camera_from_map;
    EXPECT_EQ(before.translation, after.translation);
    EXPECT_EQ(before.rotation.coeffs(), after.rotation.coeffs());
  }
  for (size_t i = 0; i < sessions.map.points.size(); ++i) {
    EXPECT_LT((merged->database.points[i] - sessions.map.points[i]).norm(), 0.02f);
  }
}

TEST(MergeSession, SharesPointsThatLookTheSameAndAddsTheOthers) {
  const TwoSessions sessions = MakeTwoSessions({.changed_share = 0.4});
  const Result<MergedMap> merged = Merge(sessions);
  ASSERT_TRUE(merged.ok()) << merged.message();
  EXPECT_NEAR(merged->report.shared_points, 180, 20);
  EXPECT_NEAR(merged->report.added_points, 120, 20);
  int both = 0;
  for (size_t i = 0; i < merged->database.points.size(); ++i) {
    const uint32_t mask = merged->database.session_masks[i];
    EXPECT_TRUE(mask == 1u || mask == 2u || mask == 3u);
    both += mask == 3u;
    EXPECT_EQ(mask == 2u, i >= 300);  // The map's points come first.
  }
  EXPECT_EQ(both, merged->report.shared_points);
}

TEST(MergeSession, BringsTheGainsToOneReference) {
  const Result<MergedMap> merged = Merge(MakeTwoSessions({}));
  ASSERT_TRUE(merged.ok()) << merged.message();
  // A value of 1 in the session's reference is 2 in the map's, so the session's colours double and
  // its gain of 2 becomes 1.
  EXPECT_NEAR(merged->database.keyframes.back().gain[1], 1.0f, 1e-4f);
  EXPECT_NEAR(merged->database.colours.back()[0], 0.4f, 1e-4f);
  EXPECT_EQ(merged->database.keyframes.front().gain[1], 1.0f);
}

TEST(MergeSession, TakesAnotherCamera) {
  const TwoSessions sessions = MakeTwoSessions({.other_camera = true});
  const Result<MergedMap> merged = Merge(sessions);
  ASSERT_TRUE(merged.ok()) << merged.message();
  ASSERT_TRUE(merged->database.Validate().ok()) << merged->database.Validate().message();
  EXPECT_EQ(merged->database.camera, sessions.map.camera);
  EXPECT_EQ(merged->database.keyframes.back().grey.cols, sessions.map.camera.width);
  EXPECT_LT(LargestCenterError(sessions, merged->database), 0.02);
  EXPECT_LT(merged->database.mean_reprojection_error_px, 0.6);
}

TEST(MergeSession, RefusesAnotherPlaceAndSaysWhatToFilm) {
  const Result<MergedMap> merged = Merge(MakeTwoSessions({.changed_share = 1.0}));
  ASSERT_FALSE(merged.ok());
  EXPECT_THAT(merged.message(), testing::HasSubstr("0 of 6 images of the new video"));
  EXPECT_THAT(merged.message(), testing::HasSubstr("film the place from where"));
}

// Makes a map consistent, as training does: points fit their observations, and normals are the mean
// directions to the observing cameras.
void Settle(SceneDatabase& map) {
  std::vector<Rigid3> poses;
  for (const vision::Keyframe& keyframe : map.keyframes) {
    poses.push_back(keyframe.camera_from_map);
  }
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3f& point : map.points) {
    points.push_back(point.cast<double>());
  }
  ASSERT_TRUE(AdjustPoints(CamerasOf(map), map.observations, poses,
                           std::vector<bool>(points.size(), true), points));
  std::vector<Eigen::Vector3d> towards(points.size(), Eigen::Vector3d::Zero());
  std::fill(map.observation_counts.begin(), map.observation_counts.end(), 0u);
  for (const Observation& o : map.observations) {
    towards[o.point] += (poses[o.keyframe].Center() - points[o.point]).normalized();
    ++map.observation_counts[o.point];
  }
  for (size_t i = 0; i < points.size(); ++i) {
    map.points[i] = points[i].cast<float>();
    map.normals[i] = towards[i].normalized().cast<float>();
  }
}

TEST(MergeSession, WhatItAddsIsAllThatRemovingTheSessionTakes) {
  TwoSessions sessions = MakeTwoSessions({});
  SceneDatabase& map = sessions.map;
  Settle(map);
  const Result<MergedMap> merged = Merge(sessions);
  ASSERT_TRUE(merged.ok()) << merged.message();
  ASSERT_GT(merged->database.descriptors.size(), map.descriptors.size());
  const Result<RemovedSession> removed = RemoveSession(merged->database, 1);
  ASSERT_TRUE(removed.ok()) << removed.message();
  const SceneDatabase& left = removed->database;
  EXPECT_EQ(left.keyframes.size(), map.keyframes.size());
  EXPECT_EQ(left.descriptors, map.descriptors);
  EXPECT_EQ(left.descriptor_begin, map.descriptor_begin);
  EXPECT_TRUE(left.descriptor_sessions.empty());
  EXPECT_EQ(left.session_masks, map.session_masks);
  EXPECT_EQ(left.observation_counts, map.observation_counts);
  ASSERT_EQ(left.observations.size(), map.observations.size());
  for (size_t i = 0; i < map.observations.size(); ++i) {
    EXPECT_EQ(left.observations[i].point, map.observations[i].point);
    EXPECT_EQ(left.observations[i].x, map.observations[i].x);
  }
  ASSERT_EQ(left.points.size(), map.points.size());
  for (size_t i = 0; i < map.points.size(); ++i) {
    EXPECT_LT((left.points[i] - map.points[i]).norm(), 1e-3f)
        << i;  // The cameras are at a distance of 4.
    EXPECT_LT((left.normals[i] - map.normals[i]).norm(), 1e-3f) << i;
  }
}

TEST(MergeSession, SaysOfDescriptorsWhichSessionsSawThem) {
  const Result<MergedMap> merged = Merge(MakeTwoSessions({.changed_share = 0.4}));
  ASSERT_TRUE(merged.ok()) << merged.message();
  const SceneDatabase& db = merged->database;
  ASSERT_EQ(db.descriptor_sessions.size(), db.descriptors.size());
  for (uint32_t d = 0; d < db.descriptors.size(); ++d) {
    EXPECT_EQ(db.SessionsOf(d) & ~db.session_masks[db.descriptor_point[d]], 0u);
  }
  const Result<vision::SceneDatabase> read =
      vision::ParseSceneDatabase(vision::SerializeSceneDatabase(db), "merged");
  ASSERT_TRUE(read.ok()) << read.message();
  EXPECT_EQ(read->descriptor_sessions, db.descriptor_sessions);
}

TEST(MergeSession, GivesTheSameBytesTwice) {
  const TwoSessions sessions = MakeTwoSessions({});
  const Result<MergedMap> first = Merge(sessions);
  const Result<MergedMap> second = Merge(sessions);
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_EQ(vision::SerializeSceneDatabase(first->database),
            vision::SerializeSceneDatabase(second->database));
}

// The points that a merged map keeps are chosen among all points, with all their descriptors.
TEST(MergeSession, WithinABudgetKeepsWhatPruningTheWholeKeeps) {
  const TwoSessions sessions = MakeTwoSessions({});
  const Result<MergedMap> whole = Merge(sessions);
  MergeOptions options;
  options.max_points = 120;
  const Result<MergedMap> small =
      MergeSession(sessions.map, sessions.session, sessions.features, options, *MakeSilentLog());
  ASSERT_TRUE(whole.ok() && small.ok());
  EXPECT_EQ(small->database.points.size(), 120u);
  BudgetOptions budget;
  budget.max_points = options.max_points;
  EXPECT_EQ(vision::SerializeSceneDatabase(small->database),
            vision::SerializeSceneDatabase(Prune(whole->database, budget)));
}

TEST(NextSession, FollowsTheHighest) {
  SceneDatabase map = test::MakeSceneDatabase(test::MakeSyntheticWorld({.points = 10}));
  EXPECT_EQ(NextSession(map), 1u);
  map.keyframes[3].session = 6;
  EXPECT_EQ(NextSession(map), 7u);
  EXPECT_EQ(NextSession(SceneDatabase()), 0u);
}

}  // namespace
}  // namespace lararium::train
