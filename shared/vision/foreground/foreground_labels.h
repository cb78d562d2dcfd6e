#pragma once

// Labels the pixels of a small image as foreground or background. Evidence of single pixels is
// joined with a colour model, in the manner of iterated segmentation (Rother, Kolmogorov & Blake,
// "GrabCut", SIGGRAPH 2004) but with box filters instead of graph cuts, and carried to the full
// image by a guided filter (He, Sun & Tang, "Guided image filtering", ECCV 2010; He & Sun, "Fast
// guided filter", 2015).

#include <array>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "shared/vision/foreground/small_filters.h"

namespace lararium::vision {

class ForegroundLabels {
 public:
  // Log odds of foreground that one pixel may contribute.
  static constexpr float kLeastOdds = -3.0f;
  static constexpr float kMostOdds = 4.0f;
  // Log odds where nothing is known.
  static constexpr float kUnknownOdds = -1.0f;

  // bgr: CV_8UC3. grey, expected: CV_32FC1 of the same size, the image and what it would show
  // without a foreground; negative where that is not known. log_odds: CV_32FC1, kUnknownOdds where
  // nothing is known. seen: pixels that certainly show the background. guide: CV_32FC4 of the same
  // size, is filled with (b, g, r, offset): the opacity of the foreground at a pixel of the full
  // image, values 0 to 1, is b B + g G + r R + offset, clamped to 0..1.
  void Label(const cv::Mat& bgr,
             const cv::Mat& grey,
             const cv::Mat& expected,
             const cv::Mat& log_odds,
             std::span<const int> seen,
             cv::Mat& guide);

  // Share of the pixels that were labelled as foreground.
  double share() const { return share_; }

 private:
  static constexpr int kBins = 16;  // Per colour channel.
  static constexpr int kAllBins = kBins * kBins * kBins;

  void AddColourEvidence(const cv::Mat& log_odds, std::span<const int> seen);
  void Smooth(std::vector<float>& histogram);
  // Removes patches of foreground that are small, without evidence of their own, or that show the
  // background in another light, and small holes.
  void Clean(const cv::Mat& log_odds, std::span<const int> seen);
  // The correlation of grey values in a patch with the expected ones, the highest for shifts by up
  // to a pixel.
  float Correlation(int patch) const;
  void Guide(const cv::Mat& bgr, cv::Mat& guide);

  std::vector<int> bins_;  // [pixel]
  std::vector<float> foreground_ = std::vector<float>(kAllBins);
  std::vector<float> background_ = std::vector<float>(kAllBins);
  std::vector<float> copy_ = std::vector<float>(kAllBins);
  cv::Mat odds_, joined_;
  cv::Mat detail_, expected_detail_;  // Grey values without their local mean.
  cv::Mat is_foreground_, patches_, extents_, centroids_;
  struct Patch {
    int known = 0;
    int seen = 0;
    double odds = 0.0;
    bool holds = false;
  };
  std::vector<Patch> tally_;
  std::array<cv::Mat, 3> channels_;
  std::array<cv::Mat, 3> means_;
  std::array<cv::Mat, 3> joint_means_;  // Means of each channel times the log odds.
  std::array<cv::Mat, 6> products_;     // Means of BB, BG, BR, GG, GR, RR.
  cv::Mat product_, mean_odds_, coefficients_;
  cv::Mat bytes_;  // CV_8UC1 of the small image's size, for any use.
  WindowMean mean_;
  double share_ = 0.0;
};

}  // namespace lararium::vision
