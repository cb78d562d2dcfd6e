#pragma once

// Execution of a running task, phase by phase. Internal to shared/stage.

#include "shared/stage/task_queue.h"

namespace lararium::stage {

struct Actor;
struct World;

class TaskSteps {
 public:
  // Borrows both.
  TaskSteps(World& world, const TaskQueue& queue) : world_(world), queue_(queue) {}

  // One tick; Task::time already includes it.
  void Step(Task& task, float seconds);
  void Enter(Task& task, TaskPhase phase);
  // The actor has reached the place where the task is done.
  void Arrive(Task& task);
  // Stops a running task and leaves actors and objects in a plausible state.
  void Abandon(Task& task);

 private:
  void StepAct(Task& task, float seconds);
  void BeginAct(Task& task);
  bool MayMove(Task& task, float seconds);
  void FollowPath(const Task& task, Object& object);
  const Actor* InTheWay(const Task& task);
  void BeginSeat(Task& task);
  void StepSeat(Task& task);
  void StepReach(Task& task);
  Pose PutGoal(const Task& task) const;
  void StepPut(Task& task);
  void StepGive(Task& task, float seconds);
  void EndAction(const Task& task);

  World& world_;
  const TaskQueue& queue_;
};

}  // namespace lararium::stage
