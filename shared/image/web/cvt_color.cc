// cv::cvtColor for the conversions that a page needs, in place of OpenCV's own, which brings each
// of its hundreds into a program: about 300 kB, of which 55 to 75 are left when it is packed.

#include <opencv2/imgproc.hpp>
#include <opencv2/imgproc/hal/hal.hpp>

#include "shared/core/check.h"

namespace {

// Colour conversions of images with interleaved channels.
struct Conversion {
  int code;
  int from;  // Channels.
  int to;
  bool swaps = false;  // Swaps red and blue.
};
constexpr Conversion kConversions[] = {
    {cv::COLOR_BGR2BGRA, 3, 4},      {cv::COLOR_RGBA2BGR, 4, 3, true},
    {cv::COLOR_BGR2RGB, 3, 3, true}, {cv::COLOR_BGRA2RGBA, 4, 4, true},
    {cv::COLOR_BGR2GRAY, 3, 1},      {cv::COLOR_RGBA2GRAY, 4, 1, true},
    {cv::COLOR_GRAY2BGR, 1, 3},      {cv::COLOR_GRAY2BGRA, 1, 4},
};

void Convert(const cv::Mat& in, const Conversion& conversion, cv::Mat& out) {
  const auto [code, from, to, swaps] = conversion;
  CHECK(in.channels() == from);
  if (to == 1) {
    cv::hal::cvtBGRtoGray(in.data, in.step, out.data, out.step, in.cols, in.rows, in.depth(), from,
                          swaps);
  } else if (from == 1) {
    cv::hal::cvtGraytoBGR(in.data, in.step, out.data, out.step, in.cols, in.rows, in.depth(), to);
  } else {
    cv::hal::cvtBGRtoBGR(in.data, in.step, out.data, out.step, in.cols, in.rows, in.depth(), from,
                         to, swaps);
  }
}

}  // namespace

void cv::cvtColor(InputArray given, OutputArray converted, int code, int) {
  const Mat in = given.getMat();  // Keeps the pixels where input and output are one image.
  if (code == COLOR_YUV2BGR_I420 || code == COLOR_YUV2BGR_NV12) {
    converted.create(in.rows * 2 / 3, in.cols, CV_8UC3);
    Mat out = converted.getMat();
    const auto convert =
        code == COLOR_YUV2BGR_I420
            ? &hal::cvtThreePlaneYUVtoBGR
            : static_cast<decltype(&hal::cvtThreePlaneYUVtoBGR)>(&hal::cvtTwoPlaneYUVtoBGR);
    convert(in.data, in.step, out.data, out.step, out.cols, out.rows, 3, false, 0);
    return;
  }
  for (const Conversion& conversion : kConversions) {
    if (conversion.code == code) {
      converted.create(in.size(), CV_MAKETYPE(in.depth(), conversion.to));
      Mat out = converted.getMat();
      Convert(in, conversion, out);
      return;
    }
  }
  CHECK(false);  // No other conversion is called in a page.
}
