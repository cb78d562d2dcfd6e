#include "shared/vision/patch.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstring>

namespace lararium::vision {
namespace {

constexpr int kBordered = kPatchSize + 2;
constexpr float kLeastVariance = 4.0f;  // Minimum contrast of a patch, grey levels^2.
constexpr float kLeastNoise2 = 1.0f;    // Noise by rounding and compression, grey levels^2.
constexpr int kMostBlurSamples = 12;

// Samples of a patch with its border, row by row, padded to a multiple of 8 for vectorised loops.
constexpr size_t kSamples = kBordered * kBordered;
constexpr size_t kPadded = (kSamples + 7) / 8 * 8;
using Samples = std::array<float, kPadded>;

struct SamplePlaces {
  Samples x{};
  Samples y{};
};

// Sample positions relative to the patch's centre. Padding samples repeat the first position.
constexpr SamplePlaces InPatch() {
  SamplePlaces places;
  for (size_t i = 0; i < kPadded; ++i) {
    const size_t sample = i < kSamples ? i : 0;
    places.x[i] = static_cast<float>(sample % kBordered) - 0.5f * (kBordered - 1);
    places.y[i] = static_cast<float>(sample / kBordered) - 0.5f * (kBordered - 1);
  }
  return places;
}

// Sample positions in the source, without motion.
SamplePlaces PlacesOf(const PatchWarp& warp) {
  static constexpr SamplePlaces kInPatch = InPatch();
  const Eigen::Vector2f centre = warp.centre;
  const Eigen::Matrix2f slope = warp.source_from_patch;
  SamplePlaces places;
  for (size_t i = 0; i < kPadded; ++i) {
    places.x[i] = centre.x() + slope(0, 0) * kInPatch.x[i] + slope(0, 1) * kInPatch.y[i];
    places.y[i] = centre.y() + slope(1, 0) * kInPatch.x[i] + slope(1, 1) * kInPatch.y[i];
  }
  return places;
}

// Loads four bytes; the two lower ones are the pixel and its right neighbour.
int32_t PixelPair(const uint8_t* p) {
  int32_t word;
  std::memcpy(&word, p, sizeof(word));
  return word;
}

// Adds the source's values at the places, moved by shift, to out. The loops are written so that the
// compiler vectorises them, because sampling takes most of the time of a tracked frame.
void AddSamples(const cv::Mat& source,
                const SamplePlaces& places,
                const Eigen::Vector2f& shift,
                Samples& out) {
  std::array<int32_t, kPadded> offsets;
  Samples right;
  Samples down;
  const int step = static_cast<int>(source.step);
  const float shift_x = shift.x();
  const float shift_y = shift.y();
  for (size_t i = 0; i < kPadded; ++i) {
    const float x = places.x[i] + shift_x;
    const float y = places.y[i] + shift_y;
    const int column = static_cast<int>(x);
    const int row = static_cast<int>(y);
    right[i] = x - static_cast<float>(column);
    down[i] = y - static_cast<float>(row);
    offsets[i] = row * step + column;
  }
  std::array<int32_t, kPadded> upper;
  std::array<int32_t, kPadded> lower;
  for (size_t i = 0; i < kPadded; ++i) {
    const uint8_t* p = source.data + offsets[i];
    upper[i] = PixelPair(p);
    lower[i] = PixelPair(p + step);
  }
  for (size_t i = 0; i < kPadded; ++i) {
    const auto u0 = static_cast<float>(upper[i] & 0xff);
    const auto u1 = static_cast<float>(upper[i] >> 8 & 0xff);
    const auto l0 = static_cast<float>(lower[i] & 0xff);
    const auto l1 = static_cast<float>(lower[i] >> 8 & 0xff);
    const float top = u0 + right[i] * (u1 - u0);
    const float bottom = l0 + right[i] * (l1 - l0);
    out[i] += top + down[i] * (bottom - top);
  }
}

// Returns whether all samples, their right and lower neighbours, and the four bytes that
// PixelPair() reads lie inside the source.
bool Inside(const cv::Mat& source, const PatchWarp& warp) {
  const Eigen::Array2f reach =
      0.5f * (kBordered - 1) * warp.source_from_patch.cwiseAbs().rowwise().sum().array() +
      0.5f * warp.motion.velocity.array().abs() + 0.125f * warp.motion.acceleration.array().abs();
  const Eigen::Array2f low = warp.centre.array() - reach;
  const Eigen::Array2f high = warp.centre.array() + reach;
  const auto columns = static_cast<float>(source.cols);
  const auto rows = static_cast<float>(source.rows);
  const bool above_last_row = high.y() < rows - 2.0f;
  return low.x() >= 0.0f && low.y() >= 0.0f && high.y() < rows - 1.0f &&
         high.x() < (above_last_row ? columns - 1.0f : columns - 3.0f);
}

float Sum(const std::array<float, kPatchArea>& a) {
  std::array<float, kPatchSize> lanes{};
  for (size_t row = 0; row < kPatchSize; ++row) {
    for (size_t column = 0; column < kPatchSize; ++column) {
      lanes[column] += a[row * kPatchSize + column];
    }
  }
  float sum = 0.0f;
  for (const float lane : lanes) {
    sum += lane;
  }
  return sum;
}

float Dot(const std::array<float, kPatchArea>& a, const std::array<float, kPatchArea>& b) {
  std::array<float, kPatchArea> products;
  for (size_t i = 0; i < kPatchArea; ++i) {
    products[i] = a[i] * b[i];
  }
  return Sum(products);
}

// Removes from derivative its components along the constant vector and along values (of mean 0).
void Eliminate(const std::array<float, kPatchArea>& values,
               float energy,
               std::array<float, kPatchArea>& derivative) {
  const float mean = Sum(derivative) / kPatchArea;
  const float along = Dot(derivative, values) / energy;
  for (size_t i = 0; i < kPatchArea; ++i) {
    derivative[i] -= mean + along * values[i];
  }
}

// Sums over the patch at an image position, as alignment needs them.
struct Products {
  float sum = 0.0f;      // Sum of the image values.
  float squares = 0.0f;  // Sum of their squares.
  float values = 0.0f;   // Sum of products with the template values.
  float dx = 0.0f;       // Sum of products with the template derivatives.
  float dy = 0.0f;
};

bool Fits(const cv::Mat& image, const Eigen::Vector2f& centre) {
  return centre.x() >= kPatchHalf && centre.y() >= kPatchHalf &&
         centre.x() + kPatchHalf < static_cast<float>(image.cols - 1) &&
         centre.y() + kPatchHalf < static_cast<float>(image.rows - 1);
}

Products Multiply(const cv::Mat& image, const PatchTemplate& patch, const Eigen::Vector2f& centre) {
  const float left = centre.x() - kPatchHalf;
  const float top = centre.y() - kPatchHalf;
  const int column = static_cast<int>(left);
  const int row = static_cast<int>(top);
  const float fx = left - static_cast<float>(column);
  const float fy = top - static_cast<float>(row);
  const float w00 = (1.0f - fx) * (1.0f - fy);
  const float w01 = fx * (1.0f - fy);
  const float w10 = (1.0f - fx) * fy;
  const float w11 = fx * fy;
  const uint8_t* upper = image.ptr<uint8_t>(row) + column;
  // One accumulator per column keeps the sums in vector registers.
  std::array<float, kPatchSize> sum{};
  std::array<float, kPatchSize> squares{};
  std::array<float, kPatchSize> values{};
  std::array<float, kPatchSize> dx{};
  std::array<float, kPatchSize> dy{};
  for (size_t r = 0; r < kPatchSize; ++r) {
    const uint8_t* lower = upper + image.step;
    for (size_t c = 0; c < kPatchSize; ++c) {
      const float v = w00 * upper[c] + w01 * upper[c + 1] + w10 * lower[c] + w11 * lower[c + 1];
      const size_t i = r * kPatchSize + c;
      sum[c] += v;
      squares[c] += v * v;
      values[c] += v * patch.values[i];
      dx[c] += v * patch.dx[i];
      dy[c] += v * patch.dy[i];
    }
    upper = lower;
  }
  Products products;
  for (size_t c = 0; c < kPatchSize; ++c) {
    products.sum += sum[c];
    products.squares += squares[c];
    products.values += values[c];
    products.dx += dx[c];
    products.dy += dy[c];
  }
  return products;
}

// Sum of squared deviations from the mean.
float Energy(const Products& p) { return std::max(p.squares - p.sum * p.sum / kPatchArea, 1e-3f); }

}  // namespace

bool PatchTemplate::Sample(const cv::Mat& source, const PatchWarp& warp) {
  if (!Inside(source, warp)) {
    return false;
  }
  Samples samples{};
  const SamplePlaces places = PlacesOf(warp);
  // Blurs by averaging shifted samples at most about one source pixel apart. The source is shifted
  // against the motion.
  const PatchMotion& motion = warp.motion;
  const int count =
      std::clamp(static_cast<int>(std::ceil(motion.velocity.norm())), 1, kMostBlurSamples);
  for (int i = 0; i < count; ++i) {
    const float t = (static_cast<float>(i) + 0.5f) / static_cast<float>(count) - 0.5f;
    // A single sample uses the mean of t^2 over the exposure, 1/12.
    const float t2 = count > 1 ? t * t : 1.0f / 12.0f;
    AddSamples(source, places, -t * motion.velocity - 0.5f * t2 * motion.acceleration, samples);
  }
  const float share = 1.0f / static_cast<float>(count);
  for (size_t r = 0; r < kPatchSize; ++r) {
    for (size_t c = 0; c < kPatchSize; ++c) {
      const size_t s = (r + 1) * kBordered + c + 1;
      const size_t i = r * kPatchSize + c;
      values[i] = share * samples[s];
      dx[i] = 0.5f * share * (samples[s + 1] - samples[s - 1]);
      dy[i] = 0.5f * share * (samples[s + kBordered] - samples[s - kBordered]);
    }
  }
  const float mean = Sum(values) / kPatchArea;
  for (float& value : values) {
    value -= mean;
  }
  energy = Dot(values, values);
  if (energy < kLeastVariance * kPatchArea) {
    return false;
  }
  Eliminate(values, energy, dx);
  Eliminate(values, energy, dy);
  const float xx = Dot(dx, dx);
  const float xy = Dot(dx, dy);
  const float yy = Dot(dy, dy);
  gradients << xx, xy, xy, yy;
  // The position along an edge is undetermined; the damping keeps it unchanged.
  constexpr float kDamping = 0.01f;
  Eigen::Matrix2f damped = gradients;
  damped.diagonal().array() += kDamping * (xx + yy) + 1.0f;
  step = damped.inverse();
  return true;
}

bool AlignPatch(const cv::Mat& image,
                const PatchTemplate& patch,
                const Eigen::Vector2f& start,
                const PatchSearch& search,
                PatchFit& fit) {
  fit.centre = start;
  for (int iteration = 0; iteration < search.iterations; ++iteration) {
    if (!Fits(image, fit.centre)) {
      return false;
    }
    const Products products = Multiply(image, patch, fit.centre);
    fit.gain = products.values / patch.energy;
    if (fit.gain <= 0.02f) {
      return false;
    }
    const float energy = Energy(products);
    const float explained = fit.gain * fit.gain * patch.energy;
    fit.correlation = std::sqrt(std::min(explained / energy, 1.0f));
    fit.noise2 = std::max((energy - explained) / (kPatchArea - 4), kLeastNoise2);
    const Eigen::Vector2f shift = patch.step * Eigen::Vector2f(products.dx, products.dy) / fit.gain;
    fit.centre -= shift;
    if ((fit.centre - start).squaredNorm() > search.largest_shift * search.largest_shift) {
      return false;
    }
    if (shift.squaredNorm() < search.converged * search.converged) {
      break;
    }
  }
  fit.information = (fit.gain * fit.gain / fit.noise2) * patch.gradients;
  return true;
}

float CorrelatePatch(const cv::Mat& image,
                     const PatchTemplate& patch,
                     const Eigen::Vector2f& centre) {
  if (!Fits(image, centre)) {
    return -1.0f;
  }
  const Products products = Multiply(image, patch, centre);
  return products.values / std::sqrt(patch.energy * Energy(products));
}

}  // namespace lararium::vision
