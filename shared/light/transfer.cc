#include "shared/light/transfer.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <string>

#include "shared/core/check.h"
#include "shared/light/spherical_harmonics.h"

namespace lararium::light {
namespace {

constexpr float kLargestByte = 127.0f;

bool FinitePositive(std::span<const float> values) {
  return std::all_of(values.begin(), values.end(),
                     [](float value) { return std::isfinite(value) && value >= 0.0f; });
}

// Rows of padded Padded floats for each channel.
template <size_t Padded>
void LightRange(const LightVerticesJob& job, size_t begin, size_t end) {
  constexpr size_t kRegisters = 3 * Padded / kLanes;
  const Transfer& transfer = *job.transfer;
  const float* light_rows = job.light->row(0);
  const float* pose_weight_rows = job.pose_weights.data();
  const size_t poses = transfer.poses;
  for (size_t v = begin; v < end; ++v) {
    const VertexReceivers& receivers = job.receivers[v];
    Lanes light[kRegisters] = {};
    Lanes pose_weights = {};
    for (size_t r = 0; r < kReceiversOfVertex && receivers.weight[r] > 0; ++r) {
      const Lanes weight = Broadcast(receivers.weight[r] * (1.0f / 255.0f));
      const float* row = light_rows + receivers.receiver[r] * (kRegisters * kLanes);
#pragma GCC unroll 15
      for (size_t i = 0; i < kRegisters; ++i) {
        light[i] = MultiplyAdd(weight, Load(row + i * kLanes), light[i]);
      }
      pose_weights = MultiplyAdd(
          weight, Load(pose_weight_rows + receivers.receiver[r] * kMaxKeyPoses), pose_weights);
    }
    Lanes sums[3] = {};
    float total = 0.0f;
    const float* scale_of_vertex = transfer.scale.data() + v;
    const int8_t* row = transfer.row(0, v);
    for (size_t pose = 0; pose < poses; ++pose) {
      const float weight = pose_weights[pose];
      if (weight >= kLeastPoseWeight) {
        total += weight;
        const Lanes scale = Broadcast(weight * *scale_of_vertex);
#pragma GCC unroll 3
        for (size_t channel = 0; channel < 3; ++channel) {
          const size_t first = channel * kRegisters / 3;
          Lanes sum = light[first] * LoadBytes(row + first * kLanes);
#pragma GCC unroll 4
          for (size_t i = first + 1; i < first + kRegisters / 3; ++i) {
            sum = MultiplyAdd(light[i], LoadBytes(row + i * kLanes), sum);
          }
          sums[channel] = MultiplyAdd(scale, sum, sums[channel]);
        }
      }
      scale_of_vertex += transfer.vertices;
      row += transfer.vertices * kRegisters * kLanes;
    }
    const glm::vec3 irradiance(Sum(sums[0]), Sum(sums[1]), Sum(sums[2]));
    job.irradiance[v] = glm::max(irradiance * (1.0f / std::max(total, 1e-6f)), glm::vec3(0.0f));
  }
}

}  // namespace

Status CheckTransfer(const Transfer& transfer, const std::string& place) {
  if (!IsShCount(transfer.count) || transfer.count < 9) {
    return Status::Error(place, std::to_string(transfer.count) + " coefficients of light transfer",
                         "bake it again with 9, 16, 25 or 36");
  }
  if (transfer.poses == 0 || transfer.poses > kMaxKeyPoses) {
    return Status::Error(place,
                         std::to_string(transfer.poses) +
                             " key poses of light transfer, not 1 to " +
                             std::to_string(kMaxKeyPoses),
                         "bake it again");
  }
  // In this order nothing overflows: each size bounds the next.
  const bool sizes = transfer.vertices <= transfer.scale.size() &&
                     transfer.scale.size() == transfer.poses * transfer.vertices &&
                     transfer.values.size() == transfer.scale.size() * 3 * transfer.padded_count();
  if (!sizes) {
    return Status::Error(place, "light transfer of another size than it says", "bake it again");
  }
  if (!FinitePositive(transfer.scale)) {
    return Status::Error(place, "a scale of light transfer is negative or not finite",
                         "bake it again");
  }
  return Status();
}

Transfer QuantiseTransfer(std::span<const float> vectors, int count, size_t poses) {
  const auto size = static_cast<size_t>(count);
  CHECK(IsShCount(count) && poses > 0 && vectors.size() % (poses * 3 * size) == 0);
  Transfer transfer;
  transfer.count = count;
  transfer.poses = poses;
  transfer.vertices = vectors.size() / (poses * 3 * size);
  transfer.scale.resize(poses * transfer.vertices);
  transfer.values.resize(transfer.scale.size() * 3 * transfer.padded_count());
  for (size_t row = 0; row < transfer.scale.size(); ++row) {
    const std::span<const float> vector = vectors.subspan(row * 3 * size, 3 * size);
    float largest = 0.0f;
    for (const float value : vector) {
      largest = std::max(largest, std::abs(value));
    }
    transfer.scale[row] = largest / kLargestByte;
    const float inverse = largest > 0.0f ? kLargestByte / largest : 0.0f;
    for (size_t i = 0; i < vector.size(); ++i) {
      transfer.values[(row * 3 + i / size) * transfer.padded_count() + i % size] =
          static_cast<int8_t>(std::nearbyint(vector[i] * inverse));
    }
  }
  return transfer;
}

void DecodeTransfer(const Transfer& transfer,
                    size_t pose,
                    size_t vertex,
                    std::span<float> vectors) {
  const auto size = static_cast<size_t>(transfer.count);
  CHECK(pose < transfer.poses && vertex < transfer.vertices && vectors.size() == 3 * size);
  const float scale = transfer.scale[pose * transfer.vertices + vertex];
  for (size_t channel = 0; channel < 3; ++channel) {
    const int8_t* row = transfer.row(pose, vertex) + channel * transfer.padded_count();
    for (size_t k = 0; k < size; ++k) {
      vectors[channel * size + k] = row[k] * scale;
    }
  }
}

void PackReceiverLight(const ShRowsRgb& light, ReceiverRange range, ReceiverLight& packed) {
  const int count = packed.count();
  const size_t padded = packed.stride() / 3;
  CHECK(range.begin <= range.end && range.end <= packed.receivers());
  for (size_t channel = 0; channel < 3; ++channel) {
    const ShRows& rows = light[channel];
    CHECK(rows.count() == count && rows.receivers() == packed.receivers());
    for (size_t i = range.begin; i < range.end; i += kLanes) {
      const size_t valid = std::min(kLanes, range.end - i);
      for (int k = 0; k < count; k += static_cast<int>(kLanes)) {
        Lanes block[kLanes] = {};
        for (int n = 0; n < static_cast<int>(kLanes) && k + n < count; ++n) {
          block[n] = LoadFirst(rows.row(k + n) + i, valid);
        }
        Transpose(block);
        for (size_t receiver = 0; receiver < valid; ++receiver) {
          Store(block[receiver],
                packed.row(i + receiver) + channel * padded + static_cast<size_t>(k));
        }
      }
    }
  }
}

void LightVerticesJob::Run(size_t begin, size_t end) const {
  CHECK(transfer != nullptr && light != nullptr && light->count() == transfer->count &&
        receivers.size() == transfer->vertices && irradiance.size() == transfer->vertices &&
        pose_weights.size() == light->receivers() * kMaxKeyPoses &&
        transfer->poses <= kMaxKeyPoses && begin <= end && end <= transfer->vertices);
  switch (transfer->padded_count()) {
    case 16:
      return LightRange<16>(*this, begin, end);
    case 32:
      return LightRange<32>(*this, begin, end);
    default:
      CHECK(transfer->padded_count() == 40);
      return LightRange<40>(*this, begin, end);
  }
}

}  // namespace lararium::light
