#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "shared/vision/descriptor_forest.h"
#include "shared/vision/features.h"
#include "shared/vision/poses_file.h"
#include "tests/support/test_files.h"

namespace lararium::vision {
namespace {

std::vector<cv::Mat> GreyFrames(const std::filesystem::path& video, int count) {
  cv::VideoCapture capture(video.string());
  std::vector<cv::Mat> frames;
  cv::Mat bgr;
  while (static_cast<int>(frames.size()) < count && capture.read(bgr)) {
    cv::cvtColor(bgr, frames.emplace_back(), cv::COLOR_BGR2GRAY);
  }
  return frames;
}

// Distance of a point from its epipolar line in the other image, pixels.
double EpipolarDistance(const PoseRecord& from,
                        const PoseRecord& to,
                        const Keypoint& a,
                        const Keypoint& b) {
  const geometry::Rigid3 motion = *to.camera_from_world * from.camera_from_world->Inverse();
  const Eigen::Vector3d line =
      geometry::Skew(motion.translation) *
      (motion.rotation * from.camera.PlaneFromPixel({a.x, a.y}).homogeneous());
  const Eigen::Vector3d ray = to.camera.PlaneFromPixel({b.x, b.y}).homogeneous();
  return std::abs(line.dot(ray)) / line.head<2>().norm() * to.camera.Focal();
}

TEST(ExtractFeatures, MatchAcrossFramesOfTheMaquette) {
  LARARIUM_REQUIRE_DATA(folder, "maquette/training");
  const std::vector<cv::Mat> frames = GreyFrames(folder / "video.mp4", 6);
  ASSERT_EQ(frames.size(), 6u);
  const auto poses = LoadPoses(folder / "ground_truth.json");
  ASSERT_TRUE(poses.ok()) << poses.message();
  for (const int first_octave : {-1, 0}) {
    FeatureOptions options;
    options.first_octave = first_octave;
    const Features a = *ExtractFeatures(frames[0], options);
    const Features b = *ExtractFeatures(frames[5], options);
    ASSERT_GT(a.size(), first_octave < 0 ? 3000u : 800u);
    const DescriptorForest forest = BuildForest(b.descriptors, {});
    ForestSearcher searcher(forest, b.descriptors);
    std::vector<double> distances;
    for (size_t i = 0; i < a.size(); ++i) {
      std::array<Neighbour, 2> found;
      ASSERT_EQ(searcher.Search(a.descriptors[i], 128, found), 2u);
      if (found[0].squared_distance < 0.64 * found[1].squared_distance) {
        distances.push_back(EpipolarDistance((*poses)[0], (*poses)[5], a.keypoints[i],
                                             b.keypoints[found[0].descriptor]));
      }
    }
    ASSERT_GT(distances.size(), 0.3 * a.size());
    std::sort(distances.begin(), distances.end());
    EXPECT_LT(distances[distances.size() / 2], 0.25) << "first octave " << first_octave;
    EXPECT_LT(distances[distances.size() * 9 / 10], 1.5) << "first octave " << first_octave;
  }
}

}  // namespace
}  // namespace lararium::vision
