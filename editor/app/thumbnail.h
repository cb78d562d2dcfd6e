#pragma once

// Small pictures of people, kept beside the baked person: NAME.thumbnail.png, with the
// hash of what it was made from in NAME.thumbnail.png.from.

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "editor/app/studio.h"
#include "shared/core/status.h"
#include "shared/human/human.h"

namespace lararium::app {

inline constexpr int kThumbnailSide = 192;  // pixels

// human: the person's .larhuman.
std::filesystem::path ThumbnailFile(const std::filesystem::path& human);

// bgr. Nothing where there is none, or where the person was baked anew since.
std::optional<cv::Mat> LoadThumbnail(const std::filesystem::path& human);

// Head and shoulders of whoever sits in the studio, who was loaded from that file.
Result<cv::Mat> MakeThumbnail(const std::filesystem::path& human, Studio& studio);

// Makes it in a studio of its own where it is missing or stale.
Status LeaveThumbnail(const std::filesystem::path& file, const human::Human& human);

}  // namespace lararium::app
