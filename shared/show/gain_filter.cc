#include "shared/show/gain_filter.h"

#include <algorithm>
#include <cmath>

namespace lararium::show {

std::array<float, 3> GainFilter::Update(const std::array<float, 3>& gain, double time) {
  const bool anew = !time_ || time < *time_;
  const double share = anew ? 1.0 : -std::expm1((*time_ - time) / kTimeConstant);
  time_ = time;
  std::array<float, 3> steadied;
  for (size_t c = 0; c < gain.size(); ++c) {
    const double log_gain = std::log(std::max(static_cast<double>(gain[c]), 1e-6));
    log_gain_[c] += share * (log_gain - log_gain_[c]);
    steadied[c] = static_cast<float>(std::exp(log_gain_[c]));
  }
  return steadied;
}

}  // namespace lararium::show
