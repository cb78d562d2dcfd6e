#include "shared/image/image_header.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

namespace lararium::image {
namespace {

using Format = ImageHeader::Format;

std::optional<ImageHeader> Read(const std::string& bytes) {
  return ReadImageHeader(std::as_bytes(std::span(bytes)));
}

std::string Text(std::initializer_list<int> bytes) {
  std::string text;
  for (const int byte : bytes) {
    text += static_cast<char>(byte);
  }
  return text;
}

std::string Png() {
  return "\x89PNG\r\n\x1a\n" + Text({0, 0, 0, 13}) + "IHDR" + Text({0, 0, 2, 0x80, 0, 0, 1, 0xe0});
}

// A progressive JPEG with a segment before the frame's, and padding.
std::string Jpeg() {
  return Text(
      {0xff, 0xd8, 0xff, 0xe0, 0, 4, 1, 2, 0xff, 0xff, 0xff, 0xc2, 0, 11, 8, 1, 0xe0, 2, 0x80});
}

std::string Bmp(int32_t height) {
  std::string bytes = "BM" + std::string(16, '\0') + Text({0x80, 2, 0, 0});
  for (int i = 0; i < 4; ++i) {
    bytes += static_cast<char>(static_cast<uint32_t>(height) >> (8 * i));
  }
  return bytes;
}

std::string Tiff() {
  std::vector<uint8_t> bytes;
  EXPECT_TRUE(cv::imencode(".tif", cv::Mat(480, 640, CV_8UC1, cv::Scalar(7)), bytes));
  return {bytes.begin(), bytes.end()};
}

std::string Webp(const std::string& chunk, std::initializer_list<int> content) {
  return "RIFF" + Text({30, 0, 0, 0}) + "WEBP" + chunk + Text({10, 0, 0, 0}) + Text(content);
}
std::string LossyWebp() { return Webp("VP8 ", {0, 0, 0, 0x9d, 1, 0x2a, 0x80, 0x42, 0xe0, 0x81}); }
std::string LosslessWebp() { return Webp("VP8L", {0x2f, 0x7f, 0xc2, 0x77, 0, 0, 0, 0, 0, 0}); }
std::string ExtendedWebp() { return Webp("VP8X", {0, 0, 0, 0, 0x7f, 2, 0, 0xdf, 1, 0}); }

std::string Psd() {
  return "8BPS" + Text({0, 1, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0, 1, 0xe0, 0, 0, 2, 0x80, 0, 8, 0, 3});
}
std::string Dds() {
  return "DDS " + Text({124, 0, 0, 0, 7, 0x10, 0, 0, 0xe0, 1, 0, 0, 0x80, 2, 0, 0});
}
std::string Tga() {
  return Text({0, 0, 10, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0x80, 2, 0xe0, 1, 24, 0x20});
}

TEST(ImageHeader, TellsFormatAndSize) {
  EXPECT_EQ(Read(Png()), (ImageHeader{Format::kPng, 640, 480}));
  EXPECT_EQ(Read(Jpeg()), (ImageHeader{Format::kJpeg, 640, 480}));
  EXPECT_EQ(Read(Bmp(480)), (ImageHeader{Format::kBmp, 640, 480}));
  EXPECT_EQ(Read(Tiff()), (ImageHeader{Format::kTiff, 640, 480}));
  EXPECT_EQ(Read(LossyWebp()), (ImageHeader{Format::kWebp, 640, 480})) << "two bits are a scale";
  EXPECT_EQ(Read(LosslessWebp()), (ImageHeader{Format::kWebp, 640, 480}));
  EXPECT_EQ(Read(ExtendedWebp()), (ImageHeader{Format::kWebp, 640, 480}));
  EXPECT_EQ(Read(Psd()), (ImageHeader{Format::kPsd, 640, 480}));
  EXPECT_EQ(Read(Dds()), (ImageHeader{Format::kDds, 640, 480}));
  EXPECT_EQ(Read(Tga()), (ImageHeader{Format::kTga, 640, 480}));
  EXPECT_EQ(Read(Bmp(-480)), (ImageHeader{Format::kBmp, 640, 480})) << "the top row first";
}

TEST(ImageHeader, KnowsNothingOfWhatIsCutShort) {
  for (const std::string& whole : {Png(), Jpeg(), Bmp(480), LossyWebp(), LosslessWebp(),
                                   ExtendedWebp(), Psd(), Dds(), Tga()}) {
    for (size_t size = 0; size < whole.size(); ++size) {
      EXPECT_FALSE(Read(whole.substr(0, size)).has_value()) << size;
    }
  }
}

TEST(ImageHeader, TakesNothingElseForAnImage) {
  EXPECT_FALSE(Read(std::string(500, '\0')).has_value());
  EXPECT_FALSE(Read("GIF89a" + std::string(50, 'x')).has_value());
  std::string png = Png();
  png[12] = 'J';
  EXPECT_FALSE(Read(png).has_value()) << "another chunk first";
  EXPECT_FALSE(Read(Text({0xff, 0xd8}) + std::string(50, 'x')).has_value());
}

TEST(ImageHeader, ReturnsSizesThatNobodyCouldHold) {
  std::string png = Png();
  png[16] = '\xff';
  EXPECT_EQ(Read(png)->width, 0xff000280u);
  EXPECT_EQ(Read(Bmp(INT32_MIN))->height, 0x80000000u);
}

TEST(ImageHeader, EndsWhereSegmentsHaveNoLength) {
  EXPECT_FALSE(
      Read(Text({0xff, 0xd8, 0xff, 0xe0, 0, 0, 0xff, 0xe0, 0, 0, 0xff, 0xe0, 0, 0})).has_value());
}

}  // namespace
}  // namespace lararium::image
