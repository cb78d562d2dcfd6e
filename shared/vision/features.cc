#include "shared/vision/features.h"

#include <algorithm>
#include <functional>

#include "shared/core/parallel.h"
#include "shared/vision/extrema.h"
#include "shared/vision/orientation.h"
#include "shared/vision/scale_space.h"
#include "shared/vision/sift_descriptor.h"

namespace lararium::vision {
namespace {

constexpr int kMaxImageSide = 16384;  // pixels
constexpr size_t kKeypointsPerJob = 32;

size_t JobCount(size_t keypoints) { return (keypoints + kKeypointsPerJob - 1) / kKeypointsPerJob; }

// Keeps the `count` items of strongest response in their order. `responses` is working memory.
template <typename T, typename Response>
void KeepStrongest(std::vector<T>& items,
                   int count,
                   std::vector<float>& responses,
                   Response response) {
  if (count <= 0 || items.size() <= static_cast<size_t>(count)) {
    return;
  }
  responses.resize(items.size());
  std::transform(items.begin(), items.end(), responses.begin(), response);
  const auto nth = responses.begin() + (count - 1);
  std::nth_element(responses.begin(), nth, responses.end(), std::greater<>());
  const float least = *nth;
  const auto stronger = [&](const T& item) { return response(item) > least; };
  auto ties = count - std::count_if(items.begin(), items.end(), stronger);
  std::erase_if(items, [&](const T& item) {
    return !stronger(item) && (response(item) < least || ties-- <= 0);
  });
}

Keypoint ToKeypoint(const Octave& octave, const OrientedExtremum& oriented) {
  const Extremum& e = oriented.extremum;
  return {octave.pixel_size * e.x + octave.origin, octave.pixel_size * e.y + octave.origin,
          octave.pixel_size * e.sigma, oriented.angle, e.response};
}

}  // namespace

Status FeatureOptions::Validate() const {
  constexpr std::string_view kPlace = "feature options";
  if (first_octave < -1 || first_octave > 6) {
    return Status::Error(kPlace, "first_octave must lie between -1 and 6");
  }
  if (scales_per_octave < 1 || scales_per_octave > 16) {
    return Status::Error(kPlace, "scales_per_octave must lie between 1 and 16");
  }
  if (!(contrast_threshold >= 0.0f && contrast_threshold <= 1.0f)) {
    return Status::Error(kPlace, "contrast_threshold must lie between 0 and 1");
  }
  if (!(edge_threshold >= 1.0f && edge_threshold <= 1e6f)) {
    return Status::Error(kPlace, "edge_threshold must be at least 1");
  }
  if (max_features < 0) {
    return Status::Error(kPlace, "max_features must not be negative");
  }
  return Status();
}

// Working memory of the extraction: the scale space, and lists that keep their capacity.
struct FeatureExtractor::Memory {
  struct Job {
    OrientationMemory orientation;
    DescriptorMemory descriptor;
    std::vector<OrientedExtremum> oriented;
  };

  ScaleSpace scale_space;
  ExtremaFinder extrema_finder;
  std::vector<Extremum> extrema;
  std::vector<OrientedExtremum> oriented;
  std::vector<Job> jobs;
  std::vector<float> responses;

  void Orient();
  void DescribeAll(Features& features);
};

void FeatureExtractor::Memory::Orient() {
  const size_t count = JobCount(extrema.size());
  jobs.resize(std::max(jobs.size(), count));
  ParallelFor(count, [&](size_t j) {
    Job& job = jobs[j];
    job.oriented.clear();
    const size_t end = std::min((j + 1) * kKeypointsPerJob, extrema.size());
    for (size_t i = j * kKeypointsPerJob; i < end; ++i) {
      const Extremum& e = extrema[i];
      const cv::Mat& image = scale_space.octaves()[e.octave].gaussians[e.level];
      AddOrientations(image, e, job.orientation, job.oriented);
    }
  });
  oriented.clear();
  for (size_t j = 0; j < count; ++j) {
    oriented.insert(oriented.end(), jobs[j].oriented.begin(), jobs[j].oriented.end());
  }
}

void FeatureExtractor::Memory::DescribeAll(Features& features) {
  features.keypoints.resize(oriented.size());
  features.descriptors.resize(oriented.size());
  const size_t count = JobCount(oriented.size());
  jobs.resize(std::max(jobs.size(), count));
  ParallelFor(count, [&](size_t j) {
    const size_t end = std::min((j + 1) * kKeypointsPerJob, oriented.size());
    for (size_t i = j * kKeypointsPerJob; i < end; ++i) {
      const Octave& octave = scale_space.octaves()[oriented[i].extremum.octave];
      const cv::Mat& image = octave.gaussians[oriented[i].extremum.level];
      features.keypoints[i] = ToKeypoint(octave, oriented[i]);
      features.descriptors[i] = Describe(image, oriented[i], jobs[j].descriptor);
    }
  });
}

FeatureExtractor::FeatureExtractor() : memory_(std::make_unique<Memory>()) {}
FeatureExtractor::~FeatureExtractor() = default;

Status FeatureExtractor::Extract(const cv::Mat& grey,
                                 const FeatureOptions& options,
                                 Features& features) {
  LARARIUM_RETURN_IF_ERROR(options.Validate());
  if (grey.empty() || grey.type() != CV_8UC1) {
    return Status::Error("image for features", "must be grey with 8 bits for each pixel");
  }
  if (grey.cols > kMaxImageSide || grey.rows > kMaxImageSide) {
    return Status::Error("image for features", "is larger than 16384 pixels", "reduce it first");
  }
  Memory& m = *memory_;
  m.scale_space.Build(grey, options.first_octave, options.scales_per_octave);
  m.extrema_finder.Find(m.scale_space.octaves(), options, m.extrema);
  // Every extremum has at least one orientation, so max_features extrema are enough.
  KeepStrongest(m.extrema, options.max_features, m.responses,
                [](const Extremum& e) { return e.response; });
  m.Orient();
  KeepStrongest(m.oriented, options.max_features, m.responses,
                [](const OrientedExtremum& o) { return o.extremum.response; });
  m.DescribeAll(features);
  return Status();
}

Result<Features> ExtractFeatures(const cv::Mat& grey, const FeatureOptions& options) {
  Features features;
  LARARIUM_RETURN_IF_ERROR(FeatureExtractor().Extract(grey, options, features));
  return features;
}

}  // namespace lararium::vision
