#include "shared/stage/hands.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace lararium::stage {
namespace {

constexpr float kEyesOfCarrier = 1.58f;   // Eye height of a person 1.7 m tall, metres.
constexpr float kInHandPerSecond = 6.0f;  // Rate of ObjectState::in_hand, 1/s.
constexpr int kMaxPile = 8;               // Maximum height of a pile, in objects.
// Where the right hand of a person 1.7 m tall hangs, actor frame. The palm faces the body.
constexpr glm::vec3 kHangingHand = {0.24f, 0.78f, -0.03f};

human::GripFrame ToGripFrame(const Pose& pose) { return {pose.position, pose.rotation}; }

// actor_from_hand of a hand that hangs at the side, for a person 1.7 m tall.
Pose HangingHand(int side) {
  const float sign = human::SideSign(side);
  // Fingers down (-Z of the hand), the palm (-Y) towards the body.
  const glm::vec3 y = {sign, 0.0f, 0.0f};
  const glm::vec3 z = {0.0f, 1.0f, 0.0f};
  const glm::quat rotation = glm::quat_cast(glm::mat3(glm::cross(y, z), y, z));
  return {{sign * kHangingHand.x, kHangingHand.y, kHangingHand.z}, rotation};
}

Pose Mirrored(const Pose& pose) {
  return {{-pose.position.x, pose.position.y, pose.position.z},
          glm::quat(pose.rotation.w, pose.rotation.x, -pose.rotation.y, -pose.rotation.z)};
}

// Whether the object is carried with one hand, and that is not the hand of its carry pose.
bool IsMirrored(const HandGrips& hands, const HandGrips& written) {
  return (hands[human::kLeft] >= 0) != (written[human::kLeft] >= 0) &&
         (hands[human::kRight] >= 0) != (written[human::kRight] >= 0);
}

bool IsFull(const World& world, ActorId actor, ObjectId except, int side) {
  const ObjectId held = InHand(world, actor, side);
  return held && held != except;
}

void AdvanceHeld(World& world, Object& object, float seconds) {
  Actor* holder = world.actors.Find(object.state.holder);
  if (holder == nullptr) {
    PutAway(object);
    return;
  }
  object.held.time += seconds;
  object.state.stage_from_object = StageFromUpperBody(*holder) * object.held.now();
  MoveHands(*holder, object, object.state.hands);
  if (object.state.hand < 0) {
    return;
  }
  const bool hangs = !object.use().carry->holder_from_object;
  human::Reach& reach =
      holder->state.animation_state.reaches[static_cast<size_t>(object.state.hand)];
  const bool arrives = reach.to_weight > 0.0f && reach.time < reach.duration;
  const float step =
      (object.held.comes_loose || arrives ? -kInHandPerSecond : kInHandPerSecond) * seconds;
  object.state.in_hand = std::clamp(object.state.in_hand + step, 0.0f, 1.0f);
  if (hangs && object.held.rests && object.held.time >= object.held.duration &&
      reach.to_weight > 0.0f) {
    human::EndReach(reach, kLetGoSeconds);  // The hand swings freely now.
  }
}

// stage_from_object of an object that stands on others, computed from the lowest one up.
Pose SupportedPose(const World& world, const Object& object, int depth) {
  const Object* base = world.objects.Find(object.state.support.object);
  if (base == nullptr || depth == 0) {
    return object.state.stage_from_object;
  }
  return SupportedPose(world, *base, depth - 1) *
         ObjectFromSpot(*base->model, base->state.joints, object.state.support.surface,
                        object.state.support.spot, object.state.support.turn);
}

}  // namespace

human::GripFrame ActorFromGrip(const Actor& actor, const Object& object, int grip) {
  const Pose actor_from_object =
      StageFromActorPose(actor.state).Inverse() * object.state.stage_from_object;
  return ToGripFrame(actor_from_object * ObjectFromGrip(*object.model, object.state.joints, grip));
}

ObjectId InHand(const World& world, ActorId actor, int side) {
  for (const ObjectId id : world.object_ids) {
    const ObjectState& state = world.objects.Find(id)->state;
    if (state.holder == actor && state.hands[static_cast<size_t>(side)] >= 0) {
      return id;
    }
  }
  return {};
}

float ReachFor(Actor& actor, const Object& object, const HandGrips& hands) {
  float longest = 0.0f;
  for (const int side : {human::kRight, human::kLeft}) {
    const int grip = hands[static_cast<size_t>(side)];
    if (grip < 0) {
      continue;
    }
    const human::GripFrame goal = ActorFromGrip(actor, object, grip);
    const glm::vec3 hanging = ScaledTo(actor, HangingHand(side)).position;
    const float seconds = human::ReachSeconds(glm::distance(hanging, goal.position));
    auto& animation_state = actor.state.animation_state;
    human::StartReach(animation_state.reaches[static_cast<size_t>(side)], goal, seconds);
    human::SetHandPose(animation_state.hands[static_cast<size_t>(side)],
                       object.use().grips[static_cast<size_t>(grip)].hand_pose, seconds);
    longest = std::max(longest, seconds);
  }
  return longest;
}

void MoveHands(Actor& actor, const Object& object, const HandGrips& hands, const Pose& offset) {
  for (size_t side = 0; side < 2; ++side) {
    human::Reach& reach = actor.state.animation_state.reaches[side];
    if (hands[side] < 0 || reach.to_weight <= 0.0f) {
      continue;
    }
    const Pose stage_from_object = object.state.stage_from_object;
    Pose shifted = ObjectFromGrip(*object.model, object.state.joints, hands[side]);
    shifted.position += offset.position;
    shifted.rotation = glm::normalize(offset.rotation * shifted.rotation);
    human::MoveGrip(reach, ToGripFrame(StageFromActorPose(actor.state).Inverse() *
                                       stage_from_object * shifted));
  }
}

void LetGo(Actor& actor, const HandGrips& hands) {
  for (size_t side = 0; side < 2; ++side) {
    if (hands[side] >= 0) {
      human::EndReach(actor.state.animation_state.reaches[side], kLetGoSeconds);
      human::SetHandPose(actor.state.animation_state.hands[side], human::HandPose::kRelaxed,
                         kLetGoSeconds);
    }
  }
}

std::optional<HandGrips> ChooseHands(const World& world,
                                     ActorId actor,
                                     ObjectId object,
                                     const HandGrips& wanted) {
  std::array<bool, 2> full;
  for (const int side : {human::kRight, human::kLeft}) {
    full[static_cast<size_t>(side)] = IsFull(world, actor, object, side);
  }
  const auto possible = [&](const HandGrips& hands) {
    return !(hands[0] >= 0 && full[0]) && !(hands[1] >= 0 && full[1]);
  };
  if (possible(wanted)) {
    return wanted;
  }
  const HandGrips swapped = {wanted[1], wanted[0]};
  const std::vector<Grip>& grips = world.objects.Find(object)->use().grips;
  for (size_t side = 0; side < 2; ++side) {
    if (swapped[side] >= 0 && !grips[static_cast<size_t>(swapped[side])].fits[side]) {
      return std::nullopt;
    }
  }
  return possible(swapped) ? std::optional(swapped) : std::nullopt;
}

std::optional<HandGrips> ChooseReceivingHands(const World& world,
                                              ActorId actor,
                                              ObjectId object,
                                              const Pose& actor_from_object) {
  const Object& of = *world.objects.Find(object);
  const HandGrips& carried = of.use().carry->hands;
  if (carried[0] >= 0 && carried[1] >= 0) {
    return ChooseHands(world, actor, object, carried);
  }
  std::optional<HandGrips> best;
  float best_ease = -10.0f;
  for (size_t grip = 0; grip < of.use().grips.size(); ++grip) {
    const Pose hand =
        actor_from_object * ObjectFromGrip(*of.model, of.state.joints, static_cast<int>(grip));
    const glm::vec3 fingers = hand.rotation * glm::vec3(0.0f, 0.0f, -1.0f);
    for (const int side : {human::kRight, human::kLeft}) {
      const auto s = static_cast<size_t>(side);
      if (!of.use().grips[grip].fits[s] || IsFull(world, actor, {}, side)) {
        continue;
      }
      const bool is_other = static_cast<int>(grip) != of.state.hands[0] &&
                            static_cast<int>(grip) != of.state.hands[1];
      // Fingers that point forward and across the body are comfortable. A grip that the giver does
      // not use is better.
      const float ease = -fingers.z - 0.3f * human::SideSign(side) * fingers.x +
                         (is_other ? 1.0f : 0.0f) + (side == human::kRight ? 0.2f : 0.0f);
      if (ease > best_ease) {
        best_ease = ease;
        best = kNoHands;
        (*best)[s] = static_cast<int>(grip);
      }
    }
  }
  return best;
}

Pose ScaledTo(const Actor& actor, Pose pose) {
  pose.position *= actor.eye_height() / kEyesOfCarrier;
  return pose;
}

Pose CarryPose(const Actor& actor, const Object& object, const HandGrips& hands) {
  const Carry& carry = *object.use().carry;
  if (carry.holder_from_object) {
    const Pose& pose = *carry.holder_from_object;
    return ScaledTo(actor, IsMirrored(hands, carry.hands) ? Mirrored(pose) : pose);
  }
  const int side = hands[human::kRight] >= 0 ? human::kRight : human::kLeft;
  return ScaledTo(actor, HangingHand(side)) *
         ObjectFromGrip(*object.model, object.state.joints, hands[static_cast<size_t>(side)])
             .Inverse();
}

float HeadingOf(const glm::quat& rotation) {
  const glm::vec3 forward = rotation * glm::vec3(0.0f, 0.0f, -1.0f);
  return HeadingOf(glm::vec2(forward.x, forward.z));
}

float CarriedTurn(const ObjectUse& use) {
  return use.carry && use.carry->holder_from_object
             ? HeadingOf(use.carry->holder_from_object->rotation)
             : 0.0f;
}

void TakeHold(World& world, ActorId actor, ObjectId id, const HandGrips& hands) {
  Object& object = world.object(id);
  ObjectState& state = object.state;
  const Pose here = StageFromUpperBody(world.actor(actor)).Inverse() * state.stage_from_object;
  object.held = {here, here, 0.0f, 0.0f};
  state.holder = actor;
  state.hands = hands;
  state.support = {};
  const bool both = hands[0] >= 0 && hands[1] >= 0;
  state.hand = static_cast<int8_t>(both                        ? -1
                                   : hands[human::kRight] >= 0 ? human::kRight
                                                               : human::kLeft);
  state.in_hand = 0.0f;
}

void MoveHeld(Object& object, const Pose& holder_from_object, float seconds) {
  object.held = {object.held.now(), holder_from_object, 0.0f, seconds};
}

void CarryAlong(const Actor& actor, Object& object, float seconds) {
  MoveHeld(object, CarryPose(actor, object, object.state.hands), seconds);
  object.held.rests = true;
}

void PutAway(Object& object) {
  object.state.holder = {};
  object.state.hands = kNoHands;
  object.state.hand = -1;
  object.state.in_hand = 0.0f;
}

void AdvanceObjects(World& world, float seconds) {
  for (const ObjectId id : world.object_ids) {
    Object& object = world.object(id);
    if (object.state.holder) {
      AdvanceHeld(world, object, seconds);
    }
  }
  for (const ObjectId id : world.object_ids) {
    Object& object = world.object(id);
    if (object.state.support.object) {
      object.state.stage_from_object = SupportedPose(world, object, kMaxPile);
    }
  }
}

bool IsOccupied(const World& world, ObjectId object, int surface, int spot) {
  return std::any_of(world.object_ids.begin(), world.object_ids.end(), [&](ObjectId id) {
    const Support& support = world.objects.Find(id)->state.support;
    return support.object == object && support.surface == surface && support.spot == spot;
  });
}

bool RestsOn(const World& world, ObjectId object, ObjectId base) {
  for (int i = 0; i <= kMaxPile; ++i) {
    if (object == base) {
      return true;
    }
    const Object* at = world.objects.Find(object);
    if (at == nullptr || !at->state.support.object) {
      return false;
    }
    object = at->state.support.object;
  }
  return true;  // The pile is too high: refuse.
}

}  // namespace lararium::stage
