#pragma once

// What hands do with objects. Private to the room.

#include "shared/stage/world.h"

namespace lararium::stage {

// Begin to bring hands to their grips; the seconds that the slower one takes. MoveHands
// follows the grips as they move; a pose that the hands' way is shifted by: offset, in
// the object's frame.
float ReachFor(Actor& actor, const Object& object, const HandGrips& hands);
void MoveHands(Actor& actor, const Object& object, const HandGrips& hands, const Pose& offset = {});
// Let go; the hands come back to the body.
void LetGo(Actor& actor, const HandGrips& hands);
inline constexpr float kLetGoSeconds = 0.5f;

// The hands for a purpose, from what the object says: the other one where the one
// named is full and the grip fits both. None: they are full (of anything but object).
std::optional<HandGrips> ChooseHands(const World& world,
                                     ActorId actor,
                                     ObjectId object,
                                     const HandGrips& wanted);
// For somebody who is handed the object at a pose in its frame.
std::optional<HandGrips> ChooseReceivingHands(const World& world,
                                              ActorId actor,
                                              ObjectId object,
                                              const Pose& actor_from_object);

// Where an actor carries an object with these hands, in the frame of its upper body.
Pose CarryPose(const Actor& actor, const Object& object, const HandGrips& hands);
// How an object lies to whoever carries it, about +Y, radians: who takes it or puts it
// down with this turn against the own heading need not twist the hands.
float CarriedTurn(const ObjectUse& use);
// Where something looks that has a pose, about +Y.
float HeadingOf(const glm::quat& rotation);
// Of somebody 1.7 m tall to this actor.
Pose ScaledTo(const Actor& actor, Pose pose);

// The object is in somebody's hands from now on, where it is.
void TakeHold(World& world, ActorId actor, ObjectId object, const HandGrips& hands);
// The object goes to another pose in its holder's frame.
void MoveHeld(Object& object, const Pose& holder_from_object, float seconds);
// It goes to where its holder carries it.
void CarryAlong(const Actor& actor, Object& object, float seconds);
// It is in nobody's hands.
void PutAway(Object& object);

// One tick of everything that is held, or stands on something: where it is, and the
// hands on it.
void AdvanceObjects(World& world, float seconds);

// The spot is taken by an object that stands there.
bool IsOccupied(const World& world, ObjectId object, int surface, int spot);
// Whether object stands, over however many others, on base; or is base.
bool RestsOn(const World& world, ObjectId object, ObjectId base);

}  // namespace lararium::stage
