#include "editor/train/budget.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "shared/vision/localizer.h"
#include "tests/support/synthetic_world.h"

namespace lararium::train {
namespace {

using vision::SceneDatabase;

SceneDatabase Map(int points) {
  return test::MakeSceneDatabase(test::MakeSyntheticWorld({.points = points, .cameras = 10}));
}

TEST(ChoosePoints, TakesAllWhereThereIsRoom) {
  EXPECT_EQ(ChoosePoints(Map(50), 50).size(), 50u);
  EXPECT_EQ(ChoosePoints(Map(50), 80).back(), 49u);
}

TEST(ChoosePoints, ServesEveryKeyframe) {
  // Only one keyframe observes the last twenty points; most points are observed by nine.
  SceneDatabase db = Map(500);
  std::erase_if(db.observations,
                [](const vision::Observation& o) { return (o.keyframe == 9) != (o.point >= 480); });
  std::set<uint32_t> lonely;
  for (const uint32_t point : ChoosePoints(db, 100)) {
    if (point >= 480) {
      lonely.insert(point);
    }
  }
  EXPECT_GE(lonely.size(), 8u);
}

TEST(ChoosePoints, PrefersPointsSeenOften) {
  SceneDatabase db = Map(300);
  std::erase_if(db.observations, [](const vision::Observation& o) {
    return o.point % 2 == 1 && o.keyframe % 5 != 0;  // Odd points are observed a fifth as often.
  });
  size_t even = 0;
  const std::vector<uint32_t> chosen = ChoosePoints(db, 100);
  for (const uint32_t point : chosen) {
    even += point % 2 == 0;
  }
  EXPECT_GT(even, 80u);
  EXPECT_TRUE(std::is_sorted(chosen.begin(), chosen.end()));
}

TEST(ChoosePoints, AvoidsPointsThatLookAlike) {
  SceneDatabase db = Map(300);
  for (uint32_t d = 1; d < 300; d += 2) {  // Half of the points share one descriptor.
    db.descriptors[d] = db.descriptors[1];
  }
  db.forest = vision::BuildForest(db.descriptors, {});
  size_t distinct = 0;
  for (const uint32_t point : ChoosePoints(db, 100)) {
    distinct += point % 2 == 0;
  }
  EXPECT_GT(distinct, 80u);
}

TEST(ChooseImages, DropsImagesThatShowNothingNew) {
  const SceneDatabase db = Map(200);
  const std::vector<uint32_t> all = ChooseImages(db, 1.0);
  const std::vector<uint32_t> most = ChooseImages(db, 0.9);
  EXPECT_LT(all.size(), 10u);  // Cameras are 6 degrees apart.
  EXPECT_GE(all.size(), 2u);   // The arc spans 57 degrees.
  EXPECT_LE(most.size(), all.size());
  EXPECT_TRUE(ChooseImages(db, 0.0).empty());
}

TEST(ChooseImages, ShowsEveryObservationFromNearby) {
  const SceneDatabase db = Map(200);
  const std::vector<uint32_t> images = ChooseImages(db, 1.0);
  for (const vision::Observation& o : db.observations) {
    const Eigen::Vector3d point = db.points[o.point].cast<double>();
    const auto towards = [&](uint32_t k) {
      return (db.keyframes[k].camera_from_map.Center() - point).normalized();
    };
    EXPECT_TRUE(std::any_of(images.begin(), images.end(), [&](uint32_t k) {
      return towards(k).dot(towards(o.keyframe)) > 0.96;
    }));
  }
}

TEST(Prune, KeepsAValidMapWithinTheBudget) {
  SceneDatabase db = Map(400);
  db.colours.assign(400, Eigen::Vector3f(0.1f, 0.2f, 0.3f));
  BudgetOptions options;
  options.max_points = 150;
  options.image_coverage = 0.9;
  const SceneDatabase pruned = Prune(db, options);
  ASSERT_TRUE(pruned.Validate().ok()) << pruned.Validate().message();
  EXPECT_EQ(pruned.points.size(), 150u);
  EXPECT_EQ(pruned.colours.size(), 150u);
  EXPECT_EQ(pruned.keyframes.size(), 10u);
  EXPECT_EQ(pruned.keyframes[4].camera_from_map.translation,
            db.keyframes[4].camera_from_map.translation);
  EXPECT_TRUE(std::any_of(pruned.keyframes.begin(), pruned.keyframes.end(),
                          [](const vision::Keyframe& k) { return k.grey.empty(); }));
  EXPECT_EQ(vision::SerializeSceneDatabase(pruned),
            vision::SerializeSceneDatabase(Prune(db, options)));
}

TEST(Prune, MayKeepOnlyTheObservationsOfImages) {
  const SceneDatabase db = Map(400);
  BudgetOptions options;
  options.image_coverage = 0.9;
  const SceneDatabase all = Prune(db, options);
  options.pictured_observations = true;
  const SceneDatabase pruned = Prune(db, options);
  ASSERT_TRUE(pruned.Validate().ok()) << pruned.Validate().message();
  EXPECT_LT(pruned.observations.size(), all.observations.size());
  for (uint32_t k = 0; k < pruned.keyframes.size(); ++k) {
    EXPECT_EQ(ObservationsOf(pruned, k).size(),
              pruned.keyframes[k].grey.empty() ? 0 : ObservationsOf(all, k).size());
  }
}

TEST(Prune, StillLocatesViewsBetweenTheKeyframes) {
  const test::SyntheticWorld world = test::MakeSyntheticWorld({.points = 600, .cameras = 10});
  BudgetOptions options;
  options.max_points = 100;
  const SceneDatabase pruned = Prune(test::MakeSceneDatabase(world), options);
  vision::Localizer localizer(pruned, {});
  for (int i = 0; i < 5; ++i) {
    const double angle = 0.18 * (i - 2);
    const geometry::Rigid3 truth =
        test::LookAt({4.0 * std::sin(angle), 0.1, 4.0 * std::cos(angle)}, {0, 0, 0});
    const test::SyntheticView view = test::RenderView(world, truth, {.noise_px = 0.5});
    const vision::Location location = localizer.Locate(view.features, world.camera);
    ASSERT_TRUE(location.camera_from_map.has_value());
    EXPECT_LT((location.camera_from_map->Center() - truth.Center()).norm(), 0.03);
  }
}

TEST(Prune, KeepsTheDescriptorsThatDifferMost) {
  SceneDatabase db = Map(100);
  Random random(3);
  std::vector<vision::Descriptor> descriptors;  // Three per point, two of them similar.
  db.descriptor_point.clear();
  db.descriptor_begin = {0};
  for (uint32_t i = 0; i < 100; ++i) {
    const vision::Descriptor other = test::RandomDescriptor(random);
    descriptors.insert(descriptors.end(), {db.descriptors[i], db.descriptors[i], other});
    db.descriptor_point.insert(db.descriptor_point.end(), 3, i);
    db.descriptor_begin.push_back(static_cast<uint32_t>(descriptors.size()));
  }
  db.descriptors = descriptors;
  db.forest = vision::BuildForest(db.descriptors, {});
  BudgetOptions options;
  options.max_points = 100;
  options.max_descriptors_per_point = 2;
  const SceneDatabase pruned = Prune(db, options);
  ASSERT_EQ(pruned.descriptors.size(), 200u);
  for (size_t i = 0; i < 100; ++i) {
    EXPECT_NE(pruned.descriptors[2 * i], pruned.descriptors[2 * i + 1]);
  }
}

TEST(BudgetOptions, SayWhatIsWrong) {
  EXPECT_TRUE(BudgetOptions().Validate().ok());
  EXPECT_THAT(BudgetOptions{.max_points = 5}.Validate().message(),
              testing::HasSubstr("max_points"));
  EXPECT_THAT(BudgetOptions{.max_descriptors_per_point = -1}.Validate().message(),
              testing::HasSubstr("max_descriptors_per_point"));
  EXPECT_THAT(BudgetOptions{.image_coverage = 1.5}.Validate().message(),
              testing::HasSubstr("image_coverage"));
}

}  // namespace
}  // namespace lararium::train
