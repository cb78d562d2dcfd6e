#include "player/benchmark/benchmark_sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::player {
namespace {

using ::testing::HasSubstr;

constexpr std::string_view kTruth = R"({"distortion": [-0.1, 0.01, 0, 0], "images": [
  {"file": "images/a.png", "width": 64, "height": 48, "K": [50, 50, 31.5, 23.5],
   "world_to_camera": {"R": [1,0,0,0,1,0,0,0,1], "t": [0,0,1]},
   "visible_fraction": 0.25, "gain_ev": -1.5},
  {"file": "images/b.png", "width": 64, "height": 48, "K": [50, 50, 31.5, 23.5],
   "world_to_camera": null}]})";

class BenchmarkSequenceTest : public ::testing::Test {
 protected:
  void Write(const std::string& name, std::string_view text) {
    std::filesystem::create_directories((folder_ / name).parent_path());
    ASSERT_TRUE(WriteFileAtomically(folder_ / name, text).ok());
  }
  std::string Error() { return LoadBenchmarkSequences(folder_.path()).message(); }

  test::TemporaryFolder folder_;
};

TEST_F(BenchmarkSequenceTest, ReadsPosesPointsAndWhatTheCameraDid) {
  Write("one/ground_truth.json", kTruth);
  Write("points.json", R"({"points": [{"xyz": [1, 2, 3]}, [4, 5, 6]]})");
  const auto sequences = LoadBenchmarkSequences(folder_.path()).value();
  ASSERT_EQ(sequences.size(), 1u);
  const BenchmarkSequence& sequence = sequences.front();
  EXPECT_EQ(sequence.name, "one");
  ASSERT_EQ(sequence.points.size(), 2u);
  EXPECT_EQ(sequence.points[1], Eigen::Vector3d(4, 5, 6));
  const TrueImage* image = sequence.Find("a.png");
  ASSERT_NE(image, nullptr);
  EXPECT_EQ(image->camera_from_world->translation.z(), 1.0);
  EXPECT_EQ(image->camera.k1, -0.1);
  EXPECT_EQ(image->visible_fraction, 0.25);
  EXPECT_EQ(image->gain_ev, -1.5);
  EXPECT_FALSE(sequence.Find("b.png")->camera_from_world);
  EXPECT_EQ(sequence.Find("c.png"), nullptr);
  EXPECT_TRUE(sequence.HasPoses());
  EXPECT_FALSE(sequence.IsStill());
}

TEST_F(BenchmarkSequenceTest, TheFolderMayBeTheSequenceItself) {
  Write("one/ground_truth.json", kTruth);
  Write("one/points.txt", "# x y z\n1 2 3 red\n\n  4 5 6\n");
  Write("one/images/a.png", "");
  ASSERT_TRUE(cv::imwrite(folder_ / "one/images/a.png", cv::Mat1b(48, 64)));
  const auto sequences = LoadBenchmarkSequences(folder_ / "one/").value();
  ASSERT_EQ(sequences.size(), 1u);
  EXPECT_EQ(sequences.front().name, "one");
  EXPECT_EQ(sequences.front().points.size(), 2u);
  EXPECT_EQ(OpenSequence(sequences.front()).value()->FrameName(0), "a.png");
  EXPECT_EQ(OpenForeign(folder_ / "one").value()->width(), 64);
}

TEST_F(BenchmarkSequenceTest, ErrorsNameTheFileAndWhatToDo) {
  EXPECT_THAT(Error(), HasSubstr("contains no sequence"));
  Write("one/ground_truth.json", kTruth);
  EXPECT_THAT(Error(), HasSubstr("put points.json or points.txt there"));
  Write("points.txt", "1 2 3\n1 2\n");
  EXPECT_THAT(Error(), HasSubstr("points.txt:2: expected x y z"));
  Write("points.txt", "");
  EXPECT_THAT(Error(), HasSubstr("contains no points"));
  Write("points.txt", "1 2 3");
  EXPECT_TRUE(LoadBenchmarkSequences(folder_.path()).ok());
  Write("two/ground_truth.json", R"({"images": [{"file": "x"}]})");
  EXPECT_THAT(Error(), HasSubstr("two/ground_truth.json: images[0]"));
  Write("two/ground_truth.json", R"({"images": []})");
  EXPECT_THAT(Error(), HasSubstr("lists no images"));
}

TEST_F(BenchmarkSequenceTest, ImagesOutsideTheFolderAreRefused) {
  std::string truth(kTruth);
  truth.replace(truth.find("images/a.png"), 12, "../../a.png");
  Write("one/ground_truth.json", truth);
  Write("points.txt", "1 2 3");
  const auto sequences = LoadBenchmarkSequences(folder_.path()).value();
  EXPECT_THAT(OpenSequence(sequences.front()).message(), HasSubstr("outside its own folder"));
}

}  // namespace
}  // namespace lararium::player
