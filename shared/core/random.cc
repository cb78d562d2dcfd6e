#include "shared/core/random.h"

#include <cmath>
#include <numbers>

#include "shared/core/check.h"

namespace lararium {

Random::Random(uint64_t seed, uint64_t stream) : state_(0), increment_(2 * stream + 1) {
  Next();
  state_ += seed;
  Next();
}

uint32_t Random::Next() {
  const uint64_t old = state_;
  state_ = old * 6364136223846793005ULL + increment_;
  const auto shifted = static_cast<uint32_t>(((old >> 18) ^ old) >> 27);
  const auto rotation = static_cast<uint32_t>(old >> 59);
  return (shifted >> rotation) | (shifted << ((-rotation) & 31));
}

uint32_t Random::Below(uint32_t count) {
  CHECK(count > 0);
  // Values below the threshold would make the first residues too likely.
  const uint32_t threshold = -count % count;
  uint32_t value = Next();
  while (value < threshold) {
    value = Next();
  }
  return value % count;
}

double Random::Uniform() {
  const uint64_t high = Next() >> 5;
  const uint64_t low = Next() >> 6;
  return static_cast<double>((high << 26) | low) * 0x1p-53;
}

double Random::Normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - Uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * Uniform());
}

}  // namespace lararium
