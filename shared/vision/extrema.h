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

// An extremum, refined to sub-sample accuracy in position and scale.
struct Extremum {
  int octave = 0;
  int level = 0;
  int row = 0;
  int column = 0;
  float x = 0.0f;         // octave pixels
  float y = 0.0f;         // octave pixels
  float sigma = 0.0f;     // octave pixels
  float response = 0.0f;  // |D|, grey 0..1

  // The nearest sample. No two extrema share one.
  auto Cell() const { return std::tie(octave, level, row, column); }
};

// Working memory while the rows of a level are searched: three adjacent rows of differences, and
// for each sample of the middle row whether it may be an extremum.
struct ExtremaRows {
  std::array<std::vector<float>, 3> differences;
  std::vector<int32_t> marks;
};

// Reuses its memory from image to image.
class ExtremaFinder {
 public:
  // Finds all extrema that pass the options' thresholds, ordered by Extremum::Cell.
  void Find(std::span<const Octave> octaves,
            const FeatureOptions& options,
            std::vector<Extremum>& extrema);

 private:
  // A block of rows of one level.
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
