// Budgets on one core of a PC: features 40 ms at first octave 0, search 10 ms for a thousand
// queries, preemptive RANSAC 3 ms. OpenCV's SIFT is the reference.

#include <benchmark/benchmark.h>

#include <opencv2/core/utility.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "shared/core/check.h"
#include "shared/core/parallel.h"
#include "shared/geometry/p3p.h"
#include "shared/geometry/preemptive_ransac.h"
#include "shared/vision/features.h"
#include "shared/vision/localizer.h"
#include "tests/support/synthetic_world.h"

namespace lararium::vision {
namespace {

constexpr int kFeatures = 1000;

// A 640 x 480 picture, as rich as a photograph of a decorated wall.
cv::Mat Picture() {
  Random random(1);
  cv::Mat picture(480, 640, CV_8UC1, cv::Scalar(128));
  for (int i = 0; i < 6000; ++i) {
    const cv::Point centre{static_cast<int>(random.Below(640)),
                           static_cast<int>(random.Below(480))};
    const cv::Size axes{1 + static_cast<int>(random.Below(8)),
                        1 + static_cast<int>(random.Below(8))};
    const double angle = random.Uniform(0.0, 180.0);
    cv::ellipse(picture, centre, axes, angle, 0.0, 360.0, cv::Scalar(random.Uniform(20.0, 235.0)),
                cv::FILLED);
  }
  cv::GaussianBlur(picture, picture, cv::Size(), 0.8);
  return picture;
}

// Argument: first octave. At most kFeatures features.
void BenchExtractFeatures(benchmark::State& state) {
  const ThreadLimit limit(1);
  const cv::Mat picture = Picture();
  FeatureOptions options;
  options.first_octave = static_cast<int>(state.range(0));
  options.max_features = kFeatures;
  FeatureExtractor extractor;
  Features features;
  for (auto _ : state) {
    CHECK(extractor.Extract(picture, options, features).ok());
  }
  state.counters["features"] = static_cast<double>(features.size());
}
BENCHMARK(BenchExtractFeatures)->Arg(-1)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void BenchOpenCvSift(benchmark::State& state) {
  cv::setNumThreads(1);
  const cv::Mat picture = Picture();
  const auto sift = cv::SIFT::create(kFeatures);
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  for (auto _ : state) {
    sift->detectAndCompute(picture, cv::noArray(), keypoints, descriptors);
  }
  state.counters["features"] = static_cast<double>(keypoints.size());
}
BENCHMARK(BenchOpenCvSift)->Unit(benchmark::kMillisecond);

// Argument: checks for each of kFeatures queries among 100 000 descriptors.
void BenchForestSearch(benchmark::State& state) {
  Random random(2);
  std::vector<Descriptor> descriptors(100'000);
  for (Descriptor& descriptor : descriptors) {
    descriptor = test::RandomDescriptor(random);
  }
  const DescriptorForest forest = BuildForest(descriptors, {});
  ForestSearcher searcher(forest, descriptors);
  std::array<Neighbour, 8> found;
  for (auto _ : state) {
    for (int i = 0; i < kFeatures; ++i) {
      benchmark::DoNotOptimize(
          searcher.Search(descriptors[i * 97], static_cast<int>(state.range(0)), found));
    }
  }
}
BENCHMARK(BenchForestSearch)->Arg(32)->Arg(64)->Arg(128)->Unit(benchmark::kMillisecond);

// Argument: number of matches, six of ten wrong. The time must hardly grow with it.
void BenchPreemptiveRansac(benchmark::State& state) {
  using Pose = Eigen::Matrix<double, 3, 4>;
  const auto world =
      test::MakeSyntheticWorld({.points = static_cast<int>(state.range(0)), .cameras = 1});
  const geometry::Rigid3& truth = world.cameras_from_world[0];
  Random noise(3);
  std::vector<Eigen::Vector2d> seen;
  for (const Eigen::Vector3d& point : world.points) {
    const bool wrong = noise.Uniform() < 0.6;
    seen.push_back(wrong ? Eigen::Vector2d{noise.Uniform(-0.5, 0.5), noise.Uniform(-0.4, 0.4)}
                         : Eigen::Vector2d((truth * point).hnormalized()));
  }
  const auto generate = [&](Random& random, std::vector<Pose>& poses) {
    std::array<Eigen::Vector3d, 3> rays;
    std::array<Eigen::Vector3d, 3> points;
    for (int k = 0; k < 3; ++k) {
      const uint32_t i = random.Below(static_cast<uint32_t>(seen.size()));
      rays[k] = seen[i].homogeneous().normalized();
      points[k] = world.points[i];
    }
    const geometry::P3pSolutions solutions = geometry::SolveP3p(rays, points);
    for (const geometry::Rigid3& pose : solutions.poses()) {
      poses.push_back(pose.Matrix3x4());
    }
  };
  const auto cost = [&](const Pose& pose, uint32_t i) {
    const Eigen::Vector3d p = pose.leftCols<3>() * world.points[i] + pose.col(3);
    return std::min((p.hnormalized() - seen[i]).squaredNorm(), 1e-4);
  };
  geometry::PreemptiveRansac<Pose> ransac;
  for (auto _ : state) {
    benchmark::DoNotOptimize(ransac.Run(seen.size(), {}, generate, cost));
  }
}
BENCHMARK(BenchPreemptiveRansac)->Arg(300)->Arg(3000)->Unit(benchmark::kMillisecond);

// Locates a frame whose features are given.
void BenchLocate(benchmark::State& state) {
  const ThreadLimit limit(1);
  const auto world = test::MakeSyntheticWorld({.points = static_cast<int>(state.range(0))});
  const SceneDatabase database = test::MakeSceneDatabase(world);
  Localizer localizer(database, {});
  const auto view =
      test::RenderView(world, world.cameras_from_world[3], {.noise_px = 0.3, .outlier_share = 0.4});
  for (auto _ : state) {
    benchmark::DoNotOptimize(localizer.Locate(view.features, world.camera).inliers);
  }
}
BENCHMARK(BenchLocate)->Arg(1000)->Arg(4000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lararium::vision
