#include "shared/vision/foreground/foreground_labels.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace lararium::vision {
namespace {

constexpr int kColourIterations = 2;     // How often the colour model is estimated.
constexpr int kEvidenceWindow = 5;       // Window in which evidence is averaged, small pixels.
constexpr float kMostColourOdds = 3.0f;  // Log odds that the colour of a pixel may contribute.
constexpr float kPrior = 0.5f;           // Pixels of each colour that are assumed in advance.
constexpr double kLeastPatch = 0.005;    // Share of the image.
constexpr double kLeastKnown = 0.5;      // Share of a patch in which something must be known.
constexpr double kLeastMeanOdds = -0.3;  // Evidence of a patch by itself, per known pixel.
// Density of seen points in a patch, over that in the background, above which it is no foreground.
constexpr double kMostSeen = 0.25;
// Correlation with the background above which a patch is the background in another light, and the
// window whose mean is taken out before, small pixels, because shades correlate by chance.
constexpr float kMostCorrelation = 0.5f;
constexpr int kDetailWindow = 9;
constexpr float kUnknownDetail = -1e6f;
constexpr int kGuideWindow = 7;  // Small pixels.
constexpr float kGuideNoise =
    10.0f;  // Variance of a colour that is no edge, squares of 8-bit values.
constexpr float kOpacityPerOdds = 0.5f;

}  // namespace

void ForegroundLabels::Label(const cv::Mat& bgr,
                             const cv::Mat& grey,
                             const cv::Mat& expected,
                             const cv::Mat& log_odds,
                             std::span<const int> seen,
                             cv::Mat& guide) {
  bins_.resize(bgr.total());
  const auto* colour = bgr.ptr<cv::Vec3b>();
  constexpr int kShare = 256 / kBins;
  for (size_t i = 0; i < bins_.size(); ++i) {
    bins_[i] =
        (colour[i][0] / kShare * kBins + colour[i][1] / kShare) * kBins + colour[i][2] / kShare;
  }
  mean_.Apply(log_odds, kEvidenceWindow, joined_);
  for (int i = 0; i < kColourIterations; ++i) {
    AddColourEvidence(log_odds, seen);
    mean_.Apply(odds_, kEvidenceWindow, joined_);
  }
  mean_.Apply(grey, kDetailWindow, product_);
  cv::subtract(grey, product_, detail_);
  mean_.Apply(expected, kDetailWindow, product_);
  cv::subtract(expected, product_, expected_detail_);
  cv::compare(expected, 0.0, bytes_, cv::CMP_LT);
  expected_detail_.setTo(kUnknownDetail, bytes_);
  Clean(log_odds, seen);
  Guide(bgr, guide);
}

void ForegroundLabels::AddColourEvidence(const cv::Mat& log_odds, std::span<const int> seen) {
  std::fill(foreground_.begin(), foreground_.end(), 0.0f);
  std::fill(background_.begin(), background_.end(), 0.0f);
  auto* joined = joined_.ptr<float>();
  for (const int pixel : seen) {
    joined[pixel] = kLeastOdds;
  }
  for (size_t i = 0; i < bins_.size(); ++i) {
    const float share = 1.0f / (1.0f + std::exp(-2.0f * joined[i]));
    foreground_[static_cast<size_t>(bins_[i])] += share;
    background_[static_cast<size_t>(bins_[i])] += 1.0f - share;
  }
  Smooth(foreground_);
  Smooth(background_);
  const auto total = [](std::span<const float> histogram) {
    float sum = kPrior * kAllBins;
    for (const float count : histogram) {
      sum += count;
    }
    return sum;
  };
  const float ratio = total(background_) / total(foreground_);
  odds_.create(log_odds.size(), CV_32FC1);
  const auto* own = log_odds.ptr<float>();
  auto* odds = odds_.ptr<float>();
  for (size_t i = 0; i < bins_.size(); ++i) {
    const auto bin = static_cast<size_t>(bins_[i]);
    const float colour =
        std::log(ratio * (foreground_[bin] + kPrior) / (background_[bin] + kPrior));
    odds[i] = own[i] + std::clamp(colour, -kMostColourOdds, kMostColourOdds);
  }
}

void ForegroundLabels::Smooth(std::vector<float>& histogram) {
  for (const int stride : {1, kBins, kBins * kBins}) {
    copy_ = histogram;
    for (int i = 0; i < kAllBins; ++i) {
      const int along = i / stride % kBins;
      const auto at = static_cast<size_t>(i);
      histogram[at] +=
          0.5f * ((along > 0 ? copy_[at - static_cast<size_t>(stride)] : 0.0f) +
                  (along + 1 < kBins ? copy_[at + static_cast<size_t>(stride)] : 0.0f));
    }
  }
}

float ForegroundLabels::Correlation(int patch) const {
  const int left = extents_.at<int>(patch, cv::CC_STAT_LEFT);
  const int top = extents_.at<int>(patch, cv::CC_STAT_TOP);
  const int right = left + extents_.at<int>(patch, cv::CC_STAT_WIDTH);
  const int bottom = top + extents_.at<int>(patch, cv::CC_STAT_HEIGHT);
  float best = 0.0f;
  for (int shift = 0; shift < 9; ++shift) {
    const int dx = shift % 3 - 1;
    const int dy = shift / 3 - 1;
    double n = 0.0, a = 0.0, b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
    for (int y = std::max(top, -dy); y < std::min(bottom, detail_.rows - dy); ++y) {
      const auto* label = patches_.ptr<int>(y);
      const auto* now = detail_.ptr<float>(y);
      const auto* usual = expected_detail_.ptr<float>(y + dy);
      for (int x = std::max(left, -dx); x < std::min(right, detail_.cols - dx); ++x) {
        const double v = usual[x + dx];
        if (label[x] != patch || v == kUnknownDetail) {
          continue;
        }
        const double u = now[x];
        n += 1.0;
        a += u;
        b += v;
        aa += u * u;
        bb += v * v;
        ab += u * v;
      }
    }
    const double spread = (n * aa - a * a) * (n * bb - b * b);
    if (n > 0.0 && spread > 0.0) {
      best = std::max(best, static_cast<float>((n * ab - a * b) / std::sqrt(spread)));
    }
  }
  return best;
}

void ForegroundLabels::Clean(const cv::Mat& log_odds, std::span<const int> seen) {
  const auto pixels = static_cast<double>(log_odds.total());
  cv::compare(joined_, 0.0, is_foreground_, cv::CMP_GT);
  const int count =
      cv::connectedComponentsWithStats(is_foreground_, patches_, extents_, centroids_, 8, CV_32S);
  tally_.assign(static_cast<size_t>(count), Patch());
  const auto* patch = patches_.ptr<int>();
  const auto* own = log_odds.ptr<float>();
  auto* joined = joined_.ptr<float>();
  for (size_t i = 0; i < log_odds.total(); ++i) {
    if (own[i] != kUnknownOdds) {
      Patch& tally = tally_[static_cast<size_t>(patch[i])];
      ++tally.known;
      tally.odds += own[i];
    }
  }
  for (const int pixel : seen) {
    ++tally_[static_cast<size_t>(patch[pixel])].seen;
  }
  const auto area_of = [&](int p) { return extents_.at<int>(p, cv::CC_STAT_AREA); };
  const double density = tally_[0].seen / std::max(1.0, static_cast<double>(area_of(0)));
  const auto holds = [&](int p) {
    const Patch& tally = tally_[static_cast<size_t>(p)];
    const double area = area_of(p);
    return area >= kLeastPatch * pixels && tally.known >= kLeastKnown * area &&
           tally.odds >= kLeastMeanOdds * tally.known && tally.seen <= kMostSeen * density * area;
  };
  for (int p = 1; p < count; ++p) {
    tally_[static_cast<size_t>(p)].holds = holds(p) && Correlation(p) < kMostCorrelation;
  }
  for (size_t i = 0; i < log_odds.total(); ++i) {
    if (patch[i] > 0 && !tally_[static_cast<size_t>(patch[i])].holds) {
      joined[i] = kLeastOdds;
    }
  }
  cv::compare(joined_, 0.0, is_foreground_, cv::CMP_LE);
  cv::connectedComponentsWithStats(is_foreground_, patches_, extents_, centroids_, 8, CV_32S);
  patch = patches_.ptr<int>();
  int labelled = 0;
  for (size_t i = 0; i < log_odds.total(); ++i) {
    if (patch[i] > 0 && area_of(patch[i]) < kLeastPatch * pixels) {
      joined[i] = 1.0f;
    }
    labelled += joined[i] > 0.0f ? 1 : 0;
  }
  share_ = labelled / pixels;
}

void ForegroundLabels::Guide(const cv::Mat& bgr, cv::Mat& guide) {
  const auto average_product = [this](const cv::Mat& a, const cv::Mat& b, cv::Mat& mean) {
    cv::multiply(a, b, product_);
    mean_.Apply(product_, kGuideWindow, mean);
  };
  mean_.Apply(joined_, kGuideWindow, mean_odds_);
  size_t pair = 0;
  for (size_t c = 0; c < 3; ++c) {
    cv::extractChannel(bgr, bytes_, static_cast<int>(c));
    bytes_.convertTo(channels_[c], CV_32F);
  }
  for (size_t c = 0; c < 3; ++c) {
    mean_.Apply(channels_[c], kGuideWindow, means_[c]);
    average_product(channels_[c], joined_, joint_means_[c]);
    for (size_t d = c; d < 3; ++d) {
      average_product(channels_[c], channels_[d], products_[pair++]);
    }
  }
  coefficients_.create(bgr.size(), CV_32FC4);
  auto* out = coefficients_.ptr<cv::Vec4f>();
  for (size_t i = 0; i < bgr.total(); ++i) {
    const auto at = [i](const cv::Mat& image) { return image.ptr<float>()[i]; };
    const Eigen::Vector3f mean(at(means_[0]), at(means_[1]), at(means_[2]));
    Eigen::Matrix3f covariance;
    covariance << at(products_[0]), at(products_[1]), at(products_[2]),  //
        at(products_[1]), at(products_[3]), at(products_[4]),            //
        at(products_[2]), at(products_[4]), at(products_[5]);
    covariance -= mean * mean.transpose();
    covariance.diagonal().array() += kGuideNoise;
    const Eigen::Vector3f joint =
        Eigen::Vector3f(at(joint_means_[0]), at(joint_means_[1]), at(joint_means_[2])) -
        at(mean_odds_) * mean;
    const Eigen::Vector3f slope = covariance.inverse() * joint;
    const float offset = at(mean_odds_) - slope.dot(mean);
    out[i] = {255.0f * kOpacityPerOdds * slope.x(), 255.0f * kOpacityPerOdds * slope.y(),
              255.0f * kOpacityPerOdds * slope.z(), 0.5f + kOpacityPerOdds * offset};
  }
  mean_.Apply(coefficients_, kGuideWindow, guide);
}

}  // namespace lararium::vision
