#pragma once

// Takes a session out of a map that several were merged into.

#include <cstddef>
#include <cstdint>

#include "shared/core/status.h"
#include "shared/vision/scene_database.h"

namespace lararium::train {

struct RemovedSession {
  vision::SceneDatabase database;
  size_t keyframes = 0;     // that went
  size_t observations = 0;  // likewise
  size_t points = 0;        // likewise
};

// The map without the keyframes and observations of a session, and without the points that
// fewer than two other observations show; later sessions move up by one. Frame, poses and places
// stay: what the session once moved a little is not moved back. What points look like stays too,
// for descriptors do not say whose they are. Counts, masks, directions and the mean error are
// those of what is left, and the forest is new.
// An error where the map has no such session, where it is the first, whose camera and frame are
// the map's, or where nothing would be left.
Result<RemovedSession> RemoveSession(const vision::SceneDatabase& map,
                                     uint32_t session,
                                     uint64_t seed = 1);

}  // namespace lararium::train
