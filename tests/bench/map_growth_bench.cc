// lararium_map_growth MAP.larscene VIDEO [STEP]: measures the cost of the first pose from one
// frame, and how many frames get one, in the map reduced to 10 000 points and grown from there to
// 100 000 and 1 000 000. The grown map is a house of many rooms: copies of the points beside each
// other, with descriptors that are perturbed mixtures of real ones. One thread; CPU time.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <vector>

#include "shared/core/check.h"
#include "shared/core/median.h"
#include "shared/core/parallel.h"
#include "shared/core/random.h"
#include "shared/core/statistics.h"
#include "shared/vision/feature_scale_controller.h"
#include "shared/vision/features.h"
#include "shared/vision/localizer.h"
#include "shared/vision/scene_database.h"

namespace lararium::vision {
namespace {

constexpr size_t kSizes[] = {10'000, 100'000, 1'000'000};
constexpr double kDescriptorNoise = 10.0;  // Standard deviation of a component.
constexpr int kFeatureBudget = 1000;

void AddPoint(const SceneDatabase& from, uint32_t point, SceneDatabase& to) {
  to.points.push_back(from.points[point]);
  to.normals.push_back(from.normals[point]);
  to.observation_counts.push_back(from.observation_counts[point]);
  to.session_masks.push_back(from.session_masks[point]);
}

void AddDescriptor(const Descriptor& descriptor, SceneDatabase& to) {
  to.descriptors.push_back(descriptor);
  to.descriptor_point.push_back(static_cast<uint32_t>(to.points.size() - 1));
}

// The points with the most observations.
SceneDatabase Reduced(const SceneDatabase& map, size_t count) {
  std::vector<uint32_t> order(map.points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return map.observation_counts[a] > map.observation_counts[b];
  });
  order.resize(std::min(count, order.size()));
  SceneDatabase reduced;
  reduced.camera = map.camera;
  reduced.keyframes = map.keyframes;
  std::vector<uint32_t> new_index(map.points.size(), UINT32_MAX);
  for (const uint32_t point : order) {
    new_index[point] = static_cast<uint32_t>(reduced.points.size());
    reduced.descriptor_begin.push_back(static_cast<uint32_t>(reduced.descriptors.size()));
    AddPoint(map, point, reduced);
    for (uint32_t d = map.descriptor_begin[point]; d < map.descriptor_begin[point + 1]; ++d) {
      AddDescriptor(map.descriptors[d], reduced);
    }
  }
  reduced.descriptor_begin.push_back(static_cast<uint32_t>(reduced.descriptors.size()));
  for (Observation o : map.observations) {
    if (new_index[o.point] != UINT32_MAX) {
      o.point = new_index[o.point];
      reduced.observations.push_back(o);
    }
  }
  return reduced;
}

Descriptor Mixture(const Descriptor& a, const Descriptor& b, Random& random) {
  const double share = random.Uniform();
  std::array<double, kDescriptorSize> values;
  double square = 0.0;
  for (int k = 0; k < kDescriptorSize; ++k) {
    values[k] =
        std::max(share * a[k] + (1.0 - share) * b[k] + kDescriptorNoise * random.Normal(), 0.0);
    square += values[k] * values[k];
  }
  Descriptor mixture;
  for (int k = 0; k < kDescriptorSize; ++k) {
    mixture[k] = static_cast<uint8_t>(std::min(values[k] * 512.0 / std::sqrt(square), 255.0));
  }
  return mixture;
}

// Places rooms on a square grid, each as large as the map's room and with its keyframes.
SceneDatabase Grown(const SceneDatabase& map, size_t count) {
  SceneDatabase grown = map;
  const size_t own = map.points.size();
  std::vector<const Observation*> observation(own, nullptr);
  for (const Observation& o : map.observations) {
    observation[o.point] = &o;
  }
  // Ignore the few points that are far away.
  std::vector<float> extents;
  const Eigen::Vector3f centre = map.points[0];
  for (const Eigen::Vector3f& point : map.points) {
    extents.push_back((point - centre).norm());
  }
  std::nth_element(extents.begin(), extents.begin() + extents.size() * 95 / 100, extents.end());
  const float pitch = 2.0f * extents[extents.size() * 95 / 100];
  Random random(1);
  const auto any = [&] {
    return map.descriptors[random.Below(static_cast<uint32_t>(map.descriptors.size()))];
  };
  grown.descriptor_begin.pop_back();
  for (size_t room = 1; grown.points.size() < count; ++room) {
    const Eigen::Vector3f offset(pitch * static_cast<float>(room % 10), 0.0f,
                                 pitch * static_cast<float>(room / 10));
    const auto first_keyframe = static_cast<uint32_t>(grown.keyframes.size());
    for (const Keyframe& keyframe : map.keyframes) {
      Keyframe& copy = grown.keyframes.emplace_back();
      const geometry::Rigid3& pose = keyframe.camera_from_map;
      copy.camera_from_map = {pose.rotation,
                              pose.translation - pose.rotation * offset.cast<double>()};
    }
    for (uint32_t point = 0; point < own && grown.points.size() < count; ++point) {
      grown.descriptor_begin.push_back(static_cast<uint32_t>(grown.descriptors.size()));
      AddPoint(map, point, grown);
      grown.points.back() += offset;
      for (uint32_t d = map.descriptor_begin[point]; d < map.descriptor_begin[point + 1]; ++d) {
        AddDescriptor(Mixture(any(), any(), random), grown);
      }
      if (observation[point] != nullptr) {
        Observation o = *observation[point];
        o.point = static_cast<uint32_t>(grown.points.size() - 1);
        o.keyframe += first_keyframe;
        grown.observations.push_back(o);
      }
    }
  }
  grown.descriptor_begin.push_back(static_cast<uint32_t>(grown.descriptors.size()));
  return grown;
}

struct Cost {
  double build_ms = 0.0;   // Building the forest.
  double first_ms = 0.0;   // Median of features and location.
  double locate_ms = 0.0;  // Median of location alone.
  double tracked = 0.0;    // Share of the frames with a pose.
};

Cost Measure(SceneDatabase& map, const std::vector<cv::Mat>& frames) {
  Cost cost;
  const double start = ThreadCpuMilliseconds();
  map.forest = BuildForest(map.descriptors, {});
  cost.build_ms = ThreadCpuMilliseconds() - start;
  Localizer localizer(map, {});
  FeatureExtractor extractor;
  const FeatureOptions options = FeatureScaleController(kFeatureBudget).options();
  Features features;
  std::vector<double> first_ms;
  std::vector<double> locate_ms;
  size_t tracked = 0;
  for (const cv::Mat& frame : frames) {
    const double before = ThreadCpuMilliseconds();
    CHECK(extractor.Extract(frame, options, features).ok());
    const double middle = ThreadCpuMilliseconds();
    tracked += localizer.Locate(features, map.camera).camera_from_map ? 1 : 0;
    const double after = ThreadCpuMilliseconds();
    first_ms.push_back(after - before);
    locate_ms.push_back(after - middle);
  }
  cost.first_ms = Median(first_ms);
  cost.locate_ms = Median(locate_ms);
  cost.tracked = static_cast<double>(tracked) / static_cast<double>(frames.size());
  return cost;
}

std::vector<cv::Mat> Frames(const char* video, int step) {
  cv::VideoCapture capture(video);
  std::vector<cv::Mat> frames;
  cv::Mat bgr;
  for (int i = 0; capture.read(bgr); ++i) {
    if (i % step == 0) {
      cv::cvtColor(bgr, frames.emplace_back(), cv::COLOR_BGR2GRAY);
    }
  }
  return frames;
}

int Main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: lararium_map_growth MAP.larscene VIDEO [STEP]\n");
    return 2;
  }
  const ThreadLimit limit(1);
  const Result<SceneDatabase> map = LoadSceneDatabase(argv[1]);
  if (!map.ok()) {
    std::fprintf(stderr, "%s\n", map.message().c_str());
    return 2;
  }
  const std::vector<cv::Mat> frames = Frames(argv[2], argc > 3 ? std::max(atoi(argv[3]), 1) : 1);
  if (frames.empty() || map->points.empty()) {
    std::fprintf(stderr, "%s: holds no frame, or the map no point\n", argv[2]);
    return 2;
  }
  const SceneDatabase base = Reduced(*map, kSizes[0]);
  std::printf("%9s %11s %9s %10s %11s %8s %6s\n", "points", "descriptors", "tracked", "locate ms",
              "first pose", "ratio", "build");
  double smallest = 0.0;
  for (const size_t size : kSizes) {
    SceneDatabase grown = Grown(base, size);
    const Cost cost = Measure(grown, frames);
    smallest = smallest > 0.0 ? smallest : cost.first_ms;
    std::printf("%9zu %11zu %8.1f%% %10.2f %8.2f ms %8.2f %4.1f s\n", grown.points.size(),
                grown.descriptors.size(), 100.0 * cost.tracked, cost.locate_ms, cost.first_ms,
                cost.first_ms / smallest, cost.build_ms / 1000.0);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace lararium::vision

int main(int argc, char** argv) { return lararium::vision::Main(argc, argv); }
