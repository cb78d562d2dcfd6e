#pragma once

// The results of the benchmark, as a table for people and as JSON for programs.

#include <cstdio>
#include <string>
#include <vector>

#include "player/benchmark/benchmark_evaluation.h"
#include "shared/core/json.h"

namespace lararium::player {

struct SequenceReport {
  std::string name;
  SequenceScore score;
};

// Results for images of another place, where each pose is a false accept.
struct ForeignReport {
  std::string name;
  size_t frames = 0;
  // Names of frames in which a searching tracker found a pose.
  std::vector<std::string> accepted;
  // Cuts: images of the other place, scaled and cropped to the show's image size, for a tracker
  // that had a pose in the frame before.
  size_t cuts = 0;
  std::vector<std::string> accepted_after_cut;  // names of the images in which it found a pose
  size_t back_after_cut = 0;  // number of cuts after which the next image of the place had a pose
};

struct BenchmarkReport {
  std::string show;
  std::string mode;       // how the tracker was run
  std::string smoothing;  // "off", "soft", "strong"
  int threads = 0;        // 0: one for each core
  std::vector<SequenceReport> sequences;
  std::vector<ForeignReport> foreign;

  Json ToJson() const;
};

void PrintBenchmark(const BenchmarkReport& report, std::FILE* out);

}  // namespace lararium::player
