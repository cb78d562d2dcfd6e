#include "shared/light/receivers.h"

#include <algorithm>
#include <optional>

#include "shared/light/blocker_table.h"

namespace lararium::light {
namespace {

struct Register3 {
  Lanes x, y, z;
};

// q of eight receivers (BlockerTable), faded to 0 near kLeastShare.
inline Lanes FadedShare(const Lanes& distance2, float radius2) {
  const Lanes share = radius2 / (distance2 + (radius2 + 1e-12f));
  const Lanes fade = (share - kLeastShare) * (1.0f / kLeastShare);
  // In this order of operands NaN becomes 0, so that it blocks nothing.
  const Lanes faded = share * Min(Max(fade, Lanes{}), Broadcast(1.0f));
  return Min(Max(faded, Lanes{}), Broadcast(1.0f));
}

template <int Count>
inline void AddSphere(const BlockerTable& table,
                      const float* normalisation,
                      const Register3& to_centre,
                      const Lanes& distance2,
                      const Lanes& share,
                      Lanes* log) {
  constexpr int kDegree = ShDegreeOf(Count);
  Lanes factors[kDegree + 1];
  table.At<kDegree>(share, factors);
  const Lanes inverse = 1.0f / Sqrt(distance2 + 1e-12f);
  Lanes basis[Count];
  EvaluateShBasis<Count>(to_centre.x * inverse, to_centre.y * inverse, to_centre.z * inverse,
                         normalisation, basis);
#pragma GCC unroll 5
  for (int l = 0; l <= kDegree; ++l) {
#pragma GCC unroll 9
    for (int k = l * l; k < (l + 1) * (l + 1); ++k) {
      log[k] = MultiplyAdd(factors[l], basis[k], log[k]);
    }
  }
}

// turns: rotations of the receivers' own frames; nullptr: all use the stage's frame.
template <int Count>
void AddSpheres(const Spheres& spheres,
                const Points& receivers,
                const Turns* turns,
                ReceiverRange range,
                ShRows& log_visibility) {
  const BlockerTable& table = BlockerTable::ForCount(Count);
  const float* normalisation = FloatShNormalisation().data();
  for (size_t i = range.begin; i < range.end; i += kLanes) {
    const size_t valid = std::min(kLanes, range.end - i);
    const Register3 at = {LoadFirst(&receivers.x[i], valid), LoadFirst(&receivers.y[i], valid),
                          LoadFirst(&receivers.z[i], valid)};
    std::optional<Turn8> turn;
    if (turns != nullptr) {
      turn.emplace(*turns, i, valid);
    }
    Lanes log[Count];
    for (int k = 0; k < Count; ++k) {
      log[k] = Load(log_visibility.row(k) + i);
    }
    for (size_t s = 0; s < spheres.radius.size(); ++s) {
      Register3 d = {spheres.x[s] - at.x, spheres.y[s] - at.y, spheres.z[s] - at.z};
      const Lanes distance2 = d.x * d.x + d.y * d.y + d.z * d.z;
      const Lanes share = FadedShare(distance2, spheres.radius[s] * spheres.radius[s]);
      if (AnyAbove(share, 0.0f)) {
        if (turn) {
          turn->Back(d.x, d.y, d.z);
        }
        AddSphere<Count>(table, normalisation, d, distance2, share, log);
      }
    }
    for (int k = 0; k < Count; ++k) {
      Store(log[k], log_visibility.row(k) + i);
    }
  }
}

void LoadBlock(const ShRows& rows, size_t begin, Lanes* block) {
  for (int k = 0; k < rows.count(); ++k) {
    block[k] = Load(rows.row(k) + begin);
  }
}

// target = matrix * vector for eight receivers; `count` rows and columns.
void MultiplyMatrix(const float* matrix, const Lanes* vector, int count, Lanes* target) {
  for (int i = 0; i < count; ++i, matrix += count) {
    Lanes even = matrix[0] * vector[0], odd = {};
    for (int j = 1; j + 1 < count; j += 2) {
      odd = MultiplyAdd(Broadcast(matrix[j]), vector[j], odd);
      even = MultiplyAdd(Broadcast(matrix[j + 1]), vector[j + 1], even);
    }
    if (count % 2 == 0) {
      odd = MultiplyAdd(Broadcast(matrix[count - 1]), vector[count - 1], odd);
    }
    target[i] = even + odd;
  }
}

}  // namespace

void ClearLogVisibility(ReceiverRange range, ShRows& log_visibility) {
  CheckRegisters(range, log_visibility);
  for (int k = 0; k < log_visibility.count(); ++k) {
    float* row = log_visibility.row(k);
    std::fill(row + range.begin, row + PaddedToLanes(range.end), 0.0f);
  }
}

namespace {

void AddAll(const Spheres& spheres,
            const Points& receivers,
            const Turns* turns,
            ReceiverRange range,
            ShRows& log_visibility) {
  CheckRegisters(range, log_visibility);
  CHECK(receivers.x.size() == log_visibility.receivers() &&
        receivers.y.size() == receivers.x.size() && receivers.z.size() == receivers.x.size());
  CHECK(spheres.x.size() == spheres.radius.size() && spheres.y.size() == spheres.x.size() &&
        spheres.z.size() == spheres.x.size());
  CHECK(turns == nullptr ||
        (turns->w.size() == receivers.x.size() && turns->x.size() == receivers.x.size() &&
         turns->y.size() == receivers.x.size() && turns->z.size() == receivers.x.size()));
  switch (log_visibility.count()) {
    case 9:
      return AddSpheres<9>(spheres, receivers, turns, range, log_visibility);
    case 16:
      return AddSpheres<16>(spheres, receivers, turns, range, log_visibility);
    default:
      CHECK(log_visibility.count() == 25);
      return AddSpheres<25>(spheres, receivers, turns, range, log_visibility);
  }
}

}  // namespace

void AddLogVisibility(const Spheres& spheres,
                      const Points& receivers,
                      ReceiverRange range,
                      ShRows& log_visibility) {
  AddAll(spheres, receivers, nullptr, range, log_visibility);
}

void AddLogVisibility(const Spheres& spheres,
                      const Points& receivers,
                      const Turns& stage_from_own,
                      ReceiverRange range,
                      ShRows& log_visibility) {
  AddAll(spheres, receivers, &stage_from_own, range, log_visibility);
}

void ShadowLight(const LightMatrix& light,
                 const ShRows& log_visibility,
                 ReceiverRange range,
                 ShRowsRgb& shadowed) {
  CheckRegisters(range, log_visibility);
  const int count = light.count();
  CHECK(log_visibility.count() == count);
  const ShProductTable& products = ShProductTable::ForCount(count);
  for (size_t i = range.begin; i < range.end; i += kLanes) {
    Lanes log[25], visibility[25], lit[25];
    LoadBlock(log_visibility, i, log);
    ExpSh(products, log, visibility);
    for (int channel = 0; channel < 3; ++channel) {
      ShRows& rows = shadowed[static_cast<size_t>(channel)];
      MultiplyMatrix(light.channel(channel), visibility, count, lit);
      for (int k = 0; k < count; ++k) {
        Store(lit[k], rows.row(k) + i);
      }
    }
  }
}

}  // namespace lararium::light
