#include "editor/bake/transfer_packer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "shared/light/transfer.h"

namespace lararium::bake {
namespace {

uint8_t ToByte(float share) {
  return static_cast<uint8_t>(std::nearbyint(255.0f * std::clamp(share, 0.0f, 1.0f)));
}

}  // namespace

void TurnTransfer(const glm::mat3& rotation, int count, TransferVector& vector) {
  const light::ShRotation turn(rotation);
  std::array<float, light::kShCount> turned = {};
  for (size_t channel = 0; channel < 3; ++channel) {
    const std::span<float> values(&vector[channel * light::kShCount], static_cast<size_t>(count));
    turn.Apply(values, std::span(turned).first(values.size()));
    std::copy_n(turned.begin(), values.size(), values.begin());
  }
}

void TransferPacker::AddKeyPose(const TransferSites& sites, const SolvedTransfer& solved) {
  vectors_.resize(sites.meshes.size());
  back_sums_.resize(sites.meshes.size());
  ++poses_;
  for (size_t m = 0; m < sites.meshes.size(); ++m) {
    const size_t count = sites.meshes[m].positions.size();
    for (size_t v = 0; v < count; ++v) {
      const TransferVector& vector = solved.vectors[sites.first[m] + v];
      for (size_t channel = 0; channel < 3; ++channel) {
        const float* from = &vector[channel * light::kShCount];
        vectors_[m].insert(vectors_[m].end(), from, from + count_);
      }
    }
    if (sites.first_back[m] != TransferSites::kNone) {
      back_sums_[m].resize(count);
      for (size_t v = 0; v < count; ++v) {
        back_sums_[m][v] += ShareOfEvenLight(solved.vectors[sites.first_back[m] + v]);
      }
    }
  }
}

void TransferPacker::Pack(std::vector<human::LightTransfer::Mesh>& meshes) const {
  for (size_t m = 0; m < vectors_.size(); ++m) {
    light::TransferBytes packed = light::QuantiseTransfer(vectors_[m], count_, poses_);
    human::LightTransfer::Mesh& mesh = meshes[m];
    mesh.coefficients = std::move(packed.values);
    mesh.scale = std::move(packed.scale);
    mesh.backs.clear();
    for (const glm::vec3& sum : back_sums_[m]) {
      const glm::vec3 mean = sum / static_cast<float>(poses_);
      mesh.backs.push_back({ToByte(mean.r), ToByte(mean.g), ToByte(mean.b)});
    }
  }
}

}  // namespace lararium::bake
