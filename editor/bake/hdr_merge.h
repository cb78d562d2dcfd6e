#pragma once

// Merges photographs of one view at several exposures into one HDR image and calibrates the
// response of the camera from them (Debevec & Malik, SIGGRAPH 1997).

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/light/camera_response.h"

namespace lararium::bake {

struct Bracket {
  std::string name;       // Names the photograph in errors.
  cv::Mat bgr;            // CV_8UC3
  double exposure = 0.0;  // Seconds, or any value in proportion to the light admitted.
};

// Requires two to 32 photographs of the same size and view with different exposures.
Status Validate(std::span<const Bracket> brackets);

// Reads photographs of one view; neither the camera nor the light may have changed between
// them. `exposures` has one entry for each file, or is empty, and the EXIF data are used.
Result<std::vector<Bracket>> ReadBrackets(std::span<const std::filesystem::path> files,
                                          std::span<const double> exposures);

struct CalibratedResponse {
  light::CameraResponse response;
  // RMS difference of the natural logarithms of radiance over pixels that two photographs both
  // show well (bytes 16 to 240). It says how well the exposures agree.
  double residual = 0.0;
};

// Calibrates from a grid of pixels and forces the curve to rise. Few samples support bytes
// below 16 and above 250.
Result<CalibratedResponse> CalibrateResponse(std::span<const Bracket> brackets);

struct MergedImage {
  cv::Mat linear;         // CV_32FC3, R, G, B; the unit of the response per unit of exposure.
  size_t clipped = 0;     // Pixels that are white even in the shortest exposure.
  size_t unexposed = 0;   // Pixels that are black even in the longest exposure.
  double residual = 0.0;  // See CalibratedResponse::residual.
};

// Merges each channel separately: the mean over the photographs that show a pixel, weighted by
// the reliability of its byte and by exposure (Robertson, Borman & Stevenson, ICIP 1999). A
// pixel that is clipped in all photographs gets the least radiance that clips in the shortest.
Result<MergedImage> MergeBrackets(std::span<const Bracket> brackets,
                                  const light::CameraResponse& response);

}  // namespace lararium::bake
