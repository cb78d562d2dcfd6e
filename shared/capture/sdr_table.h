#pragma once

// Maps the colours of films with a high dynamic range (HLG and PQ, ITU-R BT.2100) or a wide gamut
// (BT.2020, Display P3) to those of ordinary video (BT.709), which tracking and drawing expect.
// Private to capture.

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <vector>

namespace lararium::capture {

enum class Transfer { kGamma, kHlg, kPq };
enum class Gamut { kBt709, kBt2020, kP3 };

struct FilmColours {
  Transfer transfer = Transfer::kGamma;
  Gamut gamut = Gamut::kBt709;

  bool ordinary() const { return transfer == Transfer::kGamma && gamut == Gamut::kBt709; }
  bool high_dynamic_range() const { return transfer != Transfer::kGamma; }
};

// Returns the luminance in cd/m2 below which lie all but the brightest 0.5 % of the pixels' largest
// channels. coded: CV_16UC3, B, G, R of the film, 0 to 65535. The film has a high dynamic range.
double HighlightLuminance(const FilmColours& colours, const cv::Mat& coded);

// Cubes of the film's coded colours with the BT.709 colours at their corners.
class SdrTable {
 public:
  // highlights: what HighlightLuminance returned for pictures of the film; not used if its dynamic
  // range is ordinary.
  //
  // Films that show nothing brighter than 100 cd/m2 were graded for displays of this brightness,
  // so that 100 cd/m2 becomes white; in others it is 203 cd/m2 (ITU-R BT.2408). Highlights above
  // white are compressed from 80 % of the coded white on, and keep their hue.
  SdrTable(const FilmColours& colours, double highlights);

  // Converts CV_16UC3 to CV_8UC3 of the same size. Allocates nothing if bgr has this type and size.
  void Apply(const cv::Mat& coded, cv::Mat& bgr) const;

 private:
  std::vector<cv::Vec4f>
      corners_;  // [red][green][blue]: B, G, R from 0 to 255; the last is unused.
};

}  // namespace lararium::capture
