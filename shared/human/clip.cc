#include "shared/human/clip.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>

#include "shared/human/finite.h"

namespace lararium::human {
namespace {

JointTransform Interpolate(const JointTransform& a, const JointTransform& b, float t) {
  return {glm::slerp(a.rotation, b.rotation, t),  // takes the shorter arc
          glm::mix(a.translation, b.translation, t), glm::mix(a.scale, b.scale, t)};
}

}  // namespace

std::vector<float> TurnedFromFirst(const Clip& clip, size_t joint_count) {
  std::vector<float> turned(clip.KeyCount(joint_count), 0.0f);
  for (size_t key = 1; key < turned.size(); ++key) {
    double sum = 0.0;
    for (size_t joint = 0; joint < joint_count; ++joint) {
      const float cosine = std::abs(
          glm::dot(clip.keys[joint].rotation, clip.keys[key * joint_count + joint].rotation));
      sum += 2.0 * std::acos(std::min(cosine, 1.0f));
    }
    turned[key] = static_cast<float>(sum);
  }
  return turned;
}

double ClipTime(double time, float duration, bool loops) {
  const auto end = static_cast<double>(duration);
  if (!loops || duration <= 0.0f) {
    return std::clamp(time, 0.0, end);
  }
  const double wrapped = std::fmod(time, end);
  return wrapped < 0.0 ? wrapped + end : wrapped;
}

Status Clip::Validate(size_t joint_count, const std::string& where) const {
  const std::string clip_place = where + ": clip '" + name + "'";
  if (name.empty()) {
    return Status::Error(where, "a clip has no name");
  }
  if (joint_count == 0 || keys.empty() || keys.size() % joint_count != 0) {
    return Status::Error(clip_place, "its keys do not cover the joints of the skeleton");
  }
  if (!std::isfinite(duration) || duration < 0.0f || !std::isfinite(stride) ||
      !std::isfinite(keys_per_second) || keys_per_second <= 0.0f) {
    return Status::Error(clip_place, "the duration, rate or stride is not valid");
  }
  const double intervals = static_cast<double>(KeyCount(joint_count) - 1);
  if (std::abs(intervals - static_cast<double>(duration) * keys_per_second) > 0.5) {
    return Status::Error(clip_place, "the number of keys does not fit duration and rate");
  }
  if (!std::all_of(keys.begin(), keys.end(), Valid)) {
    return Status::Error(clip_place, "a key has an invalid transform");
  }
  return Status();
}

void SampleClip(const Clip& clip, double time, std::span<JointTransform> pose) {
  const size_t key_count = clip.KeyCount(pose.size());
  CHECK(key_count > 0 && std::isfinite(time));
  const double position = ClipTime(time, clip.duration, clip.loops) * clip.keys_per_second;
  const size_t first = std::min(static_cast<size_t>(position), key_count - 1);
  const size_t second = std::min(first + 1, key_count - 1);
  const float t = std::min(static_cast<float>(position - static_cast<double>(first)), 1.0f);
  const JointTransform* a = &clip.keys[first * pose.size()];
  const JointTransform* b = &clip.keys[second * pose.size()];
  for (size_t joint = 0; joint < pose.size(); ++joint) {
    pose[joint] = Interpolate(a[joint], b[joint], t);
  }
}

void BlendPose(std::span<JointTransform> pose,
               std::span<const JointTransform> other,
               float weight) {
  CHECK(pose.size() == other.size());
  for (size_t joint = 0; joint < pose.size(); ++joint) {
    pose[joint] = Interpolate(pose[joint], other[joint], weight);
  }
}

}  // namespace lararium::human
