#include "shared/vision/foreground/small_filters.h"

#include <algorithm>

namespace lararium::vision {
namespace {

// choose(a, b) returns one of two values.
template <typename Choose>
void ChooseAround(const cv::Mat& from, cv::Mat& to, Choose choose) {
  to.create(from.size(), CV_32FC1);
  for (int y = 0; y < from.rows; ++y) {
    auto* out = to.ptr<float>(y);
    std::copy_n(from.ptr<float>(y), from.cols, out);
    for (int row = std::max(y - 1, 0); row <= std::min(y + 1, from.rows - 1); ++row) {
      const auto* in = from.ptr<float>(row);
      for (int x = 0; x < from.cols; ++x) {
        const float left = in[std::max(x - 1, 0)];
        const float right = in[std::min(x + 1, from.cols - 1)];
        out[x] = choose(choose(out[x], in[x]), choose(left, right));
      }
    }
  }
}

}  // namespace

void WindowMean::Apply(const cv::Mat& from, int window, cv::Mat& to) {
  to.create(from.size(), from.type());
  const int radius = window / 2;
  const int channels = from.channels();
  const double share = 1.0 / (window * window);
  columns_.assign(static_cast<size_t>(from.cols * channels), 0.0);
  const auto add = [&](int y, double sign) {
    const auto* row = from.ptr<float>(std::clamp(y, 0, from.rows - 1));
    for (size_t i = 0; i < columns_.size(); ++i) {
      columns_[i] += sign * row[i];
    }
  };
  for (int y = -radius; y < radius; ++y) {
    add(y, 1.0);
  }
  for (int y = 0; y < from.rows; ++y) {
    add(y + radius, 1.0);
    auto* out = to.ptr<float>(y);
    for (int channel = 0; channel < channels; ++channel) {
      const auto column = [&](int x) {
        return columns_[static_cast<size_t>(std::clamp(x, 0, from.cols - 1) * channels + channel)];
      };
      double sum = 0.0;
      for (int x = -radius; x < radius; ++x) {
        sum += column(x);
      }
      for (int x = 0; x < from.cols; ++x) {
        sum += column(x + radius);
        out[x * channels + channel] = static_cast<float>(sum * share);
        sum -= column(x - radius);
      }
    }
    add(y - radius, -1.0);
  }
}

void LeastAround(const cv::Mat& from, cv::Mat& to) {
  ChooseAround(from, to, [](float a, float b) { return std::min(a, b); });
}

void GreatestAround(const cv::Mat& from, cv::Mat& to) {
  ChooseAround(from, to, [](float a, float b) { return std::max(a, b); });
}

}  // namespace lararium::vision
