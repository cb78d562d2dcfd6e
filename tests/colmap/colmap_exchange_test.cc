#include "editor/colmap/colmap_exchange.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "shared/core/file.h"
#include "shared/core/random.h"
#include "shared/vision/localizer.h"
#include "tests/support/synthetic_world.h"
#include "tests/support/test_files.h"

namespace lararium::train {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;
using lararium::test::LookAt;
using lararium::test::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

vision::SceneDatabase MakeColmapDatabase() {
  return lararium::test::MakeSceneDatabase(lararium::test::MakeSyntheticWorld({.points = 60}));
}

TEST(ExportColmap, HoldsTheMapWithPixelsMovedByHalf) {
  vision::SceneDatabase db = MakeColmapDatabase();
  db.colours.assign(db.points.size(), {1.0f, 0.2140411f, -1.0f});  // sRGB 255, 127.5, unknown
  const ColmapModel model = ColmapFromDatabase(db);
  ASSERT_TRUE(model.Validate().ok()) << model.Validate().message();
  ASSERT_EQ(model.images.size(), db.keyframes.size());
  ASSERT_EQ(model.points.size(), db.points.size());
  size_t features = 0;
  for (const ColmapImage& image : model.images) {
    features += image.features.size();
  }
  ASSERT_EQ(features, db.observations.size());
  EXPECT_DOUBLE_EQ(model.images[0].features[0].x, db.observations[0].x + 0.5);
  EXPECT_DOUBLE_EQ(model.cameras[0].parameters[2], db.camera.cx + 0.5);
  EXPECT_EQ(model.points[3].position, db.points[3].cast<double>());
  EXPECT_EQ(model.points[3].colour[0], 255);
  EXPECT_NEAR(model.points[3].colour[1], 127.5, 0.6);
  EXPECT_EQ(model.points[3].colour[2], 0);
  EXPECT_LT(model.points[3].error, 1e-3);
}

TEST(ExportColmap, NamesAreUniqueAndStayInsideTheFolder) {
  vision::SceneDatabase db = MakeColmapDatabase();
  db.keyframes[1].name = db.keyframes[0].name;
  db.keyframes[1].session = 1;
  db.keyframes[2].name = "../../outside.png";
  db.keyframes[3].name = "/etc/passwd";
  db.keyframes[4].name = "a name with\nblanks.png";
  db.keyframes[5].name = "no extension";
  const TemporaryFolder folder;
  ASSERT_TRUE(ExportColmap(db, folder / "model", ColmapFormat::kText, true).ok());
  std::set<std::string> names;
  const auto model = LoadColmapModel(folder / "model");
  ASSERT_TRUE(model.ok()) << model.message();
  for (const ColmapImage& image : model->images) {
    EXPECT_EQ(image.name.find(' '), std::string::npos);
    EXPECT_TRUE(names.insert(image.name).second) << image.name;
    EXPECT_TRUE(std::filesystem::exists(folder / "model" / "images" / image.name)) << image.name;
  }
  size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    ++entries;
  }
  EXPECT_EQ(entries, 1u);  // Only the model.
}

TEST(ExportColmap, GivesTheSameBytesTwice) {
  const vision::SceneDatabase db = MakeColmapDatabase();
  const TemporaryFolder folder;
  ASSERT_TRUE(ExportColmap(db, folder / "a", ColmapFormat::kBinary, false).ok());
  ASSERT_TRUE(ExportColmap(db, folder / "b", ColmapFormat::kBinary, false).ok());
  for (const char* name : {"cameras.bin", "images.bin", "points3D.bin"}) {
    EXPECT_EQ(*ReadText(folder / "a" / name), *ReadText(folder / "b" / name));
  }
}

TEST(ExportColmap, LeavesAFolderWithContentAloneAndNothingHalfWritten) {
  const vision::SceneDatabase db = MakeColmapDatabase();
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "mine.txt", std::string_view("keep")).ok());
  EXPECT_THAT(ExportColmap(db, folder.path(), ColmapFormat::kText, false).message(),
              HasSubstr("exists already"));
  EXPECT_FALSE(ExportColmap(db, folder / "no/such/place", ColmapFormat::kText, false).ok());
  EXPECT_FALSE(std::filesystem::exists(folder / "cameras.txt"));
  EXPECT_EQ(*ReadText(folder / "mine.txt"), "keep");
}

// ---------------------------------------------------------------- import

// Photographs a board of 2 m width with a random texture in the plane z = 0.
class Board {
 public:
  Board() {
    Random random(3);
    texture_ = cv::Mat(kSide, kSide, CV_8UC3, cv::Scalar::all(110));
    for (int i = 0; i < 900; ++i) {
      const cv::Point center{static_cast<int>(random.Below(kSide)),
                             static_cast<int>(random.Below(kSide))};
      cv::Scalar colour;
      for (int channel = 0; channel < 3; ++channel) {
        colour[channel] = random.Below(256);
      }
      cv::circle(texture_, center, static_cast<int>(3 + random.Below(14)), colour, -1, cv::LINE_AA);
    }
    cv::GaussianBlur(texture_, texture_, cv::Size(), 1.2);
  }

  cv::Mat Photograph(const CameraModel& camera, const Rigid3& camera_from_board) const {
    const Eigen::Matrix<double, 3, 4> pose = camera_from_board.Matrix3x4();
    Eigen::Matrix3d pixel_from_board;
    pixel_from_board << pose.col(0), pose.col(1), pose.col(3);
    Eigen::Matrix3d k;
    k << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1;
    Eigen::Matrix3d board_from_texel;
    const double metres = 2.0 / kSide;
    board_from_texel << metres, 0, -1, 0, metres, -1, 0, 0, 1;
    const Eigen::Matrix3d h = k * pixel_from_board * board_from_texel;
    const cv::Matx33d warp(h(0, 0), h(0, 1), h(0, 2), h(1, 0), h(1, 1), h(1, 2), h(2, 0), h(2, 1),
                           h(2, 2));
    cv::Mat image;
    cv::warpPerspective(texture_, image, warp, cv::Size(camera.width, camera.height));
    return image;
  }

 private:
  static constexpr int kSide = 700;
  cv::Mat texture_;
};

// A model of the board as another program's detector would give it: its points are at the features
// of the first image and are observed without error in all images.
class ColmapImport : public ::testing::Test {
 protected:
  ColmapImport() {
    for (int i = 0; i < 4; ++i) {
      poses_.push_back(LookAt({0.35 * i - 0.6, 0.15 * i - 0.3, -2.0 + 0.1 * i}, {0, 0, 0}));
    }
    cameras_.assign(poses_.size(), camera_);
  }

  void Write() {
    std::filesystem::create_directories(folder_ / "images");
    ColmapModel model;
    for (uint32_t i = 0; i < poses_.size(); ++i) {
      const cv::Mat image = board_.Photograph(cameras_[i], poses_[i]);
      const std::string name = "view" + std::to_string(i) + ".png";
      ASSERT_TRUE(cv::imwrite((folder_ / "images" / name).string(), image));
      model.cameras.push_back(ColmapFromCamera(cameras_[i], i + 1));
      model.images.push_back({i + 1, poses_[i], i + 1, name, {}});
    }
    AddPoints(model);
    const ColmapFiles files = SerializeColmapModel(model, ColmapFormat::kBinary);
    ASSERT_TRUE(WriteFileAtomically(folder_ / "cameras.bin", files.cameras).ok());
    ASSERT_TRUE(WriteFileAtomically(folder_ / "images.bin", files.images).ok());
    ASSERT_TRUE(WriteFileAtomically(folder_ / "points3D.bin", files.points).ok());
    model_ = std::move(model);
  }

  void AddPoints(ColmapModel& model) const {
    cv::Mat grey;
    cv::cvtColor(board_.Photograph(cameras_[0], poses_[0]), grey, cv::COLOR_BGR2GRAY);
    const auto features = vision::ExtractFeatures(grey, {});
    ASSERT_TRUE(features.ok());
    for (const vision::Keypoint& keypoint : features->keypoints) {
      const Eigen::Vector3d ray =
          poses_[0].rotation.conjugate() *
          cameras_[0].PlaneFromPixel({keypoint.x, keypoint.y}).homogeneous();
      const Eigen::Vector3d center = poses_[0].Center();
      const Eigen::Vector3d point = center - ray * (center.z() / ray.z());
      ColmapPoint& added = model.points.emplace_back();
      added.id = model.points.size();
      added.position = point;
      for (uint32_t i = 0; i < poses_.size(); ++i) {
        const auto pixel = cameras_[i].Project(poses_[i] * point);
        if (pixel && cameras_[i].Contains(*pixel)) {
          std::vector<ColmapFeature>& of_image = model.images[i].features;
          added.observations.push_back({i + 1, static_cast<uint32_t>(of_image.size())});
          of_image.push_back({pixel->x() + 0.5, pixel->y() + 0.5, added.id});
        }
      }
    }
  }

  // Writes the model again with another name of an image.
  void Rename(size_t image, const std::string& name) {
    ColmapModel model = model_;
    model.images[image].name = name;
    const ColmapFiles files = SerializeColmapModel(model, ColmapFormat::kBinary);
    ASSERT_TRUE(WriteFileAtomically(folder_ / "images.bin", files.images).ok());
  }

  Result<vision::SceneDatabase> Import() {
    NoProgress progress;
    warnings_.clear();
    return ImportColmap(folder_.path(), {}, {}, progress, *MakeSilentLog(), warnings_);
  }

  const TemporaryFolder folder_;
  const Board board_;
  std::vector<std::string> warnings_;
  CameraModel camera_{320, 240, 300, 300, 160.5, 119};
  std::vector<Rigid3> poses_;
  std::vector<CameraModel> cameras_;
  ColmapModel model_;
};

// Mean offset of the observations from the projections of their points.
Eigen::Vector2d MeanOffset(const vision::SceneDatabase& db) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const vision::Observation& o : db.observations) {
    const auto pixel = db.camera.Project(db.keyframes[o.keyframe].camera_from_map *
                                         db.points[o.point].cast<double>());
    EXPECT_TRUE(pixel.has_value());
    sum += Eigen::Vector2d(o.x, o.y) - *pixel;
  }
  return sum / static_cast<double>(db.observations.size());
}

TEST_F(ColmapImport, KeepsPosesAndPointsAndTiesFeaturesWithoutAHalfPixelShift) {
  Write();
  const auto db = Import();
  ASSERT_TRUE(db.ok()) << db.message();
  ASSERT_EQ(db->keyframes.size(), 4u);
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(db->keyframes[i].name, "view" + std::to_string(i) + ".png");
    EXPECT_EQ(db->keyframes[i].frame_index, static_cast<int64_t>(i));
    EXPECT_LT((db->keyframes[i].camera_from_map.Center() - poses_[i].Center()).norm(), 1e-12);
  }
  EXPECT_GT(db->points.size(), model_.points.size() / 3);
  EXPECT_LE(db->points.size(), model_.points.size());
  size_t next = 0;  // The database keeps the model's order.
  for (const Eigen::Vector3f& point : db->points) {
    while (next < model_.points.size() && model_.points[next].position.cast<float>() != point) {
      ++next;
    }
    ASSERT_LT(next, model_.points.size());
  }
  EXPECT_EQ(db->colours.size(), db->points.size());
  EXPECT_LT(db->mean_reprojection_error_px, 0.4);
  EXPECT_LT(MeanOffset(*db).norm(), 0.05);
}

TEST_F(ColmapImport, LocatesAnotherImageInThePlace) {
  Write();
  const auto db = Import();
  ASSERT_TRUE(db.ok()) << db.message();
  const Rigid3 truth = LookAt({0.2, -0.1, -2.1}, {0.05, 0, 0});
  cv::Mat grey;
  cv::cvtColor(board_.Photograph(camera_, truth), grey, cv::COLOR_BGR2GRAY);
  const auto features = vision::ExtractFeatures(grey, {});
  ASSERT_TRUE(features.ok());
  const vision::Location location = vision::Localizer(*db, {}).Locate(*features, camera_);
  ASSERT_TRUE(location.camera_from_map.has_value());
  EXPECT_LT((location.camera_from_map->Center() - truth.Center()).norm(), 0.01);
}

TEST_F(ColmapImport, ResamplesImagesOfOtherCamerasToTheMostUsed) {
  cameras_[2] = {.width = 320, .height = 240, .fx = 270, .fy = 280, .cx = 150, .cy = 125};
  Write();
  const auto db = Import();
  ASSERT_TRUE(db.ok()) << db.message();
  EXPECT_EQ(db->camera, camera_);
  size_t in_resampled = 0;
  for (const vision::Observation& o : db->observations) {
    in_resampled += o.keyframe == 2 ? 1 : 0;
  }
  EXPECT_GT(in_resampled, 50u);
  EXPECT_LT(db->mean_reprojection_error_px, 0.4);
}

TEST_F(ColmapImport, LeavesOutAnImageThatIsMissingOrOfAnotherSize) {
  Write();
  const std::filesystem::path file = folder_ / "images" / "view2.png";
  ASSERT_TRUE(cv::imwrite(file.string(), cv::Mat(100, 100, CV_8UC3, cv::Scalar::all(9))));
  const auto told_once = [this](const char* what) {
    return std::count_if(warnings_.begin(), warnings_.end(), [what](const std::string& warning) {
             return warning.find(what) != std::string::npos;
           }) == 1;
  };
  auto db = Import();
  ASSERT_TRUE(db.ok()) << db.message();
  EXPECT_EQ(db->keyframes.size(), poses_.size() - 1);
  EXPECT_TRUE(told_once("view2.png: is 100x100"));
  std::filesystem::remove(file);
  db = Import();
  ASSERT_TRUE(db.ok()) << db.message();
  EXPECT_EQ(db->keyframes.size(), poses_.size() - 1);
  EXPECT_TRUE(told_once("view2.png: does not exist"));
}

TEST_F(ColmapImport, RefusesAFolderThatLacksMostImages) {
  Write();
  for (size_t i = 0; i < poses_.size() / 2 + 1; ++i) {
    std::filesystem::remove(folder_ / "images" / ("view" + std::to_string(i) + ".png"));
  }
  EXPECT_THAT(Import().message(), HasSubstr("view0.png: does not exist"));
}

TEST_F(ColmapImport, FindsFilesThatAreNamedAlike) {
  for (const char* name : {"VIEW1.PNG", "view1.jpg", "C:\\photographs\\view1.png",
                           "/home/curator/photographs/View1.JPG", "../view1.png"}) {
    Write();
    Rename(1, name);
    const auto db = Import();
    ASSERT_TRUE(db.ok()) << name << ": " << db.message();
    EXPECT_EQ(db->keyframes[1].name, "view1.png");
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("1 of 4 images have other names")));
  }
}

TEST_F(ColmapImport, RefusesImagesThatAreNotTheModels) {
  Write();
  Random random(5);
  for (size_t i = 0; i < poses_.size(); ++i) {
    cv::Mat noise(240, 320, CV_8UC3);
    for (int p = 0; p < 240 * 320 * 3; ++p) {
      noise.data[p] = static_cast<uint8_t>(random.Below(256));
    }
    cv::GaussianBlur(noise, noise, cv::Size(), 9.0);
    ASSERT_TRUE(
        cv::imwrite((folder_ / "images" / ("view" + std::to_string(i) + ".png")).string(), noise));
  }
  const auto db = Import();
  ASSERT_FALSE(db.ok());
  EXPECT_THAT(db.message(), HasSubstr("points were found again"));
}

TEST_F(ColmapImport, StaysWithinTheFolder) {
  Write();
  std::filesystem::rename(folder_ / "images" / "view1.png", folder_ / "outside.png");
  for (const std::string& name :
       {std::string("../outside.png"), std::string("/etc/../outside.png"),
        (folder_ / "outside.png").string(), std::string("a/../../outside.png")}) {
    Rename(1, name);
    const auto db = Import();
    ASSERT_TRUE(db.ok()) << name << ": " << db.message();
    EXPECT_EQ(db->keyframes.size(), poses_.size() - 1);
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("outside.png: does not exist")));
  }
}

TEST_F(ColmapImport, RefusesTwoImagesOfOneName) {
  Write();
  Rename(1, model_.images[0].name);
  EXPECT_THAT(Import().message(), HasSubstr("two images of the model are named"));
}

TEST_F(ColmapImport, TakesTheExportOfItsOwnPlaceBack) {
  Write();
  const auto db = Import();
  ASSERT_TRUE(db.ok()) << db.message();
  const std::filesystem::path model = folder_ / "exported";
  ASSERT_TRUE(ExportColmap(*db, model, ColmapFormat::kText, true).ok());
  NoProgress progress;
  std::vector<std::string> warnings;
  const auto again = ImportColmap(model, {}, {}, progress, *MakeSilentLog(), warnings);
  ASSERT_TRUE(again.ok()) << again.message();
  EXPECT_EQ(again->camera, db->camera);
  // The exported images are grey, so a few features differ.
  EXPECT_GT(again->points.size(), db->points.size() * 95 / 100);
  EXPECT_GT(again->observations.size(), db->observations.size() * 95 / 100);
  EXPECT_NEAR(again->mean_reprojection_error_px, db->mean_reprojection_error_px, 0.02);
}

TEST(FindColmapFolders, FindsTheModelAndImagesOfAProject) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "sparse/0");
  std::filesystem::create_directories(folder / "images");
  ASSERT_TRUE(WriteFileAtomically(folder / "sparse/0/cameras.bin", std::string_view("x")).ok());
  for (const char* given : {"", "sparse/0"}) {
    const auto found = FindColmapFolders(folder / given, {});
    ASSERT_TRUE(found.ok()) << found.message();
    EXPECT_TRUE(std::filesystem::equivalent(found->model, folder / "sparse/0"));
    EXPECT_TRUE(std::filesystem::equivalent(found->images, folder / "images"));
  }
  EXPECT_THAT(FindColmapFolders(folder / "images", {}).message(), HasSubstr("cameras.bin"));
  EXPECT_THAT(FindColmapFolders(folder.path(), folder / "nowhere").message(),
              HasSubstr("--images"));
}

TEST(ColmapImportOptions, SaysWhatIsWrong) {
  EXPECT_TRUE(ColmapImportOptions().Validate().ok());
  EXPECT_FALSE(ColmapImportOptions{.radius_px = 0.0}.Validate().ok());
  EXPECT_FALSE(ColmapImportOptions{.max_features = 1}.Validate().ok());
  EXPECT_FALSE(ColmapImportOptions{.max_points = 1}.Validate().ok());
}

}  // namespace
}  // namespace lararium::train
