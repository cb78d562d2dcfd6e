#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <span>
#include <vector>

#include "shared/capture/exif.h"
#include "shared/capture/frame_source.h"
#include "shared/core/file.h"
#include "shared/core/lower_case.h"
#include "shared/core/parallel.h"
#include "shared/image/decode.h"
#include "shared/image/image_header.h"

namespace lararium::capture {
namespace {

using geometry::Frame;

constexpr double kFramesPerSecond = 30.0;

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// Skips leading zeros and returns the digits up to the end of the number.
std::string_view NumberAt(std::string_view text, size_t& position) {
  while (position + 1 < text.size() && text[position] == '0' && IsDigit(text[position + 1])) {
    ++position;
  }
  const size_t begin = position;
  while (position < text.size() && IsDigit(text[position])) {
    ++position;
  }
  return text.substr(begin, position - begin);
}

// Compares names with numbers by value: 2 before 10.
bool NaturalLess(std::string_view a, std::string_view b) {
  size_t i = 0;
  size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (IsDigit(a[i]) && IsDigit(b[j])) {
      const std::string_view m = NumberAt(a, i);
      const std::string_view n = NumberAt(b, j);
      if (m != n) {
        return m.size() != n.size() ? m.size() < n.size() : m < n;
      }
    } else if (a[i] != b[j]) {
      return a[i] < b[j];
    } else {
      ++i;
      ++j;
    }
  }
  const size_t rest_a = a.size() - i;
  const size_t rest_b = b.size() - j;
  return rest_a != rest_b ? rest_a < rest_b : a < b;
}

bool IsImageName(const std::filesystem::path& name) {
  const std::string extension = LowerCase(name.extension().string());
  const std::span<const char* const> known = ImageExtensions();
  return std::find(known.begin(), known.end(), extension) != known.end();
}

std::string SizeText(cv::Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

double Diagonal(cv::Size size) { return std::hypot(size.width, size.height); }

// The size and the camera of an image, as its file tells them without being decoded if possible.
struct ImageTraits {
  cv::Size size;  // Empty if the image cannot be read.
  std::string camera;
  std::optional<uint32_t> focal_in_35mm_film;

  friend bool SameCamera(const ImageTraits& a, const ImageTraits& b) {
    return a.size == b.size && a.camera == b.camera;
  }
};

ImageTraits TraitsOf(const std::filesystem::path& file) {
  ImageTraits traits;
  const Result<MappedFile> mapped = MappedFile::Open(file);
  if (!mapped.ok()) {
    return traits;
  }
  if (const auto header = image::ReadImageHeader(mapped->bytes())) {
    constexpr uint32_t kLargest = 1u << 20;
    if (header->width > 0 && header->width < kLargest && header->height > 0 &&
        header->height < kLargest) {
      traits.size = {static_cast<int>(header->width), static_cast<int>(header->height)};
    }
  } else if (const auto decoded = image::ReadImage(file, image::Channels::kGrey); decoded.ok()) {
    traits.size = decoded->size();
  }
  traits.camera = FindCameraName(mapped->bytes());
  traits.focal_in_35mm_film = FindFocalLengthIn35mmFilm(mapped->bytes());
  return traits;
}

// The cameras of a folder's images, and how their images lie in frames of one size.
struct FolderLayout {
  cv::Size frame;
  std::vector<SourceCamera> cameras;
  std::vector<size_t> camera_of_image;
};

// Returns nullopt if no image can be read.
std::optional<FolderLayout> LayOut(std::span<const ImageTraits> images) {
  FolderLayout layout;
  std::vector<ImageTraits> cameras;
  std::vector<size_t> counts;
  for (const ImageTraits& image : images) {
    const auto known = std::find_if(cameras.begin(), cameras.end(), [&](const ImageTraits& camera) {
      return SameCamera(image, camera);
    });
    const auto camera = static_cast<size_t>(known - cameras.begin());
    if (known == cameras.end() && !image.size.empty()) {
      cameras.push_back(image);
      counts.push_back(0);
    }
    // Reading the image will fail, so its camera does not matter.
    layout.camera_of_image.push_back(image.size.empty() ? 0 : camera);
    if (!image.size.empty()) {
      ++counts[camera];
    }
  }
  if (cameras.empty()) {
    return std::nullopt;
  }
  const bool one_size = std::all_of(cameras.begin(), cameras.end(), [&](const ImageTraits& camera) {
    return camera.size == cameras.front().size;
  });
  const auto most_frequent =
      static_cast<size_t>(std::max_element(counts.begin(), counts.end()) - counts.begin());
  // Frames with room for images of all shapes are large.
  constexpr double kLargestDiagonal = 3000.0;
  const double diagonal = std::min(Diagonal(cameras[most_frequent].size), kLargestDiagonal);
  std::vector<cv::Size> sizes;
  for (const ImageTraits& camera : cameras) {
    const double scale = one_size ? 1.0 : std::min(1.0, diagonal / Diagonal(camera.size));
    sizes.emplace_back(std::max(1, cvRound(scale * camera.size.width)),
                       std::max(1, cvRound(scale * camera.size.height)));
    layout.frame.width = std::max(layout.frame.width, sizes.back().width);
    layout.frame.height = std::max(layout.frame.height, sizes.back().height);
  }
  for (size_t i = 0; i < cameras.size(); ++i) {
    const cv::Point corner((layout.frame.width - sizes[i].width) / 2,
                           (layout.frame.height - sizes[i].height) / 2);
    SourceCamera& camera = layout.cameras.emplace_back();
    camera.size = cameras[i].size;
    camera.area = cv::Rect(corner, sizes[i]);
    camera.assumed = cameras[i].camera.empty();
    if (cameras[i].focal_in_35mm_film) {
      camera.focal_px =
          FocalPixels(*cameras[i].focal_in_35mm_film, sizes[i].width, sizes[i].height);
    }
  }
  return layout;
}

class ImageFolder final : public FrameSource {
 public:
  ImageFolder(std::filesystem::path folder, std::vector<std::string> names, FolderLayout layout)
      : folder_(std::move(folder)), names_(std::move(names)), layout_(std::move(layout)) {}

  Result<std::optional<Frame>> Next() override {
    if (next_ == names_.size()) {
      return std::optional<Frame>();
    }
    const size_t index = next_++;
    const std::filesystem::path file = folder_ / names_[index];
    Frame frame;
    frame.index = static_cast<int64_t>(index);
    frame.capture_time = static_cast<double>(index) / kFramesPerSecond;
    LARARIUM_ASSIGN_OR_RETURN(frame.bgr, image::ReadImage(file, image::Channels::kBgr));
    const SourceCamera& camera = layout_.cameras[layout_.camera_of_image[index]];
    if (frame.bgr.size() != camera.size) {
      return Status::Error(file.string(), "is " + SizeText(frame.bgr.size()) + ", but was " +
                                              SizeText(camera.size) +
                                              " when the folder was opened");
    }
    if (camera.area.size() != camera.size) {
      cv::resize(frame.bgr, frame.bgr, camera.area.size(), 0.0, 0.0, cv::INTER_AREA);
    }
    if (camera.area.size() != layout_.frame) {
      cv::Mat framed(layout_.frame, CV_8UC3, cv::Scalar::all(0));
      frame.bgr.copyTo(framed(camera.area));
      frame.bgr = framed;
    }
    cv::cvtColor(frame.bgr, frame.grey, cv::COLOR_BGR2GRAY);
    return std::optional<Frame>(std::move(frame));
  }

  Status Seek(int64_t index) override {
    if (index < 0 || index >= static_cast<int64_t>(names_.size())) {
      return Status::Error(folder_.string(), "image " + std::to_string(index) +
                                                 " does not exist, it has " +
                                                 std::to_string(names_.size()) + " images");
    }
    next_ = static_cast<size_t>(index);
    return Status();
  }

  std::optional<int64_t> frame_count() const override {
    return static_cast<int64_t>(names_.size());
  }
  int width() const override { return layout_.frame.width; }
  int height() const override { return layout_.frame.height; }
  double frames_per_second() const override { return kFramesPerSecond; }
  bool live() const override { return false; }
  std::string FrameName(int64_t index) const override {
    return Known(index) ? names_[static_cast<size_t>(index)] : NumberedFrameName(index);
  }
  std::vector<SourceCamera> Cameras() const override { return layout_.cameras; }
  size_t CameraOf(int64_t index) const override {
    return Known(index) ? layout_.camera_of_image[static_cast<size_t>(index)] : 0;
  }

 private:
  bool Known(int64_t index) const {
    return index >= 0 && index < static_cast<int64_t>(names_.size());
  }

  std::filesystem::path folder_;
  std::vector<std::string> names_;
  FolderLayout layout_;
  size_t next_ = 0;
};

Result<std::vector<std::string>> ListImages(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::directory_iterator entry(folder, error);
  std::vector<std::string> names;
  for (const std::filesystem::directory_iterator end; !error && entry != end;
       entry.increment(error)) {
    if (IsImageName(entry->path()) && entry->is_regular_file(error)) {
      names.push_back(entry->path().filename().string());
    }
  }
  if (error) {
    return Status::Error(folder.string(), "cannot be read as a folder (" + error.message() + ")");
  }
  if (names.empty()) {
    return Status::Error(folder.string(), "contains no images",
                         "give a folder of png, jpg, tif, webp or bmp files");
  }
  std::sort(names.begin(), names.end(), NaturalLess);
  return names;
}

}  // namespace

std::span<const char* const> ImageExtensions() {
  static constexpr std::array kExtensions = {".png", ".jpg",  ".jpeg", ".bmp",
                                             ".tif", ".tiff", ".webp"};
  return kExtensions;
}

Result<std::unique_ptr<FrameSource>> OpenImageFolder(const std::filesystem::path& folder) {
  LARARIUM_ASSIGN_OR_RETURN(std::vector<std::string> names, ListImages(folder));
  std::vector<ImageTraits> traits(names.size());
  ParallelFor(names.size(), [&](size_t i) { traits[i] = TraitsOf(folder / names[i]); });
  std::optional<FolderLayout> layout = LayOut(traits);
  if (!layout) {
    // Says what is wrong with one of them.
    LARARIUM_RETURN_IF_ERROR(
        image::ReadImage(folder / names.front(), image::Channels::kBgr).status());
    return Status::Error(folder.string(), "contains no image that can be read");
  }
  return std::unique_ptr<FrameSource>(
      std::make_unique<ImageFolder>(folder, std::move(names), *std::move(layout)));
}

}  // namespace lararium::capture
