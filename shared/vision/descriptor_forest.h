#pragma once

// Randomised k-d trees over descriptors, searched best bin first: Beis & Lowe,
// "Shape indexing using approximate nearest-neighbour search in
// high-dimensional spaces", CVPR 1997; Silpa-Anan & Hartley, "Optimised
// KD-trees for fast image descriptor matching", CVPR 2008. A flat array, so that
// it is stored in the scene database and used where it lies.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "shared/core/status.h"
#include "shared/vision/features.h"

namespace lararium::vision {

// Inner node: descriptors with [dimension] < threshold lie to the left. Leaf
// (dimension == kLeaf): order[first, first + count).
struct ForestNode {
  static constexpr uint16_t kLeaf = 0xffff;
  uint16_t dimension = kLeaf;
  uint16_t threshold = 0;
  uint32_t first = 0;  // inner: index of the left child, the right one follows it
  uint32_t count = 0;  // leaf: number of descriptors
};

struct DescriptorForest {
  std::vector<uint32_t> roots;  // one for each tree
  std::vector<ForestNode> nodes;
  std::vector<uint32_t> order;  // descriptor indices, grouped by leaf

  // Every index in range, no cycles, for a forest over descriptor_count descriptors.
  Status Validate(size_t descriptor_count) const;
};

struct ForestOptions {
  int trees = 4;      // searched together: more of them find more, and take more memory
  int leaf_size = 8;  // the most descriptors of a leaf
  uint64_t seed = 1;
};

// The same descriptors and options give the same forest. Without descriptors it is empty.
DescriptorForest BuildForest(std::span<const Descriptor> descriptors, const ForestOptions& options);

struct Neighbour {
  uint32_t descriptor = 0;  // its index
  uint32_t squared_distance = 0;
};

// Working memory of searches, a few kilobytes whatever the forest's size; keep
// one for each thread.
class ForestSearcher {
 public:
  // Borrows both for its life.
  ForestSearcher(const DescriptorForest& forest, std::span<const Descriptor> descriptors);

  // The found.size() nearest neighbours, nearest first, after looking at up to
  // max_checks descriptors. Returns how many were found. Allocates nothing in
  // steady state.
  size_t Search(const Descriptor& query, int max_checks, std::span<Neighbour> found);

 private:
  struct Branch {
    uint32_t node;
    uint32_t squared_distance;
  };
  // In a large forest nearly every step waits for memory, so several branches
  // are followed at a time, each a step while the others wait.
  static constexpr size_t kTogether = 4;
  // Slots of seen_ for each descriptor that may be looked at.
  static constexpr size_t kSlots = 4;

  void Restart(int max_checks);
  // Walks from the branches to leaves, leaving what lies beside on the heap.
  void Descend(std::span<Branch> branches, const Descriptor& query);
  void Gather(const ForestNode& leaf);
  void LookAtGathered(const Descriptor& query);
  // Whether this search meets the descriptor for the first time.
  bool MarkSeen(uint32_t descriptor);
  void Insert(Neighbour neighbour);

  const DescriptorForest& forest_;
  std::span<const Descriptor> descriptors_;
  std::vector<Branch> heap_;
  std::vector<uint32_t> gathered_;  // descriptors to look at
  // A hash table with open addresses: descriptor, number of the search.
  std::vector<std::pair<uint32_t, uint32_t>> seen_;
  uint32_t search_ = 0;
  std::span<Neighbour> found_;  // of the search at hand
  size_t count_ = 0;
  int checks_left_ = 0;
};

// Euclidean, in units of the descriptors' bytes.
uint32_t SquaredDistance(const Descriptor& a, const Descriptor& b);

}  // namespace lararium::vision
