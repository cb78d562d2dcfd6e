#include "shared/vision/extrema.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "shared/core/parallel.h"

namespace lararium::vision {
namespace {

constexpr int kBorder = 5;  // Octave pixels at the image border, where the blur is unreliable.
constexpr int kRowsPerJob = 32;

// Returns whether sign * value is largest at the centre of its 3 x 3 x 3 samples.
bool IsLargest(const Octave& octave, int level, int row, int column, float sign) {
  const float value = sign * octave.Difference(level, row, column);
  for (int l = level - 1; l <= level + 1; ++l) {
    for (int y = row - 1; y <= row + 1; ++y) {
      for (int x = column - 1; x <= column + 1; ++x) {
        if (sign * octave.Difference(l, y, x) > value) {
          return false;
        }
      }
    }
  }
  return true;
}

struct Quadratic {
  Eigen::Vector3f gradient;  // x, y, level
  Eigen::Matrix3f hessian;
};

// Second-order Taylor expansion of the difference of Gaussians around a sample (Brown & Lowe,
// "Invariant features from interest point groups", BMVC 2002).
Quadratic QuadraticAt(const Octave& octave, int level, int row, int column) {
  const auto at = [&](int dx, int dy, int dl) {
    return octave.Difference(level + dl, row + dy, column + dx);
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
  return level >= 1 && level < octave.difference_levels() - 1 && row >= kBorder &&
         row < octave.rows() - kBorder && column >= kBorder && column < octave.columns() - kBorder;
}

bool LooksLikeEdge(const Quadratic& q, float edge_threshold) {
  const float trace = q.hessian(0, 0) + q.hessian(1, 1);
  const float determinant = q.hessian.topLeftCorner<2, 2>().determinant();
  const float ratio = edge_threshold + 1.0f;
  return determinant <= 0.0f || trace * trace * edge_threshold >= ratio * ratio * determinant;
}

// Moves to the peak of the quadratic. nullopt if the extremum is weak, lies on an edge, or turns
// out to be none.
std::optional<Extremum> Refine(
    const Octave& octave, int level, int row, int column, const FeatureOptions& options) {
  constexpr int kMaxSteps = 5;
  // More than half a sample, so that the search does not alternate between two samples.
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
    const float value = octave.Difference(level, row, column) + 0.5f * q.gradient.dot(offset);
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

// Computes one row of a difference level.
void FillRow(const Octave& octave, int level, int row, std::vector<float>& differences) {
  const float* finer = octave.gaussians[level].ptr<float>(row);
  const float* coarser = octave.gaussians[level + 1].ptr<float>(row);
  differences.resize(static_cast<size_t>(octave.columns()));
  for (size_t x = 0; x < differences.size(); ++x) {
    differences[x] = coarser[x] - finer[x];
  }
}

// Marks the samples of the middle row whose absolute value exceeds least and which are the largest
// or smallest among their 3 x 3 neighbours in the level. The neighbouring levels are checked later,
// for the few marked samples only.
void MarkPeaks(const float* above,
               const float* here,
               const float* below,
               int begin,
               int end,
               float least,
               int32_t* mark) {
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

// Appends the extrema of one level of an octave in the rows [begin, end).
void FindExtremaInRows(const Octave& octave,
                       int level,
                       int begin,
                       int end,
                       const FeatureOptions& options,
                       ExtremaRows& memory,
                       std::vector<Extremum>& found) {
  // Refinement may raise |D|, but not from below half the threshold.
  const float least =
      0.5f * options.contrast_threshold / static_cast<float>(options.scales_per_octave);
  auto& [above, here, below] = memory.differences;
  memory.marks.resize(static_cast<size_t>(octave.columns()));
  FillRow(octave, level, begin - 1, here);
  FillRow(octave, level, begin, below);
  for (int row = begin; row < end; ++row) {
    std::swap(above, here);
    std::swap(here, below);
    FillRow(octave, level, row + 1, below);
    const int last = octave.columns() - kBorder;
    MarkPeaks(above.data(), here.data(), below.data(), kBorder, last, least, memory.marks.data());
    for (int x = kBorder; x < last; ++x) {
      if (memory.marks[x] != 0 && IsLargest(octave, level, row, x, here[x] > 0.0f ? 1.0f : -1.0f)) {
        if (const auto extremum = Refine(octave, level, row, x, options)) {
          found.push_back(*extremum);
        }
      }
    }
  }
}

}  // namespace

void ExtremaFinder::RunJob(std::span<const Octave> octaves,
                           const FeatureOptions& options,
                           Job& job) {
  const Octave& octave = octaves[job.octave];
  const int end = std::min(job.row + kRowsPerJob, octave.rows() - kBorder);
  job.found.clear();
  FindExtremaInRows(octave, job.level, job.row, end, options, job.rows, job.found);
  for (Extremum& extremum : job.found) {
    extremum.octave = job.octave;
  }
}

void ExtremaFinder::Find(std::span<const Octave> octaves,
                         const FeatureOptions& options,
                         std::vector<Extremum>& extrema) {
  size_t count = 0;
  for (int o = 0; o < static_cast<int>(octaves.size()); ++o) {
    for (int level = 1; level <= options.scales_per_octave; ++level) {
      const int end = octaves[o].rows() - kBorder;
      for (int row = kBorder; row < end; row += kRowsPerJob) {
        jobs_.resize(std::max(jobs_.size(), count + 1));
        Job& job = jobs_[count++];
        job.octave = o;
        job.level = level;
        job.row = row;
      }
    }
  }
  ParallelFor(count, [&](size_t i) { RunJob(octaves, options, jobs_[i]); });
  extrema.clear();
  for (size_t i = 0; i < count; ++i) {
    extrema.insert(extrema.end(), jobs_[i].found.begin(), jobs_[i].found.end());
  }
  // Refinements from neighbouring samples can end at the same sample, with equal results.
  std::sort(extrema.begin(), extrema.end(),
            [](const Extremum& a, const Extremum& b) { return a.Cell() < b.Cell(); });
  const auto same = [](const Extremum& a, const Extremum& b) { return a.Cell() == b.Cell(); };
  extrema.erase(std::unique(extrema.begin(), extrema.end(), same), extrema.end());
}

}  // namespace lararium::vision
