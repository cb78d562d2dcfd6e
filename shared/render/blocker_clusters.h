#pragma once

// Balls that keep light off real surfaces, gathered in clusters: far from a cluster one
// ball stands for it. After the sphere hierarchies of Ren et al., "Real-time Soft Shadows
// in Dynamic Scenes using Spherical Harmonic Exponentiation", SIGGRAPH 2006. Private to
// render.

#include <array>
#include <cstddef>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "shared/render/screen_bounds.h"

namespace lararium::render {

// As shaders/pass/sky_ratio.frag takes it; within the smallest uniform block that every
// driver has, 16 KiB.
struct BlockerBlock {
  static constexpr size_t kMaxBalls = 512;
  static constexpr size_t kMaxClusters = 128;

  struct Cluster {
    glm::vec4 merged = glm::vec4(0.0f);  // one ball for all: centre, radius
    // Radius of a ball about the same centre that holds all, first ball, end of balls, 0.
    glm::vec4 extent = glm::vec4(0.0f);
  };
  std::array<Cluster, kMaxClusters> clusters;
  std::array<glm::vec4, kMaxBalls> balls;
};

// Kept from frame to frame so that nothing is allocated.
class BlockerClusters {
 public:
  // Balls without a radius, or with numbers that are not finite, are left out. Where there
  // are more than fit, neighbours are merged.
  void Build(std::span<const glm::vec4> balls);

  const BlockerBlock& block() const { return block_; }
  int cluster_count() const { return cluster_count_; }
  // Outside of this nothing is darkened that could be seen.
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

// The share of a hemisphere's middle that a ball may hide and still be left out: (radius /
// distance)^2.
inline constexpr float kLeastBlockedShare = 1.0e-3f;

}  // namespace lararium::render
