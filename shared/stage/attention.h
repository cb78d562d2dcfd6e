#pragma once

// Chooses what actors look at when the drama does not say: the object that they use, the actor who
// speaks, each other or the visitor. Internal to shared/stage.

#include "shared/stage/tasks.h"
#include "shared/stage/world.h"

namespace lararium::stage {

// Sets the gaze target of each visible actor for one tick.
void DirectAttention(World& world, const Tasks& tasks, float seconds);

}  // namespace lararium::stage
