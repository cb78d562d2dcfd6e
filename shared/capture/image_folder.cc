#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <iterator>
#include <map>
#include <opencv2/imgproc.hpp>
#include <set>
#include <span>
#include <vector>

#include "shared/capture/exif.h"
#include "shared/capture/frame_source.h"
#include "shared/core/file.h"
#include "shared/core/lower_case.h"
#include "shared/core/parallel.h"
#include "shared/image/decode.h"
#include "shared/image/image_header.h"
#include "shared/image/picture_notes.h"

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
  cv::Size size;  // The size of the upright image; it is empty if the image cannot be read.
  image::PixelOrientation orientation;
  std::string camera;
  std::optional<uint32_t> focal_in_35mm_film;
  std::vector<std::string> notes;  // See image::PictureNotes().
  bool shows_all_directions = false;

  // See SourceCamera. Sensors are wider than high: where the file does not tell how an image was
  // turned, one that is higher than wide was turned clockwise, as phones are held.
  int QuarterTurns() const {
    const cv::Size stored = orientation.SizeOf(size);
    return (orientation.quarter_turns() + (stored.height > stored.width ? 1 : 0)) % 4;
  }
  friend bool SameCamera(const ImageTraits& a, const ImageTraits& b) {
    return a.size == b.size && a.camera == b.camera && a.QuarterTurns() == b.QuarterTurns();
  }
  friend bool SameLens(const ImageTraits& a, const ImageTraits& b) {
    return a.camera == b.camera &&
           (a.size == b.size || a.size == cv::Size(b.size.height, b.size.width));
  }
};

// Whether the metadata of a picture (XMP, "Photo Sphere XMP Metadata") say that its columns and
// rows are angles, as those of 360 degree cameras are.
bool ShowsAllDirections(std::span<const std::byte> file) {
  constexpr size_t kFarthest = size_t{1} << 18;  // Bytes; metadata come before the pixels.
  const std::string_view text(reinterpret_cast<const char*>(file.data()),
                              std::min(file.size(), kFarthest));
  const size_t at = text.find("GPano:ProjectionType");
  return at != std::string_view::npos && text.substr(at, 64).find("equirectangular") != text.npos;
}

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
  } else if (const auto decoded =
                 image::DecodeImage(mapped->bytes(), image::Channels::kGrey, file.string());
             decoded.ok()) {
    traits.size = decoded->size();
  }
  traits.orientation = FindOrientation(mapped->bytes());
  traits.size = traits.orientation.SizeOf(traits.size);
  traits.notes = image::PictureNotes(mapped->bytes());
  traits.camera = FindCameraName(mapped->bytes());
  traits.focal_in_35mm_film = FindFocalLengthIn35mmFilm(mapped->bytes());
  traits.shows_all_directions = ShowsAllDirections(mapped->bytes());
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
    camera.quarter_turns = cameras[i].QuarterTurns();
    const auto first = std::find_if(cameras.begin(), cameras.end(), [&](const ImageTraits& other) {
      return SameLens(other, cameras[i]);
    });
    if (const auto lens = static_cast<size_t>(first - cameras.begin()); lens < i) {
      camera.lens_of = lens;
    }
    if (cameras[i].focal_in_35mm_film) {
      camera.focal_px =
          FocalPixels(*cameras[i].focal_in_35mm_film, sizes[i].width, sizes[i].height);
    }
  }
  return layout;
}

// What a folder holds.
struct Listing {
  std::vector<std::string>
      names;  // The names of the images are relative to the folder, and ordered.
  std::vector<std::string> notes;  // Each note says what is left out.
};

class ImageFolder final : public FrameSource {
 public:
  ImageFolder(std::filesystem::path folder, Listing listing, FolderLayout layout)
      : folder_(std::move(folder)),
        names_(std::move(listing.names)),
        notes_(std::move(listing.notes)),
        layout_(std::move(layout)) {}

  Result<std::optional<Frame>> Next() override {
    while (next_ < names_.size()) {
      const size_t index = next_++;
      if (damaged_.contains(index)) {
        continue;
      }
      Result<Frame> frame = Read(index);
      if (frame.ok()) {
        return std::optional<Frame>(std::move(frame).value());
      }
      damaged_.insert(index);
      notes_.push_back(frame.message() + " (the image is left out)");
    }
    return std::optional<Frame>();
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
  std::vector<std::string> Notes() const override { return notes_; }

 private:
  bool Known(int64_t index) const {
    return index >= 0 && index < static_cast<int64_t>(names_.size());
  }

  Result<Frame> Read(size_t index) const {
    const std::filesystem::path file = folder_ / names_[index];
    Frame frame;
    frame.index = static_cast<int64_t>(index);
    frame.capture_time = static_cast<double>(index) / kFramesPerSecond;
    LARARIUM_ASSIGN_OR_RETURN(frame.bgr, ReadPhotograph(file));
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
    return frame;
  }

  std::filesystem::path folder_;
  std::vector<std::string> names_;
  std::vector<std::string> notes_;
  FolderLayout layout_;
  std::set<size_t> damaged_;  // Indices of images that could not be read.
  size_t next_ = 0;
};

// Formats of pictures that are not read, and what to do with them.
struct UnreadFormat {
  const char* name;
  std::vector<std::string_view> extensions;
  const char* remedy;
};

const std::array<UnreadFormat, 2>& UnreadFormats() {
  static const std::array<UnreadFormat, 2> kFormats = {
      {{"camera raw files",
        {".3fr", ".arw", ".cr2", ".cr3", ".crw", ".dng", ".erf", ".iiq", ".kdc", ".mrw", ".nef",
         ".nrw", ".orf", ".pef", ".raf", ".rw2", ".rwl", ".srw", ".x3f"},
        "develop them as JPEG or TIFF"},
       {"pictures of formats that are not read",
        {".exr", ".gif", ".hdr", ".insp", ".j2k", ".jp2", ".jps", ".jxr", ".mpo", ".pcx", ".pgm",
         ".ppm", ".psd", ".tga", ".xcf"},
        "save them as PNG or JPEG"}}};
  return kFormats;
}

// Whether a file begins as a picture of a format that is read.
bool BeginsAsPicture(const std::filesystem::path& file) {
  constexpr size_t kBytes = 16;
  const Result<std::vector<std::byte>> head = ReadBytesAt(file, 0, kBytes);
  if (!head.ok()) {
    return false;
  }
  const std::string_view text(reinterpret_cast<const char*>(head->data()), kBytes);
  const std::string_view brand = text.substr(4, 8);
  return text.starts_with("\xff\xd8\xff") || text.starts_with("\x89PNG\r\n\x1a\n") ||
         (text.starts_with("RIFF") && text.substr(8, 4) == "WEBP") || brand == "ftypheic" ||
         brand == "ftypavif" || brand == "ftypmif1";
}

// The name of the file for which a cloud left a hidden placeholder (".IMG_1.HEIC.icloud"); empty if
// it is none.
std::filesystem::path NameInCloud(const std::string& name) {
  constexpr std::string_view kCloud = ".icloud";
  return name.starts_with('.') && name.ends_with(kCloud) && name.size() > kCloud.size()
             ? name.substr(1, name.size() - 1 - kCloud.size())
             : std::string();
}

std::string LeftOutNote(const std::filesystem::path& folder,
                        const std::map<std::string, size_t>& numbers,
                        const std::string& what,
                        const std::string& remedy) {
  size_t count = 0;
  std::string extensions;
  for (const auto& [extension, files] : numbers) {
    count += files;
    extensions += (extensions.empty() ? "" : ", ") + extension;
  }
  return folder.string() + ": " + std::to_string(count) + " " + what + " (" + extensions +
         ") are left out: " + remedy;
}

// Collects the files of one folder, or of it and all folders below.
class Lister {
 public:
  explicit Lister(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // Hidden files and folders are left out; macOS puts one beside every file that it copies to a
  // foreign disk ("._IMG_0001.JPG"), and it is no picture.
  // deepest: how many folders below the first one are searched at most.
  Status List(int deepest) {
    std::error_code error;
    std::filesystem::recursive_directory_iterator entry(folder_, error);
    for (const std::filesystem::recursive_directory_iterator end; !error && entry != end;
         entry.increment(error)) {
      const std::string name = entry->path().filename().string();
      std::error_code unknown;
      if (entry->is_directory(unknown)) {
        if (entry.depth() >= deepest || name.starts_with('.')) {
          entry.disable_recursion_pending();
        }
      } else if (IsImageName(NameInCloud(name))) {
        ++in_cloud_;
      } else if (!name.starts_with('.') && entry->is_regular_file(unknown)) {
        Add(entry->path());
      }
    }
    return error ? Status::Error(folder_.string(),
                                 "cannot be read as a folder (" + error.message() + ")")
                 : Status();
  }

  std::vector<std::string>& names() { return names_; }

  // One sentence for each kind of pictures that are not read.
  std::vector<std::string> UnreadNotes() const {
    std::vector<std::string> notes;
    for (size_t i = 0; i < unread_.size(); ++i) {
      if (!unread_[i].empty()) {
        notes.push_back(
            LeftOutNote(folder_, unread_[i], UnreadFormats()[i].name, UnreadFormats()[i].remedy));
      }
    }
    if (!misnamed_.empty()) {
      notes.push_back(LeftOutNote(folder_, misnamed_, "files that begin as pictures do",
                                  "name them .jpg, .png, .webp or .heic if they show the place"));
    }
    if (in_cloud_ > 0) {
      notes.push_back(folder_.string() + ": " + std::to_string(in_cloud_) +
                      " pictures are still in the cloud (.icloud) and are left out: download them");
    }
    return notes;
  }

 private:
  void Add(const std::filesystem::path& file) {
    if (IsImageName(file)) {
      names_.push_back(file.lexically_relative(folder_).string());
      return;
    }
    const std::string extension = LowerCase(file.extension().string());
    for (size_t i = 0; i < unread_.size(); ++i) {
      const auto& known = UnreadFormats()[i].extensions;
      if (std::find(known.begin(), known.end(), extension) != known.end()) {
        ++unread_[i][extension];
        return;
      }
    }
    if (BeginsAsPicture(file)) {
      ++misnamed_[extension.empty() ? "without an extension" : extension];
    }
  }

  std::filesystem::path folder_;
  std::vector<std::string> names_;
  // Numbers of files by extension.
  std::array<std::map<std::string, size_t>, 2> unread_;
  std::map<std::string, size_t> misnamed_;
  size_t in_cloud_ = 0;
};

// The images of a folder, or of all folders below it if it holds none itself. (A folder of
// photographs often has a folder of thumbnails beside them; COLMAP's projects may have one folder
// for each camera.)
Result<Listing> ListImages(const std::filesystem::path& folder) {
  Lister flat(folder);
  LARARIUM_RETURN_IF_ERROR(flat.List(0));
  Lister deep(folder);
  LARARIUM_RETURN_IF_ERROR(deep.List(flat.names().empty() ? INT_MAX : 1));
  Lister& used = flat.names().empty() ? deep : flat;
  Listing listing{std::move(used.names()), used.UnreadNotes()};
  if (&used == &flat && deep.names().size() > listing.names.size()) {
    listing.notes.push_back(
        folder.string() + ": " + std::to_string(deep.names().size() - listing.names.size()) +
        " images in its subfolders are left out: put all images into the folder "
        "itself, or all into subfolders");
  }
  if (listing.names.empty()) {
    std::string unread;
    for (const std::string& note : listing.notes) {
      unread += "; " + note;
    }
    return Status::Error(folder.string(), "contains no images that are read" + unread,
                         "give a folder of jpg, png, heic, avif, jxl, tif, webp or bmp files");
  }
  std::sort(listing.names.begin(), listing.names.end(), NaturalLess);
  return listing;
}

// One sentence for each thing that the images say of themselves and that is not honoured.
std::vector<std::string> NotesOf(const std::filesystem::path& folder,
                                 std::span<const std::string> names,
                                 std::span<const ImageTraits> images) {
  std::map<std::string, std::vector<size_t>> images_of_note;
  for (size_t i = 0; i < images.size(); ++i) {
    for (const std::string& note : images[i].notes) {
      images_of_note[note].push_back(i);
    }
  }
  std::vector<std::string> notes;
  for (const auto& [note, found] : images_of_note) {
    const std::string others =
        found.size() > 1 ? " (and " + std::to_string(found.size() - 1) + " like it)" : "";
    notes.push_back((folder / names[found.front()]).string() + ": " + note + others);
  }
  return notes;
}

}  // namespace

std::span<const char* const> ImageExtensions() {
  static constexpr std::array kExtensions = {".png",  ".jpg", ".jpeg", ".jpe",  ".jfif",
                                             ".bmp",  ".tif", ".tiff", ".webp", ".heic",
                                             ".heif", ".hif", ".avif", ".jxl"};
  return kExtensions;
}

Result<std::unique_ptr<FrameSource>> OpenImageFolder(const std::filesystem::path& folder) {
  LARARIUM_ASSIGN_OR_RETURN(Listing listing, ListImages(folder));
  std::vector<ImageTraits> traits(listing.names.size());
  ParallelFor(traits.size(), [&](size_t i) { traits[i] = TraitsOf(folder / listing.names[i]); });
  std::optional<FolderLayout> layout = LayOut(traits);
  const auto spheres = std::count_if(traits.begin(), traits.end(), [](const ImageTraits& image) {
    return image.shows_all_directions;
  });
  if (spheres > 0) {
    listing.notes.push_back(
        folder.string() + ": " + std::to_string(spheres) +
        " pictures of all directions (360 degrees) are taken for those of an ordinary lens: cut "
        "ordinary views out of them");
  }
  if (!layout) {
    // Says what is wrong with one of them.
    LARARIUM_RETURN_IF_ERROR(
        image::ReadImage(folder / listing.names.front(), image::Channels::kBgr).status());
    return Status::Error(folder.string(), "contains no image that can be read");
  }
  std::ranges::move(NotesOf(folder, listing.names, traits), std::back_inserter(listing.notes));
  return std::unique_ptr<FrameSource>(
      std::make_unique<ImageFolder>(folder, std::move(listing), *std::move(layout)));
}

}  // namespace lararium::capture
