#pragma once

// The transfer function of sRGB (IEC 61966-2-1), between 0 and 1.

#include <cmath>

namespace lararium {

template <typename Real>
Real LinearFromSrgb(Real encoded) {
  return encoded <= Real(0.04045) ? encoded / Real(12.92)
                                  : std::pow((encoded + Real(0.055)) / Real(1.055), Real(2.4));
}

template <typename Real>
Real SrgbFromLinear(Real linear) {
  return linear <= Real(0.0031308)
             ? Real(12.92) * linear
             : Real(1.055) * std::pow(linear, Real(1) / Real(2.4)) - Real(0.055);
}

}  // namespace lararium
