#include "editor/import/model/clip_track.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace lararium::import {
namespace {

// Limits for the movement of a standing foot in captured motion: the ball of the foot rolls and
// markers shift. A foot in swing is ten times as fast.
constexpr float kStillSpeed = 0.35f;    // m/s
constexpr float kLowHeight = 0.06f;     // Metres above the height at which the point stands.
constexpr float kSpeedSpan = 0.05f;     // Speed is measured over this many seconds on either side.
constexpr float kShortContact = 0.08f;  // Seconds; shorter contacts and gaps are noise.

glm::vec3 VelocityAt(const PointTrack& point, size_t key, float seconds_per_key) {
  const auto span = static_cast<size_t>(std::max(1.0f, std::round(kSpeedSpan / seconds_per_key)));
  const size_t first = key < span ? 0 : key - span;
  const size_t last = std::min(key + span, point.size() - 1);
  return last == first
             ? glm::vec3(0.0f)
             : (point[last] - point[first]) / (static_cast<float>(last - first) * seconds_per_key);
}

// Inverts runs of `value` that are shorter than `least` keys, except those at either end.
void RemoveShortRuns(std::vector<bool>& flags, bool value, size_t least) {
  for (size_t begin = 0; begin < flags.size();) {
    size_t end = begin;
    while (end < flags.size() && flags[end] == flags[begin]) {
      ++end;
    }
    if (flags[begin] == value && end - begin < least && begin > 0 && end < flags.size()) {
      std::fill(flags.begin() + static_cast<std::ptrdiff_t>(begin),
                flags.begin() + static_cast<std::ptrdiff_t>(end), !value);
    }
    begin = end;
  }
}

}  // namespace

void ComputeFrames(const human::Skeleton& skeleton,
                   std::span<const human::JointTransform> pose,
                   JointFrames& frames) {
  frames.rotations.resize(skeleton.size());
  frames.positions.resize(skeleton.size());
  std::vector<float> scales(skeleton.size(), 1.0f);
  for (size_t i = 0; i < skeleton.size(); ++i) {
    const human::JointTransform& joint = pose[i];
    const float scale = std::cbrt(std::abs(joint.scale.x * joint.scale.y * joint.scale.z));
    if (skeleton.parents[i] == human::Skeleton::kNoParent) {
      frames.rotations[i] = joint.rotation;
      frames.positions[i] = joint.translation;
      scales[i] = scale;
    } else {
      const auto parent = static_cast<size_t>(skeleton.parents[i]);
      frames.rotations[i] = glm::normalize(frames.rotations[parent] * joint.rotation);
      frames.positions[i] = frames.positions[parent] +
                            frames.rotations[parent] * (scales[parent] * joint.translation);
      scales[i] = scales[parent] * scale;
    }
  }
}

BodyTrack TrackBody(const human::Skeleton& skeleton,
                    const human::BodyRig& body,
                    const human::Clip& clip) {
  BodyTrack track;
  track.seconds_per_key = 1.0f / clip.keys_per_second;
  JointFrames frames;
  for (size_t key = 0; key < clip.KeyCount(skeleton.size()); ++key) {
    ComputeFrames(skeleton, std::span(clip.keys).subspan(key * skeleton.size(), skeleton.size()),
                  frames);
    const auto root = static_cast<size_t>(body.root);
    track.pelvis.push_back(frames.positions[root]);
    track.pelvis_turn.push_back(frames.rotations[root] * glm::conjugate(body.rest[root].rotation));
    for (size_t side = 0; side < 2; ++side) {
      const human::BodyRig::Leg& leg = body.legs[side];
      const auto ankle = static_cast<size_t>(leg.ankle);
      track.feet[side].ankle.push_back(frames.positions[ankle]);
      track.feet[side].turn.push_back(frames.rotations[ankle] *
                                      glm::conjugate(body.rest[ankle].rotation));
      glm::vec3 ball(0.0f);
      for (const human::JointIndex toe : leg.toes) {
        ball += frames.positions[static_cast<size_t>(toe)];
      }
      if (!leg.toes.empty()) {
        track.feet[side].ball.push_back(ball / static_cast<float>(leg.toes.size()));
      }
    }
  }
  return track;
}

float LowHeight(const PointTrack& point) {
  if (point.empty()) {
    return 0.0f;
  }
  std::vector<float> heights;
  for (const glm::vec3& p : point) {
    heights.push_back(p.y);
  }
  const auto low = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 10);
  std::nth_element(heights.begin(), low, heights.end());
  return *low;
}

std::vector<bool> FindContacts(const PointTrack& point,
                               float seconds_per_key,
                               const glm::vec3& ground) {
  const float low = LowHeight(point);
  std::vector<bool> contacts(point.size());
  for (size_t key = 0; key < point.size(); ++key) {
    contacts[key] = point[key].y < low + kLowHeight &&
                    glm::length(VelocityAt(point, key, seconds_per_key) - ground) < kStillSpeed;
  }
  const auto least =
      static_cast<size_t>(std::max(2.0f, std::ceil(kShortContact / seconds_per_key)));
  RemoveShortRuns(contacts, false, least);
  RemoveShortRuns(contacts, true, least);
  return contacts;
}

}  // namespace lararium::import
