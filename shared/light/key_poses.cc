#include "shared/light/key_poses.h"

#include "shared/core/check.h"

namespace lararium::light {
namespace {

void CheckKeys(std::span<const ShRows> keys,
               const ShRows& now,
               ReceiverRange range,
               size_t weights) {
  CheckRegisters(range, now);
  CHECK(!keys.empty() && keys.size() <= kMaxKeyPoses && weights == now.receivers() * kMaxKeyPoses);
  for (const ShRows& key : keys) {
    CHECK(key.count() == now.count() && key.stride() == now.stride());
  }
}

Lanes SquaredDistance(const ShRows& a, const ShRows& b, size_t begin) {
  Lanes sum = {};
  for (int k = 0; k < a.count(); ++k) {
    const Lanes difference = Load(a.row(k) + begin) - Load(b.row(k) + begin);
    sum += difference * difference;
  }
  return sum;
}

void Normalise(Lanes (&weights)[kLanes]) {
  Lanes sum = {};
  for (const Lanes& weight : weights) {
    sum += weight;
  }
  for (Lanes& weight : weights) {
    weight /= sum;
  }
}

}  // namespace

static_assert(kMaxKeyPoses == kLanes);

void KeyPoseWeights(std::span<const ShRows> keys,
                    const ShRows& now,
                    std::span<const float> prior,
                    ReceiverRange range,
                    std::span<float> weights) {
  CheckKeys(keys, now, range, weights.size());
  CHECK(prior.empty() || prior.size() == keys.size());
  for (size_t i = range.begin; i < range.end; i += kLanes) {
    Lanes of_pose[kLanes] = {};
    for (size_t pose = 0; pose < keys.size(); ++pose) {
      const Lanes closeness = kIndistinct / (SquaredDistance(keys[pose], now, i) + kIndistinct);
      // The weight never becomes exactly 0, so that a distant pose remains if the prior allows no
      // other.
      const float of_prior = prior.empty() ? 1.0f : prior[pose];
      of_pose[pose] = of_prior * (closeness * closeness + 1e-20f);
    }
    Normalise(of_pose);
    for (Lanes& weight : of_pose) {
      weight = Max(weight - kLeastPoseWeight, Lanes{});
    }
    Normalise(of_pose);
    Transpose(of_pose);
    for (size_t receiver = i; receiver < std::min(range.end, i + kLanes); ++receiver) {
      Store(of_pose[receiver - i], weights.data() + receiver * kMaxKeyPoses);
    }
  }
}

void SubtractKeyPoses(std::span<const ShRows> keys,
                      const ShRows& now,
                      std::span<const float> weights,
                      ReceiverRange range,
                      ShRows& delta) {
  CheckKeys(keys, now, range, weights.size());
  CHECK(delta.count() == now.count() && delta.stride() == now.stride());
  for (size_t i = range.begin; i < range.end; i += kLanes) {
    Lanes of_pose[kLanes] = {};
    for (size_t receiver = i; receiver < std::min(range.end, i + kLanes); ++receiver) {
      of_pose[receiver - i] = Load(weights.data() + receiver * kMaxKeyPoses);
    }
    Transpose(of_pose);
    for (int k = 0; k < now.count(); ++k) {
      Lanes rest = Load(now.row(k) + i);
      for (size_t pose = 0; pose < keys.size(); ++pose) {
        rest -= of_pose[pose] * Load(keys[pose].row(k) + i);
      }
      Store(rest, delta.row(k) + i);
    }
  }
}

}  // namespace lararium::light
