#include "shared/light/blocker_table.h"

#include <cmath>

#include "shared/core/check.h"
#include "shared/core/units.h"
#include "shared/light/quadrature.h"

namespace lararium::light {
namespace {
const double kOne = std::sqrt(4.0 * kPi);  // first coefficient of the constant function 1

constexpr int kMaxBands = kShDegree + 1;
using Zonal = std::array<double, kMaxBands>;

double LegendreSeries(int degree, double x) {
  double before = 0.0, value = 1.0;
  for (int l = 1; l <= degree; ++l) {
    const double next = ((2 * l - 1) * x * value - (l - 1) * before) / l;
    before = value;
    value = next;
  }
  return value;
}

double ZonalFactor(int degree) { return std::sqrt((2.0 * degree + 1.0) / (4.0 * kPi)); }

// The same exponential as ExpSh for functions that are symmetric about +Z.
class ZonalExponential {
 public:
  explicit ZonalExponential(int bands) : bands_(bands) {
    for (const QuadratureNode& node : GaussLegendre(3 * kMaxBands / 2 + 1, -1.0, 1.0)) {
      Zonal y{};
      for (int l = 0; l < bands; ++l) {
        y[static_cast<size_t>(l)] = ZonalFactor(l) * LegendreSeries(l, node.at);
      }
      for (size_t i = 0; i < kMaxBands; ++i) {
        for (size_t j = 0; j < kMaxBands; ++j) {
          for (size_t k = 0; k < kMaxBands; ++k) {
            tripling_[i][j][k] += 2.0 * kPi * node.weight * y[i] * y[j] * y[k];
          }
        }
      }
    }
  }

  Zonal operator()(const Zonal& log) const {
    Zonal result{};
    for (size_t l = 1; l < kMaxBands; ++l) {
      result[l] = log[l] / (1 << kExpSquarings);
    }
    result[0] = kOne;
    for (int i = 0; i < kExpSquarings; ++i) {
      result = Square(result);
    }
    for (double& coefficient : result) {
      coefficient *= std::exp(log[0] / kOne);
    }
    return result;
  }

  int bands() const { return bands_; }

 private:
  Zonal Square(const Zonal& a) const {
    Zonal square{};
    for (size_t i = 0; i < kMaxBands; ++i) {
      for (size_t j = 0; j < kMaxBands; ++j) {
        for (size_t k = 0; k < kMaxBands; ++k) {
          square[k] += tripling_[i][j][k] * a[i] * a[j];
        }
      }
    }
    return square;
  }

  int bands_;
  double tripling_[kMaxBands][kMaxBands][kMaxBands] = {};
};

// Solves the symmetric positive definite system a x = b in place (Cholesky).
void SolveDefinite(double (&a)[kMaxBands][kMaxBands], Zonal& b, int size) {
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = a[i][j];
      for (int k = 0; k < j; ++k) {
        sum -= a[i][k] * a[j][k];
      }
      a[i][j] = i == j ? std::sqrt(sum) : sum / a[j][j];
    }
  }
  for (int i = 0; i < size; ++i) {
    for (int k = 0; k < i; ++k) {
      b[static_cast<size_t>(i)] -= a[i][k] * b[static_cast<size_t>(k)];
    }
    b[static_cast<size_t>(i)] /= a[i][i];
  }
  for (int i = size - 1; i >= 0; --i) {
    for (int k = i + 1; k < size; ++k) {
      b[static_cast<size_t>(i)] -= a[k][i] * b[static_cast<size_t>(k)];
    }
    b[static_cast<size_t>(i)] /= a[i][i];
  }
}

// The tabulated log minimises |exp(log) - visibility|^2 + penalty |log without its mean|^2. The
// penalty keeps the logs of balls that fill half the sky from growing without bound: more darkness
// would be invisible, but several such balls together would overflow the exponential.
constexpr double kPenalty = 1e-3;

double Cost(const Zonal& result, const Zonal& visibility, const Zonal& log) {
  double cost = 0.0;
  for (size_t k = 0; k < kMaxBands; ++k) {
    cost += (result[k] - visibility[k]) * (result[k] - visibility[k]);
    cost += k > 0 ? kPenalty * log[k] * log[k] : 0.0;
  }
  return cost;
}

// Returns a Levenberg-Marquardt step from `log`, whose exponential is `at`.
Zonal LevenbergStep(const ZonalExponential& exponential,
                    const Zonal& visibility,
                    const Zonal& log,
                    const Zonal& at,
                    double damping) {
  constexpr double kDifference = 1e-6;
  const int bands = exponential.bands();
  Zonal columns[kMaxBands];
  for (int i = 0; i < bands; ++i) {
    Zonal moved = log;
    moved[static_cast<size_t>(i)] += kDifference;
    columns[i] = exponential(moved);
    for (size_t k = 0; k < kMaxBands; ++k) {
      columns[i][k] = (columns[i][k] - at[k]) / kDifference;
    }
  }
  double normal[kMaxBands][kMaxBands] = {};
  Zonal step{};
  for (int i = 0; i < bands; ++i) {
    const auto row = static_cast<size_t>(i);
    for (size_t k = 0; k < kMaxBands; ++k) {
      step[row] += columns[i][k] * (visibility[k] - at[k]);
      for (int j = 0; j < bands; ++j) {
        normal[i][j] += columns[i][k] * columns[j][k];
      }
    }
    if (i > 0) {
      normal[i][i] += kPenalty;
      step[row] -= kPenalty * log[row];
    }
    normal[i][i] += damping;
  }
  SolveDefinite(normal, step, bands);
  return step;
}

// Improves a log until it fits this visibility best.
void FitLog(const ZonalExponential& exponential, const Zonal& visibility, Zonal& log) {
  double damping = 1e-4;
  Zonal at = exponential(log);
  for (int step = 0; step < 20; ++step) {
    Zonal moved = LevenbergStep(exponential, visibility, log, at, damping);
    for (size_t k = 0; k < kMaxBands; ++k) {
      moved[k] += log[k];
    }
    const Zonal result = exponential(moved);
    if (Cost(result, visibility, moved) < Cost(at, visibility, log)) {
      log = moved;
      at = result;
      damping *= 0.2;
    } else {
      damping *= 10.0;
    }
  }
}

}  // namespace

double ZonalVisibility(int degree, double angular_radius) {
  const double c = std::cos(angular_radius);
  // The integral of Y_l0 outside the ball: the integral of P_l from -1 to c.
  const double integral =
      degree == 0
          ? c + 1.0
          : (LegendreSeries(degree + 1, c) - LegendreSeries(degree - 1, c)) / (2.0 * degree + 1.0);
  return 2.0 * kPi * ZonalFactor(degree) * integral;
}

void ExpSh(const ShProductTable& products, const Lanes* log, Lanes* result) {
  const auto count = static_cast<size_t>(products.count());
  Lanes base[25];
  DCHECK(count <= std::size(base));
  constexpr float kScale = 1.0f / (1 << kExpSquarings);
  const auto one = static_cast<float>(kOne);
  const Lanes brightness = Exp(log[0] * (1.0f / one));
  base[0] = Broadcast(one);
  for (size_t k = 1; k < count; ++k) {
    base[k] = log[k] * kScale;
  }
  static_assert(kExpSquarings == 3);
  products.Square(base, result);
  products.Square(result, base);
  products.Square(base, result);
  for (size_t k = 0; k < count; ++k) {
    result[k] *= brightness;
  }
}

double BlockerTable::AngularRadius(double share) {
  constexpr double kSharpness = 16.0;
  const double largest = std::sin(kMaxAngularRadius);
  // s / (1 + s^16)^(1/16) follows s and approaches 1.
  const double sine = std::sqrt(share / std::max(1e-12, 1.0 - share)) / largest;
  const double inverse = 1.0 / std::max(1e-12, sine);
  return std::asin(largest / std::pow(1.0 + std::pow(inverse, kSharpness), 1.0 / kSharpness));
}

const BlockerTable& BlockerTable::ForCount(int count) {
  static const BlockerTable nine(9), sixteen(16), twenty_five(25);
  CHECK(count == 9 || count == 16 || count == 25);
  return count == 9 ? nine : count == 16 ? sixteen : twenty_five;
}

BlockerTable::BlockerTable(int count) : degree_(ShDegreeOf(count)), entries_(kEntries + 1) {
  const ZonalExponential exponential(degree_ + 1);
  Zonal log{};  // Each fit starts from the smaller ball before it.
  for (size_t i = 0; i <= kEntries; ++i) {
    const double share = static_cast<double>(i) / kEntries;
    const double radius = AngularRadius(share);
    Zonal visibility{};
    for (int l = 0; l <= degree_; ++l) {
      visibility[static_cast<size_t>(l)] = ZonalVisibility(l, radius);
    }
    if (i > 0) {
      FitLog(exponential, visibility, log);
    }
    const double inside = share > 0.5 ? std::sqrt((1.0 - share) / share) : 1.0;  // d / r
    for (int l = 0; l <= degree_; ++l) {
      entries_[i].value[static_cast<size_t>(l)] =
          static_cast<float>(log[static_cast<size_t>(l)] * std::pow(inside, l) / ZonalFactor(l));
    }
  }
  for (size_t i = 0; i < kEntries; ++i) {
    for (size_t l = 0; l < kLanes; ++l) {
      entries_[i].slope[l] = entries_[i + 1].value[l] - entries_[i].value[l];
    }
  }
}

BlockerTable::Factors BlockerTable::At(float share) const {
  const float position = (share > 0.0f ? std::min(share, 1.0f) : 0.0f) * kEntries;
  const Entry& entry = entries_[static_cast<size_t>(position)];
  const float rest = position - std::floor(position);
  Factors factors;
  for (size_t l = 0; l < kLanes; ++l) {
    factors[l] = entry.value[l] + rest * entry.slope[l];
  }
  return factors;
}

}  // namespace lararium::light
