#include "editor/bake/radiance.h"

#include <gmock/gmock.h>

#include <bit>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "shared/core/random.h"

namespace lararium::bake {
namespace {

using ::testing::HasSubstr;

std::span<const std::byte> Bytes(const std::string& text) { return std::as_bytes(std::span(text)); }

cv::Mat Light(cv::Size size, bool noisy) {
  Random random(5);
  cv::Mat light(size, CV_32FC3);
  for (int y = 0; y < light.rows; ++y) {
    for (int x = 0; x < light.cols; ++x) {
      const float noise = noisy ? static_cast<float>(random.Below(1000)) : 0.0f;
      light.at<cv::Vec3f>(y, x) = {0.01f * static_cast<float>(x / 9), 3.0f + noise,
                                   100.0f * static_cast<float>(y)};
    }
  }
  return light;
}

std::string EncodedRadiance(const cv::Mat& light) {
  std::vector<uint8_t> bytes;
  EXPECT_TRUE(cv::imencode(".hdr", light, bytes));
  return {bytes.begin(), bytes.end()};
}

void ExpectAsOpenCvReads(const std::string& file) {
  const auto image = ParseRadiance(Bytes(file), "p.hdr");
  ASSERT_TRUE(image.ok()) << image.message();
  const cv::Mat reference =
      cv::imdecode(std::vector<uint8_t>(file.begin(), file.end()), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(cv::Size(image->width, image->height), reference.size());
  for (size_t i = 0; i < image->pixels.size(); ++i) {
    const cv::Vec3f& bgr = reference.at<cv::Vec3f>(static_cast<int>(i));
    ASSERT_FLOAT_EQ(image->pixels[i].r, bgr[2]) << i;
    ASSERT_FLOAT_EQ(image->pixels[i].g, bgr[1]) << i;
    ASSERT_FLOAT_EQ(image->pixels[i].b, bgr[0]) << i;
  }
}

const std::string kHeader = "#?RADIANCE\nEXPOSURE=1.0\nFORMAT=32-bit_rle_rgbe\n\n";

TEST(ParseRadiance, GivesTheLightThatOpenCvGives) {
  ExpectAsOpenCvReads(EncodedRadiance(Light({64, 32}, false)));
  ExpectAsOpenCvReads(EncodedRadiance(Light({64, 32}, true)));
  ExpectAsOpenCvReads(EncodedRadiance(Light({5, 3}, true))) /* too narrow for runs */;
}

TEST(ParseRadiance, KnowsThatAHundredAndTwentyEightIsOneHalf) {
  const std::string pixels = {'\x80', '\x40', '\x01', '\x81', '\x7f', '\x7f', '\x7f', '\x00'};
  const auto image = ParseRadiance(Bytes(kHeader + "-Y 1 +X 2\n" + pixels), "p.hdr");
  ASSERT_TRUE(image.ok()) << image.message();
  EXPECT_EQ(image->pixels[0], glm::vec3(1.0f, 0.5f, 1.0f / 128.0f));
  EXPECT_EQ(image->pixels[1], glm::vec3(0.0f)) << "no exponent: black";
}

TEST(ParseRadiance, RepeatsPixelsOfOldRuns) {
  // One pixel, then two repeats; then a run of 1 + 1 * 256, which exceeds the row.
  const std::string pixel = {'\x80', '\x80', '\x80', '\x81'};
  const std::string twice = {'\x01', '\x01', '\x01', '\x02'};
  const std::string once = {'\x01', '\x01', '\x01', '\x01'};
  const auto image = ParseRadiance(Bytes(kHeader + "-Y 1 +X 3\n" + pixel + twice), "p.hdr");
  ASSERT_TRUE(image.ok()) << image.message();
  EXPECT_EQ(image->pixels[2], glm::vec3(1.0f));
  EXPECT_FALSE(ParseRadiance(Bytes(kHeader + "-Y 1 +X 9\n" + pixel + once + once), "p").ok());
  EXPECT_FALSE(ParseRadiance(Bytes(kHeader + "-Y 1 +X 3\n" + twice + pixel), "p").ok());
}

TEST(ParseRadiance, DividesByExposuresAndColourCorrections) {
  const std::string pixels = {'\x80', '\x80', '\x80', '\x81'};
  const auto image = ParseRadiance(Bytes("#?RADIANCE\nEXPOSURE= 2\nCOLORCORR=1 .5 4\n# EXPOSURE=9\n"
                                         "EXPOSURE=4.0\nCOLORCORR=2 1 1\n\n-Y 1 +X 1\n" +
                                         pixels),
                                   "p.hdr");
  ASSERT_TRUE(image.ok()) << image.message();
  EXPECT_EQ(image->pixels[0], glm::vec3(1.0f / 16.0f, 0.25f, 1.0f / 32.0f));
  EXPECT_TRUE(image->warnings.empty());
}

TEST(ParseRadiance, TurnsRowsAndColumnsOfEveryOrder) {
  // The picture 1 2 4; stored as the file's rows.
  //             8 16 32
  const auto stored = [](std::initializer_list<int> values) {
    std::string pixels;
    for (const int value : values) {
      pixels +=
          {'\x80', '\x80', '\x80', static_cast<char>(129 + std::countr_zero(unsigned(value)))};
    }
    return pixels;
  };
  const std::vector<std::pair<std::string, std::string>> files = {
      {"-Y 2 +X 3", stored({1, 2, 4, 8, 16, 32})}, {"+Y 2 +X 3", stored({8, 16, 32, 1, 2, 4})},
      {"-Y 2 -X 3", stored({4, 2, 1, 32, 16, 8})}, {"+Y 2 -X 3", stored({32, 16, 8, 4, 2, 1})},
      {"+X 3 -Y 2", stored({1, 8, 2, 16, 4, 32})}, {"-X 3 -Y 2", stored({4, 32, 2, 16, 1, 8})},
      {"+X 3 +Y 2", stored({8, 1, 16, 2, 32, 4})}, {"-X 3 +Y 2", stored({32, 4, 16, 2, 8, 1})}};
  for (const auto& [size, pixels] : files) {
    const auto image = ParseRadiance(Bytes(kHeader + size + "\n" + pixels), "p.hdr");
    ASSERT_TRUE(image.ok()) << size << image.message();
    ASSERT_EQ(image->width, 3) << size;
    for (size_t i = 0; i < 6; ++i) {
      EXPECT_EQ(image->pixels[i].g, static_cast<float>(1 << i)) << size << ", pixel " << i;
    }
  }
}

TEST(ParseRadiance, RefusesEveryCut) {
  const std::string whole = EncodedRadiance(Light({64, 32}, true));
  for (size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(ParseRadiance(Bytes(whole.substr(0, size)), "cut.hdr").ok()) << size;
  }
}

TEST(ParseRadiance, SaysWhatIsWrong) {
  const auto message = [](const std::string& file) {
    return ParseRadiance(Bytes(file), "p.hdr").message();
  };
  EXPECT_THAT(message("\x89PNG"), HasSubstr("p.hdr: not a Radiance"));
  EXPECT_THAT(message("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd"),
              HasSubstr("export it as RGBE"));
  EXPECT_THAT(message(kHeader + "+X 2 -X 2\n"), HasSubstr("rows from the top"));
  EXPECT_THAT(message(kHeader + "-Y 2 +X\n"), HasSubstr("rows from the top"));
  EXPECT_THAT(message("#?RADIANCE\nEXPOSURE=0\n\n-Y 1 +X 1\nabcd"), HasSubstr("EXPOSURE=0"));
  EXPECT_THAT(message("#?RADIANCE\nCOLORCORR=1 2\n\n-Y 1 +X 1\nabcd"), HasSubstr("COLORCORR=1 2"));
  EXPECT_THAT(message(kHeader + "-Y 60000 +X 60000\nabcd"), HasSubstr("too short for its size"));
  EXPECT_THAT(message(kHeader + "-Y 0 +X 2\nabcd"), HasSubstr("-Y 0 +X 2"));
}

}  // namespace
}  // namespace lararium::bake
