#include "editor/import/motion/foot_lock.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "editor/import/model/clip_track.h"
#include "shared/human/turns.h"
#include "shared/human/two_bone_ik.h"

namespace lararium::import {
namespace {

using human::JointTransform;

constexpr float kReach = 0.992f;      // Share of the length of the leg.
constexpr float kDeepestSink = 0.2f;  // metres
// Distance to the tip of the toes relative to that from ankle to ball.
constexpr float kTip = 1.4f;
// Seconds on either side of a stance in which a foot becomes level.
constexpr float kLevelSpan = 0.1f;
constexpr float kSinkSpan = 0.12f;  // Seconds on either side in which the hips are lowered.

enum class Stands { kNo, kHeel, kBall };

float SmoothStep(float x) { return x * x * (3.0f - 2.0f * x); }

// The path of one foot in a clip, and its correction.
struct Foot {
  std::vector<Stands> stands;
  std::vector<glm::quat> turn;        // Rotation from rest, level where the whole sole stands.
  std::vector<float> toes_flat;       // 0..1; at 1 the toes rest on the floor.
  PointTrack ankle, heel, ball, tip;  // Uncorrected tracks from the keys.
  std::vector<glm::vec3> correction;  // Displacement of each key.
};

class FootLock {
 public:
  FootLock(const human::Skeleton& skeleton,
           const human::BodyRig& body,
           const std::array<FootContacts, 2>& contacts,
           human::Clip& clip)
      : skeleton_(skeleton), body_(body), clip_(clip), keys_(clip.KeyCount(skeleton.size())) {
    const BodyTrack track = TrackBody(skeleton, body, clip);
    for (size_t side = 0; side < 2; ++side) {
      Follow(track.feet[side], body.legs[side], contacts[side], feet_[side]);
    }
  }

  void Run() {
    for (Foot& foot : feet_) {
      Correct(foot);
    }
    SinkHips();
    for (size_t key = 0; key < keys_; ++key) {
      for (size_t side = 0; side < 2; ++side) {
        Solve(key, side);
      }
    }
  }

 private:
  std::span<JointTransform> Pose(size_t key) {
    return std::span(clip_.keys).subspan(key * skeleton_.size(), skeleton_.size());
  }

  void Follow(const FootTrack& track,
              const human::BodyRig::Leg& leg,
              const FootContacts& contacts,
              Foot& foot) const {
    const glm::quat toe_out = human::TurnY(leg.toe_out);
    const glm::vec3 drop(0.0f, -leg.ankle_height, 0.0f);
    // The sole under the ball; toes may bend above it.
    const glm::vec3 sole(0.0f, 0.0f, leg.ball.z);
    foot.ankle = track.ankle;
    std::vector<float> flat(keys_, 0.0f);
    for (size_t key = 0; key < keys_; ++key) {
      foot.stands.push_back(contacts.ball[key]   ? Stands::kBall
                            : contacts.heel[key] ? Stands::kHeel
                                                 : Stands::kNo);
      const float heel = (track.turn[key] * toe_out * leg.heel).y;
      const float ball = (track.turn[key] * toe_out * sole).y;
      // Also where a moving part would be below the standing one.
      const bool through = (foot.stands[key] == Stands::kBall && heel < ball) ||
                           (foot.stands[key] == Stands::kHeel && ball < heel);
      flat[key] = through || (contacts.heel[key] && contacts.ball[key]) ? 1.0f : 0.0f;
    }
    flat = Smoothed(flat, kLevelSpan);
    for (const Stands stands : foot.stands) {
      foot.toes_flat.push_back(stands == Stands::kBall ? 1.0f : 0.0f);
    }
    foot.toes_flat = Smoothed(foot.toes_flat, kLevelSpan);
    for (size_t key = 0; key < keys_; ++key) {
      const glm::quat& turn = track.turn[key];
      foot.turn.push_back(glm::slerp(turn, Level(turn), flat[key]));
      foot.heel.push_back(track.ankle[key] + foot.turn[key] * (toe_out * leg.heel + drop));
      foot.ball.push_back(track.ankle[key] + foot.turn[key] * (toe_out * sole + drop));
      foot.tip.push_back(track.ankle[key] + foot.turn[key] * (toe_out * (kTip * sole) + drop));
    }
    foot.correction.assign(keys_, glm::vec3(0.0f));
  }

  // Removes the tilt of the sole from a rotation.
  static glm::quat Level(const glm::quat& turn) {
    const glm::vec3 up(0.0f, 1.0f, 0.0f);
    return human::Arc(turn * up, up) * turn;
  }

  // The mean over `seconds` on either side.
  std::vector<float> Smoothed(const std::vector<float>& values, float seconds) const {
    const auto span = static_cast<std::ptrdiff_t>(std::ceil(seconds * clip_.keys_per_second));
    const auto last = static_cast<std::ptrdiff_t>(values.size()) - 1;
    std::vector<float> smooth(values.size(), 0.0f);
    for (std::ptrdiff_t key = 0; key <= last; ++key) {
      for (std::ptrdiff_t k = -span; k <= span; ++k) {
        smooth[static_cast<size_t>(key)] +=
            values[static_cast<size_t>(std::clamp<std::ptrdiff_t>(key + k, 0, last))] /
            static_cast<float>(2 * span + 1);
      }
    }
    return smooth;
  }

  static const glm::vec3& Point(const Foot& foot, size_t key) {
    return foot.stands[key] == Stands::kHeel ? foot.heel[key] : foot.ball[key];
  }

  void Correct(Foot& foot) const {
    for (size_t begin = 0; begin < keys_;) {
      size_t end = begin;
      while (end < keys_ &&
             (foot.stands[end] == Stands::kNo) == (foot.stands[begin] == Stands::kNo)) {
        ++end;
      }
      if (foot.stands[begin] != Stands::kNo) {
        HoldStance(begin, end, foot);
      }
      begin = end;
    }
    BlendSwings(foot);
    KeepAboveFloor(foot);
  }

  // Works outwards from the middle of a stance: a standing part stays in place; when heel and
  // ball alternate, the next one stays where the previous one has brought it.
  void HoldStance(size_t begin, size_t end, Foot& foot) const {
    const size_t middle = Anchor(begin, end, foot);
    foot.correction[middle] = glm::vec3(0.0f, -Point(foot, middle).y, 0.0f);
    for (size_t key = middle + 1; key < end; ++key) {
      Continue(key - 1, key, foot);
    }
    for (size_t key = middle; key-- > begin;) {
      Continue(key + 1, key, foot);
    }
  }

  // The middle of the keys on the ball, or of all keys.
  static size_t Anchor(size_t begin, size_t end, const Foot& foot) {
    size_t first = end, last = begin;
    for (size_t key = begin; key < end; ++key) {
      if (foot.stands[key] == Stands::kBall) {
        first = std::min(first, key);
        last = key;
      }
    }
    return first < end ? (first + last) / 2 : (begin + end) / 2;
  }

  static void Continue(size_t from, size_t to, Foot& foot) {
    const bool heel = foot.stands[to] == Stands::kHeel;
    const glm::vec3& before = heel ? foot.heel[from] : foot.ball[from];
    const glm::vec3& here = heel ? foot.heel[to] : foot.ball[to];
    glm::vec3 place = before + foot.correction[from];
    if (foot.stands[from] == foot.stands[to]) {
      place.y = 0.0f;
    } else {
      // The foot touches down. Reaching the floor in one key would be a step of centimetres;
      // over several keys it is invisible.
      place.y *= 0.5f;
    }
    foot.correction[to] = place - here;
  }

  void BlendSwings(Foot& foot) const {
    for (size_t begin = 0; begin < keys_;) {
      if (foot.stands[begin] != Stands::kNo) {
        ++begin;
        continue;
      }
      size_t end = begin;
      while (end < keys_ && foot.stands[end] == Stands::kNo) {
        ++end;
      }
      const glm::vec3 from = begin > 0     ? foot.correction[begin - 1]
                             : end < keys_ ? foot.correction[end]
                                           : glm::vec3(0.0f);
      const glm::vec3 to = end < keys_ ? foot.correction[end] : from;
      for (size_t key = begin; key < end; ++key) {
        const float share =
            static_cast<float>(key - begin + 1) / static_cast<float>(end - begin + 1);
        foot.correction[key] = glm::mix(from, to, SmoothStep(share));
      }
      begin = end;
    }
  }

  void KeepAboveFloor(Foot& foot) const {
    for (size_t key = 0; key < keys_; ++key) {
      const float lowest = std::min(foot.heel[key].y, foot.tip[key].y) + foot.correction[key].y;
      if (foot.stands[key] == Stands::kNo && lowest < 0.0f) {
        foot.correction[key].y -= lowest;
      }
    }
  }

  // Distance by which the hip must be lowered for the leg to reach.
  float MissingReach(size_t key, size_t side) {
    const human::BodyRig::Leg& leg = body_.legs[side];
    const Foot& foot = feet_[side];
    const glm::vec3 hip = human::ActorFromJoint(skeleton_, Pose(key), leg.hip).position;
    const glm::vec3 goal = foot.ankle[key] + foot.correction[key];
    const float length = kReach * (leg.upper_length + leg.lower_length);
    const float aside = std::hypot(goal.x - hip.x, goal.z - hip.z);
    const float below = std::sqrt(std::max(length * length - aside * aside, 0.0f));
    return std::clamp(hip.y - goal.y - below, 0.0f, kDeepestSink);
  }

  void SinkHips() {
    std::vector<float> needed(keys_, 0.0f);
    for (size_t key = 0; key < keys_; ++key) {
      for (size_t side = 0; side < 2; ++side) {
        needed[key] = std::max(needed[key], MissingReach(key, side));
      }
    }
    const auto span = static_cast<size_t>(std::ceil(kSinkSpan * clip_.keys_per_second));
    std::vector<float> widened(keys_, 0.0f);
    for (size_t key = 0; key < keys_; ++key) {
      for (size_t k = key < span ? 0 : key - span; k < std::min(keys_, key + span + 1); ++k) {
        widened[key] = std::max(widened[key], needed[k]);
      }
    }
    const std::vector<float> smooth = Smoothed(widened, kSinkSpan);
    for (size_t key = 0; key < keys_; ++key) {
      MoveHips(key, -smooth[key]);
    }
  }

  void MoveHips(size_t key, float up) {
    const auto root = static_cast<size_t>(body_.root);
    const int16_t parent = skeleton_.parents[root];
    const human::JointFrame above = human::ActorFromJoint(skeleton_, Pose(key), parent);
    Pose(key)[root].translation +=
        glm::conjugate(above.rotation) * glm::vec3(0.0f, up, 0.0f) / above.scale;
  }

  void Solve(size_t key, size_t side) {
    const human::BodyRig::Leg& leg = body_.legs[side];
    const std::span<JointTransform> pose = Pose(key);
    const glm::vec3 hip = human::ActorFromJoint(skeleton_, pose, leg.hip).position;
    const glm::vec3 knee = human::ActorFromJoint(skeleton_, pose, leg.knee).position;
    const glm::vec3 ankle = human::ActorFromJoint(skeleton_, pose, leg.ankle).position;
    const glm::quat& turn = feet_[side].turn[key];
    const glm::vec3 along = human::Direction(ankle - hip, glm::vec3(0, -1, 0));
    const glm::vec3 forward = human::Across(turn * glm::vec3(0.0f, 0.0f, -1.0f), along);
    human::TwoBoneIk ik;
    ik.upper = leg.hip;
    ik.lower = leg.knee;
    ik.end = leg.ankle;
    ik.target = feet_[side].ankle[key] + feet_[side].correction[key];
    // Straight knees bend in the direction of the foot.
    ik.pole = human::Across(knee - hip, along) + 0.02f * forward;
    ik.hinge = glm::vec3(1.0f, 0.0f, 0.0f);
    ik.Solve(skeleton_, body_, pose);
    human::SetActorRotation(skeleton_, leg.ankle,
                            turn * body_.rest[static_cast<size_t>(leg.ankle)].rotation, pose);
    // Captured toes are seldom good: ours rest on the floor or follow the foot.
    const glm::quat toes = glm::slerp(turn, Level(turn), feet_[side].toes_flat[key]);
    for (const human::JointIndex toe : leg.toes) {
      human::SetActorRotation(skeleton_, toe, toes * body_.rest[static_cast<size_t>(toe)].rotation,
                              pose);
    }
  }

  const human::Skeleton& skeleton_;
  const human::BodyRig& body_;
  human::Clip& clip_;
  size_t keys_;
  std::array<Foot, 2> feet_;
};

}  // namespace

void LockFeet(const human::Skeleton& skeleton,
              const human::BodyRig& body,
              const std::array<FootContacts, 2>& contacts,
              human::Clip& clip) {
  FootLock(skeleton, body, contacts, clip).Run();
}

}  // namespace lararium::import
