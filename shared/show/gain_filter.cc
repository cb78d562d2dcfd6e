#include "shared/show/gain_filter.h"

#include <algorithm>
#include <cmath>

namespace lararium::show {

std::array<float, 3> GainFilter::Update(const std::array<float, 3>& gain, double time) {
  const bool anew = !time_ || time < *time_;
  const double step = anew ? 0.0 : time - *time_;
  time_ = time;
  const double left = std::exp(-step / kMemory);
  std::array<float, 3> steadied;
  for (size_t c = 0; c < gain.size(); ++c) {
    Line& line = log_gain_[c];
    const double measured = std::log(std::max(static_cast<double>(gain[c]), 1e-6));
    const double predicted = line.at + line.rate * step;
    const double off = measured - predicted;
    if (anew || (step > 0.0 && std::abs(off) > kJump)) {
      line = {measured, 0.0};
    } else if (step > 0.0) {
      line.at = predicted + (1.0 - left * left) * off;
      line.rate += (1.0 - left) * (1.0 - left) / step * off;
    }
    steadied[c] = static_cast<float>(std::exp(line.at));
  }
  return steadied;
}

}  // namespace lararium::show
