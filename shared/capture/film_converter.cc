#include "shared/capture/film_converter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace lararium::capture {
namespace {

using image::PixelOrientation;

cv::Size SizeOf(const AVFrame& frame) { return {frame.width, frame.height}; }

// Returns the YCbCr matrix. Files that do not state it use BT.709 from 720 lines on.
const int* ColourMatrix(const AVFrame& frame) {
  int matrix = frame.colorspace;
  if (matrix == AVCOL_SPC_UNSPECIFIED || matrix == AVCOL_SPC_RGB) {
    matrix = frame.height >= 720 ? SWS_CS_ITU709 : SWS_CS_ITU601;
  }
  return sws_getCoefficients(matrix);
}

bool IsKnownMatrix(AVColorSpace matrix) {
  return matrix <= AVCOL_SPC_BT2020_NCL && matrix != AVCOL_SPC_YCGCO;
}

bool IsFullRange(const AVFrame& frame) {
  return frame.color_range == AVCOL_RANGE_JPEG || frame.format == AV_PIX_FMT_YUVJ420P ||
         frame.format == AV_PIX_FMT_YUVJ422P || frame.format == AV_PIX_FMT_YUVJ444P;
}

// The deprecated formats of full range would make swscale start again with every picture.
AVPixelFormat WithoutRange(AVPixelFormat format) {
  switch (format) {
    case AV_PIX_FMT_YUVJ420P:
      return AV_PIX_FMT_YUV420P;
    case AV_PIX_FMT_YUVJ422P:
      return AV_PIX_FMT_YUV422P;
    case AV_PIX_FMT_YUVJ444P:
      return AV_PIX_FMT_YUV444P;
    default:
      return format;
  }
}

FilmColours ColoursOf(const AVFrame& frame) {
  FilmColours colours;
  if (frame.color_trc == AVCOL_TRC_ARIB_STD_B67) {
    colours.transfer = Transfer::kHlg;
  } else if (frame.color_trc == AVCOL_TRC_SMPTE2084) {
    colours.transfer = Transfer::kPq;
  }
  if (frame.color_primaries == AVCOL_PRI_BT2020) {
    colours.gamut = Gamut::kBt2020;
  } else if (frame.color_primaries == AVCOL_PRI_SMPTE432) {
    colours.gamut = Gamut::kP3;
  } else if (frame.color_primaries == AVCOL_PRI_UNSPECIFIED && colours.high_dynamic_range()) {
    colours.gamut = Gamut::kBt2020;
  }
  return colours;
}

// Transfer functions that are not near that of BT.709 and are not converted.
bool IsForeignTransfer(AVColorTransferCharacteristic transfer) {
  return transfer == AVCOL_TRC_LINEAR || transfer == AVCOL_TRC_LOG ||
         transfer == AVCOL_TRC_LOG_SQRT || transfer == AVCOL_TRC_SMPTE428;
}

bool TurnsByRightAngles(std::span<const int32_t, 9> matrix) {
  constexpr double kTolerance = 0.05;
  const double straight = std::abs(1.0 * matrix[0]) + std::abs(1.0 * matrix[4]);
  const double across = std::abs(1.0 * matrix[1]) + std::abs(1.0 * matrix[3]);
  return std::min(straight, across) <= kTolerance * std::max(straight, across);
}

// Keeps the height, as players do. Some encoders state nearly square pixels where the size is odd.
cv::Size WithSquarePixels(cv::Size size, AVRational aspect) {
  constexpr double kNearlySquare = 0.002;
  const double ratio = aspect.num > 0 && aspect.den > 0 ? av_q2d(aspect) : 1.0;
  if (std::abs(ratio - 1.0) <= kNearlySquare) {
    return size;
  }
  return {static_cast<int>(std::lround(std::min(size.width * ratio, 1e6))), size.height};
}

// Fills the odd rows of an image from the even ones by cubic interpolation.
void FillOddRows(cv::Mat& image) {
  static const cv::Mat kernel =
      (cv::Mat_<float>(4, 1) << -1.0f / 16, 9.0f / 16, 9.0f / 16, -1.0f / 16);
  const int odd_rows = image.rows / 2;
  const cv::Mat even(odd_rows, image.cols, image.type(), image.data, 2 * image.step);
  cv::Mat odd(odd_rows, image.cols, image.type(), image.data + image.step, 2 * image.step);
  cv::filter2D(even, odd, -1, kernel, cv::Point(0, 1), 0.0, cv::BORDER_REPLICATE);
}

}  // namespace

Result<FilmConverter> FilmConverter::Create(const std::filesystem::path& file,
                                            AVFormatContext& format,
                                            AVStream& stream,
                                            const AVFrame& first) {
  FilmConverter converter(file);
  const auto* vision =
      image::StreamSideData<AVDOVIDecoderConfigurationRecord>(stream, AV_PKT_DATA_DOVI_CONF);
  if (vision != nullptr && vision->dv_bl_signal_compatibility_id == 0 &&
      (vision->dv_profile == 5 || vision->dv_profile == 10)) {
    return converter.Problem("is Dolby Vision whose colours only its own decoders know (profile " +
                                 std::to_string(vision->dv_profile) + ")",
                             "film with HDR switched off");
  }
  converter.colours_ = ColoursOf(first);
  converter.stored_ = SizeOf(first);
  converter.square_ = WithSquarePixels(
      converter.stored_,
      av_guess_sample_aspect_ratio(&format, &stream, const_cast<AVFrame*>(&first)));
  if (const auto* matrix =
          image::StreamSideData<std::array<int32_t, 9>>(stream, AV_PKT_DATA_DISPLAYMATRIX)) {
    converter.orientation_ = PixelOrientation::FromDisplayMatrix(*matrix);
    if (!TurnsByRightAngles(*matrix)) {
      converter.Note(
          "is to be shown turned by an angle that is no multiple of 90 degrees; the "
          "nearest multiple is used");
    }
  }
  converter.first_orientation_ = converter.OrientationOf(first);
  converter.size_ = converter.first_orientation_.SizeOf(converter.square_);
  const auto [smallest, largest] = std::minmax(converter.size_.width, converter.size_.height);
  if (smallest < 16 || largest > 16384) {
    return converter.Problem("has an image size outside 16 to 16384 pixels",
                             "give a complete video file, for example MP4");
  }
  converter.NoteColours(first);
  converter.NoteViews(stream);
  return converter;
}

void FilmConverter::Note(const std::string& text) {
  notes_.push_back(file_.string() + ": " + text);
}

void FilmConverter::NoteColours(const AVFrame& first) {
  if (colours_.high_dynamic_range()) {
    Note(std::string("is a film with a high dynamic range (") +
         (colours_.transfer == Transfer::kHlg ? "HLG" : "PQ") +
         "); its highlights are compressed: film with HDR switched off where you can");
  } else if (IsForeignTransfer(first.color_trc)) {
    Note(std::string("its brightness is coded as \"") + av_color_transfer_name(first.color_trc) +
         "\", which is not converted: convert the film to BT.709");
  }
  if (!IsKnownMatrix(first.colorspace)) {
    Note(std::string("its colours are coded as \"") + av_color_space_name(first.colorspace) +
         "\", which is not converted: convert the film to BT.709");
  }
  if (image::IsInterlaced(first)) {
    Note(
        "is interlaced; every second row is made from its neighbours: film progressively where you "
        "can (25p or 30p)");
  }
}

void FilmConverter::NoteViews(const AVStream& stream) {
  if (image::StreamSideData<uint8_t>(stream, AV_PKT_DATA_SPHERICAL) != nullptr) {
    Note(
        "is a film of all directions (360 degrees), but is taken for that of an ordinary lens: cut "
        "an ordinary view out of it");
  }
  const auto* stereo = image::StreamSideData<AVStereo3D>(stream, AV_PKT_DATA_STEREO3D);
  if (stereo != nullptr && stereo->type != AV_STEREO3D_2D) {
    Note("holds the views of two eyes in one picture: cut out that of one eye");
  }
}

PixelOrientation FilmConverter::OrientationOf(const AVFrame& picture) const {
  const AVFrameSideData* own = av_frame_get_side_data(&picture, AV_FRAME_DATA_DISPLAYMATRIX);
  if (own == nullptr || own->size < sizeof(int32_t) * 9) {
    return orientation_;
  }
  return PixelOrientation::FromDisplayMatrix(
      std::span<const int32_t, 9>(reinterpret_cast<const int32_t*>(own->data), 9));
}

Status FilmConverter::MeasureHighlights(const AVFrame& picture) {
  if (SizeOf(picture) != stored_) {
    return Status();
  }
  LARARIUM_ASSIGN_OR_RETURN(const cv::Mat coded, ToBgr(picture, CV_16UC3));
  highlights_ = std::max(highlights_, HighlightLuminance(colours_, coded));
  return Status();
}

Status FilmConverter::Convert(const AVFrame& picture, geometry::Frame& frame) {
  if (SizeOf(picture) != stored_) {
    return Problem("changes its image size at frame " + std::to_string(frame.index),
                   "cut it in two there");
  }
  const bool ordinary = colours_.ordinary();
  LARARIUM_ASSIGN_OR_RETURN(frame.bgr, ToBgr(picture, ordinary ? CV_8UC3 : CV_16UC3));
  if (!ordinary) {
    if (!table_) {
      table_.emplace(colours_, highlights_);
    }
    cv::Mat converted = pool_.Take(stored_.height, stored_.width, CV_8UC3);
    table_->Apply(frame.bgr, converted);
    frame.bgr = converted;
  }
  if (square_ != stored_) {
    cv::Mat square = pool_.Take(square_.height, square_.width, CV_8UC3);
    cv::resize(frame.bgr, square, square_, 0.0, 0.0,
               square_.width < stored_.width ? cv::INTER_AREA : cv::INTER_CUBIC);
    frame.bgr = square;
  }
  PixelOrientation orientation = OrientationOf(picture);
  if (orientation.SizeOf(square_) != size_) {
    // All images have one size and the same lens, so these remain as the first one lies.
    orientation = first_orientation_;
    if (!std::exchange(turns_, true)) {
      Note("is turned between upright and lying at frame " + std::to_string(frame.index) +
           "; images that are turned otherwise than its first lie on their side");
    }
  }
  if (!orientation.upright()) {
    cv::Mat upright = pool_.Take(size_.height, size_.width, CV_8UC3);
    orientation.Apply(frame.bgr, upright);
    frame.bgr = upright;
  }
  frame.grey = pool_.Take(size_.height, size_.width, CV_8UC1);
  cv::cvtColor(frame.bgr, frame.grey, cv::COLOR_BGR2GRAY);
  return Status();
}

// Converts a picture. An interlaced one gives only its upper field, in the even rows.
Result<cv::Mat> FilmConverter::ToBgr(const AVFrame& picture, int type) {
  const int step = image::IsInterlaced(picture) ? 2 : 1;
  const int rows = (stored_.height + step - 1) / step;
  LARARIUM_RETURN_IF_ERROR(PrepareScaler(picture, rows, type));
  cv::Mat image = pool_.Take(stored_.height, stored_.width, type);
  std::array<int, AV_NUM_DATA_POINTERS> strides = {};
  std::transform(std::begin(picture.linesize), std::end(picture.linesize), strides.begin(),
                 [step](int stride) { return step * stride; });
  uint8_t* const planes[] = {image.data};
  const int image_strides[] = {static_cast<int>(step * image.step)};
  sws_scale(scaler_.get(), picture.data, strides.data(), 0, rows, planes, image_strides);
  if (step == 2) {
    FillOddRows(image);
  }
  return image;
}

Status FilmConverter::PrepareScaler(const AVFrame& picture, int rows, int type) {
  const AVPixelFormat format = WithoutRange(static_cast<AVPixelFormat>(picture.format));
  scaler_.reset(sws_getCachedContext(scaler_.release(), stored_.width, rows, format, stored_.width,
                                     rows, type == CV_16UC3 ? AV_PIX_FMT_BGR48 : AV_PIX_FMT_BGR24,
                                     SWS_BILINEAR | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT, nullptr,
                                     nullptr, nullptr));
  if (scaler_ == nullptr) {
    return Problem("has a pixel format that cannot be converted",
                   "convert the film to H.264 in MP4");
  }
  sws_setColorspaceDetails(scaler_.get(), ColourMatrix(picture), IsFullRange(picture) ? 1 : 0,
                           sws_getCoefficients(SWS_CS_DEFAULT), 1, 0, 1 << 16, 1 << 16);
  return Status();
}

Status FilmConverter::Problem(const std::string& problem, const std::string& remedy) const {
  return Status::Error(file_.string(), problem, remedy);
}

}  // namespace lararium::capture
