#include "editor/import/model/root_motion.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "editor/import/model/clip_track.h"
#include "shared/core/check.h"
#include "shared/human/turns.h"

namespace lararium::import {
namespace {

using human::JointTransform;
using human::Skeleton;

constexpr float kLeastTravel = 0.4f;         // metres
constexpr float kLeastSpeed = 0.25f;         // m/s
constexpr float kStraight = 0.85f;           // Net travel relative to the path length.
constexpr float kAlong = 0.7f;               // Cosine between facing and travel.
constexpr float kPathStep = 0.25f;           // Seconds between points of the path.
constexpr float kLargestCycleError = 0.35f;  // Radians, RMS over joints.

glm::vec3 Flat(const glm::vec3& v) { return {v.x, 0.0f, v.z}; }

// Length of the path of the pelvis without its sway.
float PathLength(const BodyTrack& track) {
  const auto step =
      static_cast<size_t>(std::max(1.0f, std::round(kPathStep / track.seconds_per_key)));
  float length = 0.0f;
  size_t from = 0;
  while (from + 1 < track.size()) {
    const size_t to = std::min(from + step, track.size() - 1);
    length += glm::length(Flat(track.pelvis[to] - track.pelvis[from]));
    from = to;
  }
  return length;
}

glm::vec3 Facing(const BodyTrack& track) {
  glm::vec3 facing(0.0f);
  for (const glm::quat& turn : track.pelvis_turn) {
    facing += Flat(turn * glm::vec3(0.0f, 0.0f, -1.0f));
  }
  return human::Direction(facing, glm::vec3(0.0f, 0.0f, -1.0f));
}

// Rotates the complete clip about the vertical axis and moves it, key by key.
void MoveRoots(const Skeleton& skeleton,
               float turn,
               const glm::vec3& offset,
               const glm::vec3& offset_per_key,
               human::Clip& clip) {
  const glm::quat rotation = human::TurnY(turn);
  for (size_t key = 0; key < clip.KeyCount(skeleton.size()); ++key) {
    for (size_t joint = 0; joint < skeleton.size(); ++joint) {
      if (skeleton.parents[joint] == Skeleton::kNoParent) {
        JointTransform& t = clip.keys[key * skeleton.size() + joint];
        t.rotation = glm::normalize(rotation * t.rotation);
        t.translation =
            rotation * t.translation + offset + static_cast<float>(key) * offset_per_key;
      }
    }
  }
}

float Angle(const glm::quat& a, const glm::quat& b) {
  return 2.0f * std::acos(std::min(1.0f, std::abs(glm::dot(a, b))));
}

// RMS over the joints of the difference between two keys in radians, plus the difference
// between their velocities.
float PoseError(const Skeleton& skeleton, const human::Clip& clip, size_t a, size_t b) {
  const JointTransform* pa = &clip.keys[a * skeleton.size()];
  const JointTransform* pb = &clip.keys[b * skeleton.size()];
  const JointTransform* before_a = pa - (a == 0 ? 0 : skeleton.size());
  const JointTransform* before_b = pb - (a == 0 ? 0 : skeleton.size());
  float sum = 0.0f;
  for (size_t joint = 0; joint < skeleton.size(); ++joint) {
    const float pose = Angle(pa[joint].rotation, pb[joint].rotation);
    const glm::quat step_a = glm::conjugate(before_a[joint].rotation) * pa[joint].rotation;
    const glm::quat step_b = glm::conjugate(before_b[joint].rotation) * pb[joint].rotation;
    const float change = Angle(step_a, step_b);
    sum += pose * pose + 4.0f * change * change;
  }
  return std::sqrt(sum / static_cast<float>(skeleton.size()));
}

// Speed of the floor in a clip that walks in place: that of the lower foot.
float TreadmillSpeed(const BodyTrack& track) {
  std::vector<float> speeds;
  for (size_t key = 1; key + 1 < track.size(); ++key) {
    const auto& right = track.feet[human::kRight].ball;
    const auto& left = track.feet[human::kLeft].ball;
    const PointTrack& lower = right[key].y < left[key].y ? right : left;
    speeds.push_back((lower[key + 1].z - lower[key - 1].z) / (2.0f * track.seconds_per_key));
  }
  if (speeds.empty()) {
    return 0.0f;
  }
  const auto middle = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() / 2);
  std::nth_element(speeds.begin(), middle, speeds.end());
  return *middle;
}

}  // namespace

bool TakeRootMotion(const Skeleton& skeleton, human::Clip& clip) {
  const human::BodyRig body = human::MakeBodyRig(skeleton);
  if (!body.walks() || clip.KeyCount(skeleton.size()) < 3 || !(clip.duration > 0.0f)) {
    return false;
  }
  const BodyTrack track = TrackBody(skeleton, body, clip);
  const glm::vec3 net = Flat(track.pelvis.back() - track.pelvis.front());
  const float distance = glm::length(net);
  const glm::vec3 facing = Facing(track);
  const float along = distance > 0.0f ? glm::dot(net / distance, facing) : 0.0f;
  const bool travels = distance > kLeastTravel && distance / clip.duration > kLeastSpeed &&
                       distance > kStraight * PathLength(track) && std::abs(along) > kAlong;
  if (travels) {
    const glm::vec3 ahead = (along > 0.0f ? net : -net) / distance;
    const float turn = std::atan2(ahead.x, -ahead.z);  // TurnY rotates `ahead` to -Z.
    const auto intervals = static_cast<float>(track.size() - 1);
    const glm::vec3 step = human::TurnY(turn) * net / intervals;
    const glm::vec3 start = human::TurnY(turn) * Flat(track.pelvis.front());
    MoveRoots(skeleton, turn, -start, -step, clip);
    clip.stride = along > 0.0f ? distance : -distance;
    return true;
  }
  const bool has_toes = !track.feet[0].ball.empty() && !track.feet[1].ball.empty();
  if (clip.loops && has_toes && distance < 0.1f && clip.stride == 0.0f) {
    const float speed = TreadmillSpeed(track);
    if (std::abs(speed) > kLeastSpeed) {
      clip.stride = speed * clip.duration;
    }
  }
  return clip.stride != 0.0f;
}

std::optional<std::pair<size_t, size_t>> FindCycle(const Skeleton& skeleton,
                                                   const human::Clip& clip,
                                                   const CycleLength& length) {
  const size_t keys = clip.KeyCount(skeleton.size());
  const auto least = static_cast<size_t>(std::ceil(length.least * clip.keys_per_second));
  const auto most = static_cast<size_t>(std::floor(length.most * clip.keys_per_second));
  float best = kLargestCycleError;
  std::optional<std::pair<size_t, size_t>> cycle;
  for (size_t first = 0; first + least < keys; ++first) {
    for (size_t last = first + least; last < std::min(keys, first + most + 1); ++last) {
      const float error = PoseError(skeleton, clip, first, last);
      if (error < best) {
        best = error;
        cycle = {first, last};
      }
    }
  }
  return cycle;
}

void CutLoop(const Skeleton& skeleton, size_t first, size_t last, human::Clip& clip) {
  const size_t joints = skeleton.size();
  CHECK(first < last && last < clip.KeyCount(joints));
  const float intervals = static_cast<float>(last - first);
  const std::vector<JointTransform> begin(
      clip.keys.begin() + static_cast<std::ptrdiff_t>(first * joints),
      clip.keys.begin() + static_cast<std::ptrdiff_t>((first + 1) * joints));
  const std::vector<JointTransform> end(
      clip.keys.begin() + static_cast<std::ptrdiff_t>(last * joints),
      clip.keys.begin() + static_cast<std::ptrdiff_t>((last + 1) * joints));
  std::vector<JointTransform> keys;
  for (size_t key = first; key <= last; ++key) {
    // Half of the difference is distributed before the middle, half after it.
    const float share = static_cast<float>(key - first) / intervals - 0.5f;
    for (size_t joint = 0; joint < joints; ++joint) {
      JointTransform t = clip.keys[key * joints + joint];
      const glm::quat missing =
          human::ShorterArc(glm::conjugate(end[joint].rotation) * begin[joint].rotation);
      t.rotation =
          glm::normalize(t.rotation * human::Share(share < 0.0f ? glm::conjugate(missing) : missing,
                                                   std::abs(share)));
      t.translation += share * (begin[joint].translation - end[joint].translation);
      keys.push_back(t);
    }
  }
  std::copy(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(joints),
            keys.end() - static_cast<std::ptrdiff_t>(joints));
  if (clip.stride != 0.0f) {
    // The share of the travel, minus what closing the root removes.
    clip.stride *= intervals / static_cast<float>(clip.KeyCount(joints) - 1);
    clip.stride += begin[0].translation.z - end[0].translation.z;
  }
  clip.keys = std::move(keys);
  clip.duration = intervals / clip.keys_per_second;
  clip.loops = true;
}

}  // namespace lararium::import
