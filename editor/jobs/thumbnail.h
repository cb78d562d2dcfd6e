#pragma once

// Small pictures of people, stored beside the baked person: NAME.thumbnail.png.
// NAME.thumbnail.png.from holds the hash of the person that the picture shows.

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "editor/jobs/studio.h"
#include "shared/core/status.h"
#include "shared/human/human.h"

namespace lararium::editor {

inline constexpr int kThumbnailSide = 192;  // Pixels.

// The path of the picture. human: the person's .larhuman.
std::filesystem::path ThumbnailFile(const std::filesystem::path& human);

// Bgr. nullopt where there is no picture, or where the person was baked again since.
std::optional<cv::Mat> LoadThumbnail(const std::filesystem::path& human);

// Takes a picture of head and shoulders of the person in the studio, who was loaded from that file.
Result<cv::Mat> MakeThumbnail(const std::filesystem::path& human, Studio& studio);

// Makes the picture, in a temporary studio, where it is missing or stale.
Status LeaveThumbnail(const std::filesystem::path& file, const human::Human& human);

}  // namespace lararium::editor
