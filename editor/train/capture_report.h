#pragma once

// The capture report: how well a place was filmed, and what to film next, as one
// HTML page for people.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "editor/train/trainer.h"
#include "shared/capture/frame_source.h"
#include "shared/core/status.h"
#include "shared/vision/scene_database.h"

namespace lararium::train {

struct CaptureReportOptions {
  std::string title = {};                      // the place's name
  std::string source = {};                     // what was filmed: a file name
  std::optional<double> metres_per_unit = {};  // of the map, where the stage has fixed it
  uint64_t database_bytes = 0;                 // of the .larscene; 0 leaves it out
  // The image of a frame of the source (BGR or grey), or an empty one. Without it,
  // pictures come from the keyframes.
  std::function<cv::Mat(int64_t frame_index)> frame_image = {};
};

// frame_image from the source that was trained on; borrows it.
std::function<cv::Mat(int64_t)> FrameImagesOf(capture::FrameSource& source);

// The page: everything within (styles, drawings, pictures as data URIs), no
// scripts, nothing fetched. The same input gives the same bytes. Numbers carry
// data- attributes with their names, so that programs can read them back.
std::string FormatCaptureReport(const TrainReport& report,
                                const vision::SceneDatabase& database,
                                const CaptureReportOptions& options);

Status WriteCaptureReport(const TrainReport& report,
                          const vision::SceneDatabase& database,
                          const std::filesystem::path& file,
                          const CaptureReportOptions& options);

}  // namespace lararium::train
