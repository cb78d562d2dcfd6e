#pragma once

// Eight floats in one register, or in two registers if the processor's are smaller.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#ifdef __AVX__
#include <immintrin.h>
#endif
#ifdef __wasm_simd128__
#include <wasm_simd128.h>
#endif

namespace lararium::light {

using Lanes = float __attribute__((vector_size(32)));
using IntLanes = int32_t __attribute__((vector_size(32)));
inline constexpr size_t kLanes = 8;

// Sixteen 16-bit integers in the same register size.
using ShortLanes = int16_t __attribute__((vector_size(32)));
inline constexpr size_t kShortLanes = 16;

#ifdef __wasm_simd128__
// The registers of WebAssembly are half as wide.
inline v128_t Low(const Lanes& a) {
  return reinterpret_cast<v128_t>(__builtin_shufflevector(a, a, 0, 1, 2, 3));
}
inline v128_t High(const Lanes& a) {
  return reinterpret_cast<v128_t>(__builtin_shufflevector(a, a, 4, 5, 6, 7));
}
inline v128_t Low(const ShortLanes& a) {
  return reinterpret_cast<v128_t>(__builtin_shufflevector(a, a, 0, 1, 2, 3, 4, 5, 6, 7));
}
inline v128_t High(const ShortLanes& a) {
  return reinterpret_cast<v128_t>(__builtin_shufflevector(a, a, 8, 9, 10, 11, 12, 13, 14, 15));
}
inline IntLanes Join(v128_t low, v128_t high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}
#endif

constexpr size_t PaddedToLanes(size_t count) { return (count + kLanes - 1) / kLanes * kLanes; }

inline Lanes Load(const float* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof(lanes));
  return lanes;
}
inline void Store(const Lanes& lanes, float* to) { std::memcpy(to, &lanes, sizeof(lanes)); }

// Loads or stores the first `count` lanes only; the other lanes are zero or stay unchanged.
inline Lanes LoadFirst(const float* from, size_t count) {
  if (count >= kLanes) {
    return Load(from);
  }
  Lanes lanes = {};
  std::memcpy(&lanes, from, count * sizeof(float));
  return lanes;
}

inline Lanes Broadcast(float a) { return Lanes{a, a, a, a, a, a, a, a}; }

// a b + c, with one instruction and one rounding if the processor supports it. The compiler is told
// not to fuse on its own.
inline Lanes MultiplyAdd(const Lanes& a, const Lanes& b, const Lanes& c) {
#ifdef __FMA__
  return _mm256_fmadd_ps(a, b, c);
#else
  return a * b + c;
#endif
}

// Loads four floats from each of two addresses.
inline Lanes LoadHalves(const float* low, const float* high) {
#ifdef __AVX__
  return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(low)), _mm_loadu_ps(high), 1);
#elif defined(__wasm_simd128__)
  return reinterpret_cast<Lanes>(Join(wasm_v128_load(low), wasm_v128_load(high)));
#else
  Lanes lanes;
  std::memcpy(&lanes, low, sizeof(lanes) / 2);
  std::memcpy(reinterpret_cast<char*>(&lanes) + sizeof(lanes) / 2, high, sizeof(lanes) / 2);
  return lanes;
#endif
}

inline Lanes Max(const Lanes& a, const Lanes& b) { return a > b ? a : b; }
inline Lanes Min(const Lanes& a, const Lanes& b) { return a < b ? a : b; }

inline Lanes Sqrt(const Lanes& a) {
#ifdef __AVX__
  return _mm256_sqrt_ps(a);
#elif defined(__wasm_simd128__)
  return reinterpret_cast<Lanes>(Join(wasm_f32x4_sqrt(Low(a)), wasm_f32x4_sqrt(High(a))));
#else
  Lanes root;
  for (size_t i = 0; i < kLanes; ++i) {
    root[i] = std::sqrt(a[i]);
  }
  return root;
#endif
}

inline bool AnyAbove(const Lanes& a, float threshold) {
#ifdef __AVX__
  return _mm256_movemask_ps(_mm256_cmp_ps(a, _mm256_set1_ps(threshold), _CMP_GT_OQ)) != 0;
#elif defined(__wasm_simd128__)
  const v128_t all = wasm_f32x4_splat(threshold);
  return wasm_v128_any_true(wasm_v128_or(wasm_f32x4_gt(Low(a), all), wasm_f32x4_gt(High(a), all)));
#else
  bool any = false;
  for (size_t i = 0; i < kLanes; ++i) {
    any = any || a[i] > threshold;
  }
  return any;
#endif
}

inline float Sum(const Lanes& a) {
  const Lanes halves = a + __builtin_shufflevector(a, a, 4, 5, 6, 7, 0, 1, 2, 3);
  const Lanes quarters = halves + __builtin_shufflevector(halves, halves, 2, 3, 0, 1, 6, 7, 4, 5);
  return quarters[0] + quarters[1];
}

// e^a with a relative error below 1e-6 for a in [-80, 80]; values beyond are clamped.
inline Lanes Exp(const Lanes& a) {
  const Lanes bounded = Min(Max(a, Broadcast(-80.0f)), Broadcast(80.0f));
  // 2^t with t = whole + rest, rest in [-1/2, 1/2]. Adding 1.5 * 2^23 rounds.
  const Lanes t = bounded * 1.44269504f;
  const float kRound = 12582912.0f;
  const Lanes whole = (t + kRound) - kRound;
  const Lanes rest = (t - whole) * 0.69314718f;
  // The power series of e^rest.
  Lanes power = Broadcast(1.0f / 5040.0f);
  for (const float term :
       {1.0f / 720.0f, 1.0f / 120.0f, 1.0f / 24.0f, 1.0f / 6.0f, 0.5f, 1.0f, 1.0f}) {
    power = MultiplyAdd(power, rest, Broadcast(term));
  }
  const IntLanes exponent = (__builtin_convertvector(whole, IntLanes) + 127) << 23;
  Lanes scale;
  std::memcpy(&scale, &exponent, sizeof(scale));
  return power * scale;
}

// rows[i][j] becomes rows[j][i].
inline void Transpose(Lanes (&rows)[kLanes]) {
  Lanes pairs[kLanes], fours[kLanes];
#pragma GCC unroll 8
  for (size_t i = 0; i < kLanes; i += 2) {
    pairs[i] = __builtin_shufflevector(rows[i], rows[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    pairs[i + 1] = __builtin_shufflevector(rows[i], rows[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
#pragma GCC unroll 8
  for (size_t i = 0; i < kLanes; i += 4) {
#pragma GCC unroll 8
    for (size_t k = 0; k < 2; ++k) {
      fours[i + k] =
          __builtin_shufflevector(pairs[i + k], pairs[i + k + 2], 0, 1, 8, 9, 4, 5, 12, 13);
      fours[i + k + 2] =
          __builtin_shufflevector(pairs[i + k], pairs[i + k + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  }
#pragma GCC unroll 8
  for (size_t i = 0; i < 4; ++i) {
    rows[i] = __builtin_shufflevector(fours[i], fours[i + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    rows[i + 4] = __builtin_shufflevector(fours[i], fours[i + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

// rows[i][j] becomes rows[j][i] for j below 4, and rows[i][4 + j] becomes rows[j][4 + i].
inline void TransposeHalves(Lanes (&rows)[4]) {
  const Lanes a = __builtin_shufflevector(rows[0], rows[1], 0, 8, 1, 9, 4, 12, 5, 13);
  const Lanes b = __builtin_shufflevector(rows[0], rows[1], 2, 10, 3, 11, 6, 14, 7, 15);
  const Lanes c = __builtin_shufflevector(rows[2], rows[3], 0, 8, 1, 9, 4, 12, 5, 13);
  const Lanes d = __builtin_shufflevector(rows[2], rows[3], 2, 10, 3, 11, 6, 14, 7, 15);
  rows[0] = __builtin_shufflevector(a, c, 0, 1, 8, 9, 4, 5, 12, 13);
  rows[1] = __builtin_shufflevector(a, c, 2, 3, 10, 11, 6, 7, 14, 15);
  rows[2] = __builtin_shufflevector(b, d, 0, 1, 8, 9, 4, 5, 12, 13);
  rows[3] = __builtin_shufflevector(b, d, 2, 3, 10, 11, 6, 7, 14, 15);
}

constexpr size_t PaddedToShortLanes(size_t count) {
  return (count + kShortLanes - 1) / kShortLanes * kShortLanes;
}

inline ShortLanes LoadShorts(const int16_t* from) {
  ShortLanes lanes;
  std::memcpy(&lanes, from, sizeof(lanes));
  return lanes;
}
inline void Store(const ShortLanes& lanes, int16_t* to) { std::memcpy(to, &lanes, sizeof(lanes)); }

inline ShortLanes BroadcastShort(int16_t a) {
  return ShortLanes{a, a, a, a, a, a, a, a, a, a, a, a, a, a, a, a};
}

// a b / 2^15, rounded. Not for -2^15 times itself.
inline ShortLanes MultiplyHigh(const ShortLanes& a, const ShortLanes& b) {
#ifdef __AVX2__
  return reinterpret_cast<ShortLanes>(
      _mm256_mulhrs_epi16(reinterpret_cast<__m256i>(a), reinterpret_cast<__m256i>(b)));
#elif defined(__wasm_simd128__)
  return reinterpret_cast<ShortLanes>(
      Join(wasm_i16x8_q15mulr_sat(Low(a), Low(b)), wasm_i16x8_q15mulr_sat(High(a), High(b))));
#else
  ShortLanes product;
  for (size_t i = 0; i < kShortLanes; ++i) {
    product[i] = static_cast<int16_t>((int32_t{a[i]} * b[i] + (1 << 14)) >> 15);
  }
  return product;
#endif
}

// Stores eight floats as rounded 16-bit integers. Values must be in range.
inline void StoreAsShorts(const Lanes& a, int16_t* to) {
  const Lanes half = a < 0.0f ? Broadcast(-0.5f) : Broadcast(0.5f);
#ifdef __wasm_simd128__
  const Lanes sum = a + half;
  wasm_v128_store(to, wasm_i16x8_narrow_i32x4(wasm_i32x4_trunc_sat_f32x4(Low(sum)),
                                              wasm_i32x4_trunc_sat_f32x4(High(sum))));
#else
  using HalfLanes = int16_t __attribute__((vector_size(16)));
  const auto whole =
      __builtin_convertvector(__builtin_convertvector(a + half, IntLanes), HalfLanes);
  std::memcpy(to, &whole, sizeof(whole));
#endif
}

// For each pair of neighbouring elements: the sum of the two products.
inline IntLanes DotPairs(const ShortLanes& a, const ShortLanes& b) {
#ifdef __AVX2__
  return reinterpret_cast<IntLanes>(
      _mm256_madd_epi16(reinterpret_cast<__m256i>(a), reinterpret_cast<__m256i>(b)));
#elif defined(__wasm_simd128__)
  return Join(wasm_i32x4_dot_i16x8(Low(a), Low(b)), wasm_i32x4_dot_i16x8(High(a), High(b)));
#else
  IntLanes sums;
  for (size_t i = 0; i < kLanes; ++i) {
    sums[i] = int32_t{a[2 * i]} * b[2 * i] + int32_t{a[2 * i + 1]} * b[2 * i + 1];
  }
  return sums;
#endif
}

// Loads sixteen signed bytes.
inline ShortLanes LoadBytes(const int8_t* from) {
#ifdef __AVX2__
  return reinterpret_cast<ShortLanes>(
      _mm256_cvtepi8_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from))));
#elif defined(__wasm_simd128__)
  return reinterpret_cast<ShortLanes>(
      Join(wasm_i16x8_load8x8(from), wasm_i16x8_load8x8(from + kLanes)));
#else
  ShortLanes lanes;
  for (size_t i = 0; i < kShortLanes; ++i) {
    lanes[i] = from[i];
  }
  return lanes;
#endif
}

// Loads eight signed bytes into both halves.
inline ShortLanes LoadEightBytesTwice(const int8_t* from) {
#ifdef __wasm_simd128__
  const v128_t half = wasm_i16x8_load8x8(from);
  return reinterpret_cast<ShortLanes>(Join(half, half));
#else
  using Words = int64_t __attribute__((vector_size(16)));
  using Bytes = int8_t __attribute__((vector_size(16)));
  int64_t bytes;
  std::memcpy(&bytes, from, sizeof(bytes));
  return __builtin_convertvector(reinterpret_cast<Bytes>(Words{bytes, bytes}), ShortLanes);
#endif
}

}  // namespace lararium::light
