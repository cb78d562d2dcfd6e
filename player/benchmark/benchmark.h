#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "shared/core/log.h"
#include "shared/core/status.h"
#include "shared/vision/pose_smoother.h"

namespace lararium::player {

struct BenchmarkOptions {
  std::filesystem::path show;
  std::string place;                           // Place of the bundle; empty: all places.
  std::filesystem::path sequences;             // Folder of sequences with ground truth.
  std::vector<std::filesystem::path> foreign;  // Images of other places.
  bool first_pose = false;                     // Relocalise in every frame.
  bool unknown_lens = false;                   // Do not tell the tracker the intrinsics.
  int64_t frames = 0;                          // Number of frames of each sequence; 0: all.
  int threads = 0;                             // 0: one for each core.
  uint64_t seed = 1;
  vision::Smoothing smoothing = vision::Smoothing::kSoft;
  std::filesystem::path poses_out;
  std::filesystem::path stats_out;
};

// Runs the tracker on sequences with ground truth and on images of other places, and prints its
// errors and times on stdout. Every frame is tracked once, in order; the times do not include
// reading and decoding images.
Status Benchmark(const BenchmarkOptions& options, Log& log);

}  // namespace lararium::player
