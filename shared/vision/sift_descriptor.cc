#include "shared/vision/sift_descriptor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace lararium::vision {
namespace {

constexpr int kCells = 4;   // along each side
constexpr int kAngles = 8;  // for each cell

// One more cell on every side, and one more angle, catch the outer shares of
// the trilinear interpolation.
constexpr int kPaddedCells = kCells + 2;
constexpr size_t kCellStride = kAngles + 1;
constexpr size_t kRowStride = kPaddedCells * kCellStride;
using PaddedHistogram = std::array<float, kPaddedCells * kRowStride>;

// Part of a row in which both |a + b t| < limit hold.
std::pair<float, float> Overlap(float a, float b, float limit, std::pair<float, float> range) {
  if (std::abs(b) < 1e-6f) {
    return std::abs(a) < limit ? range : std::pair(0.0f, -1.0f);
  }
  const float first = (-limit - a) / b;
  const float second = (limit - a) / b;
  return {std::max(range.first, std::min(first, second)),
          std::min(range.second, std::max(first, second))};
}

void AddSample(float u, float v, float angle_bin, float weight, PaddedHistogram& histogram) {
  const int iu = static_cast<int>(u);
  const int iv = static_cast<int>(v);
  const int ia = static_cast<int>(angle_bin);
  const float fu = u - static_cast<float>(iu);
  const float fv = v - static_cast<float>(iv);
  const float fa = angle_bin - static_cast<float>(ia);
  float* cell = &histogram[iv * kRowStride + iu * kCellStride + (ia & (kAngles - 1))];
  const float below = weight * (1.0f - fv);
  const float above = weight * fv;
  const auto add = [fa](float* bin, float share) {
    bin[0] += share * (1.0f - fa);
    bin[1] += share * fa;
  };
  add(cell, below * (1.0f - fu));
  add(cell + kCellStride, below * fu);
  add(cell + kRowStride, above * (1.0f - fu));
  add(cell + kRowStride + kCellStride, above * fu);
}

PaddedHistogram Accumulate(const cv::Mat& image,
                           const OrientedExtremum& oriented,
                           DescriptorMemory& memory) {
  const Extremum& e = oriented.extremum;
  const float cell_size = 3.0f * e.sigma;             // pixels
  constexpr float kReach = 0.5f * (kCells + 1);       // in cells, from the centre
  constexpr float kLastCell = kPaddedCells - 1.001f;  // largest u and v, exclusive
  const float cosine = std::cos(oriented.angle) / cell_size;
  const float sine = std::sin(oriented.angle) / cell_size;
  const Window window(image, e.x, e.y, std::numbers::sqrt2_v<float> * kReach * cell_size);
  constexpr float kSigmaInCells = 0.5f * kCells;
  FillGaussian(e.x, kSigmaInCells * cell_size, window.x_begin, window.x_end, memory.weights_x);
  FillGaussian(e.y, kSigmaInCells * cell_size, window.y_begin, window.y_end, memory.weights_y);

  PaddedHistogram histogram{};
  for (int y = window.y_begin; y < window.y_end; ++y) {
    const float dy = static_cast<float>(y) - e.y;
    std::pair<float, float> reach = {static_cast<float>(window.x_begin) - e.x,
                                     static_cast<float>(window.x_end - 1) - e.x};
    reach = Overlap(sine * dy, cosine, kReach, reach);
    reach = Overlap(cosine * dy, -sine, kReach, reach);
    const int begin = std::max(static_cast<int>(std::ceil(reach.first + e.x)), window.x_begin);
    const int end = std::min(static_cast<int>(std::floor(reach.second + e.x)) + 1, window.x_end);
    if (begin >= end) {
      continue;
    }
    const int count = end - begin;
    memory.gradients.Fill(image, y, begin, end);
    memory.samples.Reserve(count);
    const float* magnitude = memory.gradients.magnitude.data();
    const float* angle = memory.gradients.angle.data();
    const float* weight_x = &memory.weights_x[begin - window.x_begin];
    const float weight_y = memory.weights_y[y - window.y_begin];
    float* u = memory.samples.u.data();
    float* v = memory.samples.v.data();
    float* angle_bin = memory.samples.angle_bin.data();
    float* weight = memory.samples.weight.data();
    for (int i = 0; i < count; ++i) {
      const float dx = static_cast<float>(begin + i) - e.x;
      // Within the range but for rounding.
      u[i] = std::clamp(cosine * dx + sine * dy + kReach, 0.0f, kLastCell);
      v[i] = std::clamp(-sine * dx + cosine * dy + kReach, 0.0f, kLastCell);
      const float turned = angle[i] - oriented.angle;
      angle_bin[i] = (turned < 0.0f ? turned + kTwoPi : turned) * (kAngles / kTwoPi);
      weight[i] = weight_y * weight_x[i] * magnitude[i];
    }
    for (int i = 0; i < count; ++i) {
      AddSample(u[i], v[i], angle_bin[i], weight[i], histogram);
    }
  }
  return histogram;
}

// Unit length, clamped at 0.2 against glare, unit length again, times 512.
Descriptor Quantised(const PaddedHistogram& histogram) {
  std::array<float, kDescriptorSize> values;
  size_t k = 0;
  for (int v = 1; v <= kCells; ++v) {
    for (int u = 1; u <= kCells; ++u) {
      const float* cell = &histogram[v * kRowStride + u * kCellStride];
      for (int a = 0; a < kAngles; ++a) {
        values[k++] = cell[a] + (a == 0 ? cell[kAngles] : 0.0f);
      }
    }
  }
  const auto length = [&] {
    float sum = 0.0f;
    for (const float value : values) {
      sum += value * value;
    }
    return std::max(std::sqrt(sum), 1e-20f);
  };
  const float limit = 0.2f * length();
  for (float& value : values) {
    value = std::min(value, limit);
  }
  const float scale = 512.0f / length();
  Descriptor descriptor;
  for (int i = 0; i < kDescriptorSize; ++i) {
    descriptor[i] = static_cast<uint8_t>(std::min(values[i] * scale + 0.5f, 255.0f));
  }
  return descriptor;
}

}  // namespace

Descriptor Describe(const cv::Mat& image,
                    const OrientedExtremum& oriented,
                    DescriptorMemory& memory) {
  return Quantised(Accumulate(image, oriented, memory));
}

}  // namespace lararium::vision
