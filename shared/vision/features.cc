#include "shared/vision/features.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <tuple>

#include "shared/core/parallel.h"
#include "shared/vision/scale_space.h"

namespace lararium::vision {
namespace {

constexpr float kTwoPi = 2.0f * std::numbers::pi_v<float>;
constexpr int kBorder = 5;            // octave pixels at the rim, where blur is guesswork
constexpr int kMaxImageSide = 16384;  // pixels
constexpr size_t kKeypointsPerJob = 32;

// An extremum of the difference of Gaussians, refined to sub-pixels.
struct Extremum {
  int octave = 0;
  int level = 0;
  int row = 0;
  int column = 0;
  float x = 0.0f;         // octave pixels
  float y = 0.0f;         // octave pixels
  float sigma = 0.0f;     // octave pixels
  float response = 0.0f;  // |D|, grey 0..1

  auto Cell() const { return std::tie(octave, level, row, column); }
};

struct OrientedExtremum {
  Extremum extremum;
  float angle = 0.0f;  // radians, [0, 2 pi)
};

// ------------------------------------------------------------ detection

// Of 3 x 3 x 3 samples, where sign * value is the largest.
bool IsLargest(const Octave& octave, int level, int row, int column, float sign) {
  const float value = sign * octave.differences[level].at<float>(row, column);
  for (int l = level - 1; l <= level + 1; ++l) {
    for (int y = row - 1; y <= row + 1; ++y) {
      const float* p = octave.differences[l].ptr<float>(y) + column;
      if (sign * p[-1] > value || sign * p[0] > value || sign * p[1] > value) {
        return false;
      }
    }
  }
  return true;
}

struct Quadratic {
  Eigen::Vector3f gradient;  // x, y, level
  Eigen::Matrix3f hessian;
};

// The difference of Gaussians around a sample (Brown & Lowe, "Invariant
// features from interest point groups", BMVC 2002).
Quadratic QuadraticAt(const Octave& octave, int level, int row, int column) {
  const auto at = [&](int dx, int dy, int dl) {
    return octave.differences[level + dl].at<float>(row + dy, column + dx);
  };
  const float twice = 2.0f * at(0, 0, 0);
  const float xx = at(1, 0, 0) + at(-1, 0, 0) - twice;
  const float yy = at(0, 1, 0) + at(0, -1, 0) - twice;
  const float ll = at(0, 0, 1) + at(0, 0, -1) - twice;
  const float xy = 0.25f * (at(1, 1, 0) - at(-1, 1, 0) - at(1, -1, 0) + at(-1, -1, 0));
  const float xl = 0.25f * (at(1, 0, 1) - at(-1, 0, 1) - at(1, 0, -1) + at(-1, 0, -1));
  const float yl = 0.25f * (at(0, 1, 1) - at(0, -1, 1) - at(0, 1, -1) + at(0, -1, -1));
  Quadratic q;
  q.gradient << at(1, 0, 0) - at(-1, 0, 0), at(0, 1, 0) - at(0, -1, 0), at(0, 0, 1) - at(0, 0, -1);
  q.gradient *= 0.5f;
  q.hessian << xx, xy, xl, xy, yy, yl, xl, yl, ll;
  return q;
}

bool Inside(const Octave& octave, int level, int row, int column) {
  const int levels = static_cast<int>(octave.differences.size());
  return level >= 1 && level < levels - 1 && row >= kBorder &&
         row < octave.differences[0].rows - kBorder && column >= kBorder &&
         column < octave.differences[0].cols - kBorder;
}

bool LooksLikeEdge(const Quadratic& q, float edge_threshold) {
  const float trace = q.hessian(0, 0) + q.hessian(1, 1);
  const float determinant = q.hessian.topLeftCorner<2, 2>().determinant();
  const float ratio = edge_threshold + 1.0f;
  return determinant <= 0.0f || trace * trace * edge_threshold >= ratio * ratio * determinant;
}

// Walks to the top of the quadratic; nullopt for what is weak, an edge or not
// an extremum after all.
std::optional<Extremum> Refine(
    const Octave& octave, int level, int row, int column, const FeatureOptions& options) {
  constexpr int kMaxSteps = 5;
  // Beyond half a sample, so that the walk does not swing between two.
  constexpr float kNearest = 0.6f;
  for (int step = 0; step < kMaxSteps; ++step) {
    const Quadratic q = QuadraticAt(octave, level, row, column);
    const float determinant = q.hessian.determinant();
    if (std::abs(determinant) < 1e-20f) {
      return std::nullopt;
    }
    const Eigen::Vector3f offset = -(q.hessian.inverse() * q.gradient);
    if (!(offset.cwiseAbs().maxCoeff() < 1e4f)) {
      return std::nullopt;
    }
    if (offset.cwiseAbs().maxCoeff() >= kNearest) {
      column += std::abs(offset.x()) >= kNearest ? static_cast<int>(std::round(offset.x())) : 0;
      row += std::abs(offset.y()) >= kNearest ? static_cast<int>(std::round(offset.y())) : 0;
      level += std::abs(offset.z()) >= kNearest ? static_cast<int>(std::round(offset.z())) : 0;
      if (!Inside(octave, level, row, column)) {
        return std::nullopt;
      }
      continue;
    }
    const float value =
        octave.differences[level].at<float>(row, column) + 0.5f * q.gradient.dot(offset);
    if (std::abs(value) * static_cast<float>(options.scales_per_octave) <
            options.contrast_threshold ||
        LooksLikeEdge(q, options.edge_threshold)) {
      return std::nullopt;
    }
    Extremum e;
    e.level = level;
    e.row = row;
    e.column = column;
    e.x = static_cast<float>(column) + offset.x();
    e.y = static_cast<float>(row) + offset.y();
    e.sigma = kBaseSigma * std::exp2((static_cast<float>(level) + offset.z()) /
                                     static_cast<float>(options.scales_per_octave));
    e.response = std::abs(value);
    return e;
  }
  return std::nullopt;
}

// Marks the samples of a row that are beyond least and largest or smallest of
// their 3 x 3 level. Of the few that are left the other levels decide.
void MarkPeaks(const cv::Mat& difference,
               int row,
               int begin,
               int end,
               float least,
               std::vector<int32_t>& marks) {
  const float* above = difference.ptr<float>(row - 1);
  const float* here = difference.ptr<float>(row);
  const float* below = difference.ptr<float>(row + 1);
  marks.resize(difference.cols);
  int32_t* mark = marks.data();
  for (int x = begin; x < end; ++x) {
    float high = std::max(above[x], below[x]);
    float low = std::min(above[x], below[x]);
    for (const float* line : {above, here, below}) {
      high = std::max(std::max(high, line[x - 1]), line[x + 1]);
      low = std::min(std::min(low, line[x - 1]), line[x + 1]);
    }
    const float value = here[x];
    const int32_t is_high =
        static_cast<int32_t>(value > least) & static_cast<int32_t>(value >= high);
    const int32_t is_low =
        static_cast<int32_t>(value < -least) & static_cast<int32_t>(value <= low);
    mark[x] = is_high | is_low;
  }
}

void FindExtremaInRow(const Octave& octave,
                      int level,
                      int row,
                      const FeatureOptions& options,
                      std::vector<int32_t>& marks,
                      std::vector<Extremum>& found) {
  // Refinement may raise |D|; what is below half cannot reach the threshold.
  const float least =
      0.5f * options.contrast_threshold / static_cast<float>(options.scales_per_octave);
  const cv::Mat& difference = octave.differences[level];
  const float* values = difference.ptr<float>(row);
  const int end = difference.cols - kBorder;
  MarkPeaks(difference, row, kBorder, end, least, marks);
  for (int x = kBorder; x < end; ++x) {
    if (marks[x] != 0 && IsLargest(octave, level, row, x, values[x] > 0.0f ? 1.0f : -1.0f)) {
      if (const auto extremum = Refine(octave, level, row, x, options)) {
        found.push_back(*extremum);
      }
    }
  }
}

// All extrema in order of octave, level, row, column, each once.
std::vector<Extremum> FindExtrema(std::span<const Octave> octaves, const FeatureOptions& options) {
  struct Job {
    int octave;
    int level;
    int row;
    std::vector<Extremum> found;
  };
  constexpr int kRowsPerJob = 32;
  std::vector<Job> jobs;
  for (int o = 0; o < static_cast<int>(octaves.size()); ++o) {
    for (int level = 1; level <= options.scales_per_octave; ++level) {
      const int end = octaves[o].differences[0].rows - kBorder;
      for (int row = kBorder; row < end; row += kRowsPerJob) {
        jobs.push_back({o, level, row, {}});
      }
    }
  }
  ParallelFor(jobs.size(), [&](size_t i) {
    Job& job = jobs[i];
    const Octave& octave = octaves[job.octave];
    const int end = std::min(job.row + kRowsPerJob, octave.differences[0].rows - kBorder);
    std::vector<int32_t> marks;
    for (int row = job.row; row < end; ++row) {
      FindExtremaInRow(octave, job.level, row, options, marks, job.found);
    }
    for (Extremum& e : job.found) {
      e.octave = job.octave;
    }
  });
  std::vector<Extremum> extrema;
  for (const Job& job : jobs) {
    extrema.insert(extrema.end(), job.found.begin(), job.found.end());
  }
  std::stable_sort(extrema.begin(), extrema.end(),
                   [](const Extremum& a, const Extremum& b) { return a.Cell() < b.Cell(); });
  // Walks from neighbouring samples can end on the same one.
  const auto same = [](const Extremum& a, const Extremum& b) { return a.Cell() == b.Cell(); };
  extrema.erase(std::unique(extrema.begin(), extrema.end(), same), extrema.end());
  return extrema;
}

// Keeps the count strongest in their order.
template <typename T, typename Response>
void KeepStrongest(std::vector<T>& items, int count, Response response) {
  if (count <= 0 || items.size() <= static_cast<size_t>(count)) {
    return;
  }
  std::vector<float> responses(items.size());
  std::transform(items.begin(), items.end(), responses.begin(), response);
  const auto nth = responses.begin() + (count - 1);
  std::nth_element(responses.begin(), nth, responses.end(), std::greater<>());
  const float least = *nth;
  const auto stronger = [&](const T& item) { return response(item) > least; };
  auto ties = count - std::count_if(items.begin(), items.end(), stronger);
  std::erase_if(items, [&](const T& item) {
    return !stronger(item) && (response(item) < least || ties-- <= 0);
  });
}

// ------------------------------------------------------------ gradients

// The angle of (x, y) in [0, 2 pi), to 1e-5 (Abramowitz & Stegun, "Handbook of
// Mathematical Functions", 4.4.49), in a form that compilers vectorise.
inline float Angle(float y, float x) {
  const float ax = std::abs(x);
  const float ay = std::abs(y);
  const float t = std::min(ax, ay) / (std::max(ax, ay) + 1e-30f);
  const float t2 = t * t;
  float angle = t * (0.9998660f +
                     t2 * (-0.3302995f + t2 * (0.1801410f + t2 * (-0.0851330f + t2 * 0.0208351f))));
  angle = ay > ax ? 0.25f * kTwoPi - angle : angle;
  angle = x < 0.0f ? 0.5f * kTwoPi - angle : angle;
  angle = y < 0.0f ? kTwoPi - angle : angle;
  return angle;
}

// Magnitudes and angles of the grey values' gradients in part of a row.
struct GradientRow {
  std::vector<float> magnitude;
  std::vector<float> angle;

  void Fill(const cv::Mat& image, int row, int begin, int end) {
    const float* above = image.ptr<float>(row - 1) + begin;
    const float* here = image.ptr<float>(row) + begin;
    const float* below = image.ptr<float>(row + 1) + begin;
    const int count = end - begin;
    if (static_cast<size_t>(count) > magnitude.size()) {
      magnitude.resize(count);
      angle.resize(count);
    }
    float* m = magnitude.data();
    float* a = angle.data();
    for (int i = 0; i < count; ++i) {
      const float dx = here[i + 1] - here[i - 1];
      const float dy = below[i] - above[i];
      m[i] = std::sqrt(dx * dx + dy * dy);
      a[i] = Angle(dy, dx);
    }
  }
};

// exp(-d^2 / (2 sigma^2)) of the distances from centre to begin, begin + 1, ...
void FillGaussian(float centre, float sigma, int begin, int end, std::vector<float>& weights) {
  weights.resize(std::max(end - begin, 0));
  for (int i = begin; i < end; ++i) {
    const float d = (static_cast<float>(i) - centre) / sigma;
    weights[i - begin] = std::exp(-0.5f * d * d);
  }
}

// Samples of part of a row in a descriptor's own axes.
struct SampleRow {
  std::vector<float> u;
  std::vector<float> v;
  std::vector<float> angle_bin;
  std::vector<float> weight;

  void Reserve(size_t count) {
    if (u.size() < count) {
      for (std::vector<float>* values : {&u, &v, &angle_bin, &weight}) {
        values->resize(count);
      }
    }
  }
};

// Working memory of one job.
struct Workspace {
  GradientRow gradients;
  SampleRow samples;
  std::vector<float> weights_x;
  std::vector<float> weights_y;
};

// Pixels of a square around (x, y) whose gradients exist.
struct Window {
  int x_begin, x_end, y_begin, y_end;

  Window(const cv::Mat& image, float x, float y, float radius)
      : x_begin(std::max(static_cast<int>(std::ceil(x - radius)), 1)),
        x_end(std::min(static_cast<int>(std::floor(x + radius)) + 1, image.cols - 1)),
        y_begin(std::max(static_cast<int>(std::ceil(y - radius)), 1)),
        y_end(std::min(static_cast<int>(std::floor(y + radius)) + 1, image.rows - 1)) {}
};

// ------------------------------------------------------------ orientation

constexpr int kOrientationBins = 36;
using OrientationHistogram = std::array<float, kOrientationBins>;

OrientationHistogram Histogram(const cv::Mat& image, const Extremum& e, Workspace& work) {
  const float sigma = 1.5f * e.sigma;
  const Window window(image, e.x, e.y, 3.0f * sigma);
  FillGaussian(e.x, sigma, window.x_begin, window.x_end, work.weights_x);
  FillGaussian(e.y, sigma, window.y_begin, window.y_end, work.weights_y);
  std::array<float, kOrientationBins + 1> sums{};
  for (int y = window.y_begin; y < window.y_end; ++y) {
    work.gradients.Fill(image, y, window.x_begin, window.x_end);
    const float weight = work.weights_y[y - window.y_begin];
    for (int i = 0; i < window.x_end - window.x_begin; ++i) {
      const int bin =
          static_cast<int>(work.gradients.angle[i] * (kOrientationBins / kTwoPi) + 0.5f);
      sums[bin] += weight * work.weights_x[i] * work.gradients.magnitude[i];
    }
  }
  sums[0] += sums[kOrientationBins];
  OrientationHistogram smooth;
  for (int i = 0; i < kOrientationBins; ++i) {
    const auto at = [&](int k) { return sums[(i + k + kOrientationBins) % kOrientationBins]; };
    smooth[i] = (at(-2) + at(2) + 4.0f * (at(-1) + at(1)) + 6.0f * at(0)) / 16.0f;
  }
  return smooth;
}

// One copy of the extremum for every peak of at least 0.8 of the highest.
void AddOrientations(const cv::Mat& image,
                     const Extremum& extremum,
                     Workspace& work,
                     std::vector<OrientedExtremum>& out) {
  const OrientationHistogram histogram = Histogram(image, extremum, work);
  const float least = 0.8f * *std::max_element(histogram.begin(), histogram.end());
  for (int i = 0; i < kOrientationBins; ++i) {
    const float left = histogram[(i + kOrientationBins - 1) % kOrientationBins];
    const float right = histogram[(i + 1) % kOrientationBins];
    const float here = histogram[i];
    if (here > 0.0f && here >= least && here > left && here >= right) {
      const float peak =
          static_cast<float>(i) + 0.5f * (left - right) / (left - 2.0f * here + right);
      float angle = peak * (kTwoPi / kOrientationBins);
      angle = angle < 0.0f ? angle + kTwoPi : angle;
      angle = angle >= kTwoPi ? angle - kTwoPi : angle;
      out.push_back({extremum, angle});
    }
  }
}

// ------------------------------------------------------------ descriptor

constexpr int kCells = 4;   // along each side
constexpr int kAngles = 8;  // for each cell

// One more cell on every side, and one more angle, catch the outer shares of
// the trilinear interpolation.
constexpr int kPaddedCells = kCells + 2;
constexpr int kPaddedAngles = kAngles + 1;
using PaddedHistogram = std::array<float, kPaddedCells * kPaddedCells * kPaddedAngles>;

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
  float* cell = &histogram[(iv * kPaddedCells + iu) * kPaddedAngles + (ia & (kAngles - 1))];
  const float below = weight * (1.0f - fv);
  const float above = weight * fv;
  const auto add = [fa](float* bin, float share) {
    bin[0] += share * (1.0f - fa);
    bin[1] += share * fa;
  };
  add(cell, below * (1.0f - fu));
  add(cell + kPaddedAngles, below * fu);
  add(cell + kPaddedCells * kPaddedAngles, above * (1.0f - fu));
  add(cell + (kPaddedCells + 1) * kPaddedAngles, above * fu);
}

PaddedHistogram Accumulate(const cv::Mat& image,
                           const OrientedExtremum& oriented,
                           Workspace& work) {
  const Extremum& e = oriented.extremum;
  const float cell_size = 3.0f * e.sigma;             // pixels
  constexpr float kReach = 0.5f * (kCells + 1);       // in cells, from the centre
  constexpr float kLastCell = kPaddedCells - 1.001f;  // largest u and v, exclusive
  const float cosine = std::cos(oriented.angle) / cell_size;
  const float sine = std::sin(oriented.angle) / cell_size;
  const Window window(image, e.x, e.y, std::numbers::sqrt2_v<float> * kReach * cell_size);
  constexpr float kSigmaInCells = 0.5f * kCells;
  FillGaussian(e.x, kSigmaInCells * cell_size, window.x_begin, window.x_end, work.weights_x);
  FillGaussian(e.y, kSigmaInCells * cell_size, window.y_begin, window.y_end, work.weights_y);

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
    work.gradients.Fill(image, y, begin, end);
    work.samples.Reserve(count);
    const float* magnitude = work.gradients.magnitude.data();
    const float* angle = work.gradients.angle.data();
    const float* weight_x = &work.weights_x[begin - window.x_begin];
    const float weight_y = work.weights_y[y - window.y_begin];
    float* u = work.samples.u.data();
    float* v = work.samples.v.data();
    float* angle_bin = work.samples.angle_bin.data();
    float* weight = work.samples.weight.data();
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
      const float* cell = &histogram[(v * kPaddedCells + u) * kPaddedAngles];
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

// ------------------------------------------------------------ all together

std::vector<OrientedExtremum> Orient(std::span<const Octave> octaves,
                                     const std::vector<Extremum>& extrema) {
  std::vector<std::vector<OrientedExtremum>> parts((extrema.size() + kKeypointsPerJob - 1) /
                                                   kKeypointsPerJob);
  ParallelFor(parts.size(), [&](size_t part) {
    Workspace work;
    const size_t end = std::min((part + 1) * kKeypointsPerJob, extrema.size());
    for (size_t i = part * kKeypointsPerJob; i < end; ++i) {
      const Extremum& e = extrema[i];
      AddOrientations(octaves[e.octave].gaussians[e.level], e, work, parts[part]);
    }
  });
  std::vector<OrientedExtremum> oriented;
  for (const auto& part : parts) {
    oriented.insert(oriented.end(), part.begin(), part.end());
  }
  return oriented;
}

Keypoint ToKeypoint(const Octave& octave, const OrientedExtremum& oriented) {
  const Extremum& e = oriented.extremum;
  return {octave.pixel_size * e.x + octave.origin, octave.pixel_size * e.y + octave.origin,
          octave.pixel_size * e.sigma, oriented.angle, e.response};
}

Features Describe(std::span<const Octave> octaves, const std::vector<OrientedExtremum>& oriented) {
  Features features;
  features.keypoints.resize(oriented.size());
  features.descriptors.resize(oriented.size());
  ParallelFor((oriented.size() + kKeypointsPerJob - 1) / kKeypointsPerJob, [&](size_t part) {
    Workspace work;
    const size_t end = std::min((part + 1) * kKeypointsPerJob, oriented.size());
    for (size_t i = part * kKeypointsPerJob; i < end; ++i) {
      const Octave& octave = octaves[oriented[i].extremum.octave];
      const cv::Mat& image = octave.gaussians[oriented[i].extremum.level];
      features.keypoints[i] = ToKeypoint(octave, oriented[i]);
      features.descriptors[i] = Quantised(Accumulate(image, oriented[i], work));
    }
  });
  return features;
}

}  // namespace

Status FeatureOptions::Validate() const {
  constexpr std::string_view kPlace = "feature options";
  if (first_octave < -1 || first_octave > 6) {
    return Status::Error(kPlace, "first_octave must lie between -1 and 6");
  }
  if (scales_per_octave < 1 || scales_per_octave > 16) {
    return Status::Error(kPlace, "scales_per_octave must lie between 1 and 16");
  }
  if (!(contrast_threshold >= 0.0f && contrast_threshold <= 1.0f)) {
    return Status::Error(kPlace, "contrast_threshold must lie between 0 and 1");
  }
  if (!(edge_threshold >= 1.0f && edge_threshold <= 1e6f)) {
    return Status::Error(kPlace, "edge_threshold must be at least 1");
  }
  if (max_features < 0) {
    return Status::Error(kPlace, "max_features must not be negative");
  }
  return Status();
}

FeatureExtractor::FeatureExtractor() : scale_space_(std::make_unique<ScaleSpace>()) {}
FeatureExtractor::~FeatureExtractor() = default;

Result<Features> FeatureExtractor::Extract(const cv::Mat& grey, const FeatureOptions& options) {
  LARARIUM_RETURN_IF_ERROR(options.Validate());
  if (grey.empty() || grey.type() != CV_8UC1) {
    return Status::Error("image for features", "must be grey with 8 bits for each pixel");
  }
  if (grey.cols > kMaxImageSide || grey.rows > kMaxImageSide) {
    return Status::Error("image for features", "is larger than 16384 pixels", "reduce it first");
  }
  scale_space_->Build(grey, options.first_octave, options.scales_per_octave);
  const std::span<const Octave> octaves = scale_space_->octaves();
  std::vector<Extremum> extrema = FindExtrema(octaves, options);
  // Every extremum has at least one orientation, so these are enough.
  KeepStrongest(extrema, options.max_features, [](const Extremum& e) { return e.response; });
  std::vector<OrientedExtremum> oriented = Orient(octaves, extrema);
  KeepStrongest(oriented, options.max_features,
                [](const OrientedExtremum& o) { return o.extremum.response; });
  return Describe(octaves, oriented);
}

Result<Features> ExtractFeatures(const cv::Mat& grey, const FeatureOptions& options) {
  return FeatureExtractor().Extract(grey, options);
}

}  // namespace lararium::vision
