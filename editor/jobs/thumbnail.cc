#include "editor/jobs/thumbnail.h"

#include <string>

#include "shared/core/file.h"
#include "shared/image/decode.h"
#include "shared/image/encode.h"

namespace lararium::editor {
namespace {

namespace fs = std::filesystem;

// Part of every key. Increase it when a change of the code gives another picture of the same
// person.
constexpr std::string_view kVersion = "thumbnail 2 ";
constexpr size_t kMaxKeyBytes = 1024;

fs::path KeyFile(fs::path file) { return file += ".from"; }

// The hash of the person's inputs; nullopt where the baked person has no hash file.
std::optional<std::string> Key(const fs::path& human) {
  const Result<std::string> baked_from = ReadText(KeyFile(human), kMaxKeyBytes);
  return baked_from.ok() ? std::optional(std::string(kVersion) + *baked_from) : std::nullopt;
}

}  // namespace

fs::path ThumbnailFile(const fs::path& human) {
  return human.parent_path() / (human.stem().string() + ".thumbnail.png");
}

std::optional<cv::Mat> LoadThumbnail(const fs::path& human) {
  const fs::path file = ThumbnailFile(human);
  const std::optional<std::string> wanted = Key(human);
  const Result<std::string> known = ReadText(KeyFile(file), kMaxKeyBytes);
  if (!wanted || !known.ok() || *known != *wanted) {
    return std::nullopt;
  }
  auto picture = image::ReadImage(file, image::Channels::kBgr);
  const bool whole = picture.ok() && picture->size() == cv::Size(kThumbnailSide, kThumbnailSide);
  return whole ? std::optional(std::move(*picture)) : std::nullopt;
}

Result<cv::Mat> MakeThumbnail(const fs::path& human, Studio& studio) {
  LARARIUM_ASSIGN_OR_RETURN(StudioShot shot,
                            studio.Shoot({.azimuth = 0.3f, .frame = StudioFrame::kBust},
                                         cv::Size(kThumbnailSide, kThumbnailSide)));
  const fs::path file = ThumbnailFile(human);
  LARARIUM_RETURN_IF_ERROR(image::WriteImage(file, shot.picture));
  if (const std::optional<std::string> key = Key(human)) {
    LARARIUM_RETURN_IF_ERROR(WriteFileAtomically(KeyFile(file), std::string_view(*key)));
  }
  return std::move(shot.picture);
}

Status LeaveThumbnail(const fs::path& file, const human::Human& human) {
  if (LoadThumbnail(file)) {
    return Status();
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<Studio> studio, Studio::Create());
  LARARIUM_RETURN_IF_ERROR(
      studio->Seat(std::make_shared<const human::Human>(human), CalmPose(human)));
  return MakeThumbnail(file, *studio).status();
}

}  // namespace lararium::editor
