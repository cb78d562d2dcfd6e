#include "editor/train/pair_selection.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>

#include "editor/train/matching.h"
#include "shared/core/parallel.h"
#include "shared/core/random.h"

namespace lararium::train {
namespace {

using vision::Descriptor;
using vision::Features;
using vision::kDescriptorSize;

constexpr size_t kCenters = 64;
constexpr size_t kSampleSize = 30'000;  // Descriptors from which the centers are learnt.
constexpr int kVladIterations = 8;
constexpr size_t kPerImage = 1000;  // Number of strongest features that describe an image.

std::vector<Descriptor> Gather(const Features& features, size_t count) {
  std::vector<Descriptor> chosen;
  for (const uint32_t i : StrongestFeatures(features, count)) {
    chosen.push_back(features.descriptors[i]);
  }
  return chosen;
}

// k-means by Lloyd's algorithm, starting from random descriptors.
std::vector<Descriptor> LearnCenters(std::span<const Descriptor> sample, uint64_t seed) {
  Random random(seed);
  std::vector<Descriptor> centers;
  for (size_t k = 0; k < kCenters; ++k) {
    centers.push_back(sample[random.Below(static_cast<uint32_t>(sample.size()))]);
  }
  for (int iteration = 0; iteration < kVladIterations; ++iteration) {
    const std::vector<uint32_t> nearest = NearestCenters(sample, centers);
    std::vector<std::array<uint32_t, kDescriptorSize>> sums(kCenters);
    std::vector<uint32_t> counts(kCenters);
    for (size_t i = 0; i < sample.size(); ++i) {
      ++counts[nearest[i]];
      for (int d = 0; d < kDescriptorSize; ++d) {
        sums[nearest[i]][d] += sample[i][d];
      }
    }
    for (size_t k = 0; k < kCenters; ++k) {
      for (int d = 0; d < kDescriptorSize && counts[k] > 0; ++d) {
        centers[k][d] = static_cast<uint8_t>((sums[k][d] + counts[k] / 2) / counts[k]);
      }
    }
  }
  return centers;
}

// VLAD vector: the sum of the residuals to each center is normalised, then the whole vector.
Eigen::VectorXf Aggregate(std::span<const Descriptor> descriptors,
                          std::span<const Descriptor> centers) {
  const std::vector<uint32_t> nearest = NearestCenters(descriptors, centers);
  Eigen::VectorXf vector = Eigen::VectorXf::Zero(kCenters * kDescriptorSize);
  for (size_t i = 0; i < descriptors.size(); ++i) {
    const Descriptor& center = centers[nearest[i]];
    float* sum = vector.data() + nearest[i] * kDescriptorSize;
    for (int d = 0; d < kDescriptorSize; ++d) {
      sum[d] += static_cast<float>(descriptors[i][d]) - static_cast<float>(center[d]);
    }
  }
  for (size_t k = 0; k < kCenters; ++k) {
    vector.segment<kDescriptorSize>(static_cast<Eigen::Index>(k) * kDescriptorSize)
        .stableNormalize();
  }
  vector.stableNormalize();
  return vector;
}

std::vector<Eigen::VectorXf> DescribeImages(std::span<const Features> images, uint64_t seed) {
  std::vector<std::vector<Descriptor>> chosen(images.size());
  ParallelFor(images.size(), [&](size_t i) { chosen[i] = Gather(images[i], kPerImage); });
  size_t total = 0;
  for (const auto& descriptors : chosen) {
    total += descriptors.size();
  }
  const size_t stride = total / kSampleSize + 1;
  std::vector<Descriptor> sample;
  size_t counter = 0;
  for (const auto& descriptors : chosen) {
    for (const Descriptor& descriptor : descriptors) {
      if (counter++ % stride == 0) {
        sample.push_back(descriptor);
      }
    }
  }
  std::vector<Eigen::VectorXf> vectors(images.size());
  if (!sample.empty()) {
    const std::vector<Descriptor> centers = LearnCenters(sample, seed);
    ParallelFor(images.size(), [&](size_t i) { vectors[i] = Aggregate(chosen[i], centers); });
  }
  return vectors;
}

// [i]: The other images, the most similar to image i first.
using Rankings = std::vector<std::vector<uint32_t>>;

Rankings RankByAppearance(std::span<const Features> images, uint64_t seed) {
  const std::vector<Eigen::VectorXf> vectors = DescribeImages(images, seed);
  const auto count = static_cast<uint32_t>(images.size());
  Rankings rankings(count);
  ParallelFor(count, [&](size_t i) {
    std::vector<std::pair<float, uint32_t>> others;
    for (uint32_t j = 0; j < count; ++j) {
      if (j != i && vectors[i].size() == vectors[j].size()) {
        others.emplace_back(-vectors[i].dot(vectors[j]), j);
      }
    }
    std::sort(others.begin(), others.end());
    for (const auto& [dissimilarity, j] : others) {
      rankings[i].push_back(j);
    }
  });
  return rankings;
}

uint32_t Gap(uint32_t i, uint32_t j) { return i > j ? i - j : j - i; }

// Returns whether most images look like the next one, as in a video, unlike unordered photographs.
bool Ordered(const Rankings& rankings) {
  size_t alike = 0;
  for (uint32_t i = 0; i + 1 < rankings.size(); ++i) {
    const std::vector<uint32_t>& ranking = rankings[i];
    const auto next = std::find(ranking.begin(), ranking.end(), i + 1);
    alike += 5 * static_cast<size_t>(next - ranking.begin()) < ranking.size() ? 1 : 0;
  }
  return 3 * alike >= 2 * rankings.size();
}

// The first `count` images of the ranking whose index differs from that of image by more than
// beyond and from each other by at least apart.
std::vector<uint32_t> ChooseSimilar(uint32_t image,
                                    std::span<const uint32_t> ranking,
                                    uint32_t beyond,
                                    uint32_t apart,
                                    size_t count) {
  std::vector<uint32_t> chosen;
  for (const uint32_t candidate : ranking) {
    if (chosen.size() == count) {
      break;
    }
    if (Gap(image, candidate) > beyond &&
        std::none_of(chosen.begin(), chosen.end(),
                     [&](uint32_t other) { return Gap(candidate, other) < apart; })) {
      chosen.push_back(candidate);
    }
  }
  return chosen;
}

}  // namespace

PairSelection SelectPairs(std::span<const Features> images, const PairOptions& options) {
  const auto count = static_cast<uint32_t>(images.size());
  const Rankings rankings = RankByAppearance(images, options.seed);
  const bool ordered = Ordered(rankings);
  std::vector<ImagePair> pairs;
  const auto add = [&](uint32_t i, uint32_t j) {
    pairs.push_back({std::min(i, j), std::max(i, j)});
  };
  if (count <= options.exhaustive_up_to) {
    for (uint32_t i = 0; i < count; ++i) {
      for (uint32_t j = i + 1; j < count; ++j) {
        add(i, j);
      }
    }
    return {std::move(pairs), ordered};
  }
  for (uint32_t i = 0; i < count; ++i) {
    if (!ordered) {
      for (const uint32_t j : ChooseSimilar(i, rankings[i], 0, 0, options.similar_unordered)) {
        add(i, j);
      }
      continue;
    }
    for (const uint32_t gap : options.gaps) {
      if (i + gap < count) {
        add(i, i + gap);
      }
    }
    for (const uint32_t j :
         ChooseSimilar(i, rankings[i], options.gaps.back(), options.apart, options.similar)) {
      add(i, j);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return {std::move(pairs), ordered};
}

}  // namespace lararium::train
