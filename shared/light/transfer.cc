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

// The largest whole number that light is packed as: sums of four rounded parts of it still fit.
constexpr float kLargestShort = 32000.0f;

// Weights in 1/255 as what MultiplyHigh takes.
constexpr int16_t Weight(uint8_t weight) { return static_cast<int16_t>(weight * 128 + weight / 2); }

// Light of a vertex: of its receivers, weighed.
template <size_t Registers>
inline void BlendReceivers(const ReceiverLight& packed,
                           const VertexReceivers& receivers,
                           const float* pose_weights,
                           ShortLanes (&light)[Registers],
                           Lanes& weights) {
  for (size_t r = 0; r < kReceiversOfVertex && receivers.weight[r] > 0; ++r) {
    const ShortLanes weight = BroadcastShort(Weight(receivers.weight[r]));
    const int16_t* row = packed.row(0) + receivers.receiver[r] * (Registers * kShortLanes);
#pragma GCC unroll 9
    for (size_t i = 0; i < Registers; ++i) {
      light[i] += MultiplyHigh(weight, LoadShorts(row + i * kShortLanes));
    }
    weights = MultiplyAdd(Broadcast(receivers.weight[r] * (1.0f / 255.0f)),
                          Load(pose_weights + receivers.receiver[r] * kMaxKeyPoses), weights);
  }
}

inline bool AnyChanged(const uint8_t* changed, const VertexReceivers& receivers) {
  bool any = false;
  for (size_t r = 0; r < kReceiversOfVertex; ++r) {
    any |= receivers.weight[r] > 0 && changed[receivers.receiver[r]] != 0;
  }
  return any;
}

// Rows of so many registers for each channel.
template <size_t OfChannel>
void LightRange(const LightVerticesJob& job, size_t begin, size_t end) {
  constexpr size_t kRegisters = 3 * OfChannel;
  const Transfer& transfer = *job.transfer;
  const auto count = static_cast<size_t>(transfer.count);
  const size_t pose_stride = transfer.vertices * 3 * count;
  const uint8_t* changed = job.changed.empty() ? nullptr : job.changed.data();
  for (size_t v = begin; v < end; ++v) {
    if (changed != nullptr && !AnyChanged(changed, job.receivers[v])) {
      continue;
    }
    ShortLanes light[kRegisters] = {};
    Lanes weights = {};
    BlendReceivers(*job.light, job.receivers[v], job.pose_weights.data(), light, weights);
    float pose_weights[kLanes];
    Store(weights, pose_weights);
    Lanes sums[3] = {};
    float total = 0.0f;
    const float* scale_of_vertex = transfer.scale.data() + v;
    const int8_t* row = transfer.row(0, v);
    for (size_t pose = 0; pose < transfer.poses; ++pose) {
      const float weight = pose_weights[pose];
      if (weight >= kLeastPoseWeight) {
        total += weight;
        const Lanes scale = Broadcast(weight * *scale_of_vertex);
#pragma GCC unroll 3
        for (size_t channel = 0; channel < 3; ++channel) {
          const size_t first = channel * OfChannel;
          const int8_t* values = row + channel * count;
          IntLanes sum = DotPairs(light[first], LoadBytes(values));
#pragma GCC unroll 2
          for (size_t i = 1; i < OfChannel; ++i) {
            sum += DotPairs(light[first + i], LoadBytes(values + i * kShortLanes));
          }
          sums[channel] = MultiplyAdd(scale, __builtin_convertvector(sum, Lanes), sums[channel]);
        }
      }
      scale_of_vertex += transfer.vertices;
      row += pose_stride;
    }
    const glm::vec3 irradiance(Sum(sums[0]), Sum(sums[1]), Sum(sums[2]));
    const float unit = job.light->unit() / std::max(total, 1e-6f);
    job.irradiance[v] = glm::max(irradiance * unit, glm::vec3(0.0f));
  }
}

float LargestOf(const ShRowsRgb& light) {
  Lanes largest = {};
  for (const ShRows& rows : light) {
    for (int k = 0; k < rows.count(); ++k) {
      for (size_t i = 0; i < rows.receivers(); i += kLanes) {
        const Lanes values = LoadFirst(rows.row(k) + i, rows.receivers() - i);
        largest = Max(largest, Max(values, -values));
      }
    }
  }
  float most = 0.0f;
  for (size_t i = 0; i < kLanes; ++i) {
    most = std::max(most, largest[i]);
  }
  return most;
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
  const bool sizes =
      transfer.vertices <= transfer.scale.size() &&
      transfer.scale.size() == transfer.poses * transfer.vertices &&
      transfer.values.size() ==
          transfer.scale.size() * 3 * static_cast<size_t>(transfer.count) + transfer.tail();
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
  transfer.values.resize(vectors.size() + transfer.tail());
  for (size_t row = 0; row < transfer.scale.size(); ++row) {
    const std::span<const float> vector = vectors.subspan(row * 3 * size, 3 * size);
    float largest = 0.0f;
    for (const float value : vector) {
      largest = std::max(largest, std::abs(value));
    }
    transfer.scale[row] = largest / kLargestByte;
    const float inverse = largest > 0.0f ? kLargestByte / largest : 0.0f;
    for (size_t i = 0; i < vector.size(); ++i) {
      transfer.values[row * 3 * size + i] =
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
    const int8_t* row = transfer.row(pose, vertex) + channel * size;
    for (size_t k = 0; k < size; ++k) {
      vectors[channel * size + k] = row[k] * scale;
    }
  }
}

void PackReceiverLight(const ShRowsRgb& light, ReceiverLight& packed) {
  const size_t padded = packed.stride() / 3;
  const float most = LargestOf(light);
  const float held = packed.unit() * kLargestShort;
  if (most > held || most < 0.5f * held || !(held > 0.0f)) {
    // With room to grow.
    packed.set_unit(std::max(1.2f * most, 1e-30f) / kLargestShort);
  }
  const float inverse = 1.0f / packed.unit();
  for (size_t channel = 0; channel < 3; ++channel) {
    const ShRows& rows = light[channel];
    CHECK(rows.count() == packed.count() && rows.receivers() == packed.receivers());
    for (size_t i = 0; i < rows.receivers(); i += kLanes) {
      const size_t valid = std::min(kLanes, rows.receivers() - i);
      for (int k = 0; k < rows.count(); k += static_cast<int>(kLanes)) {
        Lanes block[kLanes] = {};
        for (int n = 0; n < static_cast<int>(kLanes) && k + n < rows.count(); ++n) {
          block[n] = LoadFirst(rows.row(k + n) + i, valid) * inverse;
        }
        Transpose(block);
        for (size_t receiver = 0; receiver < valid; ++receiver) {
          StoreAsShorts(block[receiver],
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
        (changed.empty() || changed.size() == light->receivers()) &&
        transfer->poses <= kMaxKeyPoses && begin <= end && end <= transfer->vertices);
  switch (transfer->padded_count() / kShortLanes) {
    case 1:
      return LightRange<1>(*this, begin, end);
    case 2:
      return LightRange<2>(*this, begin, end);
    default:
      CHECK(transfer->padded_count() == 3 * kShortLanes);
      return LightRange<3>(*this, begin, end);
  }
}

}  // namespace lararium::light
