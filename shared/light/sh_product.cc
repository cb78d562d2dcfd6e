#include "shared/light/sh_product.h"

#include "shared/core/check.h"
#include "shared/light/quadrature.h"

namespace lararium::light {
namespace {

using Basis = std::array<double, kShCount>;

struct WeightedBasis {
  Basis basis;
  double weight = 0.0;
};

// The basis at nodes that integrate products of three basis functions exactly.
const std::vector<WeightedBasis>& ExactNodes() {
  static const std::vector<WeightedBasis> nodes = [] {
    std::vector<WeightedBasis> list;
    for (const SphereNode& node : SphereQuadrature(3 * kShDegree)) {
      WeightedBasis& entry = list.emplace_back();
      entry.weight = node.weight;
      EvaluateShBasis<kShCount>(node.direction.x, node.direction.y, node.direction.z,
                                ShNormalisation().data(), entry.basis.data());
    }
    return list;
  }();
  return nodes;
}

double Tripling(size_t i, size_t j, size_t k) {
  double sum = 0.0;
  for (const WeightedBasis& node : ExactNodes()) {
    sum += node.weight * node.basis[i] * node.basis[j] * node.basis[k];
  }
  return sum;
}

// Degrees that break the triangle's rule or have an odd sum give zero.
bool MayBeNonZero(size_t i, size_t j, size_t k) {
  const int a = ShBandOf(static_cast<int>(i));
  const int b = ShBandOf(static_cast<int>(j));
  const int c = ShBandOf(static_cast<int>(k));
  return (a + b + c) % 2 == 0 && c <= a + b && a <= b + c && b <= a + c;
}

}  // namespace

const ShProductTable& ShProductTable::ForCount(int count) {
  static const ShProductTable four(4), nine(9), sixteen(16), twenty_five(25), thirty_six(36);
  switch (count) {
    case 4:
      return four;
    case 9:
      return nine;
    case 16:
      return sixteen;
    case 25:
      return twenty_five;
    default:
      CHECK(count == 36);
      return thirty_six;
  }
}

ShProductTable::ShProductTable(int count) : count_(count) {
  const auto size = static_cast<size_t>(count);
  for (size_t k = 0; k < size; ++k) {
    for (size_t i = 0; i < size; ++i) {
      for (size_t j = i; j < size; ++j) {
        const double gamma = MayBeNonZero(i, j, k) ? Tripling(i, j, k) : 0.0;
        if (std::abs(gamma) > 1e-9) {
          terms_.push_back({static_cast<float>(i == j ? 0.5 * gamma : gamma),
                            static_cast<uint16_t>(i), static_cast<uint16_t>(j)});
        }
      }
    }
    begin_[k + 1] = static_cast<uint16_t>(terms_.size());
  }
}

void ShProductTable::Multiply(std::span<const float> a,
                              std::span<const float> b,
                              std::span<float> product) const {
  const auto size = static_cast<size_t>(count_);
  DCHECK(a.size() == size && b.size() == size && product.size() == size);
  for (size_t k = 0; k < size; ++k) {
    float sum = 0.0f;
    for (size_t t = begin_[k]; t < begin_[k + 1]; ++t) {
      const Term& term = terms_[t];
      sum += term.gamma * (a[term.i] * b[term.j] + a[term.j] * b[term.i]);
    }
    product[k] = sum;
  }
}

void ShProductTable::Multiply(const Lanes* a, const Lanes* b, Lanes* product) const {
  const Term* term = terms_.data();
  for (size_t k = 0; k < static_cast<size_t>(count_); ++k) {
    Lanes sum = {};
    for (const Term* end = terms_.data() + begin_[k + 1]; term != end; ++term) {
      sum = MultiplyAdd(Broadcast(term->gamma),
                        MultiplyAdd(a[term->i], b[term->j], a[term->j] * b[term->i]), sum);
    }
    product[k] = sum;
  }
}

void ShProductTable::Square(const Lanes* a, Lanes* square) const {
  const Term* term = terms_.data();
  for (size_t k = 0; k < static_cast<size_t>(count_); ++k) {
    Lanes even = {}, odd = {};  // Two independent sums avoid waiting.
    const Term* end = terms_.data() + begin_[k + 1];
    for (; term + 1 < end; term += 2) {
      even = MultiplyAdd(Broadcast(term[0].gamma), a[term[0].i] * a[term[0].j], even);
      odd = MultiplyAdd(Broadcast(term[1].gamma), a[term[1].i] * a[term[1].j], odd);
    }
    if (term != end) {
      even = MultiplyAdd(Broadcast(term->gamma), a[term->i] * a[term->j], even);
      ++term;
    }
    square[k] = 2.0f * (even + odd);
  }
}

LightMatrix::LightMatrix(const ShRgb& light, int count) : count_(count) {
  CHECK(count == 4 || count == 9 || count == 16 || count == 25);
  const auto size = static_cast<size_t>(count);
  matrix_ = {};
  // The integral of L Y_i Y_j with the same nodes.
  for (const WeightedBasis& node : ExactNodes()) {
    glm::dvec3 radiance(0.0);
    for (size_t k = 0; k < kShCount; ++k) {
      radiance += node.basis[k] * glm::dvec3(light[k]);
    }
    for (size_t channel = 0; channel < 3; ++channel) {
      const double weighted = node.weight * radiance[static_cast<int>(channel)];
      for (size_t i = 0; i < size; ++i) {
        const auto row = static_cast<float>(weighted * node.basis[i]);
        for (size_t j = 0; j < size; ++j) {
          matrix_[channel][i * size + j] += row * static_cast<float>(node.basis[j]);
        }
      }
    }
  }
}

}  // namespace lararium::light
