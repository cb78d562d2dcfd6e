#pragma once

// What people look at when nobody tells them: what they use, who speaks, each other,
// the visitor. Private to the room.

#include "shared/stage/tasks.h"
#include "shared/stage/world.h"

namespace lararium::stage {

// One tick: sets what the gaze of each visible actor is to look at.
void DirectAttention(World& world, const Tasks& tasks, float seconds);

}  // namespace lararium::stage
