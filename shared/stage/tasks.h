#pragma once

// Queue of the tasks of actors: walk, use, take, put, give. A task waits until everything it needs
// is free and then reserves it all at once. A waiting task holds nothing, so there can be no
// deadlock. Tickets are served in order: a task waits while an earlier waiting task shares a person
// or an object with it.

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"
#include "shared/stage/object.h"
#include "shared/stage/sync_point.h"

namespace lararium::stage {

struct World;

using TaskId = uint64_t;  // Number of the ticket, never reused; 0: none.

struct TaskReport {
  enum class State : uint8_t {
    kUnknown,  // Never created, or forgotten.
    kWaiting,
    kRunning,
    kDone,
    kFailed,
  };
  State state = State::kUnknown;
  // For the author of the drama: why the task failed, or how the result differs from the request.
  std::string_view message;
  std::optional<SyncPoint> reached;  // The latest point that was reached; none: the task waits.
  float waited = 0.0f;               // Seconds in state kWaiting.

  bool over() const { return state == State::kDone || state == State::kFailed; }
};

// Where to put an object down.
struct PutTarget {
  ObjectId object;                    // Zero: on the floor, at `place`.
  int surface = -1;                   // Index into ObjectUse::surfaces; -1: any.
  glm::vec2 place = glm::vec2(0.0f);  // (x, z), stage frame, metres.
  std::optional<float> heading;       // Heading of the object on the floor; none: as carried.
};

class Tasks {
 public:
  static constexpr size_t kMaxTasks = 256;  // Limit of tasks that are not over.

  // Borrows world.
  explicit Tasks(World& world) : world_(world) { tasks_.reserve(2 * kMaxTasks); }

  // Each call appends a task to the queue of an actor. It returns an error only if the task can
  // never succeed: the actor is led by a track, the object has no such action. Obstacles that
  // appear when its turn comes are reported by report().
  //
  // speed: m/s; 0: a comfortable speed.
  Result<TaskId> Walk(ActorId actor, glm::vec2 goal, std::optional<float> heading, float speed);
  // speed: rad/s; 0: a natural speed.
  Result<TaskId> Turn(ActorId actor, float heading, float speed);
  // seconds: minimum duration of the action.
  Result<TaskId> Use(ActorId actor, ObjectId object, std::string_view action, float seconds);
  Result<TaskId> Take(ActorId actor, ObjectId object);
  Result<TaskId> Put(ActorId actor, ObjectId object, const PutTarget& target);
  Result<TaskId> Give(ActorId actor, ObjectId object, ActorId to);
  // The actor gets up if it sits.
  Result<TaskId> Stand(ActorId actor);

  TaskReport report(TaskId id) const;
  // Ends a task where it is; hands let go of objects that they do not hold. Ignores stale ids.
  void Stop(TaskId id);
  // Stops all tasks of an actor, and it no longer sits. `why` becomes the message of the tasks.
  void StopAll(ActorId actor, std::string_view why);
  // Drops the report of a task that is over.
  void Forget(TaskId id);

  // Whether a task of the actor is running, whether the actor sits, and which object it handles.
  bool IsBusy(ActorId actor) const;
  bool Sits(ActorId actor) const;
  std::optional<ObjectId> ObjectOf(ActorId actor) const;

  // Whether any task is waiting or running.
  bool any() const;
  void FailAll(std::string_view why);
  // One tick.
  void Advance(float seconds);
  void Reset();

  // The complete state, to return to later.
  struct State;
  std::shared_ptr<const State> Save() const;
  void Restore(const State& state);

 private:
  enum class Kind : uint8_t { kWalk, kUse, kTake, kPut, kGive };
  enum class Stage : uint8_t { kWaiting, kRunning, kLingering, kDone, kFailed };
  enum class Phase : uint8_t {
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
  struct Task {
    TaskId id = 0;
    Kind kind = Kind::kWalk;
    Stage stage = Stage::kWaiting;
    Phase phase = Phase::kApproach;
    bool is_over = false;  // Result of report(); `stage` may still be kLingering.
    // The request.
    ActorId actor;
    ActorId partner;                   // kGive: the receiver.
    ObjectId object;                   // The object to use, take, put or give.
    int action = -1;                   // kUse: index into ObjectUse::actions.
    PutTarget target;                  // kPut.
    glm::vec2 goal = glm::vec2(0.0f);  // kWalk: (x, z), stage frame, metres.
    std::optional<float> heading;      // kWalk: final heading, radians.
    float speed = 0.0f;                // m/s, or rad/s if `only_turns`; 0: the default.
    bool only_turns = false;
    float seconds = 0.0f;  // kUse: minimum duration of the action.

    // The progress.
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

  Result<TaskId> Begin(Task task);
  Status CheckActor(ActorId actor) const;
  const Task* Find(TaskId id) const;
  Task* SeatOf(ActorId actor);
  // Whether an actor who sits can do the task without getting up.
  bool IsDoneSitting(const Task& task) const;
  SyncPoint PointOf(const Task& task) const;
  bool IsSpotFor(const Task& task, int surface, int spot) const;
  bool CanReachSitting(ActorId actor, const glm::vec3& point) const;
  // Makes the actor get up if it sits and the task needs that. True: the task has to wait for it.
  bool GetsUpFor(const Task& task);

  // ---- scheduling and reservations (task_schedule.cc, task_reservations.cc) ----
  void ScheduleReservations();
  bool SharesWith(const Task& a, const Task& b) const;
  bool MustWaitFor(const Task& task, const Task& other) const;
  bool IsFirstOf(const Task& task) const;
  // Reserves what the task needs and starts it; false: not possible yet. Impossible tasks fail.
  bool Reserve(Task& task);
  bool ReserveUse(Task& task);
  bool ReserveTake(Task& task);
  bool ReservePut(Task& task);
  bool ReserveGive(Task& task);
  bool Approach(Task& task, glm::vec2 goal, std::optional<float> heading);
  bool ApproachNear(Task& task, const glm::vec3& point, std::optional<float> facing);
  bool ApproachPlaceOf(Task& task, ObjectId object, int place);
  void WaitInLine(Task& task, float seconds);
  void MakeWay(const Task& task);
  int UsersOf(ObjectId object, const Task& except) const;
  bool IsPlaceTaken(ObjectId object, int place, const Task& except) const;

  // ---- execution (task_steps.cc) ----
  void Step(Task& task, float seconds);
  void Enter(Task& task, Phase phase);
  void Arrive(Task& task);
  void StepAct(Task& task, float seconds);
  void BeginAct(Task& task);
  bool MayMove(Task& task, float seconds);
  void MoveJoints(const Task& task, Object& object) const;
  void FollowPath(const Task& task, Object& object);
  const Actor* InTheWay(const Task& task);
  void BeginSeat(Task& task);
  void StepSeat(Task& task);
  void StepReach(Task& task);
  Pose PutGoal(const Task& task) const;
  void StepPut(Task& task);
  void StepGive(Task& task, float seconds);
  void EndAction(Task& task);
  void Finish(Task& task, std::string message = {});
  void Fail(Task& task, std::string message);
  void Abandon(Task& task);

  World& world_;
  std::vector<Task> tasks_;  // Sorted by id.
  TaskId last_ = 0;
};

}  // namespace lararium::stage
