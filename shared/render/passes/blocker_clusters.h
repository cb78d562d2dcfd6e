#pragma once

// Groups the balls that block light from real surfaces into clusters; far from a cluster a single
// ball represents it. After the sphere hierarchies of Ren et al., "Real-time Soft Shadows in
// Dynamic Scenes using Spherical Harmonic Exponentiation", SIGGRAPH 2006. Private to render.

#include <array>
#include <cstddef>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "shared/render/passes/screen_bounds.h"

namespace lararium::render {

// Memory layout of the uniform block in shaders/pass/sky_ratio.frag. It fits into 16 KiB, the
// block size that every driver supports.
struct BlockerBlock {
  static constexpr size_t kMaxBalls = 512;
  static constexpr size_t kMaxClusters = 128;

  struct Cluster {
    glm::vec4 merged = glm::vec4(0.0f);  // ball that represents the cluster: centre, radius
    // Radius of the ball about the same centre that encloses all balls; index of the first ball;
    // index after the last ball; 0.
    glm::vec4 extent = glm::vec4(0.0f);
  };
  std::array<Cluster, kMaxClusters> clusters;
  std::array<glm::vec4, kMaxBalls> balls;
};

// Keep one object from frame to frame, so that its memory is reused.
class BlockerClusters {
 public:
  // Balls without a radius, or with values that are not finite, are skipped. If there are more
  // than kMaxBalls, neighbours are merged.
  void Build(std::span<const glm::vec4> balls);

  const BlockerBlock& block() const { return block_; }
  int cluster_count() const { return cluster_count_; }
  // Outside of this box the balls darken nothing visibly.
  const Box& reach() const { return reach_; }

 private:
  void Reduce();
  void AddCluster(std::span<const glm::vec4> balls);

  BlockerBlock block_;
  int cluster_count_ = 0;
  size_t ball_count_ = 0;
  Box reach_;
  std::vector<glm::vec4> sorted_;
  std::vector<glm::vec4> reduced_;
};

// A ball is ignored if it blocks less than this share of a surface's light when it stands straight
// above it: (radius / distance)^2.
inline constexpr float kLeastBlockedShare = 1.0e-3f;

}  // namespace lararium::render
