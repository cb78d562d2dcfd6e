#pragma once

// Builds the scene database from a finished reconstruction.

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
  uint32_t camera = 0;  // See FrameSource::CameraOf.
  cv::Rect area;        // See SourceCamera::area; empty if all of the image shows something.
  cv::Mat bgr;          // CV_8UC3, see geometry::Frame.
  cv::Mat grey;         // CV_8UC1, the same image.
  vision::Features features;
};

struct DatabaseOptions {
  int max_points = 60'000;
  int max_descriptors_per_point = 6;
  uint32_t session = 0;
  uint64_t seed = 1;
};

// Returns whether two descriptors are so similar that a map needs only one of them.
bool LookAlike(const vision::Descriptor& a, const vision::Descriptor& b);

// Adds candidates to chosen until it has max_count, or until every other candidate is similar to a
// chosen one. Begins with the most central candidate if chosen is empty, then always takes the one
// farthest from those chosen. max_count > 0.
void AddDistinctDescriptors(std::span<const vision::Descriptor> candidates,
                            size_t max_count,
                            std::vector<vision::Descriptor>& chosen);

// images[i] is image i of the reconstruction. If there are more than max_points points,
// ChoosePoints (budget.h) selects those that stay.
vision::SceneDatabase BuildDatabase(const Reconstruction& reconstruction,
                                    std::span<const TrainingImage> images,
                                    const DatabaseOptions& options);

}  // namespace lararium::train
