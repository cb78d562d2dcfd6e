#pragma once

// Random numbers from an explicit seed, equal on every platform (the standard library's
// distributions are not).

#include <cstdint>

namespace lararium {

// PCG32 (O'Neill, "PCG: A Family of Simple Fast Space-Efficient Statistically
// Good Algorithms for Random Number Generation", 2014), XSH-RR 64/32.
class Random {
 public:
  explicit Random(uint64_t seed, uint64_t stream = 0);

  uint32_t Next();
  // Uniform in [0, count), without bias. count > 0.
  uint32_t Below(uint32_t count);
  // Uniform in [0, 1).
  double Uniform();
  double Uniform(double low, double high) { return low + (high - low) * Uniform(); }
  // Normal with mean 0 and standard deviation 1 (Box and Muller).
  double Normal();

 private:
  uint64_t state_;
  uint64_t increment_;
};

}  // namespace lararium
