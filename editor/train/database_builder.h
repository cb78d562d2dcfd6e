#pragma once

// From a finished reconstruction to the scene database.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "editor/train/reconstruction.h"
#include "shared/geometry/frame.h"
#include "shared/vision/scene_database.h"

namespace lararium::train {

// An image of the reconstruction.
struct TrainingImage {
  int64_t frame_index = -1;
  std::string name;
  cv::Mat bgr;   // CV_8UC3, as geometry::Frame
  cv::Mat grey;  // CV_8UC1, the same image
  vision::Features features;
};

struct DatabaseOptions {
  int max_points = 60'000;
  int max_descriptors_per_point = 6;
  uint32_t session = 0;
  uint64_t seed = 1;
};

// So near to one another that a map needs but one of them.
bool LookAlike(const vision::Descriptor& a, const vision::Descriptor& b);

// Adds candidates to chosen until it has max_count: the most central one where it
// was empty, then always the one farthest from those chosen, until the rest is
// near to one of them. max_count > 0.
void AddDistinctDescriptors(std::span<const vision::Descriptor> candidates,
                            size_t max_count,
                            std::vector<vision::Descriptor>& chosen);

// images[i] is image i of the reconstruction. Where there are more points than
// max_points, budget.h's ChoosePoints says which stay.
vision::SceneDatabase BuildDatabase(const Reconstruction& reconstruction,
                                    std::span<const TrainingImage> images,
                                    const DatabaseOptions& options);

}  // namespace lararium::train
