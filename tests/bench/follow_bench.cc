// Budgets on one core of a PC at 640 x 480: the pyramid 0.3 ms, sampling 300 patches 0.5 ms and
// aligning them 1 ms, a tracked frame 4 ms, its foreground 2 ms.

#include <benchmark/benchmark.h>

#include <memory>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "shared/core/random.h"
#include "shared/vision/follow_map.h"
#include "shared/vision/foreground/foreground_mask.h"
#include "shared/vision/image_pyramid.h"
#include "shared/vision/patch.h"
#include "shared/vision/patch_tracker.h"
#include "tests/support/synthetic_world.h"

namespace lararium::vision {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;

constexpr CameraModel kCamera{640, 480, 560, 560, 319.5, 239.5};
constexpr double kMetrePixels = 250.0;  // Pixels per metre in the wall's picture.
constexpr int kPatches = 300;

// A decorated wall, 8 m by 6 m, in the plane z = 0 around the origin.
cv::Mat Wall() {
  Random random(1);
  cv::Mat wall(1500, 2000, CV_8UC1, cv::Scalar(128));
  for (int i = 0; i < 40000; ++i) {
    const cv::Point centre{static_cast<int>(random.Below(2000)),
                           static_cast<int>(random.Below(1500))};
    const cv::Size axes{2 + static_cast<int>(random.Below(12)),
                        2 + static_cast<int>(random.Below(12))};
    const double angle = random.Uniform(0.0, 180.0);
    cv::ellipse(wall, centre, axes, angle, 0.0, 360.0, cv::Scalar(random.Uniform(20.0, 235.0)),
                cv::FILLED);
  }
  cv::GaussianBlur(wall, wall, cv::Size(), 1.0);
  return wall;
}

Eigen::Vector3d OnWall(double column, double row) {
  return {(column - 999.5) / kMetrePixels, (749.5 - row) / kMetrePixels, 0.0};
}

cv::Mat Photograph(const cv::Mat& wall, const Rigid3& camera_from_map) {
  // The homography of the plane z = 0.
  Eigen::Matrix3d k;
  k << kCamera.fx, 0, kCamera.cx, 0, kCamera.fy, kCamera.cy, 0, 0, 1;
  Eigen::Matrix3d plane;
  plane << camera_from_map.rotation.toRotationMatrix().leftCols<2>(), camera_from_map.translation;
  Eigen::Matrix3d map_from_wall;
  map_from_wall << 1 / kMetrePixels, 0, -999.5 / kMetrePixels, 0, -1 / kMetrePixels,
      749.5 / kMetrePixels, 0, 0, 1;
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> h = k * plane * map_from_wall;
  cv::Mat picture;
  cv::warpPerspective(wall, picture, cv::Mat(3, 3, CV_64F, const_cast<double*>(h.data())),
                      cv::Size(kCamera.width, kCamera.height), cv::INTER_LINEAR,
                      cv::BORDER_REFLECT);
  return picture;
}

Rigid3 PathPose(double t) {
  return test::LookAt({0.6 * std::sin(t), 0.2 * std::cos(1.3 * t), 3.0}, {0.1 * t, 0.0, 0.0});
}

// Four keyframes that observe a thousand points of the wall.
std::shared_ptr<const SceneDatabase> MakeDatabase(const cv::Mat& wall) {
  auto database = std::make_shared<SceneDatabase>();
  database->camera = kCamera;
  Random random(2);
  for (int i = 0; i < 4000; ++i) {
    const double column = random.Uniform(100, 1900);
    const Eigen::Vector3d point = OnWall(column, random.Uniform(100, 1400));
    database->points.push_back(point.cast<float>());
    database->normals.emplace_back(0.0f, 0.0f, 1.0f);
    database->observation_counts.push_back(4);
    database->session_masks.push_back(1);
  }
  for (uint32_t k = 0; k < 4; ++k) {
    Keyframe keyframe;
    keyframe.frame_index = k;
    keyframe.camera_from_map = PathPose(-0.6 + 0.4 * k);
    keyframe.grey = Photograph(wall, keyframe.camera_from_map);
    for (uint32_t i = 0; i < database->points.size(); ++i) {
      const auto pixel =
          kCamera.Project(keyframe.camera_from_map * database->points[i].cast<double>());
      if (pixel && pixel->x() > 8 && pixel->y() > 8 && pixel->x() < 631 && pixel->y() < 471) {
        database->observations.push_back(
            {i, k, static_cast<float>(pixel->x()), static_cast<float>(pixel->y()), 2.0f});
      }
    }
    database->keyframes.push_back(std::move(keyframe));
  }
  return database;
}

void BenchPyramid(benchmark::State& state) {
  const cv::Mat picture = Photograph(Wall(), PathPose(0.0));
  ImagePyramid pyramid;
  for (auto _ : state) {
    pyramid.Build(picture, CoarsestLevel(picture.cols) + 1);
    benchmark::DoNotOptimize(pyramid.levels());
  }
}
BENCHMARK(BenchPyramid)->Unit(benchmark::kMillisecond);

std::vector<Eigen::Vector2f> PatchCentres() {
  Random random(3);
  std::vector<Eigen::Vector2f> centres;
  for (int i = 0; i < kPatches; ++i) {
    centres.push_back(
        {static_cast<float>(random.Uniform(20, 620)), static_cast<float>(random.Uniform(20, 460))});
  }
  return centres;
}

// Samples kPatches templates, seen slightly from the side.
void BenchSamplePatches(benchmark::State& state) {
  const cv::Mat picture = Photograph(Wall(), PathPose(0.0));
  const std::vector<Eigen::Vector2f> centres = PatchCentres();
  PatchWarp warp;
  warp.source_from_patch << 1.1f, 0.1f, -0.05f, 0.95f;
  PatchTemplate patch;
  for (auto _ : state) {
    for (const Eigen::Vector2f& centre : centres) {
      warp.centre = centre;
      benchmark::DoNotOptimize(patch.Sample(picture, warp));
    }
  }
}
BENCHMARK(BenchSamplePatches)->Unit(benchmark::kMillisecond);

// Aligns kPatches templates, each from half a pixel off.
void BenchAlignPatches(benchmark::State& state) {
  const cv::Mat picture = Photograph(Wall(), PathPose(0.0));
  std::vector<Eigen::Vector2f> centres;
  std::vector<PatchTemplate> patches;
  for (const Eigen::Vector2f& centre : PatchCentres()) {
    PatchWarp warp;
    warp.centre = centre;
    if (PatchTemplate patch; patch.Sample(picture, warp)) {
      centres.push_back(centre);
      patches.push_back(patch);
    }
  }
  PatchFit fit;
  int found = 0;
  for (auto _ : state) {
    found = 0;
    for (size_t i = 0; i < centres.size(); ++i) {
      const Eigen::Vector2f start = centres[i] + Eigen::Vector2f(0.4f, -0.3f);
      found += AlignPatch(picture, patches[i], start, {}, fit);
    }
  }
  state.counters["found"] = static_cast<double>(found);
  state.counters["of"] = static_cast<double>(centres.size());
}
BENCHMARK(BenchAlignPatches)->Unit(benchmark::kMillisecond);

// Tracks one frame of a hand-held path, from its pyramid to its pose.
void BenchFollow(benchmark::State& state) {
  constexpr int kFrames = 16;
  const cv::Mat wall = Wall();
  std::vector<cv::Mat> pictures;
  std::vector<Rigid3> truth;
  for (int i = 0; i < kFrames; ++i) {
    // Forward and back, so that the sequence can repeat without end.
    truth.push_back(PathPose(0.1 * std::sin(2.0 * M_PI * i / kFrames)));
    pictures.push_back(Photograph(wall, truth.back()));
  }
  PatchTracker patch_tracker(std::make_shared<TrackedMap>(MakeDatabase(wall)));
  patch_tracker.Start(kCamera, truth.front());
  ImagePyramid pyramid;
  Rigid3 before = truth.front();
  size_t frame = 0;
  int64_t reliable = 0;
  for (auto _ : state) {
    frame = (frame + 1) % kFrames;
    pyramid.Build(pictures[frame], CoarsestLevel(kCamera.width) + 1);
    const FollowedPose pose =
        patch_tracker.Follow(pyramid, ExactCamera(kCamera), std::span(&before, 1), &before, 1.0);
    reliable += pose.reliable;
    before = pose.reliable ? pose.camera_from_map : truth[frame];
  }
  state.counters["followed"] =
      static_cast<double>(reliable) / static_cast<double>(state.iterations());
}
BENCHMARK(BenchFollow)->Unit(benchmark::kMillisecond);

// Finds a person who stands before the wall and hides a fifth of it.
void BenchForeground(benchmark::State& state) {
  const cv::Mat wall = Wall();
  const std::shared_ptr<const SceneDatabase> database = MakeDatabase(wall);
  ForegroundMask mask(database);
  TrackedFrame tracked;
  tracked.camera = kCamera;
  tracked.camera_from_map = PathPose(0.05);
  tracked.frame.grey = Photograph(wall, *tracked.camera_from_map);
  cv::Mat person = cv::Mat::zeros(kCamera.height, kCamera.width, CV_8UC1);
  cv::ellipse(person, {320, 300}, {100, 200}, 0.0, 0.0, 360.0, 255, cv::FILLED);
  tracked.frame.grey.setTo(90, person);
  cv::cvtColor(tracked.frame.grey, tracked.frame.bgr, cv::COLOR_GRAY2BGR);
  std::vector<SeenPoint> seen;
  for (uint32_t i = 0; i < database->points.size(); i += 10) {
    const auto pixel =
        kCamera.Project(*tracked.camera_from_map * database->points[i].cast<double>());
    if (pixel && kCamera.Contains(*pixel) &&
        person.at<uint8_t>(static_cast<int>(pixel->y() + 0.5),
                           static_cast<int>(pixel->x() + 0.5)) == 0) {
      seen.push_back({i, pixel->cast<float>()});
    }
  }
  int64_t found = 0;
  for (auto _ : state) {
    found += mask.Estimate(tracked, seen).empty() ? 0 : 1;
  }
  state.counters["found"] = static_cast<double>(found) / static_cast<double>(state.iterations());
}
BENCHMARK(BenchForeground)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lararium::vision
