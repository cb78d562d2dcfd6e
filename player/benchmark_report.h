#pragma once

// The benchmark's figures, for people and for programs.

#include <cstdio>
#include <string>
#include <vector>

#include "player/benchmark_evaluation.h"
#include "shared/core/json.h"

namespace lararium::player {

struct SequenceReport {
  std::string name;
  SequenceScore score;
};

// Images of another place: each pose is a false accept.
struct ForeignReport {
  std::string name;
  size_t frames = 0;
  // Shown to a tracker that searches.
  std::vector<std::string> accepted;  // names of frames
  // Shown, cut to the show's image size, to a tracker that has just had a pose.
  size_t cuts = 0;
  std::vector<std::string> accepted_after_cut;
  size_t back_after_cut = 0;  // of the cuts: the next image of the place had a pose at once
};

struct BenchmarkReport {
  std::string show;
  std::string mode;       // how the tracker ran
  std::string smoothing;  // "off", "soft", "strong"
  int threads = 0;        // 0: as many as cores
  std::vector<SequenceReport> sequences;
  std::vector<ForeignReport> foreign;

  Json ToJson() const;
};

void PrintBenchmark(const BenchmarkReport& report, std::FILE* out);

}  // namespace lararium::player
