#pragma once

// Randomised k-d trees over descriptors, searched best bin first: Beis & Lowe,
// "Shape indexing using approximate nearest-neighbour search in
// high-dimensional spaces", CVPR 1997; Silpa-Anan & Hartley, "Optimised
// KD-trees for fast image descriptor matching", CVPR 2008. The trees are flat arrays, so that the
// scene database can store them as they are.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "shared/core/status.h"
#include "shared/vision/features.h"

namespace lararium::vision {

// In an inner node, descriptors with [dimension] < threshold are in the left subtree. A leaf
// (dimension == kLeaf) holds the descriptors order[first, first + count).
struct ForestNode {
  static constexpr uint16_t kLeaf = 0xffff;
  uint16_t dimension = kLeaf;
  uint16_t threshold = 0;
  uint32_t first = 0;  // Inner node: index of the left child; the right child is the next node.
  uint32_t count = 0;  // Leaf: number of descriptors.
};

struct DescriptorForest {
  std::vector<uint32_t> roots;  // one for each tree
  std::vector<ForestNode> nodes;
  std::vector<uint32_t> order;  // descriptor indices, grouped by leaf

  // Checks that every index is in range for descriptor_count descriptors and that there are no
  // cycles.
  Status Validate(size_t descriptor_count) const;
};

struct ForestOptions {
  int trees = 4;      // Trees searched together. More trees raise recall and use more memory.
  int leaf_size = 8;  // Maximum number of descriptors in a leaf.
  uint64_t seed = 1;
};

// Deterministic: the same descriptors and options give the same forest. Without descriptors the
// forest is empty.
DescriptorForest BuildForest(std::span<const Descriptor> descriptors, const ForestOptions& options);

struct Neighbour {
  uint32_t descriptor = 0;  // Index of the descriptor.
  uint32_t squared_distance = 0;
};

// Searches a forest. Holds a few kilobytes of working memory, independent of the forest's size.
// Use one searcher per thread.
class ForestSearcher {
 public:
  // The forest and the descriptors must outlive the searcher.
  ForestSearcher(const DescriptorForest& forest, std::span<const Descriptor> descriptors);

  // Finds the found.size() nearest neighbours, nearest first, among at most max_checks descriptors.
  // Returns how many were found. Allocates nothing in steady state.
  size_t Search(const Descriptor& query, int max_checks, std::span<Neighbour> found);

 private:
  struct Branch {
    uint32_t node;
    uint32_t squared_distance;
  };
  // In a large forest nearly every step waits for memory. Several branches are therefore descended
  // in turns: while one waits for its prefetch, the others take a step.
  static constexpr size_t kTogether = 4;
  // Hash table slots in seen_ per descriptor that may be checked.
  static constexpr size_t kSlots = 4;

  void Restart(int max_checks);
  // Descends from the branches to leaves and pushes the other child of every node on the heap.
  void Descend(std::span<Branch> branches, const Descriptor& query);
  void Gather(const ForestNode& leaf);
  void LookAtGathered(const Descriptor& query);
  // Returns whether this search meets the descriptor for the first time.
  bool MarkSeen(uint32_t descriptor);
  void Insert(Neighbour neighbour);

  const DescriptorForest& forest_;
  std::span<const Descriptor> descriptors_;
  std::vector<Branch> heap_;
  std::vector<uint32_t> gathered_;  // Descriptors whose distance is computed next.
  // Hash table with open addressing. An entry is a descriptor and the search that met it.
  std::vector<std::pair<uint32_t, uint32_t>> seen_;
  uint32_t search_ = 0;         // Number of the current search.
  std::span<Neighbour> found_;  // Output of the current search.
  size_t count_ = 0;
  int checks_left_ = 0;
};

// Squared Euclidean distance in units of the descriptors' bytes.
uint32_t SquaredDistance(const Descriptor& a, const Descriptor& b);

}  // namespace lararium::vision
