#include "editor/colmap/colmap_repair.h"

#include <gmock/gmock.h>

namespace lararium::train {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Two images, of which each shows both of two points.
ColmapModel TwoPoints() {
  ColmapModel model;
  model.cameras = {{1, ColmapCameraModel::kPinhole, 640, 480, {500.0, 500.0, 320.0, 240.0}}};
  for (uint32_t id : {1u, 2u}) {
    ColmapImage& image = model.images.emplace_back();
    image.id = id;
    image.camera = 1;
    image.name = "image" + std::to_string(id) + ".jpg";
    image.camera_from_map.translation.x() = 0.1 * id;
    image.features = {{10.0, 20.0, 5}, {30.0, 40.0, 6}, {1.0, 2.0, ColmapFeature::kNoPoint}};
  }
  for (uint64_t id : {uint64_t{5}, uint64_t{6}}) {
    ColmapPoint& point = model.points.emplace_back();
    point.id = id;
    point.position = {0.1 * static_cast<double>(id), 0.0, 2.0};
    point.observations = {{1, static_cast<uint32_t>(id - 5)}, {2, static_cast<uint32_t>(id - 5)}};
  }
  return model;
}

TEST(RepairColmapModel, LeavesAWholeModelAsItIs) {
  ColmapModel model = TwoPoints();
  ASSERT_TRUE(model.Validate().ok()) << model.Validate().message();
  EXPECT_THAT(RepairColmapModel(model), IsEmpty());
  EXPECT_EQ(model.points[1].observations.size(), 2u);
  EXPECT_TRUE(model.Validate().ok());
}

TEST(RepairColmapModel, TakesObservationsFromFeatures) {
  ColmapModel model = TwoPoints();
  for (ColmapPoint& point : model.points) {
    point.observations.clear();
  }
  EXPECT_THAT(RepairColmapModel(model), ElementsAre(HasSubstr("those of the features")));
  EXPECT_TRUE(model.Validate().ok()) << model.Validate().message();
  ASSERT_EQ(model.points[1].observations.size(), 2u);
  EXPECT_EQ(model.points[1].observations[1].image, 2u);
  EXPECT_EQ(model.points[1].observations[1].feature, 1u);
}

TEST(RepairColmapModel, TakesFeaturesFromProjections) {
  ColmapModel model = TwoPoints();
  for (ColmapImage& image : model.images) {
    image.features.clear();
  }
  EXPECT_THAT(RepairColmapModel(model), ElementsAre(HasSubstr("projections")));
  EXPECT_TRUE(model.Validate().ok()) << model.Validate().message();
  ASSERT_EQ(model.images[0].features.size(), 2u);
  EXPECT_NEAR(model.images[0].features[0].x, 320.0 + 500.0 * 0.6 / 2.0, 1e-9);
  EXPECT_NEAR(model.images[0].features[0].y, 240.0, 1e-9);
}

TEST(RepairColmapModel, DropsReferencesToWhatIsNotThere) {
  ColmapModel model = TwoPoints();
  model.images.pop_back();                         // Two observations lead nowhere.
  model.points[0].observations[0].feature = 77;    // One more, and a feature without a point.
  model.points[1].observations.push_back({1, 1});  // One is listed twice.
  EXPECT_THAT(RepairColmapModel(model), ElementsAre(HasSubstr("5 observations")));
  EXPECT_TRUE(model.Validate().ok()) << model.Validate().message();
  EXPECT_THAT(model.points[0].observations, IsEmpty());
  EXPECT_EQ(model.points[1].observations.size(), 1u);
}

TEST(RepairColmapModel, AModelWithoutTracksHasNone) {
  ColmapModel model = TwoPoints();
  for (ColmapImage& image : model.images) {
    image.features.clear();
  }
  for (ColmapPoint& point : model.points) {
    point.observations.clear();
  }
  EXPECT_THAT(RepairColmapModel(model), IsEmpty());
  EXPECT_TRUE(model.Validate().ok());
}

}  // namespace
}  // namespace lararium::train
