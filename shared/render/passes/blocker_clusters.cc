#include "shared/render/passes/blocker_clusters.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace lararium::render {
namespace {

constexpr size_t kLeaf = 8;
// This share of the discs of neighbouring balls does not overlap.
constexpr float kSeenShare = 0.8f;

bool Blocks(const glm::vec4& ball) { return std::isfinite(glm::dot(ball, ball)) && ball.w > 0.0f; }

int WidestAxis(std::span<const glm::vec4> balls) {
  Box box;
  for (const glm::vec4& ball : balls) {
    box.Extend(glm::vec3(ball));
  }
  const glm::vec3 size = box.high - box.low;
  if (size.y >= size.x && size.y >= size.z) {
    return 1;
  }
  return size.x >= size.z ? 0 : 2;
}

// Splits balls at the median of their widest axis until each group has at most `leaf` of them.
template <typename Visit>
void SplitBalls(std::span<glm::vec4> balls, size_t leaf, const Visit& visit) {
  if (balls.size() <= leaf) {
    if (!balls.empty()) {
      visit(balls);
    }
    return;
  }
  const int axis = WidestAxis(balls);
  const size_t half = balls.size() / 2;
  std::nth_element(balls.begin(), balls.begin() + static_cast<std::ptrdiff_t>(half), balls.end(),
                   [axis](const glm::vec4& a, const glm::vec4& b) { return a[axis] < b[axis]; });
  SplitBalls(balls.first(half), leaf, visit);
  SplitBalls(balls.subspan(half), leaf, visit);
}

glm::vec4 Merge(std::span<const glm::vec4> balls) {
  glm::vec3 centre(0.0f);
  float area = 0.0f;
  for (const glm::vec4& ball : balls) {
    centre += ball.w * ball.w * glm::vec3(ball);
    area += ball.w * ball.w;
  }
  const float seen = balls.size() > 1 ? kSeenShare : 1.0f;
  return {centre / area, std::sqrt(seen * area)};
}

}  // namespace

void BlockerClusters::Build(std::span<const glm::vec4> balls) {
  sorted_.clear();
  std::copy_if(balls.begin(), balls.end(), std::back_inserter(sorted_), Blocks);
  cluster_count_ = 0;
  ball_count_ = 0;
  reach_ = {};
  if (sorted_.size() > BlockerBlock::kMaxBalls) {
    Reduce();
  }
  SplitBalls(std::span(sorted_), kLeaf,
             [this](std::span<const glm::vec4> cluster) { AddCluster(cluster); });
}

// Merges balls until they fit. Splitting leaves groups of at least half the leaf's size.
void BlockerClusters::Reduce() {
  constexpr size_t kHalf = BlockerBlock::kMaxBalls / 2;
  reduced_.clear();
  SplitBalls(std::span(sorted_), (sorted_.size() + kHalf - 1) / kHalf,
             [this](std::span<const glm::vec4> near) { reduced_.push_back(Merge(near)); });
  sorted_.swap(reduced_);
}

void BlockerClusters::AddCluster(std::span<const glm::vec4> balls) {
  BlockerBlock::Cluster& cluster = block_.clusters[static_cast<size_t>(cluster_count_++)];
  cluster.merged = Merge(balls);
  float extent = 0.0f;
  for (const glm::vec4& ball : balls) {
    extent = std::max(extent, glm::distance(glm::vec3(ball), glm::vec3(cluster.merged)) + ball.w);
  }
  const auto first = static_cast<float>(ball_count_);
  std::copy(balls.begin(), balls.end(), block_.balls.begin() + static_cast<long>(ball_count_));
  ball_count_ += balls.size();
  cluster.extent = {extent, first, static_cast<float>(ball_count_), 0.0f};
  const float reach = cluster.merged.w / std::sqrt(kLeastBlockedShare);
  reach_.Extend(glm::vec3(cluster.merged) - reach);
  reach_.Extend(glm::vec3(cluster.merged) + reach);
}

}  // namespace lararium::render
