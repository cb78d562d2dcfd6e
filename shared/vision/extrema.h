#pragma once

// Extrema of the difference of Gaussians: Lowe, IJCV 2004, sections 3.1 and 4.

#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "shared/vision/features.h"
#include "shared/vision/scale_space.h"

namespace lararium::vision {

// Refined to a fraction of a sample in place and scale.
struct Extremum {
  int octave = 0;
  int level = 0;
  int row = 0;
  int column = 0;
  float x = 0.0f;         // octave pixels
  float y = 0.0f;         // octave pixels
  float sigma = 0.0f;     // octave pixels
  float response = 0.0f;  // |D|, grey 0..1

  // The sample that is nearest; no two extrema share it.
  auto Cell() const { return std::tie(octave, level, row, column); }
};

// Of a level, while its rows are searched: three rows of differences, and which samples of the
// middle one may be extrema.
struct ExtremaRows {
  std::array<std::vector<float>, 3> differences;
  std::vector<int32_t> marks;
};

// Keeps its memory from image to image.
class ExtremaFinder {
 public:
  // All extrema that pass the options' thresholds, in order of their cells.
  void Find(std::span<const Octave> octaves,
            const FeatureOptions& options,
            std::vector<Extremum>& extrema);

 private:
  // Some rows of a level.
  struct Job {
    int octave = 0;
    int level = 0;
    int row = 0;
    ExtremaRows rows;
    std::vector<Extremum> found;
  };
  void RunJob(std::span<const Octave> octaves, const FeatureOptions& options, Job& job);

  std::vector<Job> jobs_;
};

}  // namespace lararium::vision
