#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace lararium {

// Returns the median; for an even number of values the mean of the two middle ones, for none 0.
template <typename T>
T Median(std::vector<T> values) {
  if (values.empty()) {
    return T{};
  }
  const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) {
    return *middle;
  }
  return (*std::max_element(values.begin(), middle) + *middle) / 2;
}

}  // namespace lararium
