#include "editor/import/motion/retarget.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "editor/import/model/clip_track.h"
#include "editor/import/model/root_motion.h"
#include "editor/import/motion/foot_lock.h"
#include "shared/core/check.h"
#include "shared/human/body_rig.h"
#include "shared/human/turns.h"

namespace lararium::import {
namespace {

using human::BodyRig;
using human::JointIndex;
using human::JointTransform;
using human::kNoJoint;
using human::Skeleton;

constexpr float kMostFootTilt = 1.0f;  // Largest correction of a foot's rest rotation, radians.

// The source of the rotation of a target joint: a blend of two joints of the source.
struct Origin {
  JointIndex first = kNoJoint;
  JointIndex second = kNoJoint;
  float share = 0.0f;  // Weight of `second`.
  // Rotates the rest direction of the target's bones to that of the source's.
  glm::quat align = human::kNoTurn;
};

class Retargeter {
 public:
  Retargeter(const Skeleton& source, const human::Clip& clip, const Skeleton& target)
      : source_(source),
        clip_(clip),
        target_(target),
        source_body_(human::MakeBodyRig(source)),
        target_body_(human::MakeBodyRig(target)) {}

  Status Check(const std::string& where) const {
    for (const auto& [body, whose] :
         {std::pair{&source_body_, "clip's skeleton"}, std::pair{&target_body_, "figure"}}) {
      if (!body->walks()) {
        return Status::Error(where, std::string("the ") + whose + " lacks the pelvis or a leg",
                             "name its bones in a bone map");
      }
    }
    return Status();
  }

  human::Clip Run(bool lock_feet) {
    track_ = TrackBody(source_, source_body_, clip_);
    FindContacts();
    MapTrunk();
    for (size_t side = 0; side < 2; ++side) {
      MapArm(side);
      MapLeg(side);
    }
    MapSame();
    human::Clip result;
    result.keys_per_second = clip_.keys_per_second;
    result.duration = clip_.duration;
    JointFrames frames;
    for (size_t key = 0; key < track_.size(); ++key) {
      ComputeFrames(source_, std::span(clip_.keys).subspan(key * source_.size(), source_.size()),
                    frames);
      AddKey(key, frames, result);
    }
    if (lock_feet) {
      LockFeet(target_, target_body_, contacts_, result);
    }
    return result;
  }

 private:
  static size_t Index(JointIndex joint) { return static_cast<size_t>(joint); }
  glm::vec3 SourceRest(JointIndex joint) const { return source_body_.rest[Index(joint)].position; }
  glm::vec3 TargetRest(JointIndex joint) const { return target_body_.rest[Index(joint)].position; }
  Origin& OriginOf(JointIndex joint) { return origins_[Index(joint)]; }

  // ---- Mapping of joints ----

  void Map(JointIndex target, JointIndex source, const glm::quat& align = human::kNoTurn) {
    if (target != kNoJoint && source != kNoJoint) {
      OriginOf(target) = {source, source, 0.0f, align};
    }
  }

  // Maps a chain of joints to a chain of any other length; both begin after `base`.
  void MapChain(const std::vector<JointIndex>& target,
                JointIndex base,
                const std::vector<JointIndex>& source) {
    if (base == kNoJoint) {
      return;
    }
    std::vector<JointIndex> way = {base};
    way.insert(way.end(), source.begin(), source.end());
    for (size_t i = 0; i < target.size(); ++i) {
      const float at = static_cast<float>(i + 1) / static_cast<float>(target.size()) *
                       static_cast<float>(way.size() - 1);
      const auto first = std::min(static_cast<size_t>(at), way.size() - 1);
      const auto second = std::min(first + 1, way.size() - 1);
      OriginOf(target[i]) = {way[first], way[second], at - static_cast<float>(first)};
    }
  }

  void MapTrunk() {
    origins_.assign(target_.size(), Origin());
    Map(target_body_.root, source_body_.root);
    MapChain(target_body_.spine, source_body_.root, source_body_.spine);
    MapChain(target_body_.neck, source_body_.chest(), source_body_.neck);
  }

  // The rotation that takes one bone at rest, rotated by `before`, to the direction of the
  // source's.
  glm::quat Align(const glm::quat& before,
                  JointIndex target_from,
                  JointIndex target_to,
                  JointIndex source_from,
                  JointIndex source_to) const {
    const glm::vec3 own = TargetRest(target_to) - TargetRest(target_from);
    const glm::vec3 other = SourceRest(source_to) - SourceRest(source_from);
    if (glm::length(own) < 1e-4f || glm::length(other) < 1e-4f) {
      return before;
    }
    return glm::normalize(human::Arc(before * glm::normalize(own), glm::normalize(other)) * before);
  }

  void MapArm(size_t side) {
    const BodyRig::Arm& own = target_body_.arms[side];
    const BodyRig::Arm& other = source_body_.arms[side];
    Map(own.clavicle, other.clavicle == kNoJoint ? source_body_.chest() : other.clavicle);
    if (!own.whole() || !other.whole()) {
      return;
    }
    const glm::quat upper =
        Align(human::kNoTurn, own.shoulder, own.elbow, other.shoulder, other.elbow);
    const glm::quat fore = Align(upper, own.elbow, own.wrist, other.elbow, other.wrist);
    const glm::quat hand = AlignHand(fore, side);
    Map(own.shoulder, other.shoulder, upper);
    Map(own.elbow, other.elbow, fore);
    Map(own.wrist, other.wrist, hand);
    MapFingers(hand, side);
  }

  // Aligns the hand by the knuckle of the middle finger if both have it.
  glm::quat AlignHand(const glm::quat& fore, size_t side) const {
    constexpr size_t kMiddleFinger = 2;
    const JointIndex own = target_body_.fingers[side][kMiddleFinger].joints[0];
    const JointIndex other = source_body_.fingers[side][kMiddleFinger].joints[0];
    return own == kNoJoint || other == kNoJoint ? fore
                                                : Align(fore, target_body_.arms[side].wrist, own,
                                                        source_body_.arms[side].wrist, other);
  }

  void MapFingers(const glm::quat& hand, size_t side) {
    for (size_t f = 0; f < BodyRig::kFingers; ++f) {
      const auto& own = target_body_.fingers[side][f].joints;
      const auto& other = source_body_.fingers[side][f].joints;
      glm::quat align = hand;
      for (size_t i = 0; i < own.size(); ++i) {
        if (own[i] == kNoJoint || other[i] == kNoJoint) {
          break;
        }
        if (i + 1 < own.size() && own[i + 1] != kNoJoint && other[i + 1] != kNoJoint) {
          align = Align(align, own[i], own[i + 1], other[i], other[i + 1]);
        }
        Map(own[i], other[i], align);
      }
    }
  }

  void MapLeg(size_t side) {
    const BodyRig::Leg& own = target_body_.legs[side];
    const BodyRig::Leg& other = source_body_.legs[side];
    const glm::quat thigh = Align(human::kNoTurn, own.hip, own.knee, other.hip, other.knee);
    const glm::quat shin = Align(thigh, own.knee, own.ankle, other.knee, other.ankle);
    const glm::quat foot = FlatFoot(side);
    Map(own.hip, other.hip, thigh);
    Map(own.knee, other.knee, shin);
    Map(own.ankle, other.ankle, foot);
    if (own.toes.size() == 1 && other.toes.size() == 1) {
      Map(own.toes[0], other.toes[0], foot);
    }
  }

  // The rotation that makes the foot level on average while heel and ball stand. The foot of
  // the source may be bound pointing down, or be tilted by the capture.
  glm::quat FlatFoot(size_t side) const {
    glm::vec3 up(0.0f);
    for (size_t key = 0; key < track_.size(); ++key) {
      if (contacts_[side].heel[key] && contacts_[side].ball[key]) {
        up += glm::conjugate(track_.feet[side].turn[key]) * glm::vec3(0.0f, 1.0f, 0.0f);
      }
    }
    if (!(glm::length(up) > 0.0f)) {
      return human::kNoTurn;
    }
    const glm::quat level = human::Arc(glm::vec3(0.0f, 1.0f, 0.0f), glm::normalize(up));
    return 2.0f * std::acos(std::min(std::abs(level.w), 1.0f)) < kMostFootTilt ? level
                                                                               : human::kNoTurn;
  }

  // Maps joints with equal names, such as tails, skirts and spears.
  void MapSame() {
    for (size_t joint = 0; joint < target_.size(); ++joint) {
      const auto other = source_.Find(target_.names[joint]);
      const bool known = origins_[joint].first != kNoJoint;
      if (!known && other && !IsBodyPart(static_cast<JointIndex>(joint))) {
        origins_[joint].first = origins_[joint].second = static_cast<JointIndex>(*other);
      }
    }
  }

  bool IsBodyPart(JointIndex joint) const {
    for (size_t side = 0; side < 2; ++side) {
      for (const BodyRig::Finger& finger : target_body_.fingers[side]) {
        if (std::find(finger.joints.begin(), finger.joints.end(), joint) != finger.joints.end()) {
          return true;
        }
      }
      const std::vector<JointIndex>& toes = target_body_.legs[side].toes;
      if (std::find(toes.begin(), toes.end(), joint) != toes.end()) {
        return true;
      }
    }
    return false;
  }

  // ---- Keys ----

  void FindContacts() {
    for (size_t side = 0; side < 2; ++side) {
      const FootTrack& foot = track_.feet[side];
      contacts_[side].heel = import::FindContacts(foot.ankle, track_.seconds_per_key);
      contacts_[side].ball = foot.ball.empty()
                                 ? contacts_[side].heel
                                 : import::FindContacts(foot.ball, track_.seconds_per_key);
    }
    const float right = LowHeight(track_.feet[0].ankle), left = LowHeight(track_.feet[1].ankle);
    source_ankle_ = std::min(right, left);
  }

  // Rotation of a joint of the source from rest, in actor axes.
  glm::quat SourceTurn(const JointFrames& frames, JointIndex joint) const {
    return frames.rotations[Index(joint)] *
           glm::conjugate(source_body_.rest[Index(joint)].rotation);
  }

  void AddKey(size_t key, const JointFrames& frames, human::Clip& result) const {
    std::vector<JointTransform> pose = target_.rest;
    std::vector<glm::quat> rotations(target_.size());
    for (size_t joint = 0; joint < target_.size(); ++joint) {
      const Origin& origin = origins_[joint];
      const int16_t parent = target_.parents[joint];
      const glm::quat above =
          parent == Skeleton::kNoParent ? human::kNoTurn : rotations[static_cast<size_t>(parent)];
      if (origin.first == kNoJoint) {
        rotations[joint] = above * target_.rest[joint].rotation;
        continue;
      }
      const glm::quat turn = glm::slerp(SourceTurn(frames, origin.first),
                                        SourceTurn(frames, origin.second), origin.share);
      rotations[joint] = glm::normalize(turn * origin.align * target_body_.rest[joint].rotation);
      pose[joint].rotation = glm::normalize(glm::conjugate(above) * rotations[joint]);
    }
    PlaceHips(frames, pose);
    result.keys.insert(result.keys.end(), pose.begin(), pose.end());
    CHECK(result.keys.size() == (key + 1) * target_.size());
  }

  static glm::vec3 MiddleOfHips(const BodyRig& body, const JointFrames& frames) {
    return 0.5f *
           (frames.positions[Index(body.legs[0].hip)] + frames.positions[Index(body.legs[1].hip)]);
  }

  static float LegLength(const BodyRig& body) {
    float length = 0.0f;
    for (const BodyRig::Leg& leg : body.legs) {
      length += 0.5f * (leg.upper_length + leg.lower_length);
    }
    return length;
  }

  // Moves the root so that the hip joints have the same position above the standing ankles as
  // in the source, scaled by the length of the legs.
  void PlaceHips(const JointFrames& source_frames, std::vector<JointTransform>& pose) const {
    JointFrames frames;
    ComputeFrames(target_, pose, frames);
    const float scale = LegLength(target_body_) / LegLength(source_body_);
    const float own_ankle =
        0.5f * (target_body_.legs[0].ankle_height + target_body_.legs[1].ankle_height);
    glm::vec3 goal =
        scale * (MiddleOfHips(source_body_, source_frames) - glm::vec3(0.0f, source_ankle_, 0.0f));
    goal.y += own_ankle;
    const glm::vec3 move = goal - MiddleOfHips(target_body_, frames);
    const int16_t parent = target_.parents[Index(target_body_.root)];
    const human::JointFrame above = human::ActorFromJoint(target_, pose, parent);
    pose[Index(target_body_.root)].translation +=
        glm::conjugate(above.rotation) * move / above.scale;
  }

  const Skeleton& source_;
  const human::Clip& clip_;
  const Skeleton& target_;
  BodyRig source_body_, target_body_;
  BodyTrack track_;
  std::array<FootContacts, 2> contacts_;
  float source_ankle_ = 0.0f;  // Height of a standing ankle.
  std::vector<Origin> origins_;
};

// The keys from one time to another.
Result<human::Clip> ClipPart(const human::Clip& clip,
                             size_t joints,
                             const RetargetOptions& options,
                             const std::string& where) {
  const size_t keys = clip.KeyCount(joints);
  const float from = std::max(options.from, 0.0f), to = std::min(options.to, clip.duration);
  if (!(to >= from)) {
    return Status::Error(where, "the requested part of it is empty",
                         "it lasts " + std::to_string(clip.duration) + " s");
  }
  const auto first =
      std::min(keys - 1, static_cast<size_t>(std::lround(from * clip.keys_per_second)));
  const auto last = std::min(keys - 1, static_cast<size_t>(std::lround(to * clip.keys_per_second)));
  human::Clip part = clip;
  part.keys.assign(clip.keys.begin() + static_cast<std::ptrdiff_t>(first * joints),
                   clip.keys.begin() + static_cast<std::ptrdiff_t>((last + 1) * joints));
  part.duration = static_cast<float>(last - first) / clip.keys_per_second;
  return part;
}

}  // namespace

Result<human::Clip> Retarget(const Skeleton& source,
                             const human::Clip& clip,
                             const Skeleton& target,
                             const RetargetOptions& options) {
  const std::string place = "clip '" + clip.name + "'";
  LARARIUM_RETURN_IF_ERROR(clip.Validate(source.size(), place));
  LARARIUM_ASSIGN_OR_RETURN(const human::Clip part, ClipPart(clip, source.size(), options, place));
  Retargeter retargeter(source, part, target);
  LARARIUM_RETURN_IF_ERROR(retargeter.Check(place));
  human::Clip result = retargeter.Run(options.lock_feet);
  result.name = options.name.empty() ? clip.name : options.name;
  if (options.take_root) {
    TakeRootMotion(target, result);
  }
  if (options.loop) {
    const auto cycle = FindCycle(target, result);
    if (!cycle) {
      return Status::Error(place, "no part of it can be repeated: no two poses are alike",
                           "take it without looping, or choose another clip");
    }
    CutLoop(target, cycle->first, cycle->second, result);
  }
  LARARIUM_RETURN_IF_ERROR(result.Validate(target.size(), place));
  return result;
}

}  // namespace lararium::import
