// Reads rare picture formats with libav, which also reads the videos.

#include <algorithm>
#include <cstring>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "shared/image/codecs.h"
#include "shared/image/image_header.h"
#include "shared/image/libav.h"

namespace lararium::image {
namespace {

std::optional<AVCodecID> CodecOf(const std::optional<ImageHeader>& header, Bytes encoded) {
  // A bare codestream, or a container (ISO/IEC 18181-2).
  using std::literals::string_view_literals::operator""sv;
  if (StartsWith(encoded, 0, "\xff\x0a"sv) ||
      StartsWith(encoded, 0, "\0\0\0\x0cJXL \r\n\x87\n"sv)) {
    return AV_CODEC_ID_JPEGXL;
  }
  if (!header) {
    return std::nullopt;
  }
  switch (header->format) {
    case ImageHeader::Format::kBmp:
      return AV_CODEC_ID_BMP;
    case ImageHeader::Format::kWebp:
      return AV_CODEC_ID_WEBP;
    case ImageHeader::Format::kPsd:
      return AV_CODEC_ID_PSD;
    case ImageHeader::Format::kDds:
      return AV_CODEC_ID_DDS;
    case ImageHeader::Format::kTga:
      return AV_CODEC_ID_TARGA;
    default:
      return std::nullopt;
  }
}

// Returns how many bytes a Targa file has up to its last pixel; more than there are if it is cut
// short within its runs of pixels.
uint64_t TgaSize(const ImageHeader& header, Bytes encoded) {
  const auto number = [&](size_t at) { return static_cast<uint64_t>(encoded[at]); };
  constexpr uint64_t kRuns = 8;  // Added to the type of an image in runs.
  const uint64_t bytes_per_pixel = (number(16) + 7) / 8;
  const uint64_t palette = (number(5) + 256 * number(6)) * ((number(7) + 7) / 8);
  uint64_t at = 18 + number(0) + palette;
  uint64_t pixels = uint64_t{header.width} * header.height;
  if ((number(2) & kRuns) == 0) {
    return at + pixels * bytes_per_pixel;
  }
  while (pixels > 0 && at < encoded.size()) {
    const uint64_t run = number(at);
    const uint64_t count = (run & 0x7f) + 1;
    at += 1 + bytes_per_pixel * (run >= 0x80 ? 1 : count);
    pixels -= std::min(pixels, count);
  }
  return at + pixels;
}

// Returns the size of the whole file that the file declares; zero if the format does not state it.
// libav skews a BMP that is a little too short, and invents the rest of a WebP and of a run.
uint64_t ClaimedSize(AVCodecID id, const std::optional<ImageHeader>& header, Bytes encoded) {
  if (id == AV_CODEC_ID_TARGA) {
    return TgaSize(*header, encoded);
  }
  if (id != AV_CODEC_ID_BMP && id != AV_CODEC_ID_WEBP) {
    return 0;
  }
  const size_t at = id == AV_CODEC_ID_BMP ? 2 : 4;
  uint32_t claimed = 0;
  if (encoded.size() >= at + sizeof(claimed)) {
    std::memcpy(&claimed, encoded.data() + at, sizeof(claimed));
  }
  return id == AV_CODEC_ID_BMP ? claimed : uint64_t{claimed} + 8;
}

// Returns null if the decoder is not available.
LibavPtr<AVCodecContext> OpenDecoder(AVCodecID id) {
  const AVCodec* codec = avcodec_find_decoder(id);
  LibavPtr<AVCodecContext> context(codec == nullptr ? nullptr : avcodec_alloc_context3(codec));
  if (context == nullptr) {
    return nullptr;
  }
  context->thread_count = 1;
  context->max_pixels = static_cast<int64_t>(kMaxPixels);
  context->err_recognition = AV_EF_CRCCHECK | AV_EF_BITSTREAM | AV_EF_BUFFER | AV_EF_EXPLODE;
  return avcodec_open2(context.get(), codec, nullptr) == 0 ? std::move(context) : nullptr;
}

Result<LibavPtr<AVFrame>> DecodeFrame(AVCodecID id, Bytes encoded, const std::string& where) {
  av_log_set_level(AV_LOG_FATAL);  // Errors are reported as Status.
  const LibavPtr<AVCodecContext> decoder = OpenDecoder(id);
  LibavPtr<AVPacket> packet(av_packet_alloc());
  LibavPtr<AVFrame> frame(av_frame_alloc());
  if (decoder == nullptr || packet == nullptr || frame == nullptr ||
      encoded.size() > size_t{INT32_MAX} - AV_INPUT_BUFFER_PADDING_SIZE ||
      av_new_packet(packet.get(), static_cast<int>(encoded.size())) != 0) {
    return Status::Error(where, "no decoder for this format is installed", "save it again as PNG");
  }
  std::memcpy(packet->data, encoded.data(), encoded.size());
  int error = avcodec_send_packet(decoder.get(), packet.get());
  if (error == 0) {
    avcodec_send_packet(decoder.get(), nullptr);  // This marks the end of the data.
    error = avcodec_receive_frame(decoder.get(), frame.get());
  }
  if (error != 0 || frame->decode_error_flags != 0) {
    return Damaged(where, error != 0 ? LibavMessage(error) : "its decoder found errors");
  }
  return frame;
}

Result<cv::Mat> ToMat(const AVFrame& frame, Channels channels, const std::string& where) {
  const bool alpha = channels == Channels::kBgra;
  LARARIUM_ASSIGN_OR_RETURN(cv::Mat image,
                            MakeImage(static_cast<uint64_t>(std::max(frame.width, 0)),
                                      static_cast<uint64_t>(std::max(frame.height, 0)),
                                      alpha ? CV_8UC4 : CV_8UC3, where));
  const LibavPtr<SwsContext> scaler(sws_getContext(
      frame.width, frame.height, static_cast<AVPixelFormat>(frame.format), frame.width,
      frame.height, alpha ? AV_PIX_FMT_BGRA : AV_PIX_FMT_BGR24,
      SWS_BICUBIC | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT, nullptr, nullptr, nullptr));
  uint8_t* const rows[] = {image.data};
  const int stride[] = {static_cast<int>(image.step)};
  if (scaler == nullptr || sws_scale(scaler.get(), frame.data, frame.linesize, 0, frame.height,
                                     rows, stride) != frame.height) {
    return Status::Error(where, "has an unknown pixel format", "save it again as PNG");
  }
  return channels == Channels::kGrey ? Converted(image, channels) : image;
}

}  // namespace

Result<cv::Mat> DecodeByLibav(Bytes encoded, Channels channels, const std::string& where) {
  const std::optional<ImageHeader> header = ReadImageHeader(encoded);
  const std::optional<AVCodecID> codec = CodecOf(header, encoded);
  if (!codec) {
    return Status::Error(where, "cannot be read as an image",
                         "give a PNG, JPEG, TIFF, WebP, HEIC, AVIF, JPEG XL or BMP file");
  }
  if (ClaimedSize(*codec, header, encoded) > encoded.size()) {
    return Damaged(where, "shorter than its header says");
  }
  LARARIUM_ASSIGN_OR_RETURN(const LibavPtr<AVFrame> frame, DecodeFrame(*codec, encoded, where));
  return ToMat(*frame, channels, where);
}

}  // namespace lararium::image
