#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "shared/core/status.h"

namespace lararium::editor {

// The last picture of a project's camera view, bgr, at most kProjectPictureWidth wide. It is stored
// outside the project, because it is not part of the user's work.
inline constexpr int kProjectPictureWidth = 480;  // Pixels.
std::optional<cv::Mat> LoadProjectPicture(const std::filesystem::path& project);
Status SaveProjectPicture(const std::filesystem::path& project, const cv::Mat& bgr);

}  // namespace lararium::editor
