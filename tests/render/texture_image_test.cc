#include "shared/render/gl/texture_image.h"

#include <gmock/gmock.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "shared/core/random.h"

namespace lararium::render {
namespace {

using ::testing::HasSubstr;

cv::Mat Noise(int type, uint64_t seed) {
  cv::Mat image(5, 7, type);
  Random random(seed);
  for (size_t i = 0; i < image.total() * image.elemSize(); ++i) {
    image.data[i] = static_cast<uint8_t>(random.Below(256));
  }
  return image;
}

std::vector<std::byte> Encode(const cv::Mat& image, const char* extension) {
  std::vector<uint8_t> bytes;
  EXPECT_TRUE(cv::imencode(extension, image, bytes));
  const auto encoded = std::as_bytes(std::span(bytes));
  return {encoded.begin(), encoded.end()};
}

TEST(DecodeTexture, ReadsWhatAPngHolds) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC3}) {
    const cv::Mat image = Noise(type, 1);
    const auto decoded = DecodeTexture(Encode(image, ".png"), "t");
    ASSERT_TRUE(decoded.ok()) << decoded.message();
    ASSERT_EQ(decoded->type(), CV_8UC4);
    ASSERT_EQ(decoded->size(), image.size());
    const cv::Vec4b pixel = decoded->at<cv::Vec4b>(2, 3);
    if (type == CV_8UC1) {
      EXPECT_EQ(pixel, cv::Vec4b(image.at<uint8_t>(2, 3), image.at<uint8_t>(2, 3),
                                 image.at<uint8_t>(2, 3), 255));
    } else if (type == CV_8UC4) {
      EXPECT_EQ(pixel, image.at<cv::Vec4b>(2, 3));
    } else if (type == CV_8UC3) {
      const cv::Vec3b bgr = image.at<cv::Vec3b>(2, 3);
      EXPECT_EQ(pixel, cv::Vec4b(bgr[0], bgr[1], bgr[2], 255));
    }
  }
}

TEST(DecodeTexture, ReadsJpegs) {
  const cv::Mat image(20, 12, CV_8UC3, cv::Scalar(40, 90, 200));
  const auto decoded = DecodeTexture(Encode(image, ".jpg"), "t");
  ASSERT_TRUE(decoded.ok()) << decoded.message();
  EXPECT_EQ(decoded->size(), cv::Size(12, 20));
  EXPECT_NEAR(decoded->at<cv::Vec4b>(10, 6)[2], 200, 3);
}

TEST(DecodeTexture, SaysWhatIsWrongAndWhere) {
  std::vector<std::byte> png = Encode(Noise(CV_8UC3, 2), ".png");
  EXPECT_THAT(DecodeTexture({}, "keeper: texture 'skin'").message(),
              HasSubstr("keeper: texture 'skin': is not a PNG or JPEG"));
  EXPECT_THAT(DecodeTexture(std::vector<std::byte>(500), "t").message(), HasSubstr("not a PNG"));
  std::vector<std::byte> cut(png.begin(), png.begin() + 30);
  EXPECT_THAT(DecodeTexture(cut, "t").message(), HasSubstr("damaged or cut short"));
}

TEST(DecodeTexture, RefusesHugeImagesBeforeItDecodesThem) {
  std::vector<std::byte> png = Encode(Noise(CV_8UC3, 3), ".png");
  png[16] = std::byte{0x7f};  // a width of two thousand million
  EXPECT_THAT(DecodeTexture(png, "t").message(), HasSubstr("reduce it to at most 8192"));
  png[16] = std::byte{0xff};
  EXPECT_THAT(DecodeTexture(png, "t").message(), HasSubstr("reduce it to at most 8192"));
}

TEST(DecodeTexture, SurvivesEveryCutAndFlip) {
  for (const char* extension : {".png", ".jpg"}) {
    const std::vector<std::byte> whole = Encode(Noise(CV_8UC3, 4), extension);
    for (size_t size = 0; size < whole.size(); ++size) {
      std::vector<std::byte> bytes(whole.begin(), whole.begin() + static_cast<ptrdiff_t>(size));
      const auto decoded = DecodeTexture(bytes, "t");
      EXPECT_TRUE(!decoded.ok() || decoded->size() == cv::Size(7, 5)) << size;
    }
  }
}

TEST(DecodeForUse, HalvesOftenEnoughButSmallImagesLess) {
  for (const char* extension : {".png", ".jpg"}) {
    const std::vector<std::byte> encoded =
        Encode(cv::Mat(513, 300, CV_8UC3, cv::Scalar(40, 90, 200)), extension);
    for (const auto& [halvings, size] : {std::pair{0, cv::Size(300, 513)},
                                         {1, cv::Size(150, 257)},
                                         {2, cv::Size(75, 129)},
                                         {3, cv::Size(75, 129)}}) {
      const auto decoded = DecodeForUse(encoded, TextureUse::kColour, halvings, "t");
      ASSERT_TRUE(decoded.ok()) << decoded.message();
      EXPECT_EQ(decoded->size(), size) << extension;
      EXPECT_NEAR(decoded->at<cv::Vec4b>(100, 50)[2], 200, 3);
      EXPECT_EQ(decoded->at<cv::Vec4b>(100, 50)[3], 255);
    }
  }
}

// Colours of transparent pixels must not influence those of covered pixels.
TEST(DecodeForUse, HalvesColoursAfterTheyAreMultipliedWithCoverage) {
  cv::Mat image(256, 256, CV_8UC4, cv::Scalar(255, 255, 255, 0));
  for (int x = 0; x < 256; x += 2) {
    image.col(x).setTo(cv::Scalar(10, 100, 200, 255));
  }
  const auto colour = DecodeForUse(Encode(image, ".png"), TextureUse::kColour, 1, "t");
  ASSERT_TRUE(colour.ok()) << colour.message();
  EXPECT_LE(cv::norm(colour->at<cv::Vec4b>(60, 60) - cv::Vec4b(5, 50, 100, 128), cv::NORM_INF), 1);
  const auto normals = DecodeForUse(Encode(image, ".png"), TextureUse::kNormal, 1, "t");
  ASSERT_TRUE(normals.ok()) << normals.message();
  EXPECT_NEAR(normals->at<cv::Vec4b>(60, 60)[0], 132, 1);
}

TEST(PremultiplySrgb, MultipliesLight) {
  cv::Mat image(1, 3, CV_8UC4);
  image.at<cv::Vec4b>(0) = {200, 100, 50, 255};
  image.at<cv::Vec4b>(1) = {255, 255, 255, 128};
  image.at<cv::Vec4b>(2) = {200, 100, 50, 0};
  PremultiplySrgb(image);
  EXPECT_EQ(image.at<cv::Vec4b>(0), cv::Vec4b(200, 100, 50, 255));
  // Half of the light of white is 188 in sRGB.
  EXPECT_EQ(image.at<cv::Vec4b>(1), cv::Vec4b(188, 188, 188, 128));
  EXPECT_EQ(image.at<cv::Vec4b>(2), cv::Vec4b(0, 0, 0, 0));
}

}  // namespace
}  // namespace lararium::render
