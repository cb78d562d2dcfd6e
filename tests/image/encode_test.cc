#include "shared/image/encode.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "shared/core/file.h"
#include "shared/core/random.h"
#include "shared/image/decode.h"

namespace lararium::image {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

cv::Mat Noise(int type, cv::Size size = {29, 17}) {
  cv::Mat image(size, type);
  Random random(11);
  for (size_t i = 0; i < image.total() * image.elemSize(); ++i) {
    image.data[i] = static_cast<uint8_t>(random.Below(256));
  }
  return image;
}

Channels ChannelsOf(const cv::Mat& image) {
  return image.channels() == 1   ? Channels::kGrey
         : image.channels() == 3 ? Channels::kBgr
                                 : Channels::kBgra;
}

TEST(EncodePng, LosesNothing) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4}) {
    // Includes a part of a larger picture, whose rows have gaps between them.
    for (const cv::Mat& image : {Noise(type), Noise(type)(cv::Rect(3, 2, 11, 9))}) {
      for (const int compression : {1, 9}) {
        const auto png = EncodePng(image, compression);
        ASSERT_TRUE(png.ok()) << png.message();
        const auto decoded = DecodeImage(*png, ChannelsOf(image), "p");
        ASSERT_TRUE(decoded.ok()) << decoded.message();
        EXPECT_EQ(cv::norm(*decoded, image, cv::NORM_INF), 0.0);
      }
    }
  }
}

TEST(EncodeJpeg, GivesTheBytesThatOpenCvGives) {
  for (const int type : {CV_8UC1, CV_8UC3}) {
    const cv::Mat image = Noise(type, {64, 48});
    const auto jpeg = EncodeJpeg(image, 88);
    ASSERT_TRUE(jpeg.ok()) << jpeg.message();
    std::vector<uint8_t> reference;
    ASSERT_TRUE(cv::imencode(".jpg", image, reference,
                             {cv::IMWRITE_JPEG_QUALITY, 88, cv::IMWRITE_JPEG_OPTIMIZE, 1}));
    const auto bytes = std::as_bytes(std::span(reference));
    EXPECT_TRUE(std::equal(jpeg->begin(), jpeg->end(), bytes.begin(), bytes.end()));
  }
}

TEST(EncodeJpeg, RefusesWhatAJpegCannotHold) {
  EXPECT_THAT(EncodeJpeg(cv::Mat(1, 70'000, CV_8UC1, cv::Scalar(0)), 90).message(),
              HasSubstr("JPEG"));
}

TEST(WriteImage, WritesAsTheEndingSaysAndRefusesOthers) {
  const fs::path folder = fs::path(::testing::TempDir()) / "lararium_write_image";
  fs::create_directories(folder);
  const cv::Mat image = Noise(CV_8UC3);
  ASSERT_TRUE(WriteImage(folder / "a.PNG", image).ok());
  ASSERT_TRUE(WriteImage(folder / "a.jpeg", image, 50).ok());
  EXPECT_EQ(cv::norm(cv::imread((folder / "a.PNG").string()), image, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::imread((folder / "a.jpeg").string()).size(), image.size());
  EXPECT_THAT(WriteImage(folder / "a.gif", image).message(),
              HasSubstr("choose a name that ends in .png or .jpg"));
  EXPECT_FALSE(fs::exists(folder / "a.gif"));
  EXPECT_FALSE(WriteImage(folder / "no" / "such.png", image).ok());
  fs::remove_all(folder);
}

}  // namespace
}  // namespace lararium::image
