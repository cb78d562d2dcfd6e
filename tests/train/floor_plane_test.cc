#include "editor/train/floor_plane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shared/core/random.h"
#include "shared/core/units.h"

namespace lararium::train {
namespace {

using Eigen::Vector3d;
using geometry::Similarity3;

struct RoomOptions {
  double noise = 0.004;     // Noise of every point, metres.
  int floor_points = 1500;  // 0: the floor is not visible.
  int table_points = 2500;  // A richly painted table.
  bool clutter = true;
  double pitch = 0.35;  // Downward pitch of the cameras, radians.
  uint64_t seed = 1;
};

// A room of 5 m x 4 m with z up and the floor at z = 0. It has a table of 1.6 m x 0.9 m that is
// 0.75 m high, three walls, and clutter at all heights below a metre. It is filmed from the open
// side at a height of 1.5 m.
class Room {
 public:
  explicit Room(const RoomOptions& options) : random_(options.seed), noise_(options.noise) {
    for (int i = 0; i < options.floor_points; ++i) {
      Add({random_.Uniform(-2.5, 2.5), random_.Uniform(-2.0, 2.0), 0.0});
    }
    for (int i = 0; i < options.table_points; ++i) {
      Add({random_.Uniform(-0.8, 0.8), random_.Uniform(0.4, 1.3), 0.75});
    }
    for (int i = 0; i < 1500; ++i) {
      Add({random_.Uniform(-2.5, 2.5), 2.0, random_.Uniform(0.0, 2.5)});
      Add({i % 2 == 0 ? -2.5 : 2.5, random_.Uniform(-2.0, 2.0), random_.Uniform(0.0, 2.5)});
    }
    for (int i = 0; options.clutter && i < 1200; ++i) {
      const double pot = std::floor(random_.Uniform(0.0, 6.0));
      const double angle = random_.Uniform(0.0, 2.0 * std::numbers::pi);
      Add({-2.0 + 0.8 * pot + 0.15 * std::cos(angle), -0.2 + 0.15 * std::sin(angle),
           random_.Uniform(0.0, 0.6)});
    }
    for (int i = 0; i < 12; ++i) {
      const double heading = -0.6 + 0.1 * i;
      AddCamera({3.0 * std::sin(heading), -3.5 * std::cos(heading), 1.5}, heading, options.pitch);
    }
  }

  vision::SceneDatabase Map(const Similarity3& map_from_room) const {
    vision::SceneDatabase map;
    for (const Vector3d& point : points_) {
      map.points.push_back((map_from_room * point).cast<float>());
    }
    for (const geometry::Rigid3& camera_from_room : cameras_) {
      map.keyframes.emplace_back();
      map.keyframes.back().camera_from_map =
          geometry::CameraFromB(camera_from_room, map_from_room.Inverse());
    }
    return map;
  }

 private:
  void Add(const Vector3d& point) {
    points_.push_back(point +
                      noise_ * Vector3d{random_.Normal(), random_.Normal(), random_.Normal()});
  }

  // Adds a camera that looks along +y, turned by -heading and then down by pitch.
  void AddCamera(const Vector3d& center, double heading, double pitch) {
    const Vector3d level(-std::sin(heading), std::cos(heading), 0.0);
    const Vector3d forward = std::cos(pitch) * level - std::sin(pitch) * Vector3d::UnitZ();
    const Vector3d right = level.cross(Vector3d::UnitZ());
    Eigen::Matrix3d camera_from_room;
    camera_from_room << right.transpose(), forward.cross(right).transpose(), forward.transpose();
    cameras_.push_back(geometry::Rigid3::FromMatrix(camera_from_room, -camera_from_room * center));
  }

  Random random_;
  double noise_;
  std::vector<Vector3d> points_;
  std::vector<geometry::Rigid3> cameras_;
};

Similarity3 SomeGauge() {
  return {0.37, Eigen::Quaterniond(0.3, -0.5, 0.7, 0.4).normalized(), {5.0, -2.0, 11.0}};
}

double TiltFrom(const FloorPlane& floor, const Similarity3& map_from_room) {
  return std::acos(std::min(1.0, floor.normal.dot(map_from_room.rotation * Vector3d::UnitZ())));
}

// Height of the found floor in the room at the room's middle, metres.
double HeightInRoom(const FloorPlane& floor, const Similarity3& map_from_room) {
  return -floor.Height(map_from_room.translation) / map_from_room.scale;
}

TEST(FindFloor, FindsTheFloorUnderARicherTable) {
  const auto floor = FindFloor(Room({}).Map(SomeGauge()));
  ASSERT_TRUE(floor.has_value());
  EXPECT_LT(TiltFrom(*floor, SomeGauge()), 0.1 * kRadiansPerDegree);
  EXPECT_NEAR(HeightInRoom(*floor, SomeGauge()), 0.0, 0.002);
  EXPECT_NEAR(floor->spread / SomeGauge().scale, 0.004, 0.0015);
  EXPECT_GT(floor->points, 1000);
  EXPECT_LT(floor->points, 2200);
}

TEST(FindFloor, DoesNotDependOnTheGauge) {
  const Room room({});
  const auto here = FindFloor(room.Map({}));
  const Similarity3 gauge{250.0, SomeGauge().rotation, {-1e3, 2e3, 5e2}};
  const auto there = FindFloor(room.Map(gauge));
  ASSERT_TRUE(here && there);
  EXPECT_NEAR(TiltFrom(*there, gauge), TiltFrom(*here, {}), 0.05 * kRadiansPerDegree);
  EXPECT_NEAR(HeightInRoom(*there, gauge), HeightInRoom(*here, {}), 0.001);
}

TEST(FindFloor, TakesTheTableWhereNothingBelowItIsSeen) {
  RoomOptions options;
  options.floor_points = 0;
  options.clutter = false;
  const auto floor = FindFloor(Room(options).Map({}));
  ASSERT_TRUE(floor.has_value());
  EXPECT_NEAR(HeightInRoom(*floor, {}), 0.75, 0.005);
}

TEST(FindFloor, FindsNoneInWallsAndClutter) {
  RoomOptions options;
  options.floor_points = 0;
  options.table_points = 0;
  EXPECT_FALSE(FindFloor(Room(options).Map(SomeGauge())).has_value());
  EXPECT_FALSE(FindFloor({}).has_value());
}

TEST(FindFloor, StandsCamerasThatAllLookTheSameWayDown) {
  RoomOptions options;
  options.pitch = 0.55;
  options.noise = 0.01;
  const auto floor = FindFloor(Room(options).Map(SomeGauge()));
  ASSERT_TRUE(floor.has_value());
  EXPECT_LT(TiltFrom(*floor, SomeGauge()), 0.3 * kRadiansPerDegree);
  EXPECT_NEAR(HeightInRoom(*floor, SomeGauge()), 0.0, 0.005);
}

TEST(FindFloor, PredictsItsTilt) {
  double squares = 0.0;
  constexpr int kRooms = 12;
  for (int i = 0; i < kRooms; ++i) {
    RoomOptions options;
    options.seed = static_cast<uint64_t>(100 + i);
    options.floor_points = 600;
    options.noise = 0.01;
    options.clutter = false;
    const auto floor = FindFloor(Room(options).Map({}));
    ASSERT_TRUE(floor.has_value());
    squares += std::pow(TiltFrom(*floor, {}) / floor->tilt_deviation, 2);
  }
  // The tilt has two axes and the deviation is that of the worse one, so the expected mean square
  // is between 1 and 2.
  EXPECT_GT(std::sqrt(squares / kRooms), 0.6);
  EXPECT_LT(std::sqrt(squares / kRooms), 2.5);
}

}  // namespace
}  // namespace lararium::train
