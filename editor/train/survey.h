#pragma once

// Reads a source for training: lists its frames, measures the motion of the camera, and selects the
// keyframes.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "editor/train/database_builder.h"
#include "editor/train/keyframes.h"
#include "shared/capture/frame_source.h"
#include "shared/core/log.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::train {

struct SurveyedFrame {
  int64_t index = -1;
  std::string name;   // See FrameSource::FrameName.
  double time = 0.0;  // Counted in frame times: the median time between two frames of the source.
  FrameMotion motion;
};

struct Survey {
  std::vector<SurveyedFrame> frames;     // All frames of the source.
  std::vector<TrainingImage> keyframes;  // The selected images, without features.
};

// Reads source from its start; twice if it has more than max_keyframes frames. Single frames that
// cannot be read are skipped with a warning.
Result<Survey> SurveySource(capture::FrameSource& source,
                            int max_keyframes,
                            Progress& progress,
                            Log& log);

// An image with fewer features than this is rarely located.
inline constexpr size_t kFewFeatures = 150;

// Fills in the features of images, on all cores. Fails if most images have too few features.
Status ExtractFeatures(std::span<TrainingImage> images, int max_features, Progress& progress);

// Reads source once more and calls visit with batches of all frames except the keyframes. visit may
// use all cores.
Status ForOtherFrames(capture::FrameSource& source,
                      const Survey& survey,
                      Progress& progress,
                      Log& log,
                      const std::function<void(std::span<const geometry::Frame>)>& visit);

}  // namespace lararium::train
