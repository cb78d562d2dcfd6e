#include "shared/vision/image_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace lararium::vision {
namespace {

constexpr int kLeastSide = 64;
constexpr int kBlock = 16;
constexpr int kGreyLevels = 16;

// One channel with values 0..1; empty if the image is not usable.
cv::Mat Channel(const cv::Mat& image, int channel) {
  cv::Mat values;
  if (image.cols < kLeastSide || image.rows < kLeastSide || image.depth() != CV_8U) {
    return values;
  }
  if (image.channels() == 1 && channel == 0) {
    image.convertTo(values, CV_32F, 1.0 / 255.0);
  } else if (image.channels() == 3) {
    cv::Mat one;
    cv::extractChannel(image, one, channel);
    one.convertTo(values, CV_32F, 1.0 / 255.0);
  }
  return values;
}

struct Block {
  double mean = 0.0;
  double variance = 0.0;
};

// Appends the mean and the noise variance of each block. The response of the mask to noise of
// variance 1 has variance 36.
void AddBlocks(const cv::Mat& values, std::vector<Block>& blocks) {
  const cv::Mat mask = (cv::Mat_<float>(3, 3) << 1, -2, 1, -2, 4, -2, 1, -2, 1);
  cv::Mat response;
  cv::filter2D(values, response, CV_32F, mask);
  for (int y = 1; y + kBlock < values.rows; y += kBlock) {
    for (int x = 1; x + kBlock < values.cols; x += kBlock) {
      const cv::Rect place(x, y, kBlock, kBlock);
      double low = 0.0, high = 0.0;
      cv::minMaxLoc(values(place), &low, &high);
      if (low > 0.02 && high < 0.98) {
        const double square = cv::norm(response(place), cv::NORM_L2SQR) / (kBlock * kBlock);
        blocks.push_back({cv::mean(values(place))[0], square / 36.0});
      }
    }
  }
}

// Mean of the calmest third of a level's blocks, which hardly contain any texture. This selection
// makes the variance slightly too low.
std::optional<Block> CalmestOf(std::vector<Block>& blocks) {
  constexpr size_t kLeastBlocks = 12;
  if (blocks.size() < kLeastBlocks) {
    return std::nullopt;
  }
  const auto third = blocks.begin() + static_cast<std::ptrdiff_t>(blocks.size() / 3);
  std::nth_element(blocks.begin(), third, blocks.end(),
                   [](const Block& a, const Block& b) { return a.variance < b.variance; });
  Block mean;
  for (auto block = blocks.begin(); block != third; ++block) {
    mean.mean += block->mean;
    mean.variance += block->variance;
  }
  const auto count = static_cast<double>(third - blocks.begin());
  return Block{mean.mean / count, mean.variance / count};
}

// Fits variance = floor^2 + slope * mean, with neither term negative.
ImageNoise FitLine(const std::vector<Block>& levels) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const Block& level : levels) {
    // The uncertainty of a variance is proportional to the variance.
    const double weight = 1.0 / std::max(level.variance * level.variance, 1e-14);
    n += weight;
    x += weight * level.mean;
    y += weight * level.variance;
    xx += weight * level.mean * level.mean;
    xy += weight * level.mean * level.variance;
  }
  const double determinant = n * xx - x * x;
  double slope = determinant > 1e-9 * n * xx ? (n * xy - x * y) / determinant : 0.0;
  double base = (y - slope * x) / n;
  if (slope < 0.0) {
    slope = 0.0;
    base = y / n;
  } else if (base < 0.0) {
    base = 0.0;
    slope = xy / xx;
  }
  return {std::sqrt(base), slope};
}

struct Gradient {
  cv::Mat x, y, size;

  explicit Gradient(const cv::Mat& image) {
    cv::Sobel(image, x, CV_32F, 1, 0, 3, 0.125);
    cv::Sobel(image, y, CV_32F, 0, 1, 3, 0.125);
    cv::magnitude(x, y, size);
  }
  // Returns whether the gradient is largest in the direction across the edge.
  bool IsRidge(int row, int column) const {
    const bool upright = std::abs(x.at<float>(row, column)) > std::abs(y.at<float>(row, column));
    const int dx = upright ? 1 : 0;
    const int dy = upright ? 0 : 1;
    const float here = size.at<float>(row, column);
    return here >= size.at<float>(row - dy, column - dx) &&
           here > size.at<float>(row + dy, column + dx);
  }
  // Returns whether the edge is a step and not a thin line: the gradient does not change its sign
  // within kApart pixels on both sides. Blurring reduces the gradient of a line more than that of a
  // step, so lines would seem sharper than they are.
  bool IsStep(int row, int column) const {
    const bool upright = std::abs(x.at<float>(row, column)) > std::abs(y.at<float>(row, column));
    const cv::Mat& across = upright ? x : y;
    const float here = across.at<float>(row, column);
    const float least = -0.1f * std::abs(here);
    const float sign = here > 0.0f ? 1.0f : -1.0f;
    for (int k = 1; k <= kApart; ++k) {
      const int dx = upright ? k : 0;
      const int dy = upright ? 0 : k;
      if (sign * across.at<float>(row + dy, column + dx) < least ||
          sign * across.at<float>(row - dy, column - dx) < least) {
        return false;
      }
    }
    return true;
  }
  static constexpr int kApart = 4;  // pixels
};

// Re-blurs the image by a Gaussian of deviation r. In the middle of a step of deviation s the
// gradient falls by the factor sqrt(s^2 + r^2) / s, from which s follows.
void AddEdges(const cv::Mat& values, std::vector<double>& deviations) {
  constexpr double kCalm = 0.7;  // Blur before both measurements, so that noise makes no edges.
  constexpr double kReblur = 1.2;
  constexpr float kClear = 0.03f;  // Minimum gradient, as a share of the range per pixel.
  // Variance of the first blur and of the Sobel filter, taken as a Gaussian.
  constexpr double kOwn = kCalm * kCalm + 0.5;
  cv::Mat calm, blurred;
  cv::GaussianBlur(values, calm, cv::Size(), kCalm);
  cv::GaussianBlur(calm, blurred, cv::Size(), kReblur);
  const Gradient sharp(calm), soft(blurred);
  for (int y = 4; y + 4 < values.rows; ++y) {
    for (int x = 4; x + 4 < values.cols; ++x) {
      const float here = sharp.size.at<float>(y, x);
      const double ratio = here / std::max(soft.size.at<float>(y, x), 1e-6f);
      if (here > kClear && ratio > 1.01 && sharp.IsRidge(y, x) && sharp.IsStep(y, x)) {
        const double variance = kReblur * kReblur / (ratio * ratio - 1.0);
        deviations.push_back(std::sqrt(std::max(variance - kOwn, 0.0)));
      }
    }
  }
}

}  // namespace

std::optional<ImageNoise> EstimateNoise(std::span<const cv::Mat> images) {
  std::vector<Block> blocks;
  for (const cv::Mat& image : images) {
    for (int channel = 0; channel < image.channels(); ++channel) {
      if (const cv::Mat values = Channel(image, channel); !values.empty()) {
        AddBlocks(values, blocks);
      }
    }
  }
  std::array<std::vector<Block>, kGreyLevels> by_level;
  for (const Block& block : blocks) {
    by_level[std::min<size_t>(static_cast<size_t>(block.mean * kGreyLevels), kGreyLevels - 1)]
        .push_back(block);
  }
  std::vector<Block> levels;
  for (std::vector<Block>& level : by_level) {
    if (const std::optional<Block> calm = CalmestOf(level)) {
      levels.push_back(*calm);
    }
  }
  if (levels.empty()) {
    return std::nullopt;
  }
  return FitLine(levels);
}

std::optional<double> EstimateSharpness(std::span<const cv::Mat> images) {
  constexpr size_t kLeastEdges = 100;
  std::vector<double> deviations;
  for (const cv::Mat& image : images) {
    if (const cv::Mat values = Channel(image, image.channels() == 3 ? 1 : 0); !values.empty()) {
      AddEdges(values, deviations);
    }
  }
  if (deviations.size() < kLeastEdges) {
    return std::nullopt;
  }
  const auto low = deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() * 7 / 20);
  std::nth_element(deviations.begin(), low, deviations.end());
  return *low;
}

}  // namespace lararium::vision
