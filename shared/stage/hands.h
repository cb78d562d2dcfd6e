#pragma once

// Hands on objects: reaching, holding, carrying, letting go. Internal to shared/stage.

#include "shared/stage/world.h"

namespace lararium::stage {

// ReachFor starts to move the hands to their grips and returns the seconds that the slower hand
// takes. MoveHands keeps them at the grips while the object moves; `offset` shifts the hands
// relative to the grips, in the object frame.
float ReachFor(Actor& actor, const Object& object, const HandGrips& hands);
void MoveHands(Actor& actor, const Object& object, const HandGrips& hands, const Pose& offset = {});
// Lets go; the hands return to the body within kLetGoSeconds.
void LetGo(Actor& actor, const HandGrips& hands);
inline constexpr float kLetGoSeconds = 0.5f;

// Chooses the hands for an action from those that the object wants. Swaps right and left if a
// wanted hand is full and the grips fit the other one. None: too few hands are free; a hand that
// holds `object` itself counts as free.
std::optional<HandGrips> ChooseHands(const World& world,
                                     ActorId actor,
                                     ObjectId object,
                                     const HandGrips& wanted);
// Chooses the hands of an actor who receives the object at a pose in the actor frame.
std::optional<HandGrips> ChooseReceivingHands(const World& world,
                                              ActorId actor,
                                              ObjectId object,
                                              const Pose& actor_from_object);

// Pose in which an actor carries an object with these hands, in the frame of StageFromUpperBody.
Pose CarryPose(const Actor& actor, const Object& object, const HandGrips& hands);
// Heading of a carried object relative to its carrier, radians about +Y. An actor who takes it or
// puts it down with this relative heading need not twist the hands.
float CarriedTurn(const ObjectUse& use);
// Heading of a rotation, radians about +Y.
float HeadingOf(const glm::quat& rotation);
// Scales a pose of a person 1.7 m tall to this actor.
Pose ScaledTo(const Actor& actor, Pose pose);

// The actor holds the object from now on; the object does not move.
void TakeHold(World& world, ActorId actor, ObjectId object, const HandGrips& hands);
// Moves a held object to another pose in its holder's frame.
void MoveHeld(Object& object, const Pose& holder_from_object, float seconds);
// Moves a held object to its carrying pose.
void CarryAlong(const Actor& actor, Object& object, float seconds);
// Marks the object as held by no one.
void PutAway(Object& object);

// Advances all objects that are held or stand on others, and the hands on them, by one tick.
void AdvanceObjects(World& world, float seconds);

// Whether an object stands on the spot.
bool IsOccupied(const World& world, ObjectId object, int surface, int spot);
// Whether `object` is `base` or stands on it, directly or on a pile of objects.
bool RestsOn(const World& world, ObjectId object, ObjectId base);

}  // namespace lararium::stage
