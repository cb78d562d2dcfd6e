#pragma once

// Random directions about a surface with density cosine / pi.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace lararium::bake {

// A direction about +Z from two numbers in [0, 1) (Malley's method).
inline glm::vec3 CosineDirection(const glm::vec2& random) {
  const float radius = std::sqrt(random.x);
  const float angle = 2.0f * std::numbers::pi_v<float> * random.y;
  return {radius * std::cos(angle), radius * std::sin(angle),
          std::sqrt(std::max(0.0f, 1.0f - random.x))};
}

// Turns a direction about +Z to one about the unit normal `n` (Duff et al., "Building an
// Orthonormal Basis, Revisited", JCGT 6(1), 2017).
inline glm::vec3 AroundNormal(const glm::vec3& n, const glm::vec3& about_z) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1.0f / (sign + n.z);
  const float b = n.x * n.y * a;
  const glm::vec3 x(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
  const glm::vec3 y(b, sign + n.y * n.y * a, -n.y);
  return about_z.x * x + about_z.y * y + about_z.z * n;
}

// Reverses the order of the bits of i.
inline uint32_t ReverseBits(uint32_t i) {
  i = (i << 16) | (i >> 16);
  i = ((i & 0x55555555u) << 1) | ((i & 0xaaaaaaaau) >> 1);
  i = ((i & 0x33333333u) << 2) | ((i & 0xccccccccu) >> 2);
  i = ((i & 0x0f0f0f0fu) << 4) | ((i & 0xf0f0f0f0u) >> 4);
  return ((i & 0x00ff00ffu) << 8) | ((i & 0xff00ff00u) >> 8);
}

// Point i of Sobol's (0, 2)-sequence in [0, 1)^2, scrambled by two masks. The first 2^n points
// are well stratified for every n (Kollig & Keller, "Efficient Multidimensional Sampling",
// Eurographics 2002).
inline glm::vec2 SobolPoint(uint32_t i, uint32_t mask_x, uint32_t mask_y) {
  uint32_t y = 0;
  for (uint32_t direction = 1u << 31, rest = i; rest != 0;
       rest >>= 1, direction ^= direction >> 1) {
    y ^= (rest & 1u) != 0 ? direction : 0u;
  }
  return {static_cast<float>((ReverseBits(i) ^ mask_x) >> 8) * 0x1p-24f,
          static_cast<float>((y ^ mask_y) >> 8) * 0x1p-24f};
}

// Scrambles bits so that each depends only on the bits below it. On reversed bits this is a
// random nested permutation of intervals (Laine & Karras, "Stratified Sampling for Stochastic
// Transparency", EGSR 2011).
inline uint32_t ScrambleUpwards(uint32_t bits, uint32_t seed) {
  bits += seed;
  bits ^= bits * 0x6c50b47cu;
  bits ^= bits * 0xb82f1e52u;
  bits ^= bits * 0xc7afe638u;
  bits ^= bits * 0x8d22f6e6u;
  return bits;
}

// Owen scrambling of a 32-bit fraction.
inline uint32_t OwenScramble(uint32_t fraction, uint32_t seed) {
  return ReverseBits(ScrambleUpwards(ReverseBits(fraction), seed));
}

struct SobolSeeds {
  uint32_t order = 0;
  uint32_t x = 0;
  uint32_t y = 0;
};

// Point i of the sequence in a shuffled order with Owen scrambling (Burley, "Practical
// Hash-based Owen Scrambling", JCGT 9(4), 2020). It is as well stratified as SobolPoint. Points
// of different seeds are independent; points of different masks are not, because the sequence
// is linear and a mask only shifts it.
inline glm::vec2 ShuffledSobolPoint(uint32_t i, const SobolSeeds& seeds) {
  const uint32_t shuffled = OwenScramble(i, seeds.order);
  uint32_t y = 0;
  for (uint32_t direction = 1u << 31, rest = shuffled; rest != 0;
       rest >>= 1, direction ^= direction >> 1) {
    y ^= (rest & 1u) != 0 ? direction : 0u;
  }
  return {static_cast<float>(OwenScramble(ReverseBits(shuffled), seeds.x) >> 8) * 0x1p-24f,
          static_cast<float>(OwenScramble(y, seeds.y) >> 8) * 0x1p-24f};
}

}  // namespace lararium::bake
