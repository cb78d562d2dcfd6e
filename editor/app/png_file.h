#pragma once

// Small pictures that the editor keeps for itself.

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "shared/core/status.h"

namespace lararium::app {

// bgr. Nothing where the file is not there, is no picture, or is larger than 1 MiB.
std::optional<cv::Mat> LoadPng(const std::filesystem::path& file);
Status SavePng(const std::filesystem::path& file, const cv::Mat& bgr);

}  // namespace lararium::app
