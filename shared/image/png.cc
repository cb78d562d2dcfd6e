// Reads and writes PNG with libpng. It reports errors by longjmp, so functions that call setjmp own
// nothing.

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <opencv2/imgproc.hpp>

#include "shared/core/check.h"
#include "shared/image/codecs.h"
#include "shared/image/encode.h"

namespace lararium::image {
namespace {

struct PngErrors {
  std::string message;
};

[[noreturn]] void Leave(png_structp png, png_const_charp message) {
  static_cast<PngErrors*>(png_get_error_ptr(png))->message = message;
  png_longjmp(png, 1);
}

void IgnoreWarning(png_structp, png_const_charp) {}

class PngReader {
 public:
  explicit PngReader(Bytes encoded)
      : left_(encoded),
        png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &errors_, Leave, IgnoreWarning)),
        info_(png_create_info_struct(png_)) {
    CHECK(png_ != nullptr && info_ != nullptr);
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  bool Open() {
    if (setjmp(png_jmpbuf(png_)) != 0) {  // NOLINT(cert-err52-cpp)
      return false;
    }
    png_set_read_fn(png_, this, Take);
    png_read_info(png_, info_);
    return true;
  }

  uint32_t width() const { return png_get_image_width(png_, info_); }
  uint32_t height() const { return png_get_image_height(png_, info_); }
  bool grey() const { return (png_get_color_type(png_, info_) & PNG_COLOR_MASK_COLOR) == 0; }

  Bytes Profile() const {
    char* name = nullptr;
    int compression = 0;
    png_bytep profile = nullptr;
    png_uint_32 size = 0;
    const bool found = png_get_iCCP(png_, info_, &name, &compression, &profile, &size) != 0;
    return found ? std::as_bytes(std::span(profile, size)) : Bytes();
  }

  bool Read(Channels channels, cv::Mat& image) {
    if (setjmp(png_jmpbuf(png_)) != 0) {  // NOLINT(cert-err52-cpp)
      return false;
    }
    png_set_expand(png_);
    png_set_scale_16(png_);
    png_set_bgr(png_);
    if (channels != Channels::kGrey) {
      png_set_gray_to_rgb(png_);
    }
    if (channels == Channels::kBgra) {
      png_set_add_alpha(png_, 255, PNG_FILLER_AFTER);
    } else {
      png_set_strip_alpha(png_);
    }
    const int passes = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    if (png_get_rowbytes(png_, info_) != static_cast<size_t>(image.cols) * image.elemSize()) {
      png_error(png_, "its rows have another size than its header says");
    }
    for (int pass = 0; pass < passes; ++pass) {
      for (int row = 0; row < image.rows; ++row) {
        png_read_row(png_, image.ptr(row), nullptr);
      }
    }
    png_read_end(png_, nullptr);
    return true;
  }

  const std::string& message() const { return errors_.message; }

 private:
  static void Take(png_structp png, png_bytep out, size_t size) {
    Bytes& left = static_cast<PngReader*>(png_get_io_ptr(png))->left_;
    if (size > left.size()) {
      png_error(png, "it ends too early");
    }
    std::memcpy(out, left.data(), size);
    left = left.subspan(size);
  }

  PngErrors errors_;
  Bytes left_;
  png_structp png_;
  png_infop info_;
};

class PngWriter {
 public:
  PngWriter()
      : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, &errors_, Leave, IgnoreWarning)),
        info_(png_create_info_struct(png_)) {
    CHECK(png_ != nullptr && info_ != nullptr);
  }
  ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  bool Write(const cv::Mat& image, int colour_type, int compression) {
    if (setjmp(png_jmpbuf(png_)) != 0) {  // NOLINT(cert-err52-cpp)
      return false;
    }
    png_set_write_fn(png_, &bytes_, Append, nullptr);
    png_set_compression_level(png_, compression);
    png_set_IHDR(png_, info_, static_cast<png_uint_32>(image.cols),
                 static_cast<png_uint_32>(image.rows), 8, colour_type, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png_, info_);
    png_set_bgr(png_);
    for (int row = 0; row < image.rows; ++row) {
      png_write_row(png_, image.ptr(row));
    }
    png_write_end(png_, nullptr);
    return true;
  }

  std::vector<std::byte>& bytes() { return bytes_; }
  const std::string& message() const { return errors_.message; }

 private:
  static void Append(png_structp png, png_bytep data, size_t size) {
    auto* bytes = static_cast<std::vector<std::byte>*>(png_get_io_ptr(png));
    const auto* first = reinterpret_cast<const std::byte*>(data);
    bytes->insert(bytes->end(), first, first + size);
  }

  PngErrors errors_;
  std::vector<std::byte> bytes_;
  png_structp png_;
  png_infop info_;
};

}  // namespace

Result<cv::Mat> DecodePng(Bytes encoded, Channels channels, const std::string& where) {
  PngReader reader(encoded);
  if (!reader.Open()) {
    return Damaged(where, reader.message());
  }
  // libpng's conversion to grey applies gamma; OpenCV's and that of our videos do not.
  const bool convert = channels == Channels::kGrey && !reader.grey();
  const Channels stored = convert ? Channels::kBgr : channels;
  LARARIUM_ASSIGN_OR_RETURN(cv::Mat image,
                            MakeImage(reader.width(), reader.height(), TypeOf(stored), where));
  if (!reader.Read(stored, image)) {
    return Damaged(where, reader.message());
  }
  return convert ? Converted(image, channels) : image;
}

std::vector<std::byte> ReadPngProfile(Bytes encoded) {
  PngReader reader(encoded);
  const Bytes profile = reader.Open() ? reader.Profile() : Bytes();
  return {profile.begin(), profile.end()};
}

Result<std::vector<std::byte>> EncodePng(const cv::Mat& image, int compression) {
  CHECK(image.type() == CV_8UC1 || image.type() == CV_8UC3 || image.type() == CV_8UC4);
  const int colour_type = image.channels() == 1   ? PNG_COLOR_TYPE_GRAY
                          : image.channels() == 3 ? PNG_COLOR_TYPE_RGB
                                                  : PNG_COLOR_TYPE_RGB_ALPHA;
  PngWriter writer;
  if (!writer.Write(image, colour_type, compression)) {
    return Status::Error("PNG", "cannot be written: " + writer.message());
  }
  return std::move(writer.bytes());
}

}  // namespace lararium::image
