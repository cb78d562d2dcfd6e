#include "shared/image/pixel_orientation.h"

#include <gtest/gtest.h>

#include <array>
#include <opencv2/core.hpp>

namespace lararium::image {
namespace {

// The stored picture a b c   of three columns and two rows.
//                    d e f
cv::Mat Stored() { return (cv::Mat_<uint8_t>(2, 3) << 'a', 'b', 'c', 'd', 'e', 'f'); }

std::string Shown(const PixelOrientation& orientation) {
  cv::Mat upright;
  orientation.Apply(Stored(), upright);
  EXPECT_EQ(upright.size(), orientation.SizeOf(Stored().size()));
  std::string text;
  for (int y = 0; y < upright.rows; ++y) {
    text += std::string(upright.ptr<char>(y), static_cast<size_t>(upright.cols)) + "/";
  }
  return text;
}

TEST(PixelOrientation, ShowsWhatExifsTableSays) {
  // Which side of the stored picture is the upper and which the left one (JEITA CP-3451, table 6).
  const std::array<const char*, 9> expected = {"abc/def/",  "abc/def/",  "cba/fed/",
                                               "fed/cba/",  "def/abc/",  "ad/be/cf/",
                                               "da/eb/fc/", "fc/eb/da/", "cf/be/ad/"};
  for (uint32_t orientation = 0; orientation < expected.size(); ++orientation) {
    EXPECT_EQ(Shown(PixelOrientation::FromExif(orientation)), expected[orientation]) << orientation;
  }
  EXPECT_TRUE(PixelOrientation::FromExif(9).upright());
}

TEST(PixelOrientation, ReadsDisplayMatrices) {
  constexpr int32_t kOne = 1 << 16;
  const auto shown = [](int32_t a, int32_t b, int32_t c, int32_t d) {
    const std::array<int32_t, 9> matrix = {a, b, 0, c, d, 0, 0, 0, 1 << 30};
    return Shown(PixelOrientation::FromDisplayMatrix(matrix));
  };
  EXPECT_EQ(shown(kOne, 0, 0, kOne), "abc/def/");
  EXPECT_EQ(shown(0, kOne, -kOne, 0), "da/eb/fc/") << "a quarter turn clockwise";
  EXPECT_EQ(shown(-kOne, 0, 0, -kOne), "fed/cba/") << "half a turn";
  EXPECT_EQ(shown(0, -kOne, kOne, 0), "cf/be/ad/") << "a quarter turn anticlockwise";
  EXPECT_EQ(shown(-kOne, 0, 0, kOne), "cba/fed/") << "a mirror";
  EXPECT_EQ(shown(0, kOne, kOne, 0), "ad/be/cf/") << "a mirror and a quarter turn";
  EXPECT_EQ(shown(60000, 20000, -20000, 60000), "abc/def/") << "the nearest quarter turn";
  EXPECT_EQ(shown(0, 0, 0, 0), "abc/def/");
}

}  // namespace
}  // namespace lararium::image
