#include <gtest/gtest.h>

#include "editor/train/budget.h"
#include "editor/train/session_merge.h"
#include "shared/vision/localizer.h"
#include "tests/support/test_files.h"
#include "tests/train/part_of_video.h"

namespace lararium::train {
namespace {

TrainOptions Options() {
  TrainOptions options;
  options.intrinsics = geometry::CameraModel{
      .width = 640, .height = 480, .fx = 560.0, .fy = 560.0, .cx = 319.5, .cy = 239.5};
  options.max_features = 1500;
  return options;
}

// Mean number of inliers over the frames; those without a pose count 0.
double MeanInliers(const vision::SceneDatabase& map, const Part& part) {
  vision::Localizer localizer(map, {});
  const auto source = part.Open();
  double sum = 0.0;
  int frames = 0;
  while (true) {
    const auto frame = source->Next();
    if (!frame.ok() || !*frame) {
      return sum / std::max(frames, 1);
    }
    vision::FeatureOptions options;
    options.first_octave = 0;
    options.max_features = 800;
    const auto features = vision::ExtractFeatures((*frame)->grey, options);
    const vision::Location location = localizer.Locate(*features, map.camera);
    sum += location.camera_from_map ? location.inliers : 0;
    ++frames;
  }
}

// The second half of the lighting sequence has another position of the sun than the training video.
// Its even frames are added as a session, and its odd frames are tested.
TEST(AddSessionOnMaquette, WorksInBothLights) {
  LARARIUM_REQUIRE_DATA(folder, "maquette");
  NoProgress progress;
  const auto log = MakeSilentLog();
  const auto training = Part{folder / "training" / "video.mp4", 0, 119, 3}.Open();
  const auto map = Train(*training, Options(), progress, *log);
  ASSERT_TRUE(map.ok()) << map.message();
  const auto evening = Part{folder / "lighting" / "video.mp4", 60, 88, 2}.Open();
  const auto both = AddSession(map->database, *evening, Options(), progress, *log);
  ASSERT_TRUE(both.ok()) << both.message();
  ASSERT_TRUE(both->database.Validate().ok());

  const Part other_sun{folder / "lighting" / "video.mp4", 77, 89, 4};
  EXPECT_GT(MeanInliers(both->database, other_sun), 1.3 * MeanInliers(map->database, other_sun));
  const Part first_sun{folder / "handheld" / "video.mp4", 0, 149, 30};
  EXPECT_GT(MeanInliers(both->database, first_sun), 0.95 * MeanInliers(map->database, first_sun));
  for (size_t k = 0; k < map->database.keyframes.size(); ++k) {
    EXPECT_EQ(both->database.keyframes[k].camera_from_map.translation,
              map->database.keyframes[k].camera_from_map.translation);
  }
  EXPECT_EQ(both->report.located.size(), 15u);
  EXPECT_EQ(both->database.keyframes.back().session, 1u);
}

TEST(AddSessionOnMaquette, RefusesAnotherPlace) {
  LARARIUM_REQUIRE_DATA(folder, "maquette");
  LARARIUM_REQUIRE_DATA(fountain, "fountain-P11");
  NoProgress progress;
  const auto log = MakeSilentLog();
  const auto training = Part{folder / "training" / "video.mp4", 0, 60, 3}.Open();
  const auto map = Train(*training, Options(), progress, *log);
  ASSERT_TRUE(map.ok()) << map.message();
  auto source = capture::OpenImageFolder(fountain / "images");
  ASSERT_TRUE(source.ok());
  TrainOptions options;
  options.max_features = 1500;
  const auto added = AddSession(map->database, **source, options, progress, *log);
  ASSERT_FALSE(added.ok());
  EXPECT_NE(added.message().find("were found in the map"), std::string::npos) << added.message();
}

TEST(MeasureBudgetsOnMaquette, SmallerMapsWeighLessAndHaveLessInReserve) {
  LARARIUM_REQUIRE_DATA(folder, "maquette");
  NoProgress progress;
  const auto training = Part{folder / "training" / "video.mp4", 0, 60, 3}.Open();
  const auto map = Train(*training, Options(), progress, *MakeSilentLog());
  ASSERT_TRUE(map.ok()) << map.message();
  const std::vector<BudgetOptions> budgets = {
      {}, {.max_points = 1500, .image_coverage = 0.95}, {.max_points = 300, .image_coverage = 0.9}};
  const auto rows = MeasureBudgets(map->database, budgets, 4, progress);
  ASSERT_TRUE(rows.ok()) << rows.message();
  EXPECT_EQ((*rows)[0].recall, 1.0);
  EXPECT_LT((*rows)[0].median_difference_px, 0.3);
  for (size_t i = 1; i < budgets.size(); ++i) {
    EXPECT_EQ((*rows)[i].points, budgets[i].max_points);
    EXPECT_LT((*rows)[i].bytes, (*rows)[i - 1].bytes);
    EXPECT_LT((*rows)[i].images, (*rows)[i - 1].images);
    EXPECT_LE((*rows)[i].recall, (*rows)[i - 1].recall);
    EXPECT_LT((*rows)[i].mean_inliers, (*rows)[i - 1].mean_inliers);
  }
}

}  // namespace
}  // namespace lararium::train
