#include "shared/human/compressed_clip.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "shared/core/check.h"

namespace lararium::human {
namespace {

constexpr float kComponentRange = 0.70710678f;  // bound of the three smaller components
constexpr float kRotationSteps = 32767.0f;      // 15 bits
constexpr float kVectorSteps = 65535.0f;

// A close approximation of slerp for neighbouring keys at a fraction of its time.
glm::quat Between(const glm::quat& a, const glm::quat& b, float t) {
  const float cosine = glm::dot(a, b);
  if (std::abs(cosine) < 0.995f) {
    return glm::slerp(a, b, t);
  }
  const float tb = cosine < 0.0f ? -t : t;
  const glm::quat mixed = a * (1.0f - t) + b * tb;
  return mixed * (1.0f / std::sqrt(glm::dot(mixed, mixed)));
}

}  // namespace

CompressedClip::CompressedClip(const Clip& clip, size_t joint_count)
    : duration_(clip.duration),
      keys_per_second_(clip.keys_per_second),
      loops_(clip.loops),
      key_count_(clip.KeyCount(joint_count)) {
  CHECK(key_count_ > 0);
  still_.assign(clip.keys.begin(), clip.keys.begin() + static_cast<std::ptrdiff_t>(joint_count));
  PackRotations(clip);
  translations_ = PackVectors(clip, joint_count, &JointTransform::translation);
  scales_ = PackVectors(clip, joint_count, &JointTransform::scale);
}

void CompressedClip::PackRotations(const Clip& clip) {
  const float still = std::cos(0.5f * kStill);
  for (size_t joint = 0; joint < still_.size(); ++joint) {
    for (size_t key = 1; key < key_count_; ++key) {
      const glm::quat& rotation = clip.keys[key * still_.size() + joint].rotation;
      // For small angles the cosine is not precise enough, but the difference is.
      const glm::quat& first = still_[joint].rotation;
      const float sign = glm::dot(first, rotation) < 0.0f ? -1.0f : 1.0f;
      const glm::quat difference = first - rotation * sign;
      if (2.0f * std::sqrt(glm::dot(difference, difference)) > kStill ||
          std::abs(glm::dot(first, rotation)) < still) {
        rotating_.push_back(static_cast<uint16_t>(joint));
        break;
      }
    }
  }
  rotations_.reserve(key_count_ * rotating_.size());
  for (size_t key = 0; key < key_count_; ++key) {
    for (const uint16_t joint : rotating_) {
      rotations_.push_back(Pack(clip.keys[key * still_.size() + joint].rotation));
    }
  }
}

CompressedClip::PackedRotation CompressedClip::Pack(const glm::quat& rotation) {
  const float length = glm::length(rotation);
  const float q[4] = {rotation.w / length, rotation.x / length, rotation.y / length,
                      rotation.z / length};
  const auto larger = [](float a, float b) { return std::abs(a) < std::abs(b); };
  const auto largest = static_cast<size_t>(std::max_element(q, q + 4, larger) - q);
  const float sign = q[largest] < 0.0f ? -1.0f : 1.0f;
  PackedRotation packed = {};
  for (size_t i = 0, out = 0; i < 4; ++i) {
    if (i != largest) {
      const float share = 0.5f + 0.5f * std::clamp(sign * q[i] / kComponentRange, -1.0f, 1.0f);
      packed[out++] = static_cast<uint16_t>(std::lround(share * kRotationSteps));
    }
  }
  packed[0] = static_cast<uint16_t>(packed[0] | ((largest & 1u) << 15));
  packed[1] = static_cast<uint16_t>(packed[1] | ((largest >> 1) << 15));
  return packed;
}

glm::quat CompressedClip::Unpack(const PackedRotation& packed) {
  const size_t largest =
      static_cast<size_t>(packed[0] >> 15) | (static_cast<size_t>(packed[1] >> 15) << 1);
  glm::vec3 v;
  for (int i = 0; i < 3; ++i) {
    const auto steps = static_cast<float>(packed[static_cast<size_t>(i)] & 0x7fffu);
    v[i] = (2.0f * kComponentRange / kRotationSteps) * steps - kComponentRange;
  }
  const float missing = std::sqrt(std::max(1.0f - glm::dot(v, v), 0.0f));
  switch (largest) {
    case 0:
      return {missing, v.x, v.y, v.z};
    case 1:
      return {v.x, missing, v.y, v.z};
    case 2:
      return {v.x, v.y, missing, v.z};
    default:
      return {v.x, v.y, v.z, missing};
  }
}

CompressedClip::VectorTracks CompressedClip::PackVectors(const Clip& clip,
                                                         size_t joint_count,
                                                         glm::vec3 JointTransform::*member) {
  const size_t key_count = clip.KeyCount(joint_count);
  VectorTracks tracks;
  for (size_t joint = 0; joint < joint_count; ++joint) {
    glm::vec3 low = clip.keys[joint].*member, high = low;
    for (size_t key = 1; key < key_count; ++key) {
      low = glm::min(low, clip.keys[key * joint_count + joint].*member);
      high = glm::max(high, clip.keys[key * joint_count + joint].*member);
    }
    const glm::vec3 range = high - low;
    if (std::max({range.x, range.y, range.z}) > kStill) {
      tracks.joints.push_back(static_cast<uint16_t>(joint));
      tracks.low.push_back(low);
      tracks.range.push_back(range);
    }
  }
  for (size_t key = 0; key < key_count; ++key) {
    for (size_t track = 0; track < tracks.joints.size(); ++track) {
      const glm::vec3 value = clip.keys[key * joint_count + tracks.joints[track]].*member;
      PackedVector packed = {};
      for (int i = 0; i < 3; ++i) {
        const float range = tracks.range[track][i];
        const float share = range > 0.0f ? (value[i] - tracks.low[track][i]) / range : 0.0f;
        packed[static_cast<size_t>(i)] =
            static_cast<uint16_t>(std::lround(std::clamp(share, 0.0f, 1.0f) * kVectorSteps));
      }
      tracks.keys.push_back(packed);
    }
  }
  return tracks;
}

void CompressedClip::Sample(double time, std::span<JointTransform> pose) const {
  CHECK(pose.size() == still_.size() && std::isfinite(time));
  const double position = ClipTime(time, duration_, loops_) * keys_per_second_;
  Place place;
  place.first = std::min(static_cast<size_t>(position), key_count_ - 1);
  place.second = std::min(place.first + 1, key_count_ - 1);
  place.t = std::min(static_cast<float>(position - static_cast<double>(place.first)), 1.0f);
  std::copy(still_.begin(), still_.end(), pose.begin());
  const PackedRotation* a = rotations_.data() + place.first * rotating_.size();
  const PackedRotation* b = rotations_.data() + place.second * rotating_.size();
  for (size_t track = 0; track < rotating_.size(); ++track) {
    pose[rotating_[track]].rotation = Between(Unpack(a[track]), Unpack(b[track]), place.t);
  }
  SampleVectors(translations_, place, &JointTransform::translation, pose);
  SampleVectors(scales_, place, &JointTransform::scale, pose);
}

void CompressedClip::SampleVectors(const VectorTracks& tracks,
                                   const Place& place,
                                   glm::vec3 JointTransform::*member,
                                   std::span<JointTransform> pose) {
  const PackedVector* a = tracks.keys.data() + place.first * tracks.joints.size();
  const PackedVector* b = tracks.keys.data() + place.second * tracks.joints.size();
  for (size_t track = 0; track < tracks.joints.size(); ++track) {
    const glm::vec3 from(a[track][0], a[track][1], a[track][2]);
    const glm::vec3 to(b[track][0], b[track][1], b[track][2]);
    pose[tracks.joints[track]].*member =
        tracks.low[track] + tracks.range[track] * (glm::mix(from, to, place.t) / kVectorSteps);
  }
}

size_t CompressedClip::bytes() const {
  const auto vectors = [](const VectorTracks& tracks) {
    return tracks.joints.size() * (sizeof(uint16_t) + 2 * sizeof(glm::vec3)) +
           tracks.keys.size() * sizeof(PackedVector);
  };
  return still_.size() * sizeof(JointTransform) + rotating_.size() * sizeof(uint16_t) +
         rotations_.size() * sizeof(PackedRotation) + vectors(translations_) + vectors(scales_);
}

}  // namespace lararium::human
