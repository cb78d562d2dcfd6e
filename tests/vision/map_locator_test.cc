#include "shared/vision/map_locator.h"

#include <gtest/gtest.h>

#include "shared/core/parallel.h"
#include "tests/support/synthetic_world.h"

namespace lararium::vision {
namespace {

using geometry::Rigid3;
using test::SyntheticWorld;

struct House {
  std::vector<SyntheticWorld> rooms;
  std::vector<std::shared_ptr<const SceneDatabase>> maps;
};

House MakeHouse(int rooms) {
  House house;
  for (int i = 0; i < rooms; ++i) {
    house.rooms.push_back(test::MakeSyntheticWorld({.seed = static_cast<uint64_t>(i + 1)}));
    house.maps.push_back(
        std::make_shared<SceneDatabase>(test::MakeSceneDatabase(house.rooms.back())));
  }
  return house;
}

TEST(MapLocator, FindsTheRoomAndThePoseInIt) {
  const House house = MakeHouse(4);
  MapLocator locator(house.maps, {});
  for (uint32_t room = 0; room < house.rooms.size(); ++room) {
    const SyntheticWorld& world = house.rooms[room];
    const Rigid3& truth = world.cameras_from_world[2 + room];
    const auto view = test::RenderView(world, truth, {.noise_px = 0.3, .outlier_share = 0.5});
    const Located located = locator.Locate(view.features, {ExactCamera(world.camera)});
    EXPECT_EQ(located.map, room);
    ASSERT_TRUE(located.location.camera_from_map.has_value());
    EXPECT_LT((located.location.camera_from_map->Center() - truth.Center()).norm(), 0.02);
    // The search chooses one map; the pose must equal that of a localizer for this map alone.
    Localizer alone(*house.maps[room], {});
    const Location expected = alone.Locate(view.features, world.camera);
    EXPECT_EQ(located.location.camera_from_map->translation, expected.camera_from_map->translation);
    EXPECT_EQ(located.location.covariance, expected.covariance);
  }
}

TEST(MapLocator, FindsTheRoomOfAViewThatHalfShowsAnother) {
  const House house = MakeHouse(3);
  MapLocator locator(house.maps, {});
  const auto seen =
      test::RenderView(house.rooms[2], house.rooms[2].cameras_from_world[5], {.noise_px = 0.3});
  auto view = test::RenderView(house.rooms[0], house.rooms[0].cameras_from_world[5],
                               {.noise_px = 0.3, .outlier_share = 1.0});
  view.features.keypoints.resize(view.features.size() / 3);
  view.features.descriptors.resize(view.features.keypoints.size());
  test::Append(seen.features, view.features);
  const Located located = locator.Locate(view.features, {ExactCamera(house.rooms[2].camera)});
  EXPECT_EQ(located.map, 2u);
  EXPECT_TRUE(located.location.camera_from_map.has_value());
}

TEST(MapLocator, TriesTheOtherMapsWhereThatOfMostVotesGivesNoPose) {
  const House house = MakeHouse(2);
  MapLocator locator(house.maps, {});
  // Adds more features of room 0, but at positions that no pose explains.
  auto view =
      test::RenderView(house.rooms[1], house.rooms[1].cameras_from_world[5], {.noise_px = 0.3});
  view.features.keypoints.resize(100);
  view.features.descriptors.resize(100);
  const auto scattered = test::RenderView(house.rooms[0], house.rooms[0].cameras_from_world[5],
                                          {.outlier_share = 1.0});
  test::Append(scattered.features, view.features);
  const Located located = locator.Locate(view.features, {ExactCamera(house.rooms[1].camera)});
  EXPECT_EQ(located.map, 1u);
  EXPECT_TRUE(located.location.camera_from_map.has_value());
}

TEST(MapLocator, FindsNothingInAPlaceThatIsNoRoomOfTheHouse) {
  const House house = MakeHouse(3);
  MapLocator locator(house.maps, {});
  const SyntheticWorld elsewhere = test::MakeSyntheticWorld({.seed = 99});
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    const auto view =
        test::RenderView(elsewhere, elsewhere.cameras_from_world[seed], {.seed = seed});
    const Located located = locator.Locate(view.features, {ExactCamera(elsewhere.camera)});
    EXPECT_FALSE(located.location.camera_from_map.has_value());
    EXPECT_NE(located.location.reason, TrackReason::kNone);
  }
  EXPECT_FALSE(locator.Locate(Features(), {ExactCamera(elsewhere.camera)})
                   .location.camera_from_map.has_value());
}

TEST(MapLocator, DoesNotDependOnThreadsOrOnWhatCameBefore) {
  const House house = MakeHouse(3);
  MapLocator first(house.maps, {});
  MapLocator second(house.maps, {});
  const SyntheticWorld& world = house.rooms[1];
  const auto view =
      test::RenderView(world, world.cameras_from_world[4], {.noise_px = 0.5, .outlier_share = 0.5});
  const Located a = first.Locate(view.features, {ExactCamera(world.camera)});
  second.Locate(test::RenderView(house.rooms[0], world.cameras_from_world[7], {}).features,
                {ExactCamera(world.camera)});
  const ThreadLimit limit(1);
  const Located b = second.Locate(view.features, {ExactCamera(world.camera)});
  EXPECT_EQ(a.map, b.map);
  ASSERT_TRUE(a.location.camera_from_map && b.location.camera_from_map);
  EXPECT_EQ(a.location.camera_from_map->translation, b.location.camera_from_map->translation);
  EXPECT_EQ(a.location.camera_from_map->rotation.coeffs(),
            b.location.camera_from_map->rotation.coeffs());
  EXPECT_EQ(a.location.covariance, b.location.covariance);
  EXPECT_EQ(a.location.confidence, b.location.confidence);
}

}  // namespace
}  // namespace lararium::vision
