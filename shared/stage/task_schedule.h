#pragma once

// Which waiting task may start, and where actors stand meanwhile. Internal to shared/stage.

#include "shared/stage/task_queue.h"

namespace lararium::stage {

struct World;

// Whether no running task and no earlier waiting task needs what the waiting task needs.
bool MayStart(World& world, const TaskQueue& queue, const Task& task);
// The actor of a waiting task stands in line at an object with places.
void WaitInLine(World& world, const TaskQueue& queue, const Task& task);
// Idle actors step aside if they stand where the task's actor has to stand or where it is stuck.
void MakeWay(World& world, const TaskQueue& queue, const Task& task);

}  // namespace lararium::stage
