#pragma once

// One task of an actor: what was requested and how far it got. Internal to shared/stage, except
// for TaskId and PutTarget.

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <utility>

#include "shared/stage/object.h"

namespace lararium::stage {

using TaskId = uint64_t;  // Number of the ticket, never reused; 0: none.

// Where to put an object down.
struct PutTarget {
  ObjectId object;                    // Zero: on the floor, at `place`.
  int surface = -1;                   // Index into ObjectUse::surfaces; -1: any.
  glm::vec2 place = glm::vec2(0.0f);  // (x, z), stage frame, metres.
  std::optional<float> heading;       // Heading of the object on the floor; none: as carried.
};

enum class TaskKind : uint8_t { kWalk, kUse, kTake, kPut, kGive };

// kLingering: the task is reported as done, but its actor still sits on the object.
enum class TaskStage : uint8_t { kWaiting, kRunning, kLingering, kDone, kFailed };

enum class TaskPhase : uint8_t {
  kApproach,
  kReach,
  kAct,
  kBackUp,  // The actor steps back to the point from which it sits down.
  kSit,
  kRise,
  kCarry,  // The object moves to its carrying pose.
  kOver,   // The object moves above its spot.
  kLower,
  kOffer,  // The object moves to a point between the two actors.
  kBoth,   // Both actors hold the object.
  kLetGo,
};

struct TaskRequest {
  TaskKind kind = TaskKind::kWalk;
  ActorId actor = {};
  ActorId partner = {};                         // kGive: the receiver.
  ObjectId object = {};                         // The object to use, take, put or give.
  int action = -1;                              // kUse: index into ObjectUse::actions.
  PutTarget target = {};                        // kPut; the surface is chosen when the task starts.
  glm::vec2 goal = glm::vec2(0.0f);             // kWalk: (x, z), stage frame, metres.
  std::optional<float> heading = std::nullopt;  // kWalk: final heading, radians.
  float speed = 0.0f;                           // m/s, or rad/s if `only_turns`; 0: the default.
  bool only_turns = false;
  float seconds = 0.0f;  // kUse: minimum duration of the action.
};

struct Task : TaskRequest {
  explicit Task(const TaskRequest& request) : TaskRequest(request) {}

  // Whether the task occupies the object and the place that it uses.
  bool OccupiesPlace() const {
    return stage == TaskStage::kRunning || stage == TaskStage::kLingering;
  }
  // Whether only the report of the task is left.
  bool HasEnded() const { return stage == TaskStage::kDone || stage == TaskStage::kFailed; }
  void Finish() {
    stage = TaskStage::kDone;
    is_over = true;
  }
  void Fail(std::string why) {
    stage = TaskStage::kFailed;
    is_over = true;
    message = std::move(why);
  }

  TaskId id = 0;
  TaskStage stage = TaskStage::kWaiting;
  TaskPhase phase = TaskPhase::kApproach;
  bool is_over = false;                // Result of report(); `stage` may still be kLingering.
  float time = 0.0f;                   // Seconds in the current phase.
  float waited = 0.0f;                 // Seconds in stage kWaiting.
  ObjectId place_of;                   // The object at whose approach place the task is done.
  int place = -1;                      // Index into ObjectUse::places of `place_of`.
  int spot = -1;                       // kPut: index into Surface::spots.
  HandGrips hands = kNoHands;          // Hands of the actor.
  HandGrips partner_hands = kNoHands;  // Hands of the receiver.
  float reach_seconds = 0.0f;          // Duration of kReach or kBackUp.
  float held_up = 0.0f;                // Seconds that a moving part has been blocked by an actor.
  std::array<float, ObjectUse::kMaxJoints> joints = {};  // Joint values at the start of kAct.
  Pose begin;            // kBackUp: pose of the actor at the start, stage frame.
  Pose seat;             // Point of the seat's surface where the actor sits, stage frame.
  Pose stand;            // Pose in which the actor stands to sit down, stage frame.
  int clip_before = -1;  // Clip of the actor before the action.
  std::string message;   // TaskReport::message
};

}  // namespace lararium::stage
