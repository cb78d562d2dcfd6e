#pragma once

// Eight numbers in one vector register, or in two on processors with shorter ones.

#include <cstdint>
#include <cstring>

namespace lararium::vision {

inline constexpr int kLanes = 8;
using Lanes = float __attribute__((vector_size(4 * kLanes)));
using IntegerLanes = int32_t __attribute__((vector_size(4 * kLanes)));

inline Lanes LoadLanes(const float* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof(lanes));
  return lanes;
}

template <typename Vector, typename T>
void StoreLanes(const Vector& lanes, T* to) {
  std::memcpy(to, &lanes, sizeof(lanes));
}

}  // namespace lararium::vision
