#include "shared/stage/picks.h"

#include <gmock/gmock.h>

#include "shared/core/random.h"
#include "shared/core/units.h"

namespace lararium::stage {
namespace {

using geometry::Rigid3;
using geometry::Similarity3;
using ::testing::HasSubstr;

// A room in metres, Z up, with a floor at z = 0 and a wall at y = 2, seen by
// cameras in a half circle that look at the middle of the floor.
class World {
 public:
  World() {
    camera_ = {640, 480, 500.0, 505.0, 320.0, 240.0, -0.1, 0.02, 0.0, 0.0};
    for (int i = 0; i < 7; ++i) {
      const double angle = kPi * (0.2 + 0.1 * i);
      const Eigen::Vector3d center(3.0 * std::cos(angle), -3.0 * std::sin(angle), 1.6);
      camera_from_world_.push_back(LookAt(center, Eigen::Vector3d(0.0, 0.0, 0.3)));
    }
    Random random(5);
    for (int i = 0; i < 400; ++i) {
      const double x = random.Uniform(-1.5, 1.5);
      points_.push_back(i % 4 == 0 ? Eigen::Vector3d(x, 2.0, random.Uniform(0.0, 1.5))
                                   : Eigen::Vector3d(x, random.Uniform(-1.5, 2.0), 0.0));
    }
  }

  // A map of this room, as training could produce it, in a frame of its own.
  vision::SceneDatabase Map(const Similarity3& map_from_world) const {
    vision::SceneDatabase database;
    database.camera = camera_;
    for (const Eigen::Vector3d& point : points_) {
      database.points.push_back((map_from_world * point).cast<float>());
    }
    for (size_t k = 0; k < camera_from_world_.size(); ++k) {
      vision::Keyframe keyframe;
      keyframe.frame_index = static_cast<int64_t>(10 * k);
      keyframe.name = "frame" + std::to_string(10 * k);
      keyframe.camera_from_map =
          geometry::CameraFromB(camera_from_world_[k], map_from_world.Inverse());
      database.keyframes.push_back(keyframe);
      for (size_t p = 0; p < points_.size(); ++p) {
        const auto pixel = camera_.Project(camera_from_world_[k] * points_[p]);
        if (pixel && camera_.Contains(*pixel)) {
          database.observations.push_back({static_cast<uint32_t>(p), static_cast<uint32_t>(k),
                                           static_cast<float>(pixel->x()),
                                           static_cast<float>(pixel->y()), 2.0f});
        }
      }
    }
    return database;
  }

  Anchor See(const std::string& name,
             const Eigen::Vector3d& point,
             const std::vector<int>& keyframes) const {
    Anchor anchor{name, {}};
    for (const int k : keyframes) {
      const auto pixel = camera_.Project(camera_from_world_[static_cast<size_t>(k)] * point);
      EXPECT_TRUE(pixel.has_value());
      anchor.picks.push_back({10 * k, "frame" + std::to_string(10 * k), *pixel});
    }
    return anchor;
  }

 private:
  static Rigid3 LookAt(const Eigen::Vector3d& center, const Eigen::Vector3d& target) {
    const Eigen::Vector3d forward = (target - center).normalized();
    const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
    Eigen::Matrix3d camera_from_world;
    camera_from_world << right.transpose(), forward.cross(right).transpose(), forward.transpose();
    return Rigid3::FromMatrix(camera_from_world, -camera_from_world * center);
  }

  geometry::CameraModel camera_;
  std::vector<Rigid3> camera_from_world_;
  std::vector<Eigen::Vector3d> points_;
};

const Eigen::Vector3d kOrigin(0.2, -0.3, 0.0);
const Eigen::Vector3d kForward(0.2, 0.9, 0.0);  // 1.2 m from the origin.
const Eigen::Vector3d kFloor(-0.7, 0.1, 0.0);

StagePicks Picks(const World& world, const std::vector<int>& keyframes) {
  StagePicks picks;
  picks.origin = world.See("origin", kOrigin, keyframes);
  picks.forward = world.See("forward", kForward, keyframes);
  picks.floor = world.See("floor", kFloor, keyframes);
  picks.length_m = 1.2;
  return picks;
}

Similarity3 SomeGauge() {
  return {3.7, Eigen::Quaterniond(0.3, -0.5, 0.7, 0.4).normalized(), {5.0, -2.0, 11.0}};
}

// The stage frame that these picks define: metres, origin at kOrigin, -Z along +y, Y up.
Eigen::Vector3d StageFromWorld(const Eigen::Vector3d& world) {
  const Eigen::Vector3d d = world - kOrigin;
  return {d.x(), d.z(), -d.y()};
}

void ExpectTrueStage(const StageSolution& solution,
                     const Similarity3& map_from_world,
                     double tolerance) {
  for (const Eigen::Vector3d& world : {kOrigin, kForward, kFloor, Eigen::Vector3d(1.0, 1.0, 1.0),
                                       Eigen::Vector3d(-2.0, 0.0, 0.5)}) {
    const Eigen::Vector3d in_world =
        map_from_world.Inverse() * (solution.map_from_stage * StageFromWorld(world));
    EXPECT_LT((in_world - world).norm(), tolerance) << world.transpose();
  }
}

TEST(StagePicks, GiveTheStageThatTheyMean) {
  const World world;
  const auto solution = SolveStage(Picks(world, {0, 3, 6}), world.Map(SomeGauge()));
  ASSERT_TRUE(solution.ok()) << solution.message();
  ExpectTrueStage(*solution, SomeGauge(), 1e-6);
  ASSERT_EQ(solution->anchors.size(), 3u);
  for (const AnchorReport& anchor : solution->anchors) {
    EXPECT_EQ(anchor.picks, 3);
    EXPECT_LT(anchor.error_px, 1e-6);
    EXPECT_GT(anchor.angle, 1.0);
  }
}

TEST(StagePicks, TrainingAgainKeepsTheStage) {
  const World world;
  const StagePicks picks = Picks(world, {1, 5});
  const auto before = SolveStage(picks, world.Map(Similarity3()));
  const auto after = SolveStage(picks, world.Map(SomeGauge()));
  ASSERT_TRUE(before.ok() && after.ok());
  for (const Eigen::Vector3d& on_stage :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0.3, 1.7, -2)}) {
    const Eigen::Vector3d in_world = before->map_from_stage * on_stage;
    EXPECT_TRUE(
        (SomeGauge().Inverse() * (after->map_from_stage * on_stage)).isApprox(in_world, 1e-6));
  }
  EXPECT_NEAR(before->length_spread, after->length_spread, 1e-6);
}

TEST(StagePicks, ASinglePickMeetsTheSurfaceAroundIt) {
  const World world;
  const auto solution = SolveStage(Picks(world, {3}), world.Map(SomeGauge()));
  ASSERT_TRUE(solution.ok()) << solution.message();
  ExpectTrueStage(*solution, SomeGauge(), 1e-3);
  EXPECT_EQ(solution->anchors[0].angle, 0.0);
}

TEST(StagePicks, ASinglePickIgnoresPointsOffTheSurface) {
  const World world;
  vision::SceneDatabase map = world.Map(Similarity3());
  for (size_t i = 0; i < map.points.size(); i += 5) {
    map.points[i].z() += 0.2f + 0.01f * static_cast<float>(i % 7);
  }
  const auto solution = SolveStage(Picks(world, {3}), map);
  ASSERT_TRUE(solution.ok()) << solution.message();
  ExpectTrueStage(*solution, Similarity3(), 1e-3);
}

TEST(StagePicks, TheLengthMayLieElsewhere) {
  const World world;
  StagePicks picks = Picks(world, {0, 4});
  picks.length_from = world.See("foot", {0.5, 1.9, 0.0}, {1, 2, 4});
  picks.length_to = world.See("head", {0.5, 1.9, 0.8}, {1, 2, 4});
  picks.length_m = 0.8;
  const auto solution = SolveStage(picks, world.Map(SomeGauge()));
  ASSERT_TRUE(solution.ok()) << solution.message();
  ExpectTrueStage(*solution, SomeGauge(), 1e-6);
  EXPECT_EQ(solution->anchors.size(), 5u);
}

TEST(StagePicks, TheSpreadPredictsWhatWrongPicksDo) {
  const World world;
  const vision::SceneDatabase map = world.Map(Similarity3());
  const StagePicks exact = Picks(world, {0, 3, 6});
  const auto solution = SolveStage(exact, map);
  ASSERT_TRUE(solution.ok());
  Random random(11);
  double sum = 0.0;
  constexpr int kRounds = 200;
  for (int i = 0; i < kRounds; ++i) {
    StagePicks noisy = exact;
    for (Anchor* anchor : {&noisy.origin, &noisy.forward}) {
      for (Pick& pick : anchor->picks) {
        pick.pixel += Eigen::Vector2d{random.Normal(), random.Normal()};
      }
    }
    const auto other = SolveStage(noisy, map);
    ASSERT_TRUE(other.ok());
    const double change = other->map_from_stage.scale / solution->map_from_stage.scale - 1.0;
    sum += change * change;
  }
  EXPECT_NEAR(std::sqrt(sum / kRounds) / solution->length_spread, 1.0, 0.15);
}

TEST(StagePicks, TheSpreadOfAPointPredictsWhatWrongPicksDoToIt) {
  const World world;
  const vision::SceneDatabase map = world.Map(SomeGauge());
  const Anchor exact = world.See("corner", {0.4, 0.7, 0.9}, {0, 3, 6});
  const auto located = SolveAnchor(exact, map);
  ASSERT_TRUE(located.ok());
  Random random(12);
  double sum = 0.0;
  constexpr int kRounds = 400;
  for (int i = 0; i < kRounds; ++i) {
    Anchor noisy = exact;
    for (Pick& pick : noisy.picks) {
      pick.pixel += Eigen::Vector2d{random.Normal(), random.Normal()};
    }
    const auto moved = SolveAnchor(noisy, map);
    ASSERT_TRUE(moved.ok());
    sum += (moved->point_in_map - located->point_in_map).squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(sum / kRounds) / AnchorSpread(exact, map), 1.0, 0.1);
}

TEST(StagePicks, ReportHowFarPicksDisagree) {
  const World world;
  StagePicks picks = Picks(world, {0, 3, 6});
  picks.forward.picks[1].pixel.y() += 9.0;
  const auto solution = SolveStage(picks, world.Map(SomeGauge()));
  ASSERT_TRUE(solution.ok());
  EXPECT_LT(solution->anchors[0].error_px, 1e-6);
  EXPECT_GT(solution->anchors[1].error_px, 2.0);
}

TEST(StagePicks, PicksInFramesThatAreNoKeyframesAreLeftOut) {
  const World world;
  StagePicks picks = Picks(world, {0, 3, 6});
  picks.origin.picks[1].frame_index = 31;
  picks.origin.picks[2].frame = "other";
  const auto solution = SolveStage(picks, world.Map(SomeGauge()));
  ASSERT_TRUE(solution.ok());
  EXPECT_EQ(solution->anchors[0].picks, 1);
  EXPECT_THAT(solution->anchors[0].left_out, testing::ElementsAre("frame30", "other"));
  EXPECT_EQ(solution->anchors[1].picks, 3);
  EXPECT_TRUE(solution->anchors[1].left_out.empty());
}

TEST(StagePicks, LieInTheirSessionOnly) {
  const World world;
  vision::SceneDatabase map = world.Map(SomeGauge());
  StagePicks picks = Picks(world, {0, 3, 6});
  picks.origin.picks[1].session = 2;
  auto solution = SolveStage(picks, map);
  ASSERT_TRUE(solution.ok());
  EXPECT_THAT(solution->anchors[0].left_out, testing::ElementsAre("frame30 of session 2"));
  map.keyframes[3].session = 2;  // The other keyframes have session 0.
  solution = SolveStage(picks, map);
  ASSERT_TRUE(solution.ok());
  EXPECT_EQ(solution->anchors[0].picks, 3);
  EXPECT_EQ(solution->anchors[1].picks, 2);
}

TEST(StagePicks, AGivenScaleMeasuresTheKnownLength) {
  const World world;
  StagePicks picks = Picks(world, {0, 3, 6});
  picks.length_m = 1.5;  // The true length is 1.2.
  const auto solution = SolveStage(picks, world.Map(SomeGauge()), SomeGauge().scale);
  ASSERT_TRUE(solution.ok()) << solution.message();
  ExpectTrueStage(*solution, SomeGauge(), 1e-6);
  EXPECT_NEAR(solution->measured_length_m, 1.2, 1e-6);
}

TEST(StagePicks, ASinglePickMayLieInAFrameThatWasLocatedAfterwards) {
  const World world;
  vision::SceneDatabase map = world.Map(SomeGauge());
  std::erase_if(map.observations, [](const auto& o) { return o.keyframe == 3; });
  const Eigen::Vector3f away = (SomeGauge().rotation * Eigen::Vector3d(0, -1, 1)).cast<float>();
  map.normals.assign(map.points.size(), away.normalized());
  const auto solution = SolveStage(Picks(world, {3}), map);
  ASSERT_TRUE(solution.ok()) << solution.message();
  ExpectTrueStage(*solution, SomeGauge(), 1e-3);
}

TEST(StagePicks, FailuresNameTheAnchorAndTheRemedy) {
  const World world;
  const vision::SceneDatabase map = world.Map(Similarity3());
  const StagePicks good = Picks(world, {0, 4});

  StagePicks picks = good;
  picks.floor.picks.clear();
  EXPECT_THAT(SolveStage(picks, map).message(), HasSubstr("'floor': no pick lies in a keyframe"));

  picks = good;
  picks.floor.picks = {{7, "frame7", {1, 1}}, {9, "frame9", {1, 1}}};
  EXPECT_THAT(SolveStage(picks, map).message(), HasSubstr("they lie in frame7, frame9"));

  picks = good;
  picks.floor = world.See("floor", 0.4 * kOrigin + 0.6 * kForward, {0, 4});
  EXPECT_THAT(SolveStage(picks, map).message(), HasSubstr("well to the side"));

  picks = good;
  picks.forward.picks[1] = picks.forward.picks[0];
  EXPECT_FALSE(SolveStage(picks, map).ok());

  picks = good;
  picks.length_m = 0.0;
  EXPECT_THAT(SolveStage(picks, map).message(), HasSubstr("known length"));

  picks = Picks(world, {3});
  vision::SceneDatabase empty = map;
  empty.observations.clear();
  EXPECT_THAT(SolveStage(picks, empty).message(), HasSubstr("second training image"));
}

}  // namespace
}  // namespace lararium::stage
