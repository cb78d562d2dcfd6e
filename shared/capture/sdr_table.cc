#include "shared/capture/sdr_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "shared/core/parallel.h"

namespace lararium::capture {
namespace {

constexpr int kCells = 32;  // The number of cubes along each channel.
constexpr int kSide = kCells + 1;
constexpr double kGamma = 2.4;         // ITU-R BT.1886
constexpr double kHlgPeak = 1000.0;    // cd/m2 of the display that HLG is graded for
constexpr double kDimWhite = 100.0;    // cd/m2
constexpr double kUsualWhite = 203.0;  // cd/m2, BT.2408

using Matrix = std::array<std::array<double, 3>, 3>;
using Rgb = std::array<double, 3>;

constexpr Matrix kBt709FromBt2020 = {{{1.660491, -0.587641, -0.072850},
                                      {-0.124550, 1.132900, -0.008349},
                                      {-0.018151, -0.100579, 1.118730}}};
constexpr Matrix kBt709FromP3 = {
    {{1.224940, -0.224940, 0.0}, {-0.042057, 1.042057, 0.0}, {-0.019638, -0.078636, 1.098274}}};

Rgb ToBt709(Gamut gamut, const Rgb& rgb) {
  if (gamut == Gamut::kBt709) {
    return rgb;
  }
  const Matrix& matrix = gamut == Gamut::kBt2020 ? kBt709FromBt2020 : kBt709FromP3;
  Rgb result;
  for (size_t i = 0; i < 3; ++i) {
    result[i] = matrix[i][0] * rgb[0] + matrix[i][1] * rgb[1] + matrix[i][2] * rgb[2];
  }
  return result;
}

// The inverse of HLG's opto-electronic transfer function (BT.2100, table 5), 0 to 1.
double HlgScene(double coded) {
  constexpr double kA = 0.17883277;
  constexpr double kB = 1.0 - 4.0 * kA;
  constexpr double kC = 0.55991073;
  return coded <= 0.5 ? coded * coded / 3.0 : (std::exp((coded - kC) / kA) + kB) / 12.0;
}

// PQ's electro-optical transfer function (BT.2100, table 4), cd/m2.
double PqLuminance(double coded) {
  constexpr double kM1 = 2610.0 / 16384.0;
  constexpr double kM2 = 2523.0 / 4096.0 * 128.0;
  constexpr double kC1 = 3424.0 / 4096.0;
  constexpr double kC2 = 2413.0 / 4096.0 * 32.0;
  constexpr double kC3 = 2392.0 / 4096.0 * 32.0;
  const double power = std::pow(coded, 1.0 / kM2);
  return 10000.0 * std::pow(std::max(power - kC1, 0.0) / (kC2 - kC3 * power), 1.0 / kM1);
}

// The light of the reference display in cd/m2; of ordinary films, 1 is white. coded: 0 to 1.
Rgb Displayed(Transfer transfer, Rgb rgb) {
  if (transfer == Transfer::kHlg) {
    for (double& value : rgb) {
      value = HlgScene(value);
    }
    // The opto-optical transfer function for a display of 1000 cd/m2.
    const double scene = 0.2627 * rgb[0] + 0.6780 * rgb[1] + 0.0593 * rgb[2];
    const double gain = kHlgPeak * std::pow(scene, 0.2);
    return {gain * rgb[0], gain * rgb[1], gain * rgb[2]};
  }
  for (double& value : rgb) {
    value = transfer == Transfer::kPq ? PqLuminance(value) : std::pow(value, kGamma);
  }
  return rgb;
}

// Compresses coded values above the knee so that `brightest` becomes 1, with a slope of 1 at the
// knee.
double Compress(double value, double brightest) {
  constexpr double kKnee = 0.8;
  if (value <= kKnee || brightest <= 1.0) {
    return value;
  }
  const double steepness = (brightest - kKnee) / (1.0 - kKnee);
  const double t = (std::min(value, brightest) - kKnee) / (brightest - kKnee);
  return kKnee + (1.0 - kKnee) * steepness * t / (1.0 + (steepness - 1.0) * t);
}

}  // namespace

double HighlightLuminance(const FilmColours& colours, const cv::Mat& coded) {
  constexpr int kStep = 4;
  std::vector<double> brightest;
  for (int y = 0; y < coded.rows; y += kStep) {
    const auto* row = coded.ptr<cv::Vec3w>(y);
    for (int x = 0; x < coded.cols; x += kStep) {
      const Rgb rgb = Displayed(colours.transfer,
                                {row[x][2] / 65535.0, row[x][1] / 65535.0, row[x][0] / 65535.0});
      brightest.push_back(std::max({rgb[0], rgb[1], rgb[2]}));
    }
  }
  if (brightest.empty()) {
    return 0.0;
  }
  const auto limit = brightest.end() - 1 - static_cast<std::ptrdiff_t>(brightest.size() / 200);
  std::nth_element(brightest.begin(), limit, brightest.end());
  return *limit;
}

SdrTable::SdrTable(const FilmColours& colours, double highlights) {
  constexpr double kTolerance = 1.1;  // Encoders overshoot at edges.
  double white = 1.0;
  double brightest = 1.0;
  if (colours.high_dynamic_range()) {
    white = highlights <= kTolerance * kDimWhite ? kDimWhite : kUsualWhite;
    brightest = highlights <= kTolerance * white
                    ? 1.0
                    : std::pow(std::max(highlights, kHlgPeak) / white, 1.0 / kGamma);
  }
  corners_.reserve(size_t{kSide} * kSide * kSide);
  for (int red = 0; red < kSide; ++red) {
    for (int green = 0; green < kSide; ++green) {
      for (int blue = 0; blue < kSide; ++blue) {
        Rgb rgb = ToBt709(colours.gamut,
                          Displayed(colours.transfer, {1.0 * red / kCells, 1.0 * green / kCells,
                                                       1.0 * blue / kCells}));
        for (double& value : rgb) {
          value = std::pow(std::max(value / white, 0.0), 1.0 / kGamma);
        }
        const double largest = std::max({rgb[0], rgb[1], rgb[2], 1e-9});
        const double scale = 255.0 * Compress(largest, brightest) / largest;
        const auto code = [&](double value) { return static_cast<float>(scale * value); };
        corners_.emplace_back(code(rgb[2]), code(rgb[1]), code(rgb[0]), 0.0f);
      }
    }
  }
}

// Interpolates in the tetrahedron of a cube that contains the colour: from the cube's first corner
// to its last along the channels in the order of their shares.
void SdrTable::Apply(const cv::Mat& coded, cv::Mat& bgr) const {
  constexpr int kRows = 16;  // rows for each task
  constexpr float kScale = static_cast<float>(kCells) / 65535.0f;
  struct Axis {
    float share;
    int stride;
  };
  constexpr std::array<int, 3> kStrides = {1, kSide, kSide * kSide};  // blue, green, red
  bgr.create(coded.size(), CV_8UC3);
  const auto tasks = static_cast<size_t>((coded.rows + kRows - 1) / kRows);
  ParallelFor(tasks, [&](size_t task) {
    const int begin = static_cast<int>(task) * kRows;
    for (int y = begin; y < std::min(begin + kRows, coded.rows); ++y) {
      const auto* from = coded.ptr<cv::Vec3w>(y);
      auto* to = bgr.ptr<cv::Vec3b>(y);
      for (int x = 0; x < coded.cols; ++x) {
        std::array<Axis, 3> axes;
        const cv::Vec4f* corner = corners_.data();
        for (int channel = 0; channel < 3; ++channel) {
          const float position = kScale * static_cast<float>(from[x][channel]);
          const int cell = std::min(static_cast<int>(position), kCells - 1);
          axes[channel] = {position - static_cast<float>(cell), kStrides[channel]};
          corner += cell * kStrides[channel];
        }
        if (axes[0].share < axes[1].share) {
          std::swap(axes[0], axes[1]);
        }
        if (axes[1].share < axes[2].share) {
          std::swap(axes[1], axes[2]);
        }
        if (axes[0].share < axes[1].share) {
          std::swap(axes[0], axes[1]);
        }
        cv::Vec4f colour = (1.0f - axes[0].share) * *corner;
        corner += axes[0].stride;
        colour += (axes[0].share - axes[1].share) * *corner;
        corner += axes[1].stride;
        colour += (axes[1].share - axes[2].share) * *corner;
        corner += axes[2].stride;
        colour += axes[2].share * *corner;
        for (int channel = 0; channel < 3; ++channel) {
          to[x][channel] = static_cast<uint8_t>(std::min(colour[channel] + 0.5f, 255.0f));
        }
      }
    }
  });
}

}  // namespace lararium::capture
