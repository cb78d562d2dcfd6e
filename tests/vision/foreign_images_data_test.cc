// Tests that images of other places get no pose, because a wrong pose is worse than none.

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "shared/core/random.h"
#include "shared/geometry/triangulation.h"
#include "shared/vision/descriptor_forest.h"
#include "shared/vision/feature_scale_controller.h"
#include "shared/vision/features.h"
#include "shared/vision/localizer.h"
#include "shared/vision/poses_file.h"
#include "tests/support/test_files.h"

namespace lararium::vision {
namespace {

namespace fs = std::filesystem;

std::vector<cv::Mat> VideoFrames(const fs::path& video, int step) {
  cv::VideoCapture capture(video.string());
  std::vector<cv::Mat> frames;
  cv::Mat bgr;
  for (int i = 0; capture.read(bgr); ++i) {
    if (i % step == 0) {
      cv::cvtColor(bgr, frames.emplace_back(), cv::COLOR_BGR2GRAY);
    }
  }
  return frames;
}

// The images of a folder in order of names, scaled so that no side is longer than 960 pixels.
std::vector<cv::Mat> FolderImages(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<cv::Mat> images;
  for (const fs::path& file : files) {
    cv::Mat image = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
    if (!image.empty()) {
      const double scale = std::min(960.0 / std::max(image.cols, image.rows), 1.0);
      cv::resize(image, images.emplace_back(), cv::Size(), scale, scale, cv::INTER_AREA);
    }
  }
  return images;
}

// Makes a map from true poses: matches and triangulates features of images that are `step` apart.
class MapMaker {
 public:
  MapMaker(const std::vector<cv::Mat>& images, const std::vector<PoseRecord>& poses, size_t step) {
    map_.camera = poses[0].camera;
    for (size_t i = 0; i + step < images.size(); i += step) {
      AddPair(images[i], poses[i], images[i + step], poses[i + step]);
    }
    map_.descriptor_begin.push_back(static_cast<uint32_t>(map_.descriptors.size()));
    map_.forest = BuildForest(map_.descriptors, {});
  }
  const SceneDatabase& map() const { return map_; }

 private:
  void AddPair(const cv::Mat& image_a,
               const PoseRecord& pose_a,
               const cv::Mat& image_b,
               const PoseRecord& pose_b) {
    FeatureOptions options;
    options.first_octave = 0;
    options.contrast_threshold = 0.02f;
    const Features a = *ExtractFeatures(image_a, options);
    const Features b = *ExtractFeatures(image_b, options);
    const DescriptorForest forest = BuildForest(b.descriptors, {});
    ForestSearcher searcher(forest, b.descriptors);
    for (size_t i = 0; i < a.size(); ++i) {
      std::array<Neighbour, 2> found;
      if (searcher.Search(a.descriptors[i], 128, found) == 2 &&
          found[0].squared_distance < 0.64 * found[1].squared_distance) {
        const uint32_t j = found[0].descriptor;
        AddPoint(pose_a, a.keypoints[i], a.descriptors[i], pose_b, b.keypoints[j],
                 b.descriptors[j]);
      }
    }
  }

  void AddPoint(const PoseRecord& pose_a,
                const Keypoint& a,
                const Descriptor& descriptor_a,
                const PoseRecord& pose_b,
                const Keypoint& b,
                const Descriptor& descriptor_b) {
    const std::array<geometry::Rigid3, 2> cameras = {*pose_a.camera_from_world,
                                                     *pose_b.camera_from_world};
    const std::array<Eigen::Vector2d, 2> planes = {pose_a.camera.PlaneFromPixel({a.x, a.y}),
                                                   pose_b.camera.PlaneFromPixel({b.x, b.y})};
    const auto point = geometry::TriangulatePoint(cameras, planes);
    if (!point) {
      return;
    }
    for (size_t k = 0; k < 2; ++k) {
      const Eigen::Vector2d seen = (cameras[k] * *point).hnormalized();
      if ((seen - planes[k]).norm() * map_.camera.Focal() > 2.0) {
        return;
      }
    }
    map_.descriptor_begin.push_back(static_cast<uint32_t>(map_.descriptors.size()));
    for (const Descriptor& descriptor : {descriptor_a, descriptor_b}) {
      map_.descriptors.push_back(descriptor);
      map_.descriptor_point.push_back(static_cast<uint32_t>(map_.points.size()));
    }
    map_.points.push_back(point->cast<float>());
    map_.normals.push_back((cameras[0].Center() - *point).normalized().cast<float>());
    map_.observation_counts.push_back(2);
    map_.session_masks.push_back(1);
  }

  SceneDatabase map_;
};

// Locates images and, like the tracker, falls back to the finest features.
class Eye {
 public:
  explicit Eye(const SceneDatabase& map) : map_(map), localizer_(map, {}) {}

  bool Locates(const cv::Mat& image) {
    geometry::CameraModel camera = map_.camera;
    if (image.cols != camera.width || image.rows != camera.height) {
      camera.width = image.cols;
      camera.height = image.rows;
      camera.cx = 0.5 * (image.cols - 1);
      camera.cy = 0.5 * (image.rows - 1);
    }
    const FeatureScaleController detail(1000);
    for (const FeatureOptions& options : {detail.options(), detail.finest_options()}) {
      EXPECT_TRUE(extractor_.Extract(image, options, features_).ok());
      if (localizer_.Locate(features_, camera).camera_from_map) {
        return true;
      }
    }
    return false;
  }

  int CountLocated(const std::vector<cv::Mat>& images) {
    return static_cast<int>(std::count_if(images.begin(), images.end(),
                                          [&](const cv::Mat& image) { return Locates(image); }));
  }

 private:
  const SceneDatabase& map_;
  Localizer localizer_;
  FeatureExtractor extractor_;
  Features features_;
};

// Noise of all scales, bricks, tiles and checks.
std::vector<cv::Mat> NoiseAndPatterns() {
  std::vector<cv::Mat> images;
  Random random(1);
  for (int i = 0; i < 16; ++i) {
    cv::Mat noise(480, 640, CV_8UC1);
    for (int k = 0; k < 480 * 640; ++k) {
      noise.data[k] = static_cast<uint8_t>(random.Below(256));
    }
    if (i > 0) {
      cv::GaussianBlur(noise, noise, cv::Size(), 0.4 * i);
      cv::normalize(noise, noise, 0, 255, cv::NORM_MINMAX);
    }
    images.push_back(noise);
  }
  for (int i = 0; i < 16; ++i) {
    const int period = 8 + 4 * i;
    cv::Mat motif(period, period, CV_8UC1);
    for (int k = 0; k < period * period; ++k) {
      motif.data[k] = static_cast<uint8_t>(random.Below(256));
    }
    cv::GaussianBlur(motif, motif, cv::Size(), 1.0);
    cv::Mat tiles;
    cv::repeat(motif, 480 / period + 1, 640 / period + 1, tiles);
    images.push_back(tiles(cv::Rect(0, 0, 640, 480)).clone());
    cv::Mat checks(480, 640, CV_8UC1);
    for (int y = 0; y < 480; ++y) {
      for (int x = 0; x < 640; ++x) {
        checks.at<uint8_t>(y, x) = (x / period + y / period) % 2 == 0 ? 40 : 210;
      }
    }
    images.push_back(checks);
  }
  return images;
}

TEST(ForeignImages, AreNeverLocatedInTheMaquette) {
  LARARIUM_REQUIRE_DATA(home, "maquette");
  LARARIUM_REQUIRE_DATA(fox, "fox/images");
  LARARIUM_REQUIRE_DATA(fountain, "fountain-P11/images");
  LARARIUM_REQUIRE_DATA(box, "box/images");
  const auto poses = LoadPoses(home / "training/ground_truth.json");
  ASSERT_TRUE(poses.ok()) << poses.message();
  const MapMaker maker(VideoFrames(home / "training/video.mp4", 1), *poses, 4);
  ASSERT_GT(maker.map().points.size(), 5000u);
  Eye eye(maker.map());
  // The map locates its own images, so missing poses for other images are significant.
  const std::vector<cv::Mat> own = VideoFrames(home / "handheld/video.mp4", 15);
  EXPECT_EQ(eye.CountLocated(own), static_cast<int>(own.size()));
  int images = 0;
  for (const std::vector<cv::Mat>& foreign :
       {FolderImages(fox), FolderImages(fountain), FolderImages(box), NoiseAndPatterns()}) {
    EXPECT_EQ(eye.CountLocated(foreign), 0);
    images += static_cast<int>(foreign.size());
  }
  EXPECT_GE(images, 200);
}

TEST(ForeignImages, AreNeverLocatedAtTheFox) {
  LARARIUM_REQUIRE_DATA(home, "fox-pinhole");
  LARARIUM_REQUIRE_DATA(maquette, "maquette");
  const auto poses = LoadPoses(home / "ground_truth.json");
  ASSERT_TRUE(poses.ok()) << poses.message();
  const std::vector<cv::Mat> own = FolderImages(home / "images");
  ASSERT_EQ(own.size(), poses->size());
  const MapMaker maker(own, *poses, 1);
  ASSERT_GT(maker.map().points.size(), 1000u);
  Eye eye(maker.map());
  EXPECT_GT(eye.CountLocated({own[10], own[20], own[30]}), 2);
  for (const char* name : {"handheld", "blur"}) {
    EXPECT_EQ(eye.CountLocated(VideoFrames(maquette / name / "video.mp4", 6)), 0);
  }
  EXPECT_EQ(eye.CountLocated(NoiseAndPatterns()), 0);
}

}  // namespace
}  // namespace lararium::vision
