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

void Append(std::vector<uint8_t>& bytes, std::initializer_list<int> values) {
  for (const int value : values) {
    bytes.push_back(static_cast<uint8_t>(value));
  }
}

std::vector<std::byte> Bytes(const std::vector<uint8_t>& bytes) {
  const auto encoded = std::as_bytes(std::span(bytes));
  return {encoded.begin(), encoded.end()};
}

// A BGR or BGRA picture as a Targa file, the top row first; in_runs: each pixel is a run of one.
std::vector<std::byte> Tga(const cv::Mat& image, bool in_runs) {
  const int channels = image.channels();
  std::vector<uint8_t> bytes;
  Append(bytes, {0, 0, in_runs ? 10 : 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, image.cols, 0, image.rows, 0,
                 8 * channels, channels == 4 ? 0x28 : 0x20});
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      if (in_runs) {
        bytes.push_back(0x80);
      }
      const uint8_t* pixel = image.ptr(y) + channels * x;
      bytes.insert(bytes.end(), pixel, pixel + channels);
    }
  }
  return Bytes(bytes);
}

// A BGR picture as an image of Photoshop without layers: planes of red, green and blue.
std::vector<std::byte> Psd(const cv::Mat& image) {
  std::vector<uint8_t> bytes = {'8', 'B', 'P', 'S'};
  Append(bytes,
         {0, 1, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0, image.rows, 0, 0, 0, image.cols, 0, 8, 0, 3});
  Append(bytes, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});  // No palette, resources, layers; raw.
  for (int channel = 2; channel >= 0; --channel) {
    for (int y = 0; y < image.rows; ++y) {
      for (int x = 0; x < image.cols; ++x) {
        bytes.push_back(image.at<cv::Vec3b>(y, x)[channel]);
      }
    }
  }
  return Bytes(bytes);
}

// A BGRA picture as an uncompressed image of DirectDraw.
std::vector<std::byte> Dds(const cv::Mat& image) {
  std::vector<uint8_t> bytes = {'D', 'D', 'S', ' '};
  Append(bytes, {124, 0, 0, 0, 0x0f, 0x10, 0, 0, image.rows, 0, 0, 0, image.cols, 0, 0, 0});
  Append(bytes, {4 * image.cols, 0, 0, 0});
  bytes.resize(76);
  Append(bytes, {32, 0, 0, 0, 0x41, 0, 0, 0, 0, 0, 0, 0, 32, 0, 0, 0});  // RGB with alpha.
  Append(bytes, {0, 0, 255, 0, 0, 255, 0, 0, 255, 0, 0, 0, 0, 0, 0, 255, 0, 0x10, 0, 0});
  bytes.resize(128);
  for (int y = 0; y < image.rows; ++y) {
    bytes.insert(bytes.end(), image.ptr(y), image.ptr(y) + 4 * image.cols);
  }
  return Bytes(bytes);
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

TEST(DecodeImage, ReadsTheFilesInWhichModelsKeepTextures) {
  const cv::Mat opaque = Picture(CV_8UC3);
  const cv::Mat transparent = Picture(CV_8UC4);
  const auto expect = [](const std::vector<std::byte>& encoded, Channels channels,
                         const cv::Mat& picture) {
    const auto decoded = DecodeImage(encoded, channels, "p");
    ASSERT_TRUE(decoded.ok()) << decoded.message();
    EXPECT_EQ(Difference(*decoded, picture), 0.0);
    for (size_t size = 0; size < encoded.size(); ++size) {
      const auto cut = DecodeImage(std::span(encoded.data(), size), channels, "cut");
      EXPECT_FALSE(cut.ok()) << size << " of " << encoded.size();
    }
  };
  for (const bool in_runs : {false, true}) {
    SCOPED_TRACE(in_runs ? "Targa in runs" : "Targa");
    expect(Tga(opaque, in_runs), Channels::kBgr, opaque);
    expect(Tga(transparent, in_runs), Channels::kBgra, transparent);
  }
  SCOPED_TRACE("DirectDraw, Photoshop");
  expect(Dds(transparent), Channels::kBgra, transparent);
  expect(Psd(opaque), Channels::kBgr, opaque);
}

TEST(DecodeImage, ReadsABlockOfCompressedPixels) {
  std::vector<uint8_t> bytes = {'D', 'D', 'S', ' '};
  Append(bytes, {124, 0, 0, 0, 0x07, 0x10, 8, 0, 4, 0, 0, 0, 4, 0, 0, 0, 8, 0, 0, 0});
  bytes.resize(76);
  Append(bytes, {32, 0, 0, 0, 4, 0, 0, 0, 'D', 'X', 'T', '1'});
  bytes.resize(108);
  Append(bytes, {0, 0x10, 0, 0});
  bytes.resize(128);
  // Red and blue as 5, 6 and 5 bits; rows choose the first, the second, and the two between them.
  Append(bytes, {0x00, 0xf8, 0x1f, 0x00, 0x00, 0x55, 0xaa, 0xff});
  const auto decoded = DecodeImage(Bytes(bytes), Channels::kBgr, "p");
  ASSERT_TRUE(decoded.ok()) << decoded.message();
  ASSERT_EQ(decoded->size(), cv::Size(4, 4));
  EXPECT_EQ(decoded->at<cv::Vec3b>(0, 1), cv::Vec3b(0, 0, 255));
  EXPECT_EQ(decoded->at<cv::Vec3b>(1, 2), cv::Vec3b(255, 0, 0));
  EXPECT_EQ(decoded->at<cv::Vec3b>(2, 3), cv::Vec3b(85, 0, 170));
  EXPECT_EQ(decoded->at<cv::Vec3b>(3, 0), cv::Vec3b(170, 0, 85));
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
  std::vector<std::vector<std::byte>> pictures = {Tga(Picture(CV_8UC3), false),
                                                  Tga(Picture(CV_8UC3), true),
                                                  Dds(Picture(CV_8UC4)), Psd(Picture(CV_8UC3))};
  for (const char* ending : {".png", ".jpg", ".bmp", ".tif", ".webp"}) {
    pictures.push_back(Encoded(Picture(CV_8UC3), ending));
  }
  for (const std::vector<std::byte>& whole : pictures) {
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
