#include "shared/image/decode.h"

#include <gmock/gmock.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "shared/core/random.h"
#include "shared/image/encode.h"

namespace lararium::image {
namespace {

using ::testing::HasSubstr;

// A smooth picture, which JPEG preserves, with different channels.
cv::Mat Picture(int type, cv::Size size = {37, 23}) {
  cv::Mat image(size, CV_8UC3);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      image.at<cv::Vec3b>(y, x) =
          cv::Vec3b(cv::saturate_cast<uint8_t>(5 * x + y), cv::saturate_cast<uint8_t>(200 - 4 * y),
                    cv::saturate_cast<uint8_t>(40 + 2 * x + 3 * y));
    }
  }
  cv::Mat converted;
  switch (CV_MAT_CN(type)) {
    case 1:
      cv::cvtColor(image, converted, cv::COLOR_BGR2GRAY);
      break;
    case 4:
      cv::cvtColor(image, converted, cv::COLOR_BGR2BGRA);
      for (int i = 0; i < converted.rows; ++i) {
        converted.at<cv::Vec4b>(i, 3)[3] = static_cast<uint8_t>(10 * i);
      }
      break;
    default:
      converted = image;
  }
  if (CV_MAT_DEPTH(type) == CV_16U) {
    converted.convertTo(converted, CV_16U, 257.0);
  }
  return converted;
}

std::vector<std::byte> Encoded(const cv::Mat& image,
                               const std::string& ending,
                               const std::vector<int>& options = {}) {
  std::vector<uint8_t> bytes;
  EXPECT_TRUE(cv::imencode(ending, image, bytes, options));
  const auto encoded = std::as_bytes(std::span(bytes));
  return {encoded.begin(), encoded.end()};
}

cv::Mat Reference(const std::vector<std::byte>& encoded, int flags) {
  const cv::Mat bytes(1, static_cast<int>(encoded.size()), CV_8U,
                      const_cast<std::byte*>(encoded.data()));
  return cv::imdecode(bytes, flags | cv::IMREAD_IGNORE_ORIENTATION);
}

// The largest difference in any channel; huge if size or type differ.
double Difference(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() ? cv::norm(a, b, cv::NORM_INF) : 1e9;
}

TEST(DecodeImage, AJpegMayComeSmallerAndIsWhatItsPixelsAreOnAverage) {
  const cv::Mat picture = Picture(CV_8UC3, {91, 45});
  for (int halvings = 1; halvings <= kMostJpegHalvings; ++halvings) {
    const auto small = DecodeImage(Encoded(picture, ".jpg", {cv::IMWRITE_JPEG_QUALITY, 100}),
                                   Channels::kBgr, "p", halvings);
    ASSERT_TRUE(small.ok()) << small.message();
    const int cell = 1 << halvings;
    ASSERT_EQ(small->size(), cv::Size((91 + cell - 1) / cell, (45 + cell - 1) / cell));
    for (int y = 0; y < 45 / cell; ++y) {
      for (int x = 0; x < 91 / cell; ++x) {
        const cv::Scalar mean = cv::mean(picture(cv::Rect(cell * x, cell * y, cell, cell)));
        for (int c = 0; c < 3; ++c) {
          EXPECT_NEAR(small->at<cv::Vec3b>(y, x)[c], mean[c], 12.0) << x << ", " << y;
        }
      }
    }
    const auto png = DecodeImage(Encoded(picture, ".png"), Channels::kBgr, "p", halvings);
    ASSERT_TRUE(png.ok()) << png.message();
    EXPECT_EQ(png->size(), picture.size()) << "not a JPEG";
  }
}

TEST(DecodeImage, GivesThePixelsThatOpenCvGives) {
  struct Kind {
    std::string ending;
    std::vector<int> options;
    std::vector<int> types;
  };
  const std::vector<Kind> kinds = {
      {".png", {}, {CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC1, CV_16UC3}},
      {".png", {cv::IMWRITE_PNG_BILEVEL, 1}, {CV_8UC1}},
      {".jpg", {cv::IMWRITE_JPEG_QUALITY, 90}, {CV_8UC1, CV_8UC3}},
      {".jpg", {cv::IMWRITE_JPEG_PROGRESSIVE, 1}, {CV_8UC1, CV_8UC3}},
      {".bmp", {}, {CV_8UC1, CV_8UC3, CV_8UC4}},
      {".tif", {}, {CV_8UC1, CV_8UC3, CV_16UC3}},
      {".webp", {cv::IMWRITE_WEBP_QUALITY, 101}, {CV_8UC3}},  // lossless
  };
  for (const Kind& kind : kinds) {
    for (const int type : kind.types) {
      SCOPED_TRACE(kind.ending + " of type " + std::to_string(type));
      const auto encoded = Encoded(Picture(type), kind.ending, kind.options);
      const auto bgr = DecodeImage(encoded, Channels::kBgr, "p");
      ASSERT_TRUE(bgr.ok()) << bgr.message();
      EXPECT_EQ(Difference(*bgr, Reference(encoded, cv::IMREAD_COLOR)), 0.0);
      const auto grey = DecodeImage(encoded, Channels::kGrey, "p");
      ASSERT_TRUE(grey.ok()) << grey.message();
      EXPECT_LE(Difference(*grey, Reference(encoded, cv::IMREAD_GRAYSCALE)), 1.0);
    }
  }
}

TEST(DecodeImage, KeepsAlphaAndGivesTheWholeOfItWhereThereIsNone) {
  const cv::Mat image = Picture(CV_8UC4);
  const auto decoded = DecodeImage(Encoded(image, ".png"), Channels::kBgra, "p");
  ASSERT_TRUE(decoded.ok()) << decoded.message();
  EXPECT_EQ(Difference(*decoded, image), 0.0);
  for (const char* ending : {".png", ".jpg", ".bmp", ".tif"}) {
    const auto full = DecodeImage(Encoded(Picture(CV_8UC3), ending), Channels::kBgra, "p");
    ASSERT_TRUE(full.ok()) << full.message();
    ASSERT_EQ(full->type(), CV_8UC4);
    EXPECT_EQ(full->at<cv::Vec4b>(11, 20)[3], 255) << ending;
    EXPECT_NEAR(full->at<cv::Vec4b>(11, 20)[1], 156, 3) << ending;
  }
}

TEST(DecodeImage, NeverGivesAPartOfAPicture) {
  const cv::Mat image = Picture(CV_8UC3);
  for (const char* ending : {".png", ".jpg", ".bmp", ".tif", ".webp"}) {
    const auto whole = Encoded(image, ending);
    // The last bytes may not affect the picture: JPEG's end marker, PNG's last chunk.
    for (size_t size = 0; size + 16 < whole.size(); ++size) {
      const std::span<const std::byte> cut(whole.data(), size);
      const auto decoded = DecodeImage(cut, Channels::kBgr, "cut.img");
      const bool same =
          decoded.ok() && Difference(*decoded, Reference(whole, cv::IMREAD_COLOR)) == 0.0;
      EXPECT_TRUE(!decoded.ok() || same) << ending << " cut to " << size << " of " << whole.size();
      if (!decoded.ok()) {
        EXPECT_THAT(decoded.message(), HasSubstr("cut.img"));
      }
    }
  }
}

TEST(DecodeImage, SurvivesBytesThatChanged) {
  Random random(7);
  for (const char* ending : {".png", ".jpg", ".bmp", ".tif", ".webp"}) {
    const auto whole = Encoded(Picture(CV_8UC3), ending);
    for (int trial = 0; trial < 300; ++trial) {
      auto bytes = whole;
      for (int flips = 0; flips < 4; ++flips) {
        bytes[random.Below(bytes.size())] = static_cast<std::byte>(random.Below(256));
      }
      const auto decoded = DecodeImage(bytes, Channels::kBgr, "p");
      EXPECT_TRUE(!decoded.ok() || decoded->type() == CV_8UC3);
    }
  }
}

TEST(DecodeImage, RefusesSizesThatNoPictureHas) {
  auto png = Encoded(Picture(CV_8UC3), ".png");
  png[16] = std::byte{0x7f};  // a width of two thousand million
  EXPECT_FALSE(DecodeImage(png, Channels::kBgr, "p").ok());
  auto bmp = Encoded(Picture(CV_8UC3), ".bmp");
  bmp[21] = std::byte{0x7f};
  EXPECT_FALSE(DecodeImage(bmp, Channels::kBgr, "p").ok());
}

TEST(DecodeImage, SaysWhatItTakes) {
  const std::vector<std::byte> nothing(100);
  EXPECT_THAT(DecodeImage(nothing, Channels::kBgr, "a.xcf").message(), HasSubstr("a.xcf"));
  EXPECT_THAT(DecodeImage(nothing, Channels::kBgr, "a.xcf").message(),
              HasSubstr("PNG, JPEG, TIFF"));
  EXPECT_FALSE(DecodeImage({}, Channels::kBgr, "p").ok());
}

TEST(ReadImage, NamesTheFileThatIsMissing) {
  EXPECT_THAT(ReadImage("no/such.png", Channels::kGrey).message(), HasSubstr("no/such.png"));
}

}  // namespace
}  // namespace lararium::image
