#include "editor/session/project_picture.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <span>
#include <string>
#include <system_error>

#include "editor/document/project_paths.h"
#include "editor/document/user_folders.h"
#include "shared/bundle/sha256.h"
#include "shared/image/decode.h"
#include "shared/image/encode.h"

namespace lararium::editor {
namespace {

namespace fs = std::filesystem;

fs::path PictureFile(const fs::path& project) {
  const std::string name = NormalFolder(project).string();
  return CacheFolder() / "projects" /
         (bundle::FormatSha256(bundle::ComputeSha256(std::as_bytes(std::span(name)))) + ".png");
}

}  // namespace

std::optional<cv::Mat> LoadProjectPicture(const fs::path& project) {
  auto picture = image::ReadImage(PictureFile(project), image::Channels::kBgr);
  const bool fits = picture.ok() && picture->cols <= kProjectPictureWidth;
  return fits ? std::optional(std::move(*picture)) : std::nullopt;
}

Status SaveProjectPicture(const fs::path& project, const cv::Mat& bgr) {
  cv::Mat small = bgr;
  if (bgr.cols > kProjectPictureWidth) {
    const double scale = static_cast<double>(kProjectPictureWidth) / bgr.cols;
    cv::resize(bgr, small, cv::Size(kProjectPictureWidth, std::max(1, cvRound(bgr.rows * scale))),
               0, 0, cv::INTER_AREA);
  }
  const fs::path file = PictureFile(project);
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  return image::WriteImage(file, small);
}

}  // namespace lararium::editor
