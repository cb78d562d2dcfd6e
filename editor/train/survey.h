#pragma once

// Reads a source for training: which frames it has, how the camera moves, and
// the images that shape the map.

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
  std::string name;  // as FrameSource::FrameName
  FrameMotion motion;
};

struct Survey {
  std::vector<SurveyedFrame> frames;     // all of the source
  std::vector<TrainingImage> keyframes;  // the chosen ones, without features
};

// Reads source from its start, twice where it has more than max_keyframes
// frames. Single frames that cannot be read are skipped with a warning.
Result<Survey> SurveySource(capture::FrameSource& source,
                            int max_keyframes,
                            Progress& progress,
                            Log& log);

// Fewer features than this rarely locate an image.
inline constexpr size_t kFewFeatures = 150;

// Fills in the features of images, on all cores. An error where most images
// have too few.
Status ExtractFeatures(std::span<TrainingImage> images, int max_features, Progress& progress);

// Reads source once more and hands over all frames but the keyframes, a batch
// after another; visit may use all cores.
Status ForOtherFrames(capture::FrameSource& source,
                      const Survey& survey,
                      Progress& progress,
                      Log& log,
                      const std::function<void(std::span<const geometry::Frame>)>& visit);

}  // namespace lararium::train
