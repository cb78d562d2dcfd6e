#include <gtest/gtest.h>

#include <map>

#include "editor/train/trainer.h"
#include "shared/core/json.h"
#include "tests/support/test_files.h"

namespace lararium::train {
namespace {

// The images' camera and, by file name, the true poses.
struct GroundTruth {
  geometry::CameraModel camera;
  std::map<std::string, geometry::Rigid3> camera_from_world;
};

GroundTruth LoadGroundTruth(const std::filesystem::path& file) {
  const Result<Json> json = LoadJson(file);
  EXPECT_TRUE(json.ok());
  GroundTruth truth;
  for (const Json& image : (*json)["images"]) {
    truth.camera.width = image["width"];
    truth.camera.height = image["height"];
    truth.camera.fx = image["K"][0];
    truth.camera.fy = image["K"][1];
    truth.camera.cx = image["K"][2];
    truth.camera.cy = image["K"][3];
    const std::vector<double> r = image["world_to_camera"]["R"];
    const std::vector<double> t = image["world_to_camera"]["t"];
    const Eigen::Matrix3d rotation =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(r.data());
    const std::filesystem::path name = image["file"].get<std::string>();
    truth.camera_from_world[name.filename()] =
        geometry::Rigid3::FromMatrix(rotation, Eigen::Vector3d(t[0], t[1], t[2]));
  }
  return truth;
}

double MeanCenterError(const TrainReport& report, const GroundTruth& truth) {
  std::vector<Eigen::Vector3d> found;
  std::vector<Eigen::Vector3d> expected;
  for (const LocatedFrame& frame : report.located) {
    found.push_back(frame.camera_from_map.Center());
    expected.push_back(truth.camera_from_world.at(frame.name).Center());
  }
  const auto world_from_map = geometry::EstimateSimilarity(expected, found);
  EXPECT_TRUE(world_from_map.ok());
  double sum = 0.0;
  for (size_t i = 0; i < found.size(); ++i) {
    sum += (*world_from_map * found[i] - expected[i]).norm();
  }
  return sum / static_cast<double>(found.size());
}

Result<TrainResult> TrainFountain(const std::filesystem::path& folder,
                                  const TrainOptions& options) {
  LARARIUM_ASSIGN_OR_RETURN(auto source, capture::OpenImageFolder(folder / "images"));
  NoProgress progress;
  return Train(*source, options, progress, *MakeSilentLog());
}

TEST(TrainerOnFountain, LocatesAllImagesWithinFiveMillimetres) {
  LARARIUM_REQUIRE_DATA(folder, "fountain-P11");
  const GroundTruth truth = LoadGroundTruth(folder / "ground_truth.json");
  TrainOptions options;
  options.intrinsics = truth.camera;
  const Result<TrainResult> result = TrainFountain(folder, options);
  ASSERT_TRUE(result.ok()) << result.message();
  EXPECT_EQ(result->report.located.size(), 11u);
  EXPECT_LT(MeanCenterError(result->report, truth), 0.005);
  EXPECT_LT(result->report.mean_reprojection_error_px, 0.4);
}

TEST(TrainerOnFountain, EstimatesTheFocalLength) {
  LARARIUM_REQUIRE_DATA(folder, "fountain-P11");
  const GroundTruth truth = LoadGroundTruth(folder / "ground_truth.json");
  const Result<TrainResult> result = TrainFountain(folder, TrainOptions());
  ASSERT_TRUE(result.ok()) << result.message();
  EXPECT_EQ(result->report.located.size(), 11u);
  EXPECT_TRUE(result->report.intrinsics_estimated);
  EXPECT_NEAR(result->report.camera.fx, truth.camera.fx, 0.02 * truth.camera.fx);
  EXPECT_LT(MeanCenterError(result->report, truth), 0.02);
}

}  // namespace
}  // namespace lararium::train
