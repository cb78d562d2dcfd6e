// A stage at a photographed place whose cameras were measured by a laser scan.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "editor/jobs/check_points.h"
#include "editor/train/trainer.h"
#include "shared/core/random.h"
#include "shared/vision/poses_file.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Rigid3;

struct Surveyed {
  geometry::CameraModel camera;
  std::map<std::string, Rigid3> camera_from_world;  // Keyed by file name; metres.
};

Surveyed LoadSurveyed(const std::filesystem::path& file) {
  const auto poses = vision::LoadPoses(file);
  EXPECT_TRUE(poses.ok()) << poses.message();
  Surveyed surveyed;
  for (const vision::PoseRecord& pose : *poses) {
    surveyed.camera = pose.camera;
    surveyed.camera_from_world[std::filesystem::path(pose.file).filename()] =
        *pose.camera_from_world;
  }
  return surveyed;
}

// The stage is in front of the fountain: its origin on the pavement (the scan's z points down), its
// x along the basin's front, its z towards the cameras.
Rigid3 WorldFromStage() {
  const Vector3d along = Vector3d(1.792, -0.558, 0.0).normalized();
  const Vector3d up(0.0, 0.0, -1.0);
  Eigen::Matrix3d axes;
  axes << along, up, along.cross(up);
  return Rigid3::FromMatrix(axes, Vector3d(-16.42, -8.83, 1.66));
}

TEST(PhotographedPlace, AStageLaidByFourPointsShowsPeopleWhereTheyStandToThePixel) {
  LARARIUM_REQUIRE_DATA(folder, "fountain-P11");
  const Surveyed surveyed = LoadSurveyed(folder / "ground_truth.json");
  auto source = capture::OpenImageFolder(folder / "images");
  ASSERT_TRUE(source.ok()) << source.message();
  train::TrainOptions options;
  options.intrinsics = surveyed.camera;
  NoProgress progress;
  const auto trained = train::Train(**source, options, progress, *MakeSilentLog());
  ASSERT_TRUE(trained.ok()) << trained.message();
  const vision::SceneDatabase& map = trained->database;

  const auto seen = [&](const std::string& frame, const Vector3d& on_stage) {
    return surveyed.camera.Project(surveyed.camera_from_world.at(frame) *
                                   (WorldFromStage() * on_stage));
  };
  // The foot of the basin and the wall behind it, picked with typical human errors.
  ProjectDocument document;
  document.check_points = {{"left", {-0.5, 0.0, 0.9}},
                           {"right", {1.4, 0.0, 0.9}},
                           {"niche", {0.45, 1.9, -0.8}},
                           {"wall", {2.4, 1.2, -0.6}}};
  PlaceDocument place;
  Random random(1);
  for (const auto& point : document.check_points) {
    for (const vision::Keyframe& keyframe : map.keyframes) {
      const auto pixel = seen(keyframe.name, point.position);
      if (pixel && surveyed.camera.Contains(*pixel) && keyframe.frame_index % 2 == 1) {
        const Vector2d error{random.Uniform(-1.5, 1.5), random.Uniform(-1.5, 1.5)};
        SetCheckPick(place, point.name, {keyframe.frame_index, keyframe.name, *pixel + error});
      }
    }
  }
  const CheckReport report = CheckStaging(document, place, map, geometry::Similarity3());
  ASSERT_TRUE(report.map_from_stage.has_value()) << CheckText(report);
  EXPECT_TRUE(report.fit_good) << CheckText(report);
  EXPECT_LT(report.fit_rms_m, 0.01);

  // Feet and heads of people at other positions of the stage, in every photograph that sees them.
  double sum = 0.0;
  int count = 0;
  for (const vision::Keyframe& keyframe : map.keyframes) {
    const Rigid3 camera_from_stage =
        geometry::CameraFromB(keyframe.camera_from_map, *report.map_from_stage);
    for (const double x : {-1.0, 0.2, 1.9}) {
      for (const double y : {0.0, 1.7}) {
        const Vector3d at(x, y, 1.6);
        const auto expected = seen(keyframe.name, at);
        const auto shown = surveyed.camera.Project(camera_from_stage * at);
        if (expected && shown && surveyed.camera.Contains(*expected)) {
          sum += (*shown - *expected).squaredNorm();
          ++count;
        }
      }
    }
  }
  ASSERT_GT(count, 20);
  const double rms = std::sqrt(sum / count);
  RecordProperty("rms_px", std::to_string(rms));
  std::printf("%d points: %.2f px, stage to %.1f mm\n", count, rms, 1000.0 * report.fit_rms_m);
  EXPECT_LT(rms, 3.0);
}

}  // namespace
}  // namespace lararium::editor
