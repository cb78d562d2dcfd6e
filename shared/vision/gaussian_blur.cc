#include "shared/vision/gaussian_blur.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "shared/core/parallel.h"

namespace lararium::vision {
namespace {

// Eight floats in one register, or in the two that the processor has instead.
using Lanes = float __attribute__((vector_size(32)));
constexpr int kLanes = 8;

inline Lanes Load(const float* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof(lanes));
  return lanes;
}
inline void Store(const Lanes& lanes, float* to) { std::memcpy(to, &lanes, sizeof(lanes)); }

// The centre and one side of a kernel of sum 1.
std::vector<float> HalfKernel(float sigma) {
  const int radius = std::max(1, static_cast<int>(std::ceil(3.0f * sigma)));
  std::vector<float> kernel(radius + 1);
  float sum = 0.0f;
  for (int i = 0; i <= radius; ++i) {
    const auto d = static_cast<float>(i);
    kernel[i] = std::exp(-0.5f * d * d / (sigma * sigma));
    sum += i == 0 ? kernel[i] : 2.0f * kernel[i];
  }
  for (float& weight : kernel) {
    weight /= sum;
  }
  return kernel;
}

// Row or column i of count, mirrored about the first and the last.
int Mirrored(int i, int count) {
  if (count == 1) {
    return 0;
  }
  while (i < 0 || i >= count) {
    i = i < 0 ? -i : 2 * (count - 1) - i;
  }
  return i;
}

// sum over k of kernel[k] * (before[k][x] + after[k][x]), before[0] standing for
// the centre alone. Pointers to rows or to places in one row.
void Convolve(const std::vector<float>& kernel,
              const float* const* before,
              const float* const* after,
              int width,
              float* out) {
  const size_t taps = kernel.size();
  int x = 0;
  for (; x + 2 * kLanes <= width; x += 2 * kLanes) {
    Lanes left = kernel[0] * Load(before[0] + x);
    Lanes right = kernel[0] * Load(before[0] + x + kLanes);
    for (size_t k = 1; k < taps; ++k) {
      left += kernel[k] * (Load(before[k] + x) + Load(after[k] + x));
      right += kernel[k] * (Load(before[k] + x + kLanes) + Load(after[k] + x + kLanes));
    }
    Store(left, out + x);
    Store(right, out + x + kLanes);
  }
  for (; x < width; ++x) {
    float sum = kernel[0] * before[0][x];
    for (size_t k = 1; k < taps; ++k) {
      sum += kernel[k] * (before[k][x] + after[k][x]);
    }
    out[x] = sum;
  }
}

// Blurs rows [begin, end): down the columns into a row with margins, then along.
class RowBlur {
 public:
  RowBlur(const cv::Mat& image, const std::vector<float>& kernel)
      : image_(image),
        kernel_(kernel),
        radius_(static_cast<int>(kernel.size()) - 1),
        row_(image.cols + 2 * radius_),
        before_(kernel.size()),
        after_(kernel.size()) {}

  void Blur(int y, float* out) {
    for (int k = 0; k <= radius_; ++k) {
      before_[k] = image_.ptr<float>(Mirrored(y - k, image_.rows));
      after_[k] = image_.ptr<float>(Mirrored(y + k, image_.rows));
    }
    float* row = row_.data() + radius_;
    Convolve(kernel_, before_.data(), after_.data(), image_.cols, row);
    for (int k = 1; k <= radius_; ++k) {
      row[-k] = row[Mirrored(-k, image_.cols)];
      row[image_.cols - 1 + k] = row[Mirrored(image_.cols - 1 + k, image_.cols)];
    }
    for (int k = 0; k <= radius_; ++k) {
      before_[k] = row - k;
      after_[k] = row + k;
    }
    Convolve(kernel_, before_.data(), after_.data(), image_.cols, out);
  }

 private:
  const cv::Mat& image_;
  const std::vector<float>& kernel_;
  int radius_;
  std::vector<float> row_;
  std::vector<const float*> before_;
  std::vector<const float*> after_;
};

}  // namespace

void GaussianBlur(const cv::Mat& image, float sigma, cv::Mat& blurred, cv::Mat* difference) {
  const std::vector<float> kernel = HalfKernel(sigma);
  blurred.create(image.size(), CV_32F);
  if (difference != nullptr) {
    difference->create(image.size(), CV_32F);
  }
  constexpr int kRowsPerJob = 64;
  ParallelFor(static_cast<size_t>((image.rows + kRowsPerJob - 1) / kRowsPerJob), [&](size_t job) {
    const int begin = static_cast<int>(job) * kRowsPerJob;
    const int end = std::min(begin + kRowsPerJob, image.rows);
    RowBlur row_blur(image, kernel);
    for (int y = begin; y < end; ++y) {
      float* out = blurred.ptr<float>(y);
      row_blur.Blur(y, out);
      if (difference != nullptr) {
        const float* in = image.ptr<float>(y);
        float* d = difference->ptr<float>(y);
        for (int x = 0; x < image.cols; ++x) {
          d[x] = out[x] - in[x];
        }
      }
    }
  });
}

}  // namespace lararium::vision
