#include "editor/colmap/colmap_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>

#include "shared/core/file.h"
#include "shared/core/random.h"
#include "tests/support/test_files.h"

namespace lararium::train {
namespace {

using ::testing::HasSubstr;

// A model with two cameras, three images and their points, with numbers that need all their digits.
ColmapModel MakeModel() {
  Random random(7);
  ColmapModel model;
  model.cameras.push_back({1,
                           ColmapCameraModel::kOpenCv,
                           640,
                           480,
                           {500.1, 501.7, 320.3, 239.9, 0.1, -0.05, 1e-4, 2e-4}});
  model.cameras.push_back(
      {9, ColmapCameraModel::kSimpleRadial, 320, 240, {1.0 / 3.0, 160, 120, 0.1}});
  for (const uint32_t id : {2u, 3u, 40u}) {
    ColmapImage& image = model.images.emplace_back();
    image.id = id;
    image.camera = id == 40 ? 9 : 1;
    image.name = "folder/image " + std::to_string(id) + ".jpg";
    image.camera_from_map.rotation =
        Eigen::Quaterniond{random.Normal(), random.Normal(), random.Normal(), random.Normal()}
            .normalized();
    image.camera_from_map.translation = {random.Normal(), random.Normal(), random.Normal()};
    if (id == 3) {
      continue;  // An image without features.
    }
    for (int i = 0; i < 5; ++i) {
      image.features.push_back({640 * random.Uniform(), 480 * random.Uniform()});
    }
  }
  for (uint64_t id = 10; id < 13; ++id) {
    ColmapPoint& point = model.points.emplace_back();
    point.id = id;
    point.position = {random.Normal(), random.Normal(), 1e-7 * random.Normal()};
    point.colour = {static_cast<uint8_t>(id), 0, 255};
    point.error = random.Uniform();
    const auto feature = static_cast<uint32_t>(id - 9);
    for (const size_t image : {size_t{0}, size_t{2}}) {
      model.images[image].features[feature].point = id;
      point.observations.push_back({model.images[image].id, feature});
    }
  }
  return model;
}

void ExpectEqual(const ColmapModel& a, const ColmapModel& b) {
  ASSERT_EQ(a.cameras.size(), b.cameras.size());
  for (size_t i = 0; i < a.cameras.size(); ++i) {
    EXPECT_EQ(a.cameras[i].id, b.cameras[i].id);
    EXPECT_EQ(a.cameras[i].model, b.cameras[i].model);
    EXPECT_EQ(a.cameras[i].width, b.cameras[i].width);
    EXPECT_EQ(a.cameras[i].height, b.cameras[i].height);
    EXPECT_EQ(a.cameras[i].parameters, b.cameras[i].parameters);
  }
  ASSERT_EQ(a.images.size(), b.images.size());
  for (size_t i = 0; i < a.images.size(); ++i) {
    const ColmapImage& m = a.images[i];
    const ColmapImage& n = b.images[i];
    EXPECT_EQ(m.id, n.id);
    EXPECT_EQ(m.camera, n.camera);
    EXPECT_EQ(m.name, n.name);
    EXPECT_LT((m.camera_from_map.rotation.coeffs() - n.camera_from_map.rotation.coeffs()).norm(),
              1e-15);
    EXPECT_EQ(m.camera_from_map.translation, n.camera_from_map.translation);
    ASSERT_EQ(m.features.size(), n.features.size());
    for (size_t f = 0; f < m.features.size(); ++f) {
      EXPECT_EQ(m.features[f].x, n.features[f].x);
      EXPECT_EQ(m.features[f].y, n.features[f].y);
      EXPECT_EQ(m.features[f].point, n.features[f].point);
    }
  }
  ASSERT_EQ(a.points.size(), b.points.size());
  for (size_t i = 0; i < a.points.size(); ++i) {
    EXPECT_EQ(a.points[i].id, b.points[i].id);
    EXPECT_EQ(a.points[i].position, b.points[i].position);
    EXPECT_EQ(a.points[i].colour, b.points[i].colour);
    EXPECT_EQ(a.points[i].error, b.points[i].error);
    ASSERT_EQ(a.points[i].observations.size(), b.points[i].observations.size());
    for (size_t s = 0; s < a.points[i].observations.size(); ++s) {
      EXPECT_EQ(a.points[i].observations[s].image, b.points[i].observations[s].image);
      EXPECT_EQ(a.points[i].observations[s].feature, b.points[i].observations[s].feature);
    }
  }
}

class ColmapModelFormat : public ::testing::TestWithParam<ColmapFormat> {};

TEST_P(ColmapModelFormat, ReadsBackWhatItWrites) {
  const ColmapModel model = MakeModel();
  ASSERT_TRUE(model.Validate().ok()) << model.Validate().message();
  const ColmapFiles files = SerializeColmapModel(model, GetParam());
  const Result<ColmapModel> parsed = ParseColmapModel(files, GetParam(), "model");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  ExpectEqual(*parsed, model);
}

TEST_P(ColmapModelFormat, RefusesEveryTruncationWithOneErrorThatNamesTheFolder) {
  const ColmapFiles whole = SerializeColmapModel(MakeModel(), GetParam());
  for (std::string ColmapFiles::*file :
       {&ColmapFiles::cameras, &ColmapFiles::images, &ColmapFiles::points}) {
    // The text's last newline is the only redundant byte.
    for (size_t length = 0; length + 2 < (whole.*file).size(); ++length) {
      ColmapFiles files = whole;
      (files.*file).resize(length);
      const Result<ColmapModel> parsed = ParseColmapModel(files, GetParam(), "model");
      if (GetParam() == ColmapFormat::kBinary) {
        ASSERT_FALSE(parsed.ok()) << length;
        EXPECT_THAT(parsed.message(), HasSubstr("model"));
      } else if (parsed.ok()) {
        EXPECT_TRUE(parsed->Validate().ok());  // A truncated number is still a number.
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats,
                         ColmapModelFormat,
                         ::testing::Values(ColmapFormat::kText, ColmapFormat::kBinary),
                         [](const auto& info) {
                           return info.param == ColmapFormat::kText ? "Text" : "Binary";
                         });

TEST(ColmapText, ReadsCommentsBlankLinesAndNamesWithBlanks) {
  const ColmapFiles files = {"# cameras\n\n3 SIMPLE_PINHOLE 640 480 500 320 240\n",
                             "# images\n7 1 0 0 0 0.5 -1 2e-1 3 a b.jpg\r\n10.5 20.25 4 30 40 -1\n"
                             "8 1 0 0 0 0 0 0 3 second.jpg\n\n"
                             "9 1 0 0 0 0 0 0 3 third.jpg\n1 2 4\n",
                             "4 1 2 3 10 20 30 0.25 7 0 9 0\n"};
  const Result<ColmapModel> model = ParseColmapModel(files, ColmapFormat::kText, "model");
  ASSERT_TRUE(model.ok()) << model.message();
  ASSERT_EQ(model->images.size(), 3u);
  EXPECT_EQ(model->images[0].name, "a b.jpg");
  EXPECT_EQ(model->images[0].camera_from_map.translation, Eigen::Vector3d(0.5, -1.0, 0.2));
  ASSERT_EQ(model->images[0].features.size(), 2u);
  EXPECT_EQ(model->images[0].features[0].y, 20.25);
  EXPECT_EQ(model->images[0].features[1].point, ColmapFeature::kNoPoint);
  EXPECT_TRUE(model->images[1].features.empty());
  EXPECT_EQ(model->points[0].error, 0.25);
  EXPECT_EQ(model->points[0].observations[1].image, 9u);
}

TEST(ColmapText, ReadsWhatOtherProgramsWrite) {
  const ColmapFiles files = {
      "\xEF\xBB\xBF# cameras\r\n3 FULL_OPENCV 640 480 500 500 320 240 .1 0 0 0 0 0 0 0\r\n",
      "\xEF\xBB\xBF# images\r\n7 +1 0 0 0 +0.5 -1.000000e-001 2e-1 3 a.jpg \r\n"
      "8 1 0 0 0 0 0 0 3 2 b.jpg\r\n# a remark\r\n9 1 0 0 0 0 0 0 3 c.jpg\r\n"
      "1 2 4\r\n",
      "\xEF\xBB\xBF"
      "4 1 2 3 10 20 30 0.25 9 0\r\n"};
  const Result<ColmapModel> model = ParseColmapModel(files, ColmapFormat::kText, "model");
  ASSERT_TRUE(model.ok()) << model.message();
  ASSERT_EQ(model->images.size(), 3u);
  EXPECT_EQ(model->images[0].camera_from_map.translation, Eigen::Vector3d(0.5, -0.1, 0.2));
  EXPECT_EQ(model->images[0].name, "a.jpg");
  EXPECT_EQ(model->images[1].name, "2 b.jpg");
  EXPECT_EQ(model->images[2].features.size(), 1u);
  EXPECT_TRUE(model->notes.empty());
  const auto camera = CameraFromColmap(model->cameras[0]);
  ASSERT_TRUE(camera.ok()) << camera.message();
  EXPECT_EQ(camera->k1, 0.1);
}

TEST(ColmapText, NamesNewerCameraModelsAndWhatToDo) {
  for (const char* line : {"1 RAD_TAN_THIN_PRISM_FISHEYE 64 48 50 50 32 24 0 0 0 0 0 0 0 0 0 0 0 0",
                           "1 SIMPLE_DIVISION 64 48 50 32 24 0", "1 DIVISION 64 48 50 50 32 24 0",
                           "1 SIMPLE_FISHEYE 64 48 50 32 24", "1 FISHEYE 64 48 50 50 32 24",
                           "1 EUCM 64 48 50 50 32 24 .5 1", "1 EQUIRECTANGULAR 64 48 64 48",
                           "1 FULL_OPENCV 64 48 50 50 32 24 0 0 0 0 .1 0 0 0"}) {
    const auto model = ParseColmapModel({line, "", ""}, ColmapFormat::kText, "model");
    ASSERT_TRUE(model.ok()) << model.message();
    EXPECT_THAT(CameraFromColmap(model->cameras[0]).message(), HasSubstr("image_undistorter"));
  }
  EXPECT_THAT(ParseColmapModel({"1 MARS 640 480 500", "", ""}, ColmapFormat::kText, "m").message(),
              HasSubstr("image_undistorter"));
}

TEST(ColmapText, ErrorsNameTheLine) {
  ColmapFiles files;
  files.cameras = "# one\n1 PINHOLE 640 480 500 500 320 240\n2 PINHOLE 640 480 500 500 320\n";
  EXPECT_THAT(ParseColmapModel(files, ColmapFormat::kText, "model").message(),
              HasSubstr("model/cameras.txt:3"));
  files.cameras = "1 MARS 640 480 500 500 320\n";
  EXPECT_THAT(ParseColmapModel(files, ColmapFormat::kText, "model").message(), HasSubstr("MARS"));
}

TEST(ColmapBinary, RefusesHugeCountsWithoutAllocating) {
  const ColmapFiles whole = SerializeColmapModel(MakeModel(), ColmapFormat::kBinary);
  for (const uint64_t count : {uint64_t{1} << 60, uint64_t{1} << 33, uint64_t{1000}}) {
    for (std::string ColmapFiles::*file :
         {&ColmapFiles::cameras, &ColmapFiles::images, &ColmapFiles::points}) {
      ColmapFiles files = whole;
      std::memcpy((files.*file).data(), &count, sizeof(count));
      EXPECT_FALSE(ParseColmapModel(files, ColmapFormat::kBinary, "model").ok());
    }
  }
}

TEST(ColmapModel, ValidationSaysWhatIsBroken) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  using Damage = std::function<void(ColmapModel&)>;
  const std::vector<std::pair<const char*, Damage>> cases = {
      {"camera 1: appears twice", [](ColmapModel& m) { m.cameras[1].id = 1; }},
      {"image 2: appears twice", [](ColmapModel& m) { m.images[1].id = 2; }},
      {"point 10: appears twice", [](ColmapModel& m) { m.points[1].id = 10; }},
      {"camera 1: has a parameter", [&](ColmapModel& m) { m.cameras[0].parameters[2] = kNan; }},
      {"camera 77, which is missing", [](ColmapModel& m) { m.images[0].camera = 77; }},
      {"not a rigid motion",
       [](ColmapModel& m) { m.images[0].camera_from_map.rotation.coeffs() *= 1.5; }},
      {"not a rigid motion",
       [](ColmapModel& m) { m.images[0].camera_from_map.rotation.coeffs().setZero(); }},
      {"not a rigid motion",
       [&](ColmapModel& m) { m.images[0].camera_from_map.translation.x() = kNan; }},
      {"no usable name", [](ColmapModel& m) { m.images[0].name.clear(); }},
      {"no usable name", [](ColmapModel& m) { m.images[0].name = "a\nb"; }},
      {"invalid position", [&](ColmapModel& m) { m.images[0].features[0].x = kNan; }},
      {"invalid position", [&](ColmapModel& m) { m.points[0].position.z() = kNan; }},
      {"point 5, which is missing", [](ColmapModel& m) { m.images[0].features[0].point = 5; }},
      {"error that is not a finite number", [&](ColmapModel& m) { m.points[0].error = kNan; }},
      {"is not what feature 0", [](ColmapModel& m) { m.points[0].observations[0].feature = 0; }},
      {"is not what feature 900",
       [](ColmapModel& m) { m.points[0].observations[0].feature = 900; }},
      {"of image 8 shows", [](ColmapModel& m) { m.points[0].observations[0].image = 8; }},
      {"lists twice",
       [](ColmapModel& m) { m.points[0].observations.push_back(m.points[0].observations[0]); }},
      {"does not list feature", [](ColmapModel& m) { m.points[0].observations.pop_back(); }},
  };
  for (const auto& [message, damage] : cases) {
    ColmapModel model = MakeModel();
    damage(model);
    EXPECT_THAT(model.Validate().message(), HasSubstr(message));
  }
}

TEST(ColmapModel, NormalisesRotationsThatAreOffByRounding) {
  ColmapFiles files = {"1 PINHOLE 640 480 500 500 320 240\n",
                       "1 0.70711 0.70711 0 0 0 0 0 1 a.jpg\n\n", ""};
  const Result<ColmapModel> model = ParseColmapModel(files, ColmapFormat::kText, "model");
  ASSERT_TRUE(model.ok()) << model.message();
  EXPECT_NEAR(model->images[0].camera_from_map.rotation.norm(), 1.0, 1e-15);
  files.images = "1 2 0 0 0 0 0 0 1 a.jpg\n\n";
  EXPECT_FALSE(ParseColmapModel(files, ColmapFormat::kText, "model").ok());
}

TEST(ColmapCamera, PixelCentresMoveByHalfAPixel) {
  const auto camera =
      CameraFromColmap({1, ColmapCameraModel::kSimplePinhole, 640, 480, {500, 320, 240}});
  ASSERT_TRUE(camera.ok());
  EXPECT_EQ(camera->fx, 500.0);
  EXPECT_EQ(camera->fy, 500.0);
  EXPECT_EQ(camera->cx, 319.5);
  EXPECT_EQ(camera->cy, 239.5);
}

TEST(ColmapCamera, EveryModelOfOursReadsBack) {
  const geometry::CameraModel pinhole{640, 480, 500, 510, 319, 241};
  geometry::CameraModel radial = pinhole;
  radial.fy = radial.fx;
  radial.k1 = -0.1;
  radial.k2 = 0.02;
  geometry::CameraModel full = radial;
  full.fy = 505.0;
  full.p1 = 1e-3;
  full.p2 = -2e-3;
  for (const geometry::CameraModel& camera : {pinhole, radial, full}) {
    const auto read = CameraFromColmap(ColmapFromCamera(camera, 1));
    ASSERT_TRUE(read.ok()) << read.message();
    EXPECT_EQ(*read, camera);
  }
  EXPECT_EQ(ColmapFromCamera(pinhole, 1).model, ColmapCameraModel::kPinhole);
  EXPECT_EQ(ColmapFromCamera(radial, 1).model, ColmapCameraModel::kRadial);
  EXPECT_EQ(ColmapFromCamera(full, 1).model, ColmapCameraModel::kOpenCv);
}

TEST(ColmapCamera, NamesAModelThatItCannotExpressAndTheWayOut) {
  for (int i = static_cast<int>(ColmapCameraModel::kOpenCvFisheye); i < kColmapCameraModels; ++i) {
    ColmapCamera camera{4, static_cast<ColmapCameraModel>(i), 640, 480, {}};
    camera.parameters.assign(ParameterCount(camera.model), 100.0);
    const auto read = CameraFromColmap(camera);
    ASSERT_FALSE(read.ok());
    EXPECT_THAT(read.message(), HasSubstr(std::string(Name(camera.model))));
    EXPECT_THAT(read.message(), HasSubstr("image_undistorter"));
  }
}

TEST(ColmapCamera, RefusesImpossibleSizes) {
  for (const uint64_t width : {uint64_t{0}, uint64_t{1} << 40}) {
    EXPECT_FALSE(
        CameraFromColmap({1, ColmapCameraModel::kSimplePinhole, width, 480, {500, 320, 240}}).ok());
  }
}

TEST(LoadColmapModel, SaysWhichFileIsMissing) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(LoadColmapModel(folder.path()).message(), HasSubstr("cameras.bin or cameras.txt"));
  const ColmapFiles files = SerializeColmapModel(MakeModel(), ColmapFormat::kText);
  ASSERT_TRUE(WriteFileAtomically(folder / "cameras.txt", files.cameras).ok());
  EXPECT_THAT(LoadColmapModel(folder.path()).message(), HasSubstr("images.txt"));
  ASSERT_TRUE(WriteFileAtomically(folder / "images.txt", files.images).ok());
  const auto without_points = LoadColmapModel(folder.path());
  ASSERT_TRUE(without_points.ok()) << without_points.message();
  EXPECT_THAT(without_points->notes.front(), HasSubstr("points3D"));
  ASSERT_TRUE(WriteFileAtomically(folder / "points3D.txt", files.points).ok());
  EXPECT_TRUE(LoadColmapModel(folder.path()).ok());
}

}  // namespace
}  // namespace lararium::train
