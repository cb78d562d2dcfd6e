#include "shared/light/transfer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <utility>

#include "shared/core/check.h"
#include "shared/core/parallel.h"
#include "shared/light/spherical_harmonics.h"

namespace lararium::light {
namespace {

constexpr float kLargestByte = 127.0f;

// The largest integer for packed light: the sum of four rounded parts of it still fits.
constexpr float kLargestShort = 32000.0f;

// Converts a weight in 1/255 to the format of MultiplyHigh.
constexpr int16_t Weight(uint8_t weight) { return static_cast<int16_t>(weight * 128 + weight / 2); }

// The light of a vertex: the weighted light of its receivers.
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

using Ratios = std::array<float, 3>;

// Ratios of the channels to their mean, less 1.
inline Ratios RatiosOf(const Transfer& transfer, const int8_t* row) {
  const float red = row[transfer.ratios_at()] / Transfer::kRatioUnit;
  const float blue = row[transfer.ratios_at() + 1] / Transfer::kRatioUnit;
  return {red, -red - blue, blue};
}

inline float ScaleOf(const Transfer& transfer, const int8_t* row) {
  float scale;
  std::memcpy(&scale, row + transfer.scale_at(), sizeof(scale));
  return scale;
}

inline bool AnyChanged(const uint8_t* changed, const VertexReceivers& receivers) {
  bool any = false;
  for (size_t r = 0; r < kReceiversOfVertex; ++r) {
    any |= receivers.weight[r] > 0 && changed[receivers.receiver[r]] != 0;
  }
  return any;
}

// The light that a row's differences are multiplied by: red, blue and twice the part that reduces
// green, kTinted coefficients each.
template <size_t OfChannel>
inline ShortLanes TintedLight(const ShortLanes (&light)[3 * OfChannel]) {
  const ShortLanes& red = light[0];
  const ShortLanes green = -light[OfChannel];
  const ShortLanes& blue = light[2 * OfChannel];
  const ShortLanes both =
      __builtin_shufflevector(red, blue, 0, 1, 2, 3, 16, 17, 18, 19, 0, 1, 2, 3, 16, 17, 18, 19);
  return __builtin_shufflevector(both, green, 0, 1, 2, 3, 4, 5, 6, 7, 16, 17, 18, 19, 16, 17, 18,
                                 19);
}

// Lights vertices whose rows have OfChannel registers per channel.
template <size_t OfChannel>
void LightRange(const LightVerticesJob& job, size_t begin, size_t end) {
  // Selects, among a register's pairs of coefficients, those that have a ratio.
  constexpr Lanes kHaveRatio = {0, 0, 1, 1, 1, 1, 1, 1};
  // Selects the channel of each pair of TintedLight.
  constexpr Lanes kTintOf[3] = {
      {1, 1, 0, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 1, 1, 1, 1}, {0, 0, 1, 1, 0, 0, 0, 0}};
  const Transfer& transfer = *job.transfer;
  const uint8_t* changed = job.changed.empty() ? nullptr : job.changed.data();
  for (size_t v = begin; v < end; ++v) {
    if (changed != nullptr && !AnyChanged(changed, job.receivers[v])) {
      continue;
    }
    ShortLanes light[3 * OfChannel] = {};
    Lanes weights = {};
    BlendReceivers(*job.light, job.receivers[v], job.pose_weights.data(), light, weights);
    const ShortLanes tinted_light = TintedLight<OfChannel>(light);
    float pose_weights[kLanes];
    Store(weights, pose_weights);
    Lanes sums[3] = {};    // part of the mean
    Lanes ratios[3] = {};  // part that the ratios add, in all pairs
    Lanes tinted = {};
    float total = 0.0f;
    const int8_t* row = transfer.row(0, v);
    for (size_t pose = 0; pose < transfer.poses(); ++pose) {
      const float weight = pose_weights[pose];
      if (weight >= kLeastPoseWeight) {
        total += weight;
        const float scale = weight * ScaleOf(transfer, row);
        const Lanes scales = Broadcast(scale);
        const Ratios less_one = RatiosOf(transfer, row);
        ShortLanes mean[OfChannel];
#pragma GCC unroll 3
        for (size_t i = 0; i < OfChannel; ++i) {
          mean[i] = LoadBytes(row + i * kShortLanes);
        }
#pragma GCC unroll 3
        for (size_t channel = 0; channel < 3; ++channel) {
          const ShortLanes* of_channel = light + channel * OfChannel;
          const Lanes ratio = Broadcast(scale * less_one[channel]);
          const Lanes first = __builtin_convertvector(DotPairs(of_channel[0], mean[0]), Lanes);
          sums[channel] = MultiplyAdd(scales, first, sums[channel]);
          ratios[channel] = MultiplyAdd(ratio, first, ratios[channel]);
          if constexpr (OfChannel > 1) {
            IntLanes dot = DotPairs(of_channel[1], mean[1]);
            for (size_t i = 2; i < OfChannel; ++i) {
              dot += DotPairs(of_channel[i], mean[i]);
            }
            sums[channel] =
                MultiplyAdd(scales + ratio, __builtin_convertvector(dot, Lanes), sums[channel]);
          }
        }
        const IntLanes dot = DotPairs(tinted_light, LoadEightBytesTwice(row + transfer.red_at()));
        tinted = MultiplyAdd(scales, __builtin_convertvector(dot, Lanes), tinted);
      }
      row += transfer.pose_stride();
    }
#pragma GCC unroll 3
    for (size_t channel = 0; channel < 3; ++channel) {
      sums[channel] = MultiplyAdd(ratios[channel], kHaveRatio, sums[channel]);
      sums[channel] = MultiplyAdd(tinted, kTintOf[channel], sums[channel]);
    }
    const glm::vec3 irradiance(Sum(sums[0]), Sum(sums[1]), Sum(sums[2]));
    const float unit = job.light->unit() / std::max(total, 1e-6f);
    job.irradiance[v] = glm::max(irradiance * unit, glm::vec3(0.0f));
  }
}

// The best-fitting ratio of a channel to the mean, less 1, for the coefficients without stored
// differences.
int8_t RatioByte(const int8_t* channel, const float* mean, size_t count) {
  float product = 0.0f;
  float square = 0.0f;
  for (size_t k = Transfer::kTinted; k < count; ++k) {
    product += mean[k] * (channel[k] - mean[k]);
    square += mean[k] * mean[k];
  }
  const float ratio = square > 0.0f ? product / square : 0.0f;
  return static_cast<int8_t>(std::nearbyint(
      std::clamp(Transfer::kRatioUnit * ratio, -Transfer::kRatioUnit, kLargestByte)));
}

// values: [3][count], in units of scale.
void PackRow(const Transfer& layout, const int8_t* values, float scale, int8_t* row) {
  const auto count = static_cast<size_t>(layout.count());
  const int8_t* red = values;
  const int8_t* green = red + count;
  const int8_t* blue = green + count;
  float mean[kShCount];
  float largest = 0.0f;
  for (size_t k = 0; k < count; ++k) {
    mean[k] = static_cast<float>(red[k] + green[k] + blue[k]) * (1.0f / 3.0f);
    largest = std::max(largest, std::abs(mean[k]));
  }
  for (size_t k = 0; k < Transfer::kTinted; ++k) {
    largest = std::max({largest, std::abs(red[k] - mean[k]), std::abs(blue[k] - mean[k])});
  }
  const float inverse = largest > 0.0f ? kLargestByte / largest : 0.0f;
  const auto byte = [&](float value) {
    return static_cast<int8_t>(std::nearbyint(value * inverse));
  };
  for (size_t k = 0; k < count; ++k) {
    row[k] = byte(mean[k]);
  }
  for (size_t k = 0; k < Transfer::kTinted; ++k) {
    row[layout.red_at() + k] = byte(red[k] - mean[k]);
    row[layout.blue_at() + k] = byte(blue[k] - mean[k]);
  }
  row[layout.ratios_at()] = RatioByte(red, mean, count);
  row[layout.ratios_at() + 1] = RatioByte(blue, mean, count);
  std::fill(row + layout.ratios_at() + 2, row + layout.scale_at(), int8_t{0});
  const float unit = scale * largest / kLargestByte;
  std::memcpy(row + layout.scale_at(), &unit, sizeof(unit));
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

TransferBytes QuantiseTransfer(std::span<const float> vectors, int count, size_t poses) {
  const auto size = static_cast<size_t>(count);
  CHECK(IsShCount(count) && poses > 0 && vectors.size() % (poses * 3 * size) == 0);
  TransferBytes transfer;
  transfer.count = count;
  transfer.poses = poses;
  transfer.vertices = vectors.size() / (poses * 3 * size);
  transfer.scale.resize(poses * transfer.vertices);
  transfer.values.resize(vectors.size());
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

Transfer::Transfer(const TransferBytes& bytes)
    : count_(bytes.count), poses_(bytes.poses), vertices_(bytes.vertices) {
  const size_t size = 3 * static_cast<size_t>(count_);
  CHECK(IsShCount(count_) && count_ >= 9 && poses_ > 0 && poses_ <= kMaxKeyPoses &&
        bytes.scale.size() == poses_ * vertices_ &&
        bytes.values.size() == bytes.scale.size() * size);
  // The rows are not set to zero first, because all of them are written.
  std::shared_ptr<int8_t[]> rows(new int8_t[bytes.scale.size() * stride()]);
  constexpr size_t kBlock = 1024;  // rows
  ParallelFor((bytes.scale.size() + kBlock - 1) / kBlock, [&](size_t block) {
    const size_t end = std::min((block + 1) * kBlock, bytes.scale.size());
    for (size_t i = block * kBlock; i < end; ++i) {
      PackRow(*this, bytes.values.data() + i * size, bytes.scale[i], rows.get() + i * stride());
    }
  });
  rows_ = std::move(rows);
}

void Transfer::Decode(size_t pose, size_t vertex, std::span<float> vectors) const {
  const auto count = static_cast<size_t>(count_);
  CHECK(pose < poses_ && vertex < vertices_ && vectors.size() == 3 * count);
  const int8_t* from = row(pose, vertex);
  const Ratios ratios = RatiosOf(*this, from);
  const float scale = ScaleOf(*this, from);
  for (size_t k = 0; k < count; ++k) {
    for (size_t channel = 0; channel < 3; ++channel) {
      vectors[channel * count + k] =
          scale * from[k] * (k < kTinted ? 1.0f : 1.0f + ratios[channel]);
    }
  }
  for (size_t k = 0; k < kTinted; ++k) {
    const float red = scale * from[red_at() + k];
    const float blue = scale * from[blue_at() + k];
    vectors[k] += red;
    vectors[count + k] -= red + blue;
    vectors[2 * count + k] += blue;
  }
}

void PackReceiverLight(const ShRowsRgb& light, ReceiverLight& packed) {
  const size_t padded = packed.stride() / 3;
  const float most = LargestOf(light);
  const float held = packed.unit() * kLargestShort;
  if (most > held || most < 0.5f * held || !(held > 0.0f)) {
    // The margin allows the light to grow.
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
  CHECK(transfer != nullptr && light != nullptr && light->count() == transfer->count() &&
        receivers.size() == transfer->vertices() && irradiance.size() == transfer->vertices() &&
        pose_weights.size() == light->receivers() * kMaxKeyPoses &&
        (changed.empty() || changed.size() == light->receivers()) && begin <= end &&
        end <= transfer->vertices());
  const size_t padded = PaddedToShortLanes(static_cast<size_t>(transfer->count()));
  switch (padded / kShortLanes) {
    case 1:
      return LightRange<1>(*this, begin, end);
    case 2:
      return LightRange<2>(*this, begin, end);
    default:
      CHECK(padded == 3 * kShortLanes);
      return LightRange<3>(*this, begin, end);
  }
}

}  // namespace lararium::light
