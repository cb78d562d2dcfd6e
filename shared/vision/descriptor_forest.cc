#include "shared/vision/descriptor_forest.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "shared/core/check.h"
#include "shared/core/parallel.h"
#include "shared/core/random.h"

namespace lararium::vision {
namespace {

// ------------------------------------------------------------ building

constexpr size_t kVarianceSample = 128;  // Number of descriptors sampled to choose a split.
constexpr int kSplitCandidates = 5;      // Number of dimensions of largest variance to draw from.

struct Moments {
  std::array<uint32_t, kDescriptorSize> mean{};      // Mean times count.
  std::array<uint64_t, kDescriptorSize> variance{};  // Variance times count^2.
  uint64_t count = 0;
};

Moments MomentsOf(std::span<const uint32_t> order, std::span<const Descriptor> descriptors) {
  Moments m;
  m.count = std::min(order.size(), kVarianceSample);
  std::array<uint32_t, kDescriptorSize> squares{};
  for (size_t i = 0; i < m.count; ++i) {
    const Descriptor& d = descriptors[order[i * order.size() / m.count]];
    for (int k = 0; k < kDescriptorSize; ++k) {
      m.mean[k] += d[k];
      squares[k] += static_cast<uint32_t>(d[k]) * d[k];
    }
  }
  for (int k = 0; k < kDescriptorSize; ++k) {
    m.variance[k] = m.count * squares[k] - static_cast<uint64_t>(m.mean[k]) * m.mean[k];
  }
  return m;
}

// Grows one tree depth first. The two children of a node are adjacent.
class TreeBuilder {
 public:
  TreeBuilder(std::span<const Descriptor> descriptors,
              int leaf_size,
              uint64_t seed,
              uint64_t stream)
      : descriptors_(descriptors), leaf_size_(leaf_size), random_(seed, stream) {
    order_.resize(descriptors.size());
    std::iota(order_.begin(), order_.end(), 0u);
  }

  void Build() {
    nodes_.push_back({ForestNode::kLeaf, 0, 0, static_cast<uint32_t>(order_.size())});
    std::vector<uint32_t> open = {0};
    while (!open.empty()) {
      const uint32_t node = open.back();
      open.pop_back();
      if (Split(node)) {
        open.push_back(nodes_[node].first);
        open.push_back(nodes_[node].first + 1);
      }
    }
  }

  const std::vector<ForestNode>& nodes() const { return nodes_; }
  const std::vector<uint32_t>& order() const { return order_; }

 private:
  // Turns a leaf into an inner node with two leaves. Returns false if it stays a leaf.
  bool Split(uint32_t index) {
    const ForestNode leaf = nodes_[index];
    if (leaf.count <= static_cast<uint32_t>(leaf_size_)) {
      return false;
    }
    const std::span<uint32_t> range(order_.data() + leaf.first, leaf.count);
    const Moments moments = MomentsOf(range, descriptors_);
    const int dimension = ChooseDimension(moments);
    if (moments.variance[dimension] == 0) {
      return false;  // All sampled descriptors are equal.
    }
    // The mean is rounded up, so that both sides get samples.
    const auto threshold =
        static_cast<uint16_t>((moments.mean[dimension] + moments.count - 1) / moments.count);
    const auto middle = std::partition(range.begin(), range.end(), [&](uint32_t d) {
      return descriptors_[d][dimension] < threshold;
    });
    const auto left = static_cast<uint32_t>(middle - range.begin());
    const auto child = static_cast<uint32_t>(nodes_.size());
    nodes_[index] = {static_cast<uint16_t>(dimension), threshold, child, 0};
    nodes_.push_back({ForestNode::kLeaf, 0, leaf.first, left});
    nodes_.push_back({ForestNode::kLeaf, 0, leaf.first + left, leaf.count - left});
    return true;
  }

  int ChooseDimension(const Moments& moments) {
    std::array<int, kDescriptorSize> dimensions;
    std::iota(dimensions.begin(), dimensions.end(), 0);
    std::partial_sort(dimensions.begin(), dimensions.begin() + kSplitCandidates, dimensions.end(),
                      [&](int a, int b) {
                        return moments.variance[a] != moments.variance[b]
                                   ? moments.variance[a] > moments.variance[b]
                                   : a < b;
                      });
    // Dimensions without variance cannot be split.
    uint32_t candidates = 1;
    while (candidates < kSplitCandidates && moments.variance[dimensions[candidates]] > 0) {
      ++candidates;
    }
    return dimensions[random_.Below(candidates)];
  }

  std::span<const Descriptor> descriptors_;
  int leaf_size_;
  Random random_;
  std::vector<ForestNode> nodes_;
  std::vector<uint32_t> order_;
};

constexpr std::string_view kPlace = "descriptor forest";

}  // namespace

DescriptorForest BuildForest(std::span<const Descriptor> descriptors,
                             const ForestOptions& options) {
  CHECK(options.trees > 0 && options.leaf_size > 0);
  CHECK(descriptors.size() * static_cast<size_t>(options.trees) < UINT32_MAX);
  DescriptorForest forest;
  if (descriptors.empty()) {
    return forest;
  }
  std::vector<TreeBuilder> builders;
  builders.reserve(options.trees);
  for (int t = 0; t < options.trees; ++t) {
    builders.emplace_back(descriptors, options.leaf_size, options.seed, t);
  }
  ParallelFor(builders.size(), [&](size_t t) { builders[t].Build(); });
  for (const TreeBuilder& builder : builders) {
    const auto first_node = static_cast<uint32_t>(forest.nodes.size());
    const auto first_order = static_cast<uint32_t>(forest.order.size());
    forest.roots.push_back(first_node);
    for (ForestNode node : builder.nodes()) {
      node.first += node.dimension == ForestNode::kLeaf ? first_order : first_node;
      forest.nodes.push_back(node);
    }
    forest.order.insert(forest.order.end(), builder.order().begin(), builder.order().end());
  }
  return forest;
}

Status DescriptorForest::Validate(size_t descriptor_count) const {
  const auto problem = [](std::string_view what) {
    return Status::Error(kPlace, what, "train the place again");
  };
  if (roots.empty() != (descriptor_count == 0)) {
    return problem("has no trees for the descriptors");
  }
  // Every node has at most one parent, which comes before it, so there are no cycles.
  std::vector<bool> has_parent(nodes.size(), false);
  for (const uint32_t root : roots) {
    if (root >= nodes.size() || has_parent[root]) {
      return problem("a root is out of range or used twice");
    }
    has_parent[root] = true;
  }
  for (size_t i = 0; i < nodes.size(); ++i) {
    const ForestNode& node = nodes[i];
    if (node.dimension == ForestNode::kLeaf) {
      if (node.first > order.size() || node.count > order.size() - node.first) {
        return problem("a leaf points outside the descriptors");
      }
      continue;
    }
    if (node.dimension >= kDescriptorSize) {
      return problem("a node splits a dimension that does not exist");
    }
    const size_t left = node.first;
    if (left <= i || left + 1 >= nodes.size() || has_parent[left] || has_parent[left + 1]) {
      return problem("a node's children are out of range or used twice");
    }
    has_parent[left] = true;
    has_parent[left + 1] = true;
  }
  if (std::any_of(order.begin(), order.end(), [&](uint32_t d) { return d >= descriptor_count; })) {
    return problem("a leaf names a descriptor that does not exist");
  }
  return Status();
}

// ------------------------------------------------------------ searching

ForestSearcher::ForestSearcher(const DescriptorForest& forest,
                               std::span<const Descriptor> descriptors)
    : forest_(forest), descriptors_(descriptors) {
  heap_.reserve(1024);
}

void ForestSearcher::Restart(int max_checks) {
  heap_.clear();
  gathered_.clear();
  count_ = 0;
  checks_left_ = max_checks;
  const size_t wanted = std::bit_ceil(kSlots * static_cast<size_t>(std::max(max_checks, 1)));
  if (++search_ == 0 || seen_.size() < wanted) {
    seen_.assign(std::max(wanted, seen_.size()), {0u, 0u});
    search_ = 1;
  }
}

size_t ForestSearcher::Search(const Descriptor& query, int max_checks, std::span<Neighbour> found) {
  if (found.empty()) {
    return 0;
  }
  Restart(max_checks);
  found_ = found;
  const auto later = [](const Branch& a, const Branch& b) {
    return a.squared_distance > b.squared_distance;
  };
  std::array<Branch, kTogether> branches;
  const size_t trees = forest_.roots.size();
  for (size_t begin = 0; begin < trees; begin += kTogether) {
    const size_t count = std::min(kTogether, trees - begin);
    for (size_t i = 0; i < count; ++i) {
      branches[i] = {forest_.roots[begin + i], 0};
    }
    Descend({branches.data(), count}, query);
  }
  std::make_heap(heap_.begin(), heap_.end(), later);
  while (!heap_.empty() && checks_left_ > 0) {
    size_t count = 0;
    while (count < kTogether && !heap_.empty()) {
      std::pop_heap(heap_.begin(), heap_.end(), later);
      const Branch branch = heap_.back();
      heap_.pop_back();
      // Neither this branch nor any later one can hold a nearer descriptor.
      if (count_ == found_.size() &&
          branch.squared_distance >= found_[count_ - 1].squared_distance) {
        heap_.clear();
        break;
      }
      branches[count++] = branch;
    }
    const size_t before = heap_.size();
    Descend({branches.data(), count}, query);
    for (size_t end = before + 1; end <= heap_.size(); ++end) {
      std::push_heap(heap_.begin(), heap_.begin() + static_cast<std::ptrdiff_t>(end), later);
    }
  }
  return count_;
}

void ForestSearcher::Descend(std::span<Branch> branches, const Descriptor& query) {
  const std::span<const ForestNode> nodes = forest_.nodes;
  for (bool walking = true; walking;) {
    walking = false;
    for (Branch& branch : branches) {
      const ForestNode& node = nodes[branch.node];
      if (node.dimension == ForestNode::kLeaf) {
        continue;
      }
      const int difference = static_cast<int>(query[node.dimension]) - node.threshold;
      const uint32_t right = difference >= 0 ? 1 : 0;
      heap_.push_back({node.first + 1 - right,
                       branch.squared_distance + static_cast<uint32_t>(difference * difference)});
      branch.node = node.first + right;
      __builtin_prefetch(&nodes[branch.node]);
      walking = true;
    }
  }
  for (const Branch& branch : branches) {
    __builtin_prefetch(&forest_.order[nodes[branch.node].first]);
  }
  for (const Branch& branch : branches) {
    Gather(nodes[branch.node]);
  }
  LookAtGathered(query);
}

bool ForestSearcher::MarkSeen(uint32_t descriptor) {
  // Fibonacci hashing (Knuth, "The Art of Computer Programming" 3, 6.4).
  const size_t mask = seen_.size() - 1;
  size_t slot = (descriptor * 0x9e3779b97f4a7c15ull >> 32) & mask;
  while (seen_[slot].second == search_) {
    if (seen_[slot].first == descriptor) {
      return false;
    }
    slot = (slot + 1) & mask;
  }
  seen_[slot] = {descriptor, search_};
  return true;
}

void ForestSearcher::Gather(const ForestNode& leaf) {
  for (uint32_t i = leaf.first; i < leaf.first + leaf.count && checks_left_ > 0; ++i) {
    const uint32_t descriptor = forest_.order[i];
    if (MarkSeen(descriptor)) {
      --checks_left_;
      gathered_.push_back(descriptor);
      __builtin_prefetch(descriptors_[descriptor].data());
      __builtin_prefetch(descriptors_[descriptor].data() + kDescriptorSize / 2);
    }
  }
}

void ForestSearcher::LookAtGathered(const Descriptor& query) {
  for (const uint32_t descriptor : gathered_) {
    Insert({descriptor, SquaredDistance(query, descriptors_[descriptor])});
  }
  gathered_.clear();
}

void ForestSearcher::Insert(Neighbour neighbour) {
  if (count_ == found_.size()) {
    if (neighbour.squared_distance >= found_[count_ - 1].squared_distance) {
      return;
    }
    --count_;
  }
  size_t i = count_++;
  for (; i > 0 && found_[i - 1].squared_distance > neighbour.squared_distance; --i) {
    found_[i] = found_[i - 1];
  }
  found_[i] = neighbour;
}

uint32_t SquaredDistance(const Descriptor& a, const Descriptor& b) {
  int32_t sum = 0;
  for (int i = 0; i < kDescriptorSize; ++i) {
    const auto difference = static_cast<int16_t>(a[i] - b[i]);
    sum += difference * difference;
  }
  return static_cast<uint32_t>(sum);
}

}  // namespace lararium::vision
