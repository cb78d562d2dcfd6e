// Reads and writes JPEG with libjpeg-turbo. It reports errors by longjmp, so functions that call
// setjmp own nothing.

#include <csetjmp>
#include <cstdio>
#include <cstdlib>

// clang-format off
#include <jpeglib.h>  // needs <cstdio>
#include <jerror.h>
// clang-format on

#include <array>
#include <opencv2/imgproc.hpp>

#include "shared/core/check.h"
#include "shared/image/codecs.h"
#include "shared/image/encode.h"

namespace lararium::image {
namespace {

struct JpegErrors : jpeg_error_mgr {
  std::jmp_buf jump;
  std::array<char, JMSG_LENGTH_MAX> message = {};
};

[[noreturn]] void Leave(j_common_ptr info) {
  auto* errors = static_cast<JpegErrors*>(info->err);
  errors->format_message(info, errors->message.data());
  std::longjmp(errors->jump, 1);  // NOLINT(cert-err52-cpp): C frames are in between
}

// libjpeg fills missing data with grey, but we treat an incomplete picture as an error. It also
// warns of harmless defects, such as extra bytes between segments that some cameras write.
void OnWarning(j_common_ptr info, int level) {
  const int code = info->err->msg_code;
  if (level < 0 && (code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER)) {
    Leave(info);
  }
}

void Prepare(JpegErrors& errors) {
  jpeg_std_error(&errors);
  errors.error_exit = Leave;
  errors.emit_message = OnWarning;
}

class JpegReader {
 public:
  JpegReader() {
    Prepare(errors_);
    info_.err = &errors_;
    progress_.progress_monitor = LimitScans;
  }
  ~JpegReader() { jpeg_destroy_decompress(&info_); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  bool Open(Bytes encoded, int halvings) {
    if (setjmp(errors_.jump) != 0) {  // NOLINT(cert-err52-cpp)
      return false;
    }
    jpeg_create_decompress(&info_);
    info_.progress = &progress_;
    jpeg_mem_src(&info_, reinterpret_cast<const unsigned char*>(encoded.data()), encoded.size());
    jpeg_read_header(&info_, TRUE);
    info_.scale_num = 1;
    info_.scale_denom = 1U << static_cast<unsigned>(halvings);
    jpeg_calc_output_dimensions(&info_);
    return true;
  }

  // image: one channel for grey, three for BGR, four for cyan, magenta, yellow and black.
  bool Read(cv::Mat& image) {
    if (setjmp(errors_.jump) != 0) {  // NOLINT(cert-err52-cpp)
      return false;
    }
    info_.out_color_space = image.channels() == 4   ? JCS_CMYK
                            : image.channels() == 1 ? JCS_GRAYSCALE
                                                    : JCS_EXT_BGR;
    jpeg_start_decompress(&info_);
    while (info_.output_scanline < info_.output_height) {
      JSAMPROW row = image.ptr(static_cast<int>(info_.output_scanline));
      jpeg_read_scanlines(&info_, &row, 1);
    }
    jpeg_finish_decompress(&info_);
    return true;
  }

  const jpeg_decompress_struct& info() const { return info_; }
  std::string message() const { return errors_.message.data(); }

 private:
  // A progressive image has about ten scans. Thousands of scans, each over the whole image, would
  // keep a reader busy for hours.
  static void LimitScans(j_common_ptr info) {
    constexpr int kMaxScans = 200;
    if (reinterpret_cast<j_decompress_ptr>(info)->input_scan_number > kMaxScans) {
      auto* errors = static_cast<JpegErrors*>(info->err);
      std::snprintf(errors->message.data(), errors->message.size(), "more than %d scans",
                    kMaxScans);
      std::longjmp(errors->jump, 1);  // NOLINT(cert-err52-cpp)
    }
  }

  jpeg_decompress_struct info_ = {};
  jpeg_progress_mgr progress_ = {};
  JpegErrors errors_ = {};
};

class JpegWriter {
 public:
  JpegWriter() {
    Prepare(errors_);
    info_.err = &errors_;
  }
  ~JpegWriter() {
    jpeg_destroy_compress(&info_);
    std::free(bytes_);
  }
  JpegWriter(const JpegWriter&) = delete;
  JpegWriter& operator=(const JpegWriter&) = delete;

  bool Write(const cv::Mat& image, int quality) {
    if (setjmp(errors_.jump) != 0) {  // NOLINT(cert-err52-cpp)
      return false;
    }
    jpeg_create_compress(&info_);
    jpeg_mem_dest(&info_, &bytes_, &size_);
    info_.image_width = static_cast<JDIMENSION>(image.cols);
    info_.image_height = static_cast<JDIMENSION>(image.rows);
    info_.input_components = image.channels();
    info_.in_color_space = image.channels() == 1 ? JCS_GRAYSCALE : JCS_EXT_BGR;
    jpeg_set_defaults(&info_);
    jpeg_set_quality(&info_, quality, TRUE);
    info_.optimize_coding = TRUE;
    jpeg_start_compress(&info_, TRUE);
    while (info_.next_scanline < info_.image_height) {
      auto* row = const_cast<JSAMPROW>(image.ptr(static_cast<int>(info_.next_scanline)));
      jpeg_write_scanlines(&info_, &row, 1);
    }
    jpeg_finish_compress(&info_);
    return true;
  }

  Bytes bytes() const { return std::as_bytes(std::span(bytes_, size_)); }
  std::string message() const { return errors_.message.data(); }

 private:
  jpeg_compress_struct info_ = {};
  JpegErrors errors_ = {};
  unsigned char* bytes_ = nullptr;  // allocated by malloc
  unsigned long size_ = 0;          // NOLINT(google-runtime-int): libjpeg's type
};

// Converts cyan, magenta, yellow and black to BGR without a profile. Adobe's programs store the
// share of the paper that stays white, others the share of ink.
cv::Mat FromInks(const cv::Mat& inks, bool white_shares) {
  cv::Mat bgr(inks.size(), CV_8UC3);
  for (int y = 0; y < inks.rows; ++y) {
    for (int x = 0; x < inks.cols; ++x) {
      const auto white = [&](int ink) {
        const int value = inks.at<cv::Vec4b>(y, x)[ink];
        return white_shares ? value : 255 - value;
      };
      for (int channel = 0; channel < 3; ++channel) {
        bgr.at<cv::Vec3b>(y, x)[channel] =
            static_cast<uint8_t>((white(2 - channel) * white(3) + 127) / 255);
      }
    }
  }
  return bgr;
}

}  // namespace

Result<cv::Mat> DecodeJpeg(Bytes encoded,
                           Channels channels,
                           int halvings,
                           const std::string& where) {
  JpegReader reader;
  if (!reader.Open(encoded, halvings)) {
    return Damaged(where, reader.message());
  }
  const J_COLOR_SPACE colours = reader.info().jpeg_color_space;
  const bool printed = colours == JCS_CMYK || colours == JCS_YCCK;
  const bool grey = !printed && (channels == Channels::kGrey || colours == JCS_GRAYSCALE);
  LARARIUM_ASSIGN_OR_RETURN(cv::Mat image,
                            MakeImage(reader.info().output_width, reader.info().output_height,
                                      printed ? CV_8UC4
                                      : grey  ? CV_8UC1
                                              : CV_8UC3,
                                      where));
  if (!reader.Read(image)) {
    return Damaged(where, reader.message());
  }
  return Converted(printed ? FromInks(image, reader.info().saw_Adobe_marker) : image, channels);
}

Result<std::vector<std::byte>> EncodeJpeg(const cv::Mat& image, int quality) {
  CHECK(image.type() == CV_8UC1 || image.type() == CV_8UC3);
  JpegWriter writer;
  if (!writer.Write(image, quality)) {
    return Status::Error("JPEG", "cannot be written: " + writer.message());
  }
  return std::vector<std::byte>(writer.bytes().begin(), writer.bytes().end());
}

}  // namespace lararium::image
