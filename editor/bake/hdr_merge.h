#pragma once

// One image of high dynamic range from photographs of one view with several exposures
// (Debevec & Malik, SIGGRAPH 1997), and the camera's response with it.

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/light/camera_response.h"

namespace lararium::bake {

struct Bracket {
  std::string name;       // what errors call it
  cv::Mat bgr;            // CV_8UC3
  double exposure = 0.0;  // seconds, or anything in proportion to the light let in
};

// Two to 32 photographs of one size and view with exposures that differ.
Status Validate(std::span<const Bracket> brackets);

// Reads photographs. exposures: as many, or empty: from the EXIF data. Camera and
// light must not have moved between them.
Result<std::vector<Bracket>> ReadBrackets(std::span<const std::filesystem::path> files,
                                          std::span<const double> exposures);

struct CalibratedResponse {
  light::CameraResponse response;
  // Of radiances that two photographs both show well (bytes 16 to 240), the root mean square
  // difference of natural logarithms: how far the exposures agree.
  double residual = 0.0;
};

// From a grid of pixels, made to rise. Bytes below 16 and above 250 are told from few.
Result<CalibratedResponse> CalibrateResponse(std::span<const Bracket> brackets);

struct MergedImage {
  cv::Mat linear;         // CV_32FC3, R, G, B: response's unit for one unit of exposure
  size_t clipped = 0;     // pixels that are white even in the shortest exposure
  size_t unexposed = 0;   // black even in the longest
  double residual = 0.0;  // as above
};

// Each channel by itself: the mean over the photographs that show it, weighted by trust in
// its byte and by exposure (Robertson, Borman & Stevenson, ICIP 1999). What is clipped in all
// photographs gets the least radiance that the shortest allows.
Result<MergedImage> MergeBrackets(std::span<const Bracket> brackets,
                                  const light::CameraResponse& response);

}  // namespace lararium::bake
