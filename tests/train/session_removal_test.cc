#include "editor/train/session_removal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "shared/core/random.h"
#include "shared/vision/localizer.h"
#include "tests/support/synthetic_world.h"

namespace lararium::train {
namespace {

using testing::HasSubstr;
using vision::Observation;
using vision::SceneDatabase;

// A map of twelve keyframes that belong to three sessions in turn. Points below 20 are observed by
// session 1 alone, those below 40 also once by session 0, point 40 by sessions 1 and 2, and all
// others by all sessions.
SceneDatabase Map() {
  SceneDatabase db =
      test::MakeSceneDatabase(test::MakeSyntheticWorld({.points = 200, .cameras = 12}));
  for (size_t k = 0; k < db.keyframes.size(); ++k) {
    db.keyframes[k].session = static_cast<uint32_t>(k % 3);
  }
  std::erase_if(db.observations, [&](const Observation& o) {
    const uint32_t session = db.keyframes[o.keyframe].session;
    if (o.point < 20) return session != 1;
    if (o.point < 40) return session == 2 || (session == 0 && o.keyframe != 3);
    return o.point == 40 && session == 0;
  });
  std::fill(db.session_masks.begin(), db.session_masks.end(), 0u);
  std::fill(db.observation_counts.begin(), db.observation_counts.end(), 0u);
  for (const Observation& o : db.observations) {
    db.session_masks[o.point] |= 1u << db.keyframes[o.keyframe].session;
    ++db.observation_counts[o.point];
  }
  return db;
}

TEST(RemoveSession, LeavesNothingOfItAndMovesLaterSessionsUp) {
  const SceneDatabase map = Map();
  const Result<RemovedSession> removed = RemoveSession(map, 1);
  ASSERT_TRUE(removed.ok()) << removed.message();
  const SceneDatabase& db = removed->database;
  ASSERT_EQ(db.keyframes.size(), 8u);
  EXPECT_EQ(removed->keyframes, 4u);
  for (size_t k = 0; k < db.keyframes.size(); ++k) {
    // Keyframes 0, 2, 3, 5, ... of the map.
    const vision::Keyframe& before = map.keyframes[k / 2 * 3 + (k % 2) * 2];
    EXPECT_EQ(db.keyframes[k].name, before.name);
    EXPECT_EQ(db.keyframes[k].session, k % 2);
    EXPECT_EQ(db.keyframes[k].camera_from_map.translation, before.camera_from_map.translation);
  }
  EXPECT_TRUE(db.Validate().ok()) << db.Validate().message();
}

TEST(RemoveSession, KeepsPointsThatTwoOthersShow) {
  const SceneDatabase map = Map();
  const Result<RemovedSession> removed = RemoveSession(map, 1);
  ASSERT_TRUE(removed.ok());
  const SceneDatabase& db = removed->database;
  EXPECT_EQ(removed->points, 40u);
  ASSERT_EQ(db.points.size(), 160u);
  for (size_t i = 0; i < db.points.size(); ++i) {
    EXPECT_LT((db.points[i] - map.points[i + 40]).norm(), 1e-4f);
    EXPECT_EQ(db.descriptors[i], map.descriptors[i + 40]);
  }
  EXPECT_EQ(db.session_masks[0], 2u);  // Only the former session 2 observed it.
  EXPECT_EQ(db.session_masks[1], 3u);
}

TEST(RemoveSession, ObservationsArePartOfThoseThatWere) {
  const SceneDatabase map = Map();
  const Result<RemovedSession> removed = RemoveSession(map, 2);
  ASSERT_TRUE(removed.ok());
  const SceneDatabase& db = removed->database;
  EXPECT_EQ(map.observations.size() - removed->observations, db.observations.size());
  std::vector<uint32_t> counts(db.points.size(), 0);
  for (const Observation& o : db.observations) {
    ++counts[o.point];
    const auto pixel = db.camera.Project(db.keyframes[o.keyframe].camera_from_map *
                                         db.points[o.point].cast<double>());
    EXPECT_NEAR((*pixel - Eigen::Vector2d(o.x, o.y)).norm(), 0.0, 1e-3);
  }
  EXPECT_EQ(counts, db.observation_counts);
  EXPECT_NEAR(db.mean_reprojection_error_px, 0.0, 1e-3);
}

TEST(RemoveSession, TakesWhatPointsLookLikeInThatSessionAlone) {
  SceneDatabase map = Map();
  // Each point has one descriptor for sessions 0 and 2, one for session 1, and one for 1 and 2.
  Random random(4);
  map.descriptors.clear();
  map.descriptor_point.clear();
  map.descriptor_begin = {0};
  for (uint32_t point = 0; point < map.points.size(); ++point) {
    for (const uint32_t sessions : {0b101u, 0b010u, 0b110u}) {
      map.descriptors.push_back(test::RandomDescriptor(random));
      map.descriptor_point.push_back(point);
      map.descriptor_sessions.push_back(sessions);
    }
    map.descriptor_begin.push_back(static_cast<uint32_t>(map.descriptors.size()));
  }
  const Result<RemovedSession> removed = RemoveSession(map, 1);
  ASSERT_TRUE(removed.ok()) << removed.message();
  const SceneDatabase& db = removed->database;
  ASSERT_EQ(db.points.size(), 160u);
  for (uint32_t point = 0; point < db.points.size(); ++point) {
    const uint32_t first = db.descriptor_begin[point];
    ASSERT_EQ(db.descriptor_begin[point + 1] - first, 2u);
    EXPECT_EQ(db.descriptors[first], map.descriptors[3 * (point + 40)]);
    EXPECT_EQ(db.descriptor_sessions[first], 0b11u) << "session 2 is session 1 now";
    EXPECT_EQ(db.descriptors[first + 1], map.descriptors[3 * (point + 40) + 2]);
    EXPECT_EQ(db.descriptor_sessions[first + 1], 0b10u);
  }
  const Result<RemovedSession> alone = RemoveSession(db, 1);
  ASSERT_TRUE(alone.ok()) << alone.message();
  EXPECT_TRUE(alone->database.descriptor_sessions.empty()) << "one session is left";
}

TEST(RemoveSession, TheMapStillLocates) {
  const test::SyntheticWorld world = test::MakeSyntheticWorld({.points = 200, .cameras = 12});
  const Result<RemovedSession> removed = RemoveSession(Map(), 1);
  ASSERT_TRUE(removed.ok());
  vision::Localizer localizer(removed->database, vision::LocalizerOptions());
  const test::SyntheticView view = test::RenderView(world, world.cameras_from_world[4], {});
  const vision::Location location = localizer.Locate(view.features, world.camera);
  ASSERT_TRUE(location.camera_from_map.has_value());
  EXPECT_LT((location.camera_from_map->Center() - world.cameras_from_world[4].Center()).norm(),
            0.01);
}

TEST(RemoveSession, SaysWhatItCannotRemove) {
  const SceneDatabase map = Map();
  EXPECT_THAT(RemoveSession(map, 0).message(), HasSubstr("is the first recording"));
  EXPECT_THAT(RemoveSession(map, 3).message(), HasSubstr("is not in the map"));
  SceneDatabase alone = map;
  for (vision::Keyframe& keyframe : alone.keyframes) {
    keyframe.session = 1;
  }
  EXPECT_THAT(RemoveSession(alone, 1).message(), HasSubstr("supports the whole map"));
}

}  // namespace
}  // namespace lararium::train
