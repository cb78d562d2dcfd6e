#pragma once

// Finds the intervals that touch a window, in O(log n + k).

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace lararium::drama {

// Intervals sorted by begin, as an implicit balanced tree: the node of a range is its middle
// element and stores the latest end in the range (an augmented tree after Cormen et al.,
// Introduction to Algorithms, section 14.3, laid out in an array).
class IntervalIndex {
 public:
  // Accepts any order. An interval of length 0 is an instant.
  void Build(std::span<const double> begins, std::span<const double> lengths) {
    order_.resize(begins.size());
    for (uint32_t i = 0; i < order_.size(); ++i) {
      order_[i] = i;
    }
    std::stable_sort(order_.begin(), order_.end(),
                     [&](uint32_t a, uint32_t b) { return begins[a] < begins[b]; });
    begin_.resize(order_.size());
    end_.resize(order_.size());
    latest_.resize(order_.size());
    for (size_t i = 0; i < order_.size(); ++i) {
      begin_[i] = begins[order_[i]];
      end_[i] = begin_[i] + lengths[order_[i]];
    }
    FindLatest(0, order_.size());
  }

  // Appends the indices of intervals with begin < to and end > from (or begin = from), in the order
  // of their begins.
  void Query(double from, double to, std::vector<uint32_t>& found) const {
    Query(0, order_.size(), from, to, found);
  }

  std::span<const uint32_t> order() const { return order_; }
  // The latest end of all intervals; 0 if there are none.
  double latest() const { return order_.empty() ? 0.0 : latest_[order_.size() / 2]; }

 private:
  double FindLatest(size_t first, size_t last) {
    if (first == last) {
      return 0.0;
    }
    const size_t middle = first + (last - first) / 2;
    latest_[middle] =
        std::max({end_[middle], FindLatest(first, middle), FindLatest(middle + 1, last)});
    return latest_[middle];
  }

  void Query(size_t first, size_t last, double from, double to, std::vector<uint32_t>& out) const {
    if (first == last) {
      return;
    }
    const size_t middle = first + (last - first) / 2;
    if (latest_[middle] < from) {
      return;
    }
    Query(first, middle, from, to, out);
    if (begin_[middle] >= to) {
      return;
    }
    if (end_[middle] > from || begin_[middle] == from) {
      out.push_back(order_[middle]);
    }
    Query(middle + 1, last, from, to, out);
  }

  std::vector<uint32_t> order_;
  std::vector<double> begin_;  // Same order as order_.
  std::vector<double> end_;
  std::vector<double> latest_;
};

}  // namespace lararium::drama
