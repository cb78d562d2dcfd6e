#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>
#include <span>
#include <vector>

#include "shared/capture/frame_source.h"
#include "shared/core/lower_case.h"
#include "shared/image/decode.h"

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

class ImageFolder final : public FrameSource {
 public:
  ImageFolder(std::filesystem::path folder, std::vector<std::string> names, cv::Size size)
      : folder_(std::move(folder)), names_(std::move(names)), size_(size) {}

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
    if (frame.bgr.size() != size_) {
      return Status::Error(
          file.string(),
          "is " + SizeText(frame.bgr.size()) + ", the first image of the folder " + SizeText(size_),
          "all images must have the same size");
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
  int width() const override { return size_.width; }
  int height() const override { return size_.height; }
  double frames_per_second() const override { return kFramesPerSecond; }
  bool live() const override { return false; }
  std::string FrameName(int64_t index) const override {
    const bool known = index >= 0 && index < static_cast<int64_t>(names_.size());
    return known ? names_[static_cast<size_t>(index)] : NumberedFrameName(index);
  }

 private:
  static std::string SizeText(cv::Size size) {
    return std::to_string(size.width) + "x" + std::to_string(size.height);
  }

  std::filesystem::path folder_;
  std::vector<std::string> names_;
  cv::Size size_;
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
  LARARIUM_ASSIGN_OR_RETURN(const cv::Mat first,
                            image::ReadImage(folder / names.front(), image::Channels::kBgr));
  return std::unique_ptr<FrameSource>(
      std::make_unique<ImageFolder>(folder, std::move(names), first.size()));
}

}  // namespace lararium::capture
