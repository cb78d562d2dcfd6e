// Tests the exchange with the real colmap program (Debian package colmap). An offset of half a
// pixel or a wrong sign would show here.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <regex>

#include "editor/colmap/colmap_exchange.h"
#include "shared/core/file.h"
#include "shared/core/json.h"
#include "shared/core/random.h"
#include "shared/vision/localizer.h"
#include "tests/support/synthetic_world.h"
#include "tests/support/test_files.h"

#define LARARIUM_REQUIRE_COLMAP()                                \
  if (std::system("command -v colmap >/dev/null 2>&1") != 0) {   \
    GTEST_SKIP() << "needs the program colmap (package colmap)"; \
  }                                                              \
  static_assert(true, "")

namespace lararium::train {
namespace {

using geometry::Rigid3;
using lararium::test::TemporaryFolder;

// Runs colmap in folder and returns its output; fails the test if colmap fails.
std::string Colmap(const TemporaryFolder& folder, const std::string& arguments) {
  const std::string command = "cd '" + folder.path().string() +
                              "' && QT_QPA_PLATFORM=offscreen colmap " + arguments +
                              " >colmap.log 2>&1";
  const int code = std::system(command.c_str());
  const std::string output = *ReadText(folder / "colmap.log");
  EXPECT_EQ(code, 0) << command << "\n" << output;
  return output;
}

// The number after a label in text.
double NumberAfter(const std::string& text, const std::string& label) {
  std::smatch match;
  const std::regex pattern(label + R"([^0-9\n]*([0-9.eE+-]+))");
  EXPECT_TRUE(std::regex_search(text, match, pattern)) << label << "\n" << text;
  return match.empty() ? 0.0 : std::stod(match[1]);
}

// The cost as bundle_adjuster prints it: the root of half the mean squared coordinate of a
// residual.
double BundleCost(const vision::SceneDatabase& db) {
  double sum = 0.0;
  for (const vision::Observation& o : db.observations) {
    const auto pixel = db.camera.Project(db.keyframes[o.keyframe].camera_from_map *
                                         db.points[o.point].cast<double>());
    EXPECT_TRUE(pixel.has_value());
    sum += (*pixel - Eigen::Vector2d(o.x, o.y)).squaredNorm();
  }
  return std::sqrt(0.5 * sum / (2.0 * static_cast<double>(db.observations.size())));
}

double MeanPointError(const ColmapModel& model) {
  double sum = 0.0;
  for (const ColmapPoint& point : model.points) {
    sum += point.error;
  }
  return sum / static_cast<double>(model.points.size());
}

constexpr char kAdjust[] =
    "bundle_adjuster --BundleAdjustment.refine_focal_length 0 "
    "--BundleAdjustment.refine_extra_params 0 ";

// A map with a distorting lens and noise in its observations.
vision::SceneDatabase MakeNoisyDatabase() {
  vision::SceneDatabase db =
      lararium::test::MakeSceneDatabase(lararium::test::MakeSyntheticWorld({.points = 300}));
  db.camera.fy *= 1.01;
  db.camera.k1 = 0.08;
  db.camera.k2 = -0.03;
  db.camera.p1 = 0.002;
  db.camera.p2 = -0.003;
  Random random(11);
  for (vision::Observation& o : db.observations) {
    const auto pixel = db.camera.Project(db.keyframes[o.keyframe].camera_from_map *
                                         db.points[o.point].cast<double>());
    o.x = static_cast<float>(pixel->x() + 0.5 * random.Normal());
    o.y = static_cast<float>(pixel->y() + 0.5 * random.Normal());
  }
  return db;
}

TEST(ColmapProgram, ReadsAnExportedMapAsItIs) {
  LARARIUM_REQUIRE_COLMAP();
  const vision::SceneDatabase db = MakeNoisyDatabase();
  const ColmapModel exported = ColmapFromDatabase(db);
  const TemporaryFolder folder;
  ASSERT_TRUE(ExportColmap(db, folder / "binary", ColmapFormat::kBinary, false).ok());
  std::filesystem::create_directories(folder / "text");
  Colmap(folder, "model_converter --input_path binary --output_path text --output_type TXT");
  const auto converted = LoadColmapModel(folder / "text");
  ASSERT_TRUE(converted.ok()) << converted.message();
  ASSERT_EQ(converted->images.size(), exported.images.size());
  ASSERT_EQ(converted->points.size(), exported.points.size());
  for (size_t i = 0; i < exported.images.size(); ++i) {
    const ColmapImage& a = exported.images[i];
    const ColmapImage& b = converted->images[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_LT((a.camera_from_map.Center() - b.camera_from_map.Center()).norm(), 1e-9);
    EXPECT_LT(a.camera_from_map.rotation.angularDistance(b.camera_from_map.rotation), 1e-7);
    ASSERT_EQ(a.features.size(), b.features.size());
    for (size_t f = 0; f < a.features.size(); ++f) {
      EXPECT_NEAR(a.features[f].x, b.features[f].x, 1e-4);
      EXPECT_NEAR(a.features[f].y, b.features[f].y, 1e-4);
      EXPECT_EQ(a.features[f].point, b.features[f].point);
    }
  }
  for (size_t i = 0; i < exported.points.size(); ++i) {
    EXPECT_LT((exported.points[i].position - converted->points[i].position).norm(), 1e-9);
    EXPECT_EQ(exported.points[i].observations.size(), converted->points[i].observations.size());
  }
  const std::string analysis = Colmap(folder, "model_analyzer --path binary");
  EXPECT_EQ(NumberAfter(analysis, "Registered images:"), 12.0);
  EXPECT_EQ(NumberAfter(analysis, "Observations:"), static_cast<double>(db.observations.size()));
  EXPECT_NEAR(NumberAfter(analysis, "Mean reprojection error:"), MeanPointError(exported), 1e-3);
}

TEST(ColmapProgram, FindsTheReprojectionErrorsThatWeFindThroughADistortingLens) {
  LARARIUM_REQUIRE_COLMAP();
  const vision::SceneDatabase db = MakeNoisyDatabase();
  const TemporaryFolder folder;
  ASSERT_TRUE(ExportColmap(db, folder / "model", ColmapFormat::kText, false).ok());
  std::filesystem::create_directories(folder / "adjusted");
  const std::string output =
      Colmap(folder, std::string(kAdjust) + "--input_path model --output_path adjusted");
  // A mix of both pixel conventions, or another lens model, would show here.
  EXPECT_NEAR(NumberAfter(output, "Initial cost"), BundleCost(db), 0.002);
}

// ---------------------------------------------------------- fountain-P11

struct Fountain {
  geometry::CameraModel camera;
  std::map<std::string, Rigid3> camera_from_world;
};

// Writes the images first to last at half their size into folder/images; returns the ground truth
// of all images.
Fountain ShrinkFountain(const std::filesystem::path& data,
                        const TemporaryFolder& folder,
                        int first,
                        int last) {
  const auto json = LoadJson(data / "ground_truth.json");
  EXPECT_TRUE(json.ok());
  std::filesystem::create_directories(folder / "images");
  Fountain fountain;
  int index = 0;
  for (const Json& image : (*json)["images"]) {
    const std::vector<double> k = image["K"];
    const std::vector<double> r = image["world_to_camera"]["R"];
    const std::vector<double> t = image["world_to_camera"]["t"];
    const std::filesystem::path file = image["file"].get<std::string>();
    geometry::CameraModel camera{image["width"], image["height"], k[0], k[1], k[2], k[3]};
    fountain.camera = camera.Resized(camera.width / 2, camera.height / 2);
    fountain.camera_from_world[file.filename()] =
        Rigid3::FromMatrix(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(r.data()),
                           Eigen::Vector3d(t[0], t[1], t[2]));
    if (index >= first && index <= last) {
      cv::Mat small;
      cv::resize(cv::imread((data / file).string()), small,
                 cv::Size(fountain.camera.width, fountain.camera.height), 0, 0, cv::INTER_AREA);
      EXPECT_TRUE(cv::imwrite((folder / "images" / file.filename().string()).string(), small));
    }
    ++index;
  }
  return fountain;
}

void ReconstructWithColmap(const TemporaryFolder& folder, const geometry::CameraModel& camera) {
  const ColmapCamera colmap = ColmapFromCamera(camera, 1);
  std::string parameters;
  for (const double parameter : colmap.parameters) {
    parameters += (parameters.empty() ? "" : ",") + std::to_string(parameter);
  }
  std::filesystem::create_directories(folder / "sparse");
  Colmap(folder,
         "feature_extractor --image_path images --database_path database.db "
         "--ImageReader.single_camera 1 --ImageReader.camera_model PINHOLE "
         "--ImageReader.camera_params " +
             parameters + " --SiftExtraction.use_gpu 0 --SiftExtraction.max_num_features 2000");
  Colmap(folder, "exhaustive_matcher --database_path database.db --SiftMatching.use_gpu 0");
  Colmap(folder,
         "mapper --database_path database.db --image_path images --output_path sparse "
         "--Mapper.ba_refine_focal_length 0 --Mapper.ba_refine_extra_params 0");
}

Eigen::Vector2d MeanOffset(const vision::SceneDatabase& db) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const vision::Observation& o : db.observations) {
    const auto pixel = db.camera.Project(db.keyframes[o.keyframe].camera_from_map *
                                         db.points[o.point].cast<double>());
    sum += Eigen::Vector2d(o.x, o.y) - *pixel;
  }
  return sum / static_cast<double>(db.observations.size());
}

TEST(ColmapProgram, MakesAModelThatImportsLocatesAnotherImageAndGoesBack) {
  LARARIUM_REQUIRE_DATA(data, "fountain-P11");
  LARARIUM_REQUIRE_COLMAP();
  const TemporaryFolder folder;
  const Fountain fountain = ShrinkFountain(data, folder, 2, 6);
  ReconstructWithColmap(folder, fountain.camera);
  const auto model = LoadColmapModel(folder / "sparse/0");
  ASSERT_TRUE(model.ok()) << model.message();

  NoProgress progress;
  std::vector<std::string> warnings;
  const auto db = ImportColmap(folder.path(), {}, {}, progress, *MakeSilentLog(), warnings);
  ASSERT_TRUE(db.ok()) << db.message();
  EXPECT_EQ(db->keyframes.size(), 5u);
  EXPECT_NEAR(db->camera.cx, fountain.camera.cx, 1e-5);
  EXPECT_GT(db->points.size(), model->points.size() * 6 / 10);
  EXPECT_LT(db->mean_reprojection_error_px, 0.5);
  EXPECT_LT(MeanOffset(*db).norm(), 0.06);

  // The image after the last one was not part of any model.
  std::vector<Eigen::Vector3d> found;
  std::vector<Eigen::Vector3d> expected;
  for (const vision::Keyframe& keyframe : db->keyframes) {
    found.push_back(keyframe.camera_from_map.Center());
    expected.push_back(fountain.camera_from_world.at(keyframe.name).Center());
  }
  const auto world_from_map = geometry::EstimateSimilarity(expected, found);
  ASSERT_TRUE(world_from_map.ok());
  const TemporaryFolder other;
  ShrinkFountain(data, other, 7, 7);
  const cv::Mat grey = cv::imread((other / "images/0007.jpg").string(), cv::IMREAD_GRAYSCALE);
  const auto features = vision::ExtractFeatures(grey, {});
  ASSERT_TRUE(features.ok());
  const vision::Location location = vision::Localizer(*db, {}).Locate(*features, fountain.camera);
  ASSERT_TRUE(location.camera_from_map.has_value());
  const Eigen::Vector3d truth = fountain.camera_from_world.at("0007.jpg").Center();
  EXPECT_LT((*world_from_map * location.camera_from_map->Center() - truth).norm(), 0.05);  // metres

  // Exports to COLMAP again, whose own adjustment must not move anything.
  ASSERT_TRUE(ExportColmap(*db, folder / "back", ColmapFormat::kBinary, true).ok());
  std::filesystem::create_directories(folder / "adjusted");
  const std::string output =
      Colmap(folder, std::string(kAdjust) + "--input_path back --output_path adjusted");
  EXPECT_NEAR(NumberAfter(output, "Initial cost"), BundleCost(*db), 0.005);
  EXPECT_NEAR(NumberAfter(output, "Final cost"), BundleCost(*db), 0.05);
  const auto adjusted = LoadColmapModel(folder / "adjusted");
  ASSERT_TRUE(adjusted.ok()) << adjusted.message();
  for (size_t i = 0; i < adjusted->images.size(); ++i) {
    const Eigen::Vector3d center = adjusted->images[i].camera_from_map.Center();
    EXPECT_LT(world_from_map->scale * (center - found[i]).norm(), 0.02);  // metres
  }
}

}  // namespace
}  // namespace lararium::train
