#include "editor/bake/speech_features.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "shared/core/units.h"

namespace lararium::bake {
namespace {
constexpr double kWindow = 0.025;       // seconds
constexpr double kEnergyWindow = 0.01;  // seconds
constexpr int kBands = 24;
constexpr int kCepstra = 12;
constexpr double kLowest = 80.0;     // hertz
constexpr double kHighest = 7200.0;  // hertz
constexpr float kEmphasis = 0.97f;
constexpr double kFloor = 1e-9;  // Floor of energies, below the noise of 16 bits.

double MelOf(double hertz) { return 1127.0 * std::log1p(hertz / 700.0); }
double HertzOf(double mel) { return 700.0 * std::expm1(mel / 1127.0); }

// Fourier transform in place; the size is a power of two (Cooley & Tukey, 1965).
void Transform(std::span<std::complex<double>> values) {
  const size_t n = values.size();
  for (size_t i = 1, j = 0; i < n; ++i) {
    size_t bit = n >> 1;
    for (; (j & bit) != 0; bit >>= 1) {
      j ^= bit;
    }
    j ^= bit;
    if (i < j) {
      std::swap(values[i], values[j]);
    }
  }
  for (size_t length = 2; length <= n; length <<= 1) {
    const std::complex<double> root = std::polar(1.0, -2.0 * kPi / static_cast<double>(length));
    for (size_t begin = 0; begin < n; begin += length) {
      std::complex<double> turn = 1.0;
      for (size_t k = 0; k < length / 2; ++k) {
        const std::complex<double> even = values[begin + k];
        const std::complex<double> odd = values[begin + k + length / 2] * turn;
        values[begin + k] = even + odd;
        values[begin + k + length / 2] = even - odd;
        turn *= root;
      }
    }
  }
}

// Computes the cepstra of many windows with shared tables.
class CepstrumMaker {
 public:
  explicit CepstrumMaker(int rate) : size_(static_cast<size_t>(std::lround(kWindow * rate))) {
    size_t points = 1;
    while (points < size_) {
      points <<= 1;
    }
    spectrum_.resize(points);
    for (size_t i = 0; i < size_; ++i) {
      const double phase = 2.0 * kPi * (static_cast<double>(i) + 0.5) / static_cast<double>(size_);
      window_.push_back(0.5 - 0.5 * std::cos(phase));
    }
    const double low = MelOf(kLowest);
    const double high = MelOf(std::min(kHighest, 0.45 * rate));
    for (int i = 0; i < kBands + 2; ++i) {
      const double hertz = HertzOf(low + (high - low) * i / (kBands + 1));
      edges_[static_cast<size_t>(i)] = hertz / rate * static_cast<double>(points);
    }
  }

  size_t size() const { return size_; }

  // `begin` may be before the first sample and the end after the last; samples outside are 0.
  void Compute(std::span<const float> samples, std::ptrdiff_t begin, Features& features) {
    std::fill(spectrum_.begin(), spectrum_.end(), 0.0);
    const auto sample = [&](std::ptrdiff_t i) {
      return i >= 0 && i < std::ssize(samples) ? samples[static_cast<size_t>(i)] : 0.0f;
    };
    for (size_t i = 0; i < size_; ++i) {
      const auto at = begin + static_cast<std::ptrdiff_t>(i);
      spectrum_[i] = window_[i] * static_cast<double>(sample(at) - kEmphasis * sample(at - 1));
    }
    Transform(spectrum_);
    std::array<double, kBands> bands;
    for (size_t b = 0; b < kBands; ++b) {
      bands[b] = std::log(std::max(BandEnergy(b), kFloor));
    }
    for (int c = 0; c < kCepstra; ++c) {
      double sum = 0.0;
      for (int b = 0; b < kBands; ++b) {
        sum += bands[static_cast<size_t>(b)] * std::cos(kPi * (c + 1) * (b + 0.5) / kBands);
      }
      features[static_cast<size_t>(c)] = static_cast<float>(sum * std::sqrt(2.0 / kBands));
    }
  }

 private:
  double BandEnergy(size_t band) const {
    const double low = edges_[band], middle = edges_[band + 1], high = edges_[band + 2];
    double sum = 0.0;
    for (auto k = static_cast<size_t>(std::ceil(low)); static_cast<double>(k) < high; ++k) {
      const auto at = static_cast<double>(k);
      const double weight =
          at < middle ? (at - low) / (middle - low) : (high - at) / (high - middle);
      sum += weight * std::norm(spectrum_[k]);
    }
    return sum / static_cast<double>(size_);
  }

  size_t size_;
  std::vector<double> window_;
  std::vector<std::complex<double>> spectrum_;
  std::array<double, kBands + 2> edges_ = {};  // Edges of the bands in points of the transform.
};

double LogEnergy(std::span<const float> samples, std::ptrdiff_t begin, std::ptrdiff_t count) {
  double sum = 0.0;
  for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(begin, 0);
       i < std::min(begin + count, std::ssize(samples)); ++i) {
    const double sample = samples[static_cast<size_t>(i)];
    sum += sample * sample;
  }
  return 0.5 * std::log(std::max(sum / static_cast<double>(count), kFloor));
}

void AddChange(std::vector<Features>& features) {
  constexpr std::ptrdiff_t kReach = 3;  // frames
  const std::ptrdiff_t last = std::ssize(features) - 1;
  for (std::ptrdiff_t i = 0; i <= last; ++i) {
    const Features& before = features[static_cast<size_t>(std::max<std::ptrdiff_t>(i - kReach, 0))];
    const Features& after = features[static_cast<size_t>(std::min(i + kReach, last))];
    float sum = 0.0f;
    for (size_t c = 0; c < kCepstra; ++c) {
      sum += (after[c] - before[c]) * (after[c] - before[c]);
    }
    features[static_cast<size_t>(i)][kChange] = std::sqrt(sum);
  }
}

}  // namespace

std::vector<Features> ComputeFeatures(std::span<const float> samples, int rate) {
  CepstrumMaker cepstra(rate);
  const double step = kFeatureStep * rate;
  std::vector<Features> features(
      static_cast<size_t>(std::ceil(static_cast<double>(samples.size()) / step)));
  const auto energy_size = static_cast<std::ptrdiff_t>(std::lround(kEnergyWindow * rate));
  for (size_t i = 0; i < features.size(); ++i) {
    const auto middle =
        static_cast<std::ptrdiff_t>(std::lround((static_cast<double>(i) + 0.5) * step));
    cepstra.Compute(samples, middle - static_cast<std::ptrdiff_t>(cepstra.size() / 2), features[i]);
    features[i][kEnergy] =
        static_cast<float>(LogEnergy(samples, middle - energy_size / 2, energy_size));
  }
  AddChange(features);
  return features;
}

std::vector<float> Resample(std::span<const float> samples, int rate, int new_rate) {
  if (rate == new_rate) {
    return {samples.begin(), samples.end()};
  }
  constexpr double kCrossings = 32.0;
  const double ratio = static_cast<double>(rate) / new_rate;
  const double cut = std::min(1.0, 1.0 / ratio);  // Relative to the old Nyquist frequency.
  const double reach = kCrossings / cut;          // Old samples.
  std::vector<float> result(static_cast<size_t>(static_cast<double>(samples.size()) / ratio));
  for (size_t i = 0; i < result.size(); ++i) {
    const double at = static_cast<double>(i) * ratio;
    const auto first = static_cast<std::ptrdiff_t>(std::max(std::ceil(at - reach), 0.0));
    const auto last = std::min(static_cast<std::ptrdiff_t>(at + reach), std::ssize(samples) - 1);
    double sum = 0.0;
    for (std::ptrdiff_t k = first; k <= last; ++k) {
      const double away = static_cast<double>(k) - at;
      const double x = kPi * cut * away;
      const double sinc = std::abs(x) < 1e-9 ? 1.0 : std::sin(x) / x;
      const double hann = 0.5 + 0.5 * std::cos(kPi * away / reach);
      sum += cut * sinc * hann * static_cast<double>(samples[static_cast<size_t>(k)]);
    }
    result[i] = static_cast<float>(sum);
  }
  return result;
}

}  // namespace lararium::bake
