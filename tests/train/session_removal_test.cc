#include "editor/train/session_removal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "shared/vision/localizer.h"
#include "tests/support/synthetic_world.h"

namespace lararium::train {
namespace {

using testing::HasSubstr;
using vision::Observation;
using vision::SceneDatabase;

// Twelve keyframes of three sessions in turn. Points below 20 are seen by session 1 alone, those
// below 40 by it and once by session 0, point 40 by sessions 1 and 2, the others by all.
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
    EXPECT_EQ(db.points[i], map.points[i + 40]);
    EXPECT_EQ(db.descriptors[i], map.descriptors[i + 40]);
  }
  EXPECT_EQ(db.session_masks[0], 2u);  // only what was session 2 saw it
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
  EXPECT_THAT(RemoveSession(map, 0).message(), HasSubstr("the training itself"));
  EXPECT_THAT(RemoveSession(map, 3).message(), HasSubstr("is not in the map"));
  SceneDatabase alone = map;
  for (vision::Keyframe& keyframe : alone.keyframes) {
    keyframe.session = 1;
  }
  EXPECT_THAT(RemoveSession(alone, 1).message(), HasSubstr("all that the map stands on"));
}

}  // namespace
}  // namespace lararium::train
