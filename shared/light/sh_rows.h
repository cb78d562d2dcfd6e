#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "shared/core/check.h"
#include "shared/light/lanes.h"

namespace lararium::light {

// Spherical-harmonic coefficients of many receivers as a structure of arrays: row k holds
// coefficient k of each receiver. Rows are padded to whole registers; the padding is finite but has
// no meaning. Only the constructor allocates.
class ShRows {
 public:
  ShRows() = default;
  ShRows(int count, size_t receivers)
      : count_(count),
        receivers_(receivers),
        stride_(PaddedToLanes(receivers)),
        values_(static_cast<size_t>(count) * stride_, 0.0f) {}

  int count() const { return count_; }
  size_t receivers() const { return receivers_; }
  // Length of a row in floats, including its padding.
  size_t stride() const { return stride_; }
  float* row(int k) { return values_.data() + static_cast<size_t>(k) * stride_; }
  const float* row(int k) const { return values_.data() + static_cast<size_t>(k) * stride_; }
  void Clear() { std::fill(values_.begin(), values_.end(), 0.0f); }
  // Adds rows of the same count and the same receivers.
  void Add(const ShRows& more) {
    for (size_t i = 0; i < values_.size(); ++i) {
      values_[i] += more.values_[i];
    }
  }
  float& at(int k, size_t receiver) { return row(k)[receiver]; }
  float at(int k, size_t receiver) const { return row(k)[receiver]; }

 private:
  int count_ = 0;
  size_t receivers_ = 0;
  size_t stride_ = 0;
  std::vector<float> values_;
};

using ShRowsRgb = std::array<ShRows, 3>;

// Receivers [begin, end). Jobs may run in parallel on ranges that share no register. Functions that
// need it require `begin` to be a multiple of kLanes.
struct ReceiverRange {
  size_t begin = 0;
  size_t end = 0;
};

inline void CheckRegisters(const ReceiverRange& range, const ShRows& rows) {
  CHECK(range.begin % kLanes == 0 && range.begin <= range.end && range.end <= rows.receivers());
}

}  // namespace lararium::light
