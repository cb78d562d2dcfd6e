#include "shared/vision/gaussian_blur.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "shared/core/parallel.h"
#include "shared/vision/lanes.h"

namespace lararium::vision {
namespace {

// Computes the centre and one side of a kernel whose sum is 1.
void FillHalfKernel(float sigma, std::vector<float>& kernel) {
  const int radius = std::max(1, static_cast<int>(std::ceil(3.0f * sigma)));
  kernel.resize(radius + 1);
  float sum = 0.0f;
  for (int i = 0; i <= radius; ++i) {
    const auto d = static_cast<float>(i);
    kernel[i] = std::exp(-0.5f * d * d / (sigma * sigma));
    sum += i == 0 ? kernel[i] : 2.0f * kernel[i];
  }
  for (float& weight : kernel) {
    weight /= sum;
  }
}

// Index i, mirrored about the first and the last of count rows or columns.
int Mirrored(int i, int count) {
  if (count == 1) {
    return 0;
  }
  while (i < 0 || i >= count) {
    i = i < 0 ? -i : 2 * (count - 1) - i;
  }
  return i;
}

// Computes kernel[0] * before[0][x] plus the sum over k > 0 of
// kernel[k] * (before[k][x] + after[k][x]). The pointers address rows, or positions in one row.
void Convolve(const std::vector<float>& kernel,
              const float* const* before,
              const float* const* after,
              int width,
              float* out) {
  const size_t taps = kernel.size();
  int x = 0;
  for (; x + 2 * kLanes <= width; x += 2 * kLanes) {
    Lanes left = kernel[0] * LoadLanes(before[0] + x);
    Lanes right = kernel[0] * LoadLanes(before[0] + x + kLanes);
    for (size_t k = 1; k < taps; ++k) {
      left += kernel[k] * (LoadLanes(before[k] + x) + LoadLanes(after[k] + x));
      right += kernel[k] * (LoadLanes(before[k] + x + kLanes) + LoadLanes(after[k] + x + kLanes));
    }
    StoreLanes(left, out + x);
    StoreLanes(right, out + x + kLanes);
  }
  for (; x < width; ++x) {
    float sum = kernel[0] * before[0][x];
    for (size_t k = 1; k < taps; ++k) {
      sum += kernel[k] * (before[k][x] + after[k][x]);
    }
    out[x] = sum;
  }
}

// Blurs row y: first down the columns into `row`, then along `row`. `row` has image.cols values
// plus the kernel's radius on both sides; `taps` has two pointers per weight.
void BlurRow(const cv::Mat& image,
             int y,
             const std::vector<float>& kernel,
             std::vector<float>& row,
             std::vector<const float*>& taps,
             float* out) {
  const int radius = static_cast<int>(kernel.size()) - 1;
  const int width = image.cols;
  const float** before = taps.data();
  const float** after = taps.data() + kernel.size();
  for (int k = 0; k <= radius; ++k) {
    before[k] = image.ptr<float>(Mirrored(y - k, image.rows));
    after[k] = image.ptr<float>(Mirrored(y + k, image.rows));
  }
  float* middle = row.data() + radius;
  Convolve(kernel, before, after, width, middle);
  for (int k = 1; k <= radius; ++k) {
    middle[-k] = middle[Mirrored(-k, width)];
    middle[width - 1 + k] = middle[Mirrored(width - 1 + k, width)];
  }
  for (int k = 0; k <= radius; ++k) {
    before[k] = middle - k;
    after[k] = middle + k;
  }
  Convolve(kernel, before, after, width, out);
}

}  // namespace

void GaussianBlur::Apply(const cv::Mat& image, float sigma, cv::Mat& blurred) {
  FillHalfKernel(sigma, kernel_);
  blurred.create(image.size(), CV_32F);
  constexpr int kRowsPerJob = 64;
  const auto count = static_cast<size_t>((image.rows + kRowsPerJob - 1) / kRowsPerJob);
  jobs_.resize(std::max(jobs_.size(), count));
  ParallelFor(count, [&](size_t j) {
    Job& job = jobs_[j];
    job.row.resize(image.cols + 2 * (kernel_.size() - 1));
    job.taps.resize(2 * kernel_.size());
    const int begin = static_cast<int>(j) * kRowsPerJob;
    const int end = std::min(begin + kRowsPerJob, image.rows);
    for (int y = begin; y < end; ++y) {
      BlurRow(image, y, kernel_, job.row, job.taps, blurred.ptr<float>(y));
    }
  });
}

}  // namespace lararium::vision
