// Compares the benchmark's errors with those of the reference evaluator, a separate program.

#include <gtest/gtest.h>

#include <cstdlib>

#include "player/benchmark/benchmark_evaluation.h"
#include "shared/core/json.h"
#include "shared/vision/poses_file.h"
#include "tests/player/benchmark_world.h"
#include "tests/support/test_files.h"

namespace lararium::player {
namespace {

void WritePoints(const std::filesystem::path& file, const std::vector<Eigen::Vector3d>& points) {
  Json list = Json::array();
  for (const Eigen::Vector3d& p : points) {
    list.push_back({p.x(), p.y(), p.z()});
  }
  ASSERT_TRUE(SaveJson(file, list).ok());
}

// A lens with distortion and noisy poses, of which three are wrong and two are missing.
TEST(BenchmarkDataTest, AgreesWithTheReferenceEvaluator) {
  LARARIUM_REQUIRE_DATA(tool, "../tools/evaluate_poses.py");
  test::BenchmarkWorld world = test::MakeBenchmarkWorld(40, 0.004, 5);
  world.camera.k1 = -0.08;
  world.camera.k2 = 0.02;
  world.camera.p1 = 0.001;
  for (int i = 0; i < 3; ++i) {
    world.pairs[7 + 11 * i].camera_from_map.translation.y() += 0.2;
  }
  std::vector<vision::PoseRecord> truth;
  std::vector<vision::PoseRecord> estimate;
  BenchmarkSequence sequence;
  sequence.points = world.points;
  for (size_t i = 0; i < world.pairs.size(); ++i) {
    const PosePair& pair = world.pairs[i];
    const std::string name = std::to_string(i) + ".png";
    const bool tracked = i != 4 && i != 30;
    truth.push_back({name, world.camera, pair.camera_from_world, true});
    estimate.push_back({name, world.camera, pair.camera_from_map, tracked});
    TrueImage& image = sequence.images.emplace_back();
    image.file = name;
    image.camera = world.camera;
    image.camera_from_world = pair.camera_from_world;
  }
  std::vector<FrameAnswer> answers;
  for (size_t i = 0; i < estimate.size(); ++i) {
    FrameAnswer& answer = answers.emplace_back();
    answer.truth = &sequence.images[i];
    if (estimate[i].tracked) {
      answer.camera_from_map = estimate[i].camera_from_world;
    }
  }
  const SequenceScore score = Evaluate(sequence, answers, {});

  const test::TemporaryFolder folder;
  ASSERT_TRUE(vision::SavePoses(folder / "truth.json", truth).ok());
  ASSERT_TRUE(vision::SavePoses(folder / "estimate.json", estimate).ok());
  WritePoints(folder / "points.json", world.points);
  const std::string command =
      "/usr/bin/python3 " + tool.string() +
      " --json --align sim3 --align-on points --ground-truth " + (folder / "truth.json").string() +
      " --estimate " + (folder / "estimate.json").string() + " --points " +
      (folder / "points.json").string() + " > " + (folder / "report.json").string();
  if (std::system(command.c_str()) != 0) {
    GTEST_SKIP() << "the reference evaluator does not run (it needs numpy)";
  }
  const Json report = LoadJson(folder / "report.json").value();

  EXPECT_EQ(report["registered"].get<size_t>(), score.tracked);
  const Json& px = report["registration_px"];
  EXPECT_NEAR(score.registration_px.mean, px["mean"].get<double>(), 1e-3);
  EXPECT_NEAR(score.registration_px.median, px["median"].get<double>(), 1e-3);
  EXPECT_NEAR(score.registration_px.p95, px["p95"].get<double>(), 1e-3);
  EXPECT_NEAR(score.registration_px.max, px["max"].get<double>(), 1e-3);
  EXPECT_NEAR(score.centre.mean, report["centre_error"]["mean"].get<double>(), 1e-5);
  EXPECT_NEAR(score.rotation_deg.mean, report["rotation_error_deg"]["mean"].get<double>(), 1e-5);
  ASSERT_EQ(score.errors.size(), report["per_image"].size());
  for (size_t i = 0; i < score.errors.size(); ++i) {
    const Json& image = report["per_image"][i];
    EXPECT_EQ(score.errors[i].points, image["points_visible"].get<size_t>()) << i;
    EXPECT_NEAR(score.errors[i].registration_px, image["registration_px_mean"].get<double>(), 1e-3)
        << i;
  }
}

}  // namespace
}  // namespace lararium::player
