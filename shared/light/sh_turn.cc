#include "shared/light/sh_turn.h"

#include <array>
#include <cmath>
#include <vector>

#include "shared/core/check.h"
#include "shared/light/spherical_harmonics.h"

namespace lararium::light {
namespace {

constexpr int kMaxDegree = 4;

// Cosines and sines of eight angles.
struct Phase {
  Lanes cosine, sine;
};

Phase AddPhases(const Phase& a, const Phase& b) {
  return {a.cosine * b.cosine - a.sine * b.sine, a.sine * b.cosine + a.cosine * b.sine};
}
Phase Negative(const Phase& a) { return {a.cosine, -a.sine}; }

// The angle of a complex number; arbitrary if the number is zero.
Phase AngleOf(const Lanes& real, const Lanes& imaginary, const Lanes& size) {
  const Lanes inverse = 1.0f / Max(size, Broadcast(1e-12f));
  const auto none = size < 1e-10f;
  return {none ? Broadcast(1.0f) : real * inverse, none ? Lanes{} : imaginary * inverse};
}

struct Angles {
  Phase first, middle, last;  // about Z, Y, Z, in the order in which they are applied
};

// Computes the angles about Z from half their sum and half their difference. If the rotation about
// Y is almost zero, the difference is free and any value works.
Angles FindAngles(const Turns& turns, size_t begin, size_t valid, TurnDirection direction) {
  const Lanes w = LoadFirst(&turns.w[begin], valid);
  const Lanes x = LoadFirst(&turns.x[begin], valid);
  const Lanes y = LoadFirst(&turns.y[begin], valid);
  const Lanes z = LoadFirst(&turns.z[begin], valid);
  const Lanes half_cosine = Sqrt(w * w + z * z);
  const Lanes half_sine = Sqrt(x * x + y * y);
  const Phase half_sum = AngleOf(w, z, half_cosine);
  const Phase half_difference = AngleOf(y, -x, half_sine);
  const Phase about_y = {half_cosine * half_cosine - half_sine * half_sine,
                         2.0f * half_cosine * half_sine};
  const Phase last = AddPhases(half_sum, half_difference);
  const Phase first = AddPhases(half_sum, Negative(half_difference));
  if (direction == TurnDirection::kForth) {
    return {first, about_y, last};
  }
  return {Negative(last), Negative(about_y), Negative(first)};
}

// Rotates the bands from 1 on about Z: cos(m a) and sin(m a) mix.
template <int Degree>
void TurnAboutZ(const Phase& angle, Lanes* v) {
  Phase multiple = angle;
#pragma GCC unroll 4
  for (int m = 1; m <= Degree; ++m) {
#pragma GCC unroll 4
    for (int l = m; l <= Degree; ++l) {
      Lanes& cosine = v[l * (l + 1) + m];
      Lanes& sine = v[l * (l + 1) - m];
      const Lanes turned = multiple.cosine * cosine - multiple.sine * sine;
      sine = MultiplyAdd(multiple.sine, cosine, multiple.cosine * sine);
      cosine = turned;
    }
    multiple = m < Degree ? AddPhases(multiple, angle) : multiple;
  }
}

// Non-zero entries of the matrices of a quarter turn about X, row by row.
class QuarterTurn {
 public:
  explicit QuarterTurn(float sign) {
    const float half = std::sqrt(0.5f);
    const ShRotation rotation(glm::quat(half, sign * half, 0.0f, 0.0f), kMaxDegree);
    for (int l = 0; l <= kMaxDegree; ++l) {
      const std::span<const float> band = rotation.band(l);
      const int side = 2 * l + 1;
      for (int m = 0; m < side; ++m) {
        for (int n = 0; n < side; ++n) {
          const float value = band[static_cast<size_t>(m * side + n)];
          if (std::abs(value) > 1e-6f) {
            terms_.push_back({value, l * l + n});
          }
        }
        ends_[static_cast<size_t>(l * l + m)] = terms_.size();
      }
    }
  }

  template <int Degree>
  void Apply(const Lanes* v, Lanes* turned) const {
    const Term* term = terms_.data();
    for (int k = 0; k < (Degree + 1) * (Degree + 1); ++k) {
      const Term* end = terms_.data() + ends_[static_cast<size_t>(k)];
      Lanes sum = term->value * v[term->from];
      for (++term; term != end; ++term) {
        sum = MultiplyAdd(Broadcast(term->value), v[term->from], sum);
      }
      turned[k] = sum;
    }
  }

 private:
  struct Term {
    float value = 0.0f;
    int from = 0;
  };
  std::vector<Term> terms_;
  // end of each coefficient's terms
  std::array<size_t, (kMaxDegree + 1) * (kMaxDegree + 1)> ends_{};
};

template <int Degree>
void TurnRegister(const Angles& angles,
                  const QuarterTurn& forth,
                  const QuarterTurn& back,
                  const ShRows& source,
                  size_t begin,
                  ShRows& target) {
  constexpr int kCount = (Degree + 1) * (Degree + 1);
  Lanes a[kCount], b[kCount];
  for (int k = 0; k < kCount; ++k) {
    a[k] = Load(source.row(k) + begin);
  }
  TurnAboutZ<Degree>(angles.first, a);
  forth.Apply<Degree>(a, b);
  TurnAboutZ<Degree>(angles.middle, b);
  back.Apply<Degree>(b, a);
  TurnAboutZ<Degree>(angles.last, a);
  for (int k = 0; k < kCount; ++k) {
    Store(a[k], target.row(k) + begin);
  }
}

template <int Degree>
void TurnRange(std::span<const ShRows> sources,
               const Turns& turns,
               TurnDirection direction,
               ReceiverRange range,
               std::span<ShRows> targets) {
  static const QuarterTurn forth(1.0f), back(-1.0f);
  for (size_t i = range.begin; i < range.end; i += kLanes) {
    const size_t valid = std::min(kLanes, range.end - i);
    const Angles angles = FindAngles(turns, i, valid, direction);
    for (size_t k = 0; k < sources.size(); ++k) {
      TurnRegister<Degree>(angles, forth, back, sources[k], i, targets[k]);
    }
  }
}

void TurnAll(std::span<const ShRows> sources,
             const Turns& turns,
             TurnDirection direction,
             ReceiverRange range,
             std::span<ShRows> targets) {
  for (size_t k = 0; k < sources.size(); ++k) {
    CheckRegisters(range, sources[k]);
    CHECK(sources[k].count() == targets[k].count() && sources[k].count() == sources[0].count() &&
          sources[k].stride() == targets[k].stride());
  }
  CHECK(turns.w.size() >= range.end && turns.x.size() == turns.w.size() &&
        turns.y.size() == turns.w.size() && turns.z.size() == turns.w.size());
  switch (sources[0].count()) {
    case 9:
      return TurnRange<2>(sources, turns, direction, range, targets);
    case 16:
      return TurnRange<3>(sources, turns, direction, range, targets);
    default:
      CHECK(sources[0].count() == 25);
      return TurnRange<4>(sources, turns, direction, range, targets);
  }
}

}  // namespace

void TurnRows(const ShRows& source,
              const Turns& turns,
              TurnDirection direction,
              ReceiverRange range,
              ShRows& target) {
  TurnAll({&source, 1}, turns, direction, range, {&target, 1});
}

void TurnRows(const ShRowsRgb& source,
              const Turns& turns,
              TurnDirection direction,
              ReceiverRange range,
              ShRowsRgb& target) {
  TurnAll(source, turns, direction, range, target);
}

Turn8::Turn8(const Turns& turns, size_t begin, size_t valid) {
  const Lanes w = LoadFirst(&turns.w[begin], valid);
  const Lanes x = LoadFirst(&turns.x[begin], valid);
  const Lanes y = LoadFirst(&turns.y[begin], valid);
  const Lanes z = LoadFirst(&turns.z[begin], valid);
  xx_ = 1.0f - 2.0f * (y * y + z * z);
  xy_ = 2.0f * (x * y - w * z);
  xz_ = 2.0f * (x * z + w * y);
  yx_ = 2.0f * (x * y + w * z);
  yy_ = 1.0f - 2.0f * (x * x + z * z);
  yz_ = 2.0f * (y * z - w * x);
  zx_ = 2.0f * (x * z - w * y);
  zy_ = 2.0f * (y * z + w * x);
  zz_ = 1.0f - 2.0f * (x * x + y * y);
}

}  // namespace lararium::light
