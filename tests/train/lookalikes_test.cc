#include "editor/train/lookalikes.h"

#include <gtest/gtest.h>

#include "tests/support/synthetic_world.h"

namespace lararium::train {
namespace {

using test::SyntheticWorld;

constexpr double kPainting = 0.3;  // Points with a larger x belong to the painting.

// A room and, 30 m aside, another one that looks the same. The painting is only in the first.
SyntheticWorld TwinRooms() {
  SyntheticWorld world = test::MakeSyntheticWorld({.points = 1200});
  const Eigen::Vector3d aside(30.0, 0.0, 0.0);
  const size_t points = world.points.size();
  Random random(5);
  for (size_t i = 0; i < points; ++i) {
    world.points.push_back(world.points[i] + aside);
    world.normals.push_back(world.normals[i]);
    world.sizes.push_back(world.sizes[i]);
    world.descriptors.push_back(world.points[i].x() > kPainting ? test::RandomDescriptor(random)
                                                                : world.descriptors[i]);
  }
  const size_t cameras = world.cameras_from_world.size();
  for (size_t i = 0; i < cameras; ++i) {
    geometry::Rigid3 camera = world.cameras_from_world[i];
    camera.translation -= camera.rotation * aside;
    world.cameras_from_world.push_back(camera);
  }
  return world;
}

TEST(Lookalikes, MarksWhatTwoRoomsHaveAndNotWhatOneHas) {
  const SyntheticWorld world = TwinRooms();
  const vision::SceneDatabase database = test::MakeSceneDatabase(world);
  const std::vector<uint8_t> marks = FindLookalikes(database, 1);
  ASSERT_EQ(marks.size(), database.points.size());
  size_t common = 0;
  size_t marked = 0;
  size_t unique = 0;
  size_t wrong = 0;
  for (size_t i = 0; i < database.points.size(); ++i) {
    const float x = database.points[i].x();
    const bool first_room = x < 15.0f;
    const double in_room = first_room ? x : x - 30.0f;
    if (in_room < kPainting - 0.1) {
      ++common;
      marked += marks[i];
    } else if (in_room > kPainting + 0.2) {
      ++unique;
      wrong += marks[i];
    }
  }
  ASSERT_GT(unique, 100u);
  EXPECT_GT(marked, common * 95 / 100);
  EXPECT_LT(wrong, unique * 5 / 100);
}

TEST(Lookalikes, MarksNothingWhereAllIsDifferent) {
  const SyntheticWorld world = test::MakeSyntheticWorld({.points = 1200});
  EXPECT_TRUE(FindLookalikes(test::MakeSceneDatabase(world), 1).empty());
}

}  // namespace
}  // namespace lararium::train
