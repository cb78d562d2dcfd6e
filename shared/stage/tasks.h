#pragma once

// What actors are asked to do with their bodies, one thing after another: walk, use,
// take, put, give. A task waits until all that it needs is free, and then has all of
// it at once; who waits has nothing, so that nobody can wait for each other in a
// circle. Tickets are served in their order: a task that shares a person or an object
// with an earlier one that waits, waits too.

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

using TaskId = uint64_t;  // the ticket's number; never used twice; 0 names nothing

struct TaskReport {
  enum class State : uint8_t {
    kUnknown,  // never begun, or forgotten
    kWaiting,  // for its turn
    kRunning,
    kDone,
    kFailed,
  };
  State state = State::kUnknown;
  // Why it failed; of a done one, what was not quite as asked. For the drama's author.
  std::string_view message;
  std::optional<SyncPoint> reached;  // the last of its points so far; none: it waits
  float waited = 0.0f;               // seconds until it was its turn

  bool over() const { return state == State::kDone || state == State::kFailed; }
};

// Where to put something down.
struct PutTarget {
  ObjectId object;                    // zero: on the floor, at place
  int surface = -1;                   // of the object; -1: any
  glm::vec2 place = glm::vec2(0.0f);  // (x, z), stage
  std::optional<float> heading;       // of what is put down there; none: as it is carried
};

class Tasks {
 public:
  static constexpr size_t kMaxTasks = 256;  // that are not over

  // Borrows world.
  explicit Tasks(World& world) : world_(world) { tasks_.reserve(2 * kMaxTasks); }

  // Each is an actor's next thing to do. They fail only at what can never be: the
  // actor is led by a track, the object has no such action; what stands in the way
  // when its turn comes is in the report.
  //
  // speed: m/s; 0: a comfortable one.
  Result<TaskId> Walk(ActorId actor, glm::vec2 goal, std::optional<float> heading, float speed);
  // speed: rad/s; 0: as people turn.
  Result<TaskId> Turn(ActorId actor, float heading, float speed);
  // seconds: that the action lasts at least.
  Result<TaskId> Use(ActorId actor, ObjectId object, std::string_view action, float seconds);
  Result<TaskId> Take(ActorId actor, ObjectId object);
  Result<TaskId> Put(ActorId actor, ObjectId object, const PutTarget& target);
  Result<TaskId> Give(ActorId actor, ObjectId object, ActorId to);
  // Gets up, if it sits.
  Result<TaskId> Stand(ActorId actor);

  TaskReport report(TaskId id) const;
  // Ends it where it is; hands let go of what they do not hold. A stale id is fine.
  void Stop(TaskId id);
  // Likewise with all of an actor, and it no longer sits.
  void StopAll(ActorId actor, std::string_view why);
  // Its report is not wanted any more.
  void Forget(TaskId id);

  // Whether the actor does or is about to do something, and with which object.
  bool IsBusy(ActorId actor) const;
  bool Sits(ActorId actor) const;
  std::optional<ObjectId> ObjectOf(ActorId actor) const;

  // Whether there is anything to do.
  bool any() const;
  void FailAll(std::string_view why);
  // One tick.
  void Advance(float seconds);
  void Reset();

  // All that it remembers.
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
    kBackUp,  // to where one sits down from
    kSit,
    kRise,
    kCarry,  // the object comes to where it is carried
    kOver,   // the object comes above its spot
    kLower,
    kOffer,  // the object comes between two people
    kBoth,   // both hold it
    kLetGo,
  };
  struct Task {
    TaskId id = 0;
    Kind kind = Kind::kWalk;
    Stage stage = Stage::kWaiting;
    Phase phase = Phase::kApproach;
    bool is_over = false;  // for whoever asked; it may linger
    // What was asked for.
    ActorId actor;
    ActorId partner;                   // who is given something
    ObjectId object;                   // that is used, taken, put or given
    int action = -1;                   // of the object
    PutTarget target;                  // of kPut
    glm::vec2 goal = glm::vec2(0.0f);  // of kWalk: (x, z), stage, metres
    std::optional<float> heading;      // there, radians
    float speed = 0.0f;                // m/s, rad/s where it only turns; 0: a comfortable one
    bool only_turns = false;
    float seconds = 0.0f;  // that the action lasts at least

    // How far it is.
    float time = 0.0f;                   // in the phase, seconds
    float waited = 0.0f;                 // for its turn, seconds
    ObjectId place_of;                   // the object at one of whose places it is done
    int place = -1;                      // which of them
    int spot = -1;                       // of the surface: where it is put
    HandGrips hands = kNoHands;          // of the actor
    HandGrips partner_hands = kNoHands;  // of who is given something
    float reach_seconds = 0.0f;  // that hands take to reach, or the way back to a seat takes
    float held_up = 0.0f;        // seconds that a moving part has waited for room
    std::array<float, ObjectUse::kMaxJoints> joints = {};  // when the action began
    Pose begin;                                            // of whatever moves in the phase
    Pose seat;                                             // stage frame, on its surface
    Pose stand;                                            // of the actor that sits down
    int clip_before = -1;                                  // that it played before
    std::string message;                                   // TaskReport::message
  };

  Result<TaskId> Begin(Task task);
  Status CheckActor(ActorId actor) const;
  const Task* Find(TaskId id) const;
  Task* SeatOf(ActorId actor);
  // Whether somebody who sits need not get up for it.
  bool IsDoneSitting(const Task& task) const;
  SyncPoint PointOf(const Task& task) const;
  bool IsSpotFor(const Task& task, int surface, int spot) const;
  bool CanReachSitting(ActorId actor, const glm::vec3& point) const;
  // Who sits gets up for what is not done sitting: whether somebody has to wait for that.
  bool GetsUpFor(const Task& task);

  // ---- whose turn it is, what it needs (task_turns.cc, task_grants.cc) ----
  void GrantTurns();
  bool SharesWith(const Task& a, const Task& b) const;
  bool MustWaitFor(const Task& task, const Task& other) const;
  bool IsFirstOf(const Task& task) const;
  // Reserves what the task chooses among and begins it; false: not yet. What is
  // impossible fails.
  bool Grant(Task& task);
  bool GrantUse(Task& task);
  bool GrantTake(Task& task);
  bool GrantPut(Task& task);
  bool GrantGive(Task& task);
  bool Approach(Task& task, glm::vec2 goal, std::optional<float> heading);
  bool ApproachNear(Task& task, const glm::vec3& point, std::optional<float> facing);
  bool ApproachPlaceOf(Task& task, ObjectId object, int place);
  void WaitInLine(Task& task, float seconds);
  void MakeWay(const Task& task);
  int UsersOf(ObjectId object, const Task& except) const;
  bool IsPlaceTaken(ObjectId object, int place, const Task& except) const;

  // ---- what it does (task_steps.cc) ----
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
  std::vector<Task> tasks_;  // in the order of their tickets
  TaskId last_ = 0;
};

}  // namespace lararium::stage
