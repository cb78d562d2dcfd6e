#pragma once

// Reservation of what a task needs to start: hands, a place, a spot and a path; the actor may have
// to get up first. Internal to shared/stage.

#include "shared/stage/task_steps.h"

namespace lararium::stage {

class TaskReservations {
 public:
  // Borrows all of them.
  TaskReservations(World& world, TaskQueue& queue, TaskSteps& steps)
      : world_(world), queue_(queue), steps_(steps) {}

  // Reserves what the task needs and starts it; false: not possible yet. Impossible tasks fail.
  bool Reserve(Task& task);
  // Makes the actor get up if it sits and the task needs that. True: the task has to wait for it.
  bool GetsUpFor(const TaskRequest& task);

 private:
  // Whether an actor who sits can do the task without getting up.
  bool IsDoneSitting(const TaskRequest& task) const;
  bool IsSpotFor(const TaskRequest& task, int surface, int spot) const;
  bool CanReachSitting(ActorId actor, const glm::vec3& point) const;
  bool ReserveUse(Task& task);
  bool ReserveTake(Task& task);
  bool ReservePut(Task& task);
  bool ReserveGive(Task& task);
  bool Approach(Task& task, glm::vec2 goal, std::optional<float> heading);
  bool ApproachNear(Task& task, const glm::vec3& point, std::optional<float> facing);
  bool ApproachPlaceOf(Task& task, ObjectId object, int place);

  World& world_;
  TaskQueue& queue_;
  TaskSteps& steps_;
};

}  // namespace lararium::stage
