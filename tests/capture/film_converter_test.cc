#include "shared/capture/film_converter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace lararium::capture {
namespace {

using image::LibavPtr;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct FormatDeleter {
  void operator()(AVFormatContext* context) const { avformat_free_context(context); }
};

// A film without a file, of one picture.
class Film {
 public:
  explicit Film(cv::Size size, AVPixelFormat format = AV_PIX_FMT_YUV420P)
      : container_(avformat_alloc_context()),
        stream_(avformat_new_stream(container_.get(), nullptr)),
        picture_(av_frame_alloc()) {
    picture_->width = size.width;
    picture_->height = size.height;
    picture_->format = format;
    picture_->colorspace = AVCOL_SPC_BT709;
    picture_->color_range = AVCOL_RANGE_MPEG;
    CHECK(av_frame_get_buffer(picture_.get(), 0) == 0);
    for (int plane = 0; plane < 3; ++plane) {
      const int rows = plane == 0 ? size.height : (size.height + 1) / 2;
      std::memset(picture_->data[plane], 128,
                  static_cast<size_t>(rows) * static_cast<size_t>(picture_->linesize[plane]));
    }
  }

  AVFrame& picture() { return *picture_; }
  AVStream& stream() { return *stream_; }
  uint8_t& Luma(int x, int y) { return picture_->data[0][y * picture_->linesize[0] + x]; }

  void SetInterlaced() {
#ifdef AV_FRAME_FLAG_INTERLACED
    picture_->flags |= AV_FRAME_FLAG_INTERLACED;
#else
    picture_->interlaced_frame = 1;
#endif
  }
  void SetMatrix(std::array<int32_t, 9> matrix) {
    AVFrameSideData* data =
        av_frame_new_side_data(picture_.get(), AV_FRAME_DATA_DISPLAYMATRIX, sizeof(matrix));
    std::memcpy(data->data, matrix.data(), sizeof(matrix));
  }

  Result<FilmConverter> Open() {
    return FilmConverter::Create("film.mp4", *container_, *stream_, *picture_);
  }
  cv::Mat Grey() {
    Result<FilmConverter> converter = Open();
    EXPECT_TRUE(converter.ok()) << converter.message();
    geometry::Frame frame;
    const Status converted = converter->Convert(*picture_, frame);
    EXPECT_TRUE(converted.ok()) << converted.message();
    EXPECT_EQ(frame.bgr.size(), converter->size());
    return frame.grey;
  }
  std::vector<std::string> Notes() {
    Result<FilmConverter> converter = Open();
    EXPECT_TRUE(converter.ok()) << converter.message();
    return converter->notes();
  }

 private:
  std::unique_ptr<AVFormatContext, FormatDeleter> container_;
  AVStream* stream_;
  LibavPtr<AVFrame> picture_;
};

// White in the upper left quarter, black elsewhere.
void PaintCorner(Film& film) {
  for (int y = 0; y < film.picture().height; ++y) {
    for (int x = 0; x < film.picture().width; ++x) {
      film.Luma(x, y) = x < film.picture().width / 2 && y < film.picture().height / 2 ? 235 : 16;
    }
  }
}

double Mean(const cv::Mat& grey, double x, double y) {
  const cv::Rect middle(static_cast<int>(x * grey.cols) - 2, static_cast<int>(y * grey.rows) - 2, 4,
                        4);
  return cv::mean(grey(middle))[0];
}

TEST(FilmConverter, LeavesAnOrdinaryFilmAsItIs) {
  Film film({64, 48});
  PaintCorner(film);
  const cv::Mat grey = film.Grey();
  EXPECT_EQ(grey.size(), cv::Size(64, 48));
  EXPECT_GT(Mean(grey, 0.25, 0.25), 250.0);
  EXPECT_LT(Mean(grey, 0.75, 0.75), 5.0);
  EXPECT_THAT(film.Notes(), IsEmpty());
}

TEST(FilmConverter, TurnsAFilmOfAPhoneHeldUpright) {
  Film film({64, 48});
  PaintCorner(film);
  constexpr int32_t kOne = 1 << 16;
  film.SetMatrix({0, kOne, 0, -kOne, 0, 0, 0, 0, 1 << 30});  // a quarter turn clockwise
  const cv::Mat grey = film.Grey();
  EXPECT_EQ(grey.size(), cv::Size(48, 64));
  EXPECT_GT(Mean(grey, 0.75, 0.25), 250.0) << "the upper left corner is now the upper right one";
  EXPECT_LT(Mean(grey, 0.25, 0.25), 5.0);
}

TEST(FilmConverter, MakesPixelsSquare) {
  Film film({60, 48});
  PaintCorner(film);
  for (const auto& [aspect, width] :
       {std::pair<AVRational, int>{{4, 3}, 80}, {{8, 9}, 53}, {{1001, 1000}, 60}, {{0, 1}, 60}}) {
    film.picture().sample_aspect_ratio = aspect;
    const cv::Mat grey = film.Grey();
    EXPECT_EQ(grey.size(), cv::Size(width, 48)) << aspect.num << ":" << aspect.den;
    EXPECT_GT(Mean(grey, 0.25, 0.25), 250.0);
    EXPECT_LT(Mean(grey, 0.75, 0.25), 5.0);
  }
  film.picture().sample_aspect_ratio = {1, 100};
  EXPECT_THAT(film.Open().message(), HasSubstr("film.mp4: has an image size outside"));
}

TEST(FilmConverter, MakesOneMomentOfAnInterlacedPicture) {
  // A white bar that stands 8 pixels farther to the right in the second field.
  Film film({96, 48});
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 96; ++x) {
      const int begin = y % 2 == 0 ? 24 : 32;
      film.Luma(x, y) = x >= begin && x < begin + 24 ? 235 : 16;
    }
  }
  const double combed = cv::norm(film.Grey().row(20), film.Grey().row(21), cv::NORM_INF);
  EXPECT_GT(combed, 200.0);
  film.SetInterlaced();
  const cv::Mat grey = film.Grey();
  for (int y = 1; y < grey.rows; ++y) {
    EXPECT_LE(cv::norm(grey.row(0), grey.row(y), cv::NORM_INF), 2.0) << y;
  }
  EXPECT_THAT(film.Notes(), ElementsAre(HasSubstr("interlaced")));
}

TEST(FilmConverter, KeepsTheRowsOfAnInterlacedPictureWhereTheyAre) {
  for (const int height : {48, 47}) {  // 4:2:0 with an odd height is rare but possible
    Film film({64, height});
    for (int y = 0; y < height; ++y) {
      std::fill_n(&film.Luma(0, y), 64, static_cast<uint8_t>(16 + 4 * y));
    }
    const cv::Mat progressive = film.Grey().clone();
    film.SetInterlaced();
    const cv::Mat grey = film.Grey();
    EXPECT_LE(
        cv::norm(grey.rowRange(2, height - 3), progressive.rowRange(2, height - 3), cv::NORM_INF),
        2.0);
  }
}

TEST(FilmConverter, HonoursTheRange) {
  Film film({64, 48});
  for (int y = 0; y < 48; ++y) {
    std::fill_n(&film.Luma(0, y), 64, uint8_t{60});
  }
  EXPECT_NEAR(Mean(film.Grey(), 0.5, 0.5), (60 - 16) * 255.0 / 219.0, 1.5);
  film.picture().color_range = AVCOL_RANGE_JPEG;
  EXPECT_NEAR(Mean(film.Grey(), 0.5, 0.5), 60.0, 1.5);
}

TEST(FilmConverter, ShowsAFilmWithAHighDynamicRangeAsAnOrdinaryOne) {
  Film film({64, 48}, AV_PIX_FMT_YUV420P10);
  const double signal = 0.5;  // HLG: 50.7 cd/m2
  for (int plane = 0; plane < 3; ++plane) {
    const int rows = plane == 0 ? 48 : 24;
    for (int y = 0; y < rows; ++y) {
      auto* row = reinterpret_cast<uint16_t*>(film.picture().data[plane] +
                                              y * film.picture().linesize[plane]);
      std::fill_n(row, plane == 0 ? 64 : 32,
                  static_cast<uint16_t>(plane == 0 ? 64 + 876 * signal : 512));
    }
  }
  film.picture().color_trc = AVCOL_TRC_ARIB_STD_B67;
  film.picture().color_primaries = AVCOL_PRI_BT2020;
  film.picture().colorspace = AVCOL_SPC_BT2020_NCL;
  Result<FilmConverter> converter = film.Open();
  ASSERT_TRUE(converter.ok()) << converter.message();
  EXPECT_TRUE(converter->high_dynamic_range());
  EXPECT_THAT(converter->notes(), ElementsAre(HasSubstr("HLG")));
  ASSERT_TRUE(converter->MeasureHighlights(film.picture()).ok());
  geometry::Frame frame;
  ASSERT_TRUE(converter->Convert(film.picture(), frame).ok());
  EXPECT_NEAR(Mean(frame.grey, 0.5, 0.5), 255.0 * std::pow(0.507, 1.0 / 2.4), 2.5);
}

TEST(FilmConverter, TellsOfColoursThatItDoesNotConvert) {
  Film film({64, 48});
  film.picture().color_trc = AVCOL_TRC_LOG;
  film.picture().colorspace = AVCOL_SPC_ICTCP;
  EXPECT_THAT(film.Notes(), ElementsAre(HasSubstr("log"), HasSubstr("ictcp")));
}

TEST(FilmConverter, RefusesAPictureThatGrows) {
  Film film({64, 48});
  Result<FilmConverter> converter = film.Open();
  ASSERT_TRUE(converter.ok()) << converter.message();
  geometry::Frame frame;
  frame.index = 7;
  Film larger({80, 48});
  EXPECT_THAT(converter->Convert(larger.picture(), frame).message(),
              HasSubstr("changes its image size at frame 7"));
}

TEST(FilmConverter, KeepsTheWayThatAFilmLiesWhereItTurnsInItsMiddle) {
  Film film({64, 48});
  PaintCorner(film);
  Result<FilmConverter> converter = film.Open();
  ASSERT_TRUE(converter.ok()) << converter.message();
  constexpr int32_t kOne = 1 << 16;
  film.SetMatrix({0, kOne, 0, -kOne, 0, 0, 0, 0, 1 << 30});
  for (const int64_t index : {7, 8}) {
    geometry::Frame frame;
    frame.index = index;
    ASSERT_TRUE(converter->Convert(film.picture(), frame).ok());
    EXPECT_EQ(frame.bgr.size(), cv::Size(64, 48));
    EXPECT_GT(Mean(frame.grey, 0.25, 0.25), 250.0);
    EXPECT_LT(Mean(frame.grey, 0.75, 0.25), 5.0);
  }
  EXPECT_THAT(converter->notes(), ElementsAre(HasSubstr("upright and lying at frame 7")));
}

}  // namespace
}  // namespace lararium::capture
