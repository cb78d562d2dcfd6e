#include "shared/vision/sift_descriptor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "shared/vision/lanes.h"

namespace lararium::vision {
namespace {

constexpr int kCells = 4;   // Number of cells along each side.
constexpr int kAngles = 8;  // Number of orientation bins per cell.

static_assert(kAngles == kLanes, "the orientation bins of a cell fill the lanes");
static_assert(kRowPadding >= kAngles);

// Clamps to [0, most]; NaN becomes 0.
inline Lanes Clamped(const Lanes& values, float most) {
  const Lanes positive = values > 0.0f ? values : Lanes{};
  return positive < most ? positive : Lanes{} + most;
}

// An extra cell on every side receives the weights that interpolation puts outside.
constexpr int kPaddedCells = kCells + 2;
// Consecutive samples go to alternate histograms, so that one need not wait for the store of the
// other.
constexpr int kTurns = 2;
using PaddedHistogram = std::array<Lanes, kTurns * kPaddedCells * kPaddedCells>;

// The part of the range of t in which |a + b t| < limit.
std::pair<float, float> Overlap(float a, float b, float limit, std::pair<float, float> range) {
  if (std::abs(b) < 1e-6f) {
    return std::abs(a) < limit ? range : std::pair(0.0f, -1.0f);
  }
  const float first = (-limit - a) / b;
  const float second = (limit - a) / b;
  return {std::max(range.first, std::min(first, second)),
          std::min(range.second, std::max(first, second))};
}

// Adds samples to the histogram, with linear interpolation between cells and between angles.
void AddSamples(const SampleRow& samples, int count, PaddedHistogram& histogram) {
  constexpr Lanes kBins = {0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f};
  constexpr Lanes kOne = {1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f};
  constexpr Lanes kNone = {};
  constexpr auto kTurn = static_cast<float>(kAngles);
  for (int i = 0; i < count; ++i) {
    const Lanes ahead = samples.angle_bin[i] - kBins;
    const Lanes apart = ahead > kNone ? ahead : -ahead;
    const Lanes around = kTurn - apart;
    const Lanes near = kOne - (apart < around ? apart : around);
    const Lanes angles = near > kNone ? near : kNone;
    Lanes* cell = &histogram[(i % kTurns) * kPaddedCells * kPaddedCells + samples.cell[i]];
    cell[0] += samples.share[0][i] * angles;
    cell[1] += samples.share[1][i] * angles;
    cell[kPaddedCells] += samples.share[2][i] * angles;
    cell[kPaddedCells + 1] += samples.share[3][i] * angles;
  }
}

PaddedHistogram Accumulate(const cv::Mat& image,
                           const OrientedExtremum& oriented,
                           DescriptorMemory& memory) {
  const Extremum& e = oriented.extremum;
  const float cell_size = 3.0f * e.sigma;             // Octave pixels.
  constexpr float kReach = 0.5f * (kCells + 1);       // Half the window's side, in cells.
  constexpr float kLastCell = kPaddedCells - 1.001f;  // Upper bound of u and v.
  // The float functions of C libraries differ in the last bit; rounded doubles are the same in
  // browsers.
  const double angle = oriented.angle;
  const float cosine = static_cast<float>(std::cos(angle)) / cell_size;
  const float sine = static_cast<float>(std::sin(angle)) / cell_size;
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
    const float* weight_x = &memory.weights_x[begin - window.x_begin];
    const float weight_y = memory.weights_y[y - window.y_begin];
    SampleRow& samples = memory.samples;
    samples.Reserve(count + kRowPadding);
    constexpr Lanes kSteps = {0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f};
    for (int i = 0; i < count; i += kAngles) {
      const Lanes dx = static_cast<float>(begin + i) - e.x + kSteps;
      // Clamping matters only for rounding errors and for samples beyond the end of the row.
      const Lanes u = Clamped(cosine * dx + sine * dy + kReach, kLastCell);
      const Lanes v = Clamped(-sine * dx + cosine * dy + kReach, kLastCell);
      const IntegerLanes iu = __builtin_convertvector(u, IntegerLanes);
      const IntegerLanes iv = __builtin_convertvector(v, IntegerLanes);
      const Lanes fu = u - __builtin_convertvector(iu, Lanes);
      const Lanes fv = v - __builtin_convertvector(iv, Lanes);
      const Lanes turned = LoadLanes(&memory.gradients.angle[i]) - oriented.angle;
      const Lanes weight =
          weight_y * LoadLanes(weight_x + i) * LoadLanes(&memory.gradients.magnitude[i]);
      const Lanes below = weight * (1.0f - fv);
      const Lanes above = weight * fv;
      StoreLanes((turned < 0.0f ? turned + kTwoPi : turned) * (kAngles / kTwoPi),
                 &samples.angle_bin[i]);
      StoreLanes(iv * kPaddedCells + iu, &samples.cell[i]);
      StoreLanes(below * (1.0f - fu), &samples.share[0][i]);
      StoreLanes(below * fu, &samples.share[1][i]);
      StoreLanes(above * (1.0f - fu), &samples.share[2][i]);
      StoreLanes(above * fu, &samples.share[3][i]);
    }
    AddSamples(samples, count, histogram);
  }
  return histogram;
}

// Normalises to unit length, clamps at 0.2 to limit the effect of glare, normalises again, and
// scales by 512.
Descriptor Quantised(const PaddedHistogram& histogram) {
  std::array<float, kDescriptorSize> values;
  size_t k = 0;
  for (int v = 1; v <= kCells; ++v) {
    for (int u = 1; u <= kCells; ++u) {
      const Lanes* cell = &histogram[v * kPaddedCells + u];
      const Lanes sum = cell[0] + cell[kPaddedCells * kPaddedCells];
      for (int a = 0; a < kAngles; ++a) {
        values[k++] = sum[a];
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
