#pragma once

// The capture report: an HTML page that shows how well a place was filmed and what to film next.

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
  std::string title = {};                      // Name of the place.
  std::string source = {};                     // File name of the recording.
  std::optional<double> metres_per_unit = {};  // Scale of the map, if the stage has fixed it.
  uint64_t database_bytes = 0;                 // Size of the .larscene file; 0 leaves it out.
  // Returns the image of a frame of the source (BGR or grey), or an empty one. Without this
  // function, pictures come from the keyframes.
  std::function<cv::Mat(int64_t frame_index)> frame_image = {};
};

// Makes a CaptureReportOptions::frame_image that reads the trained source. The source must outlive
// it.
std::function<cv::Mat(int64_t)> FrameImagesOf(capture::FrameSource& source);

// Formats the page. It is self-contained (styles, drawings, pictures as data URIs), has no scripts
// and fetches nothing. The same input gives the same bytes. Numbers carry data- attributes with
// their names, so that programs can read them.
std::string FormatCaptureReport(const TrainReport& report,
                                const vision::SceneDatabase& database,
                                const CaptureReportOptions& options);

Status WriteCaptureReport(const TrainReport& report,
                          const vision::SceneDatabase& database,
                          const std::filesystem::path& file,
                          const CaptureReportOptions& options);

}  // namespace lararium::train
