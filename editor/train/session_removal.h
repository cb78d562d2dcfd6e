#pragma once

// Removes a session from a map into which several sessions were merged.

#include <cstddef>
#include <cstdint>

#include "shared/core/status.h"
#include "shared/vision/scene_database.h"

namespace lararium::train {

struct RemovedSession {
  vision::SceneDatabase database;
  // Numbers of removed keyframes, observations and points.
  size_t keyframes = 0;
  size_t observations = 0;
  size_t points = 0;
};

// Removes the keyframes and observations of a session, the descriptors that belong to it alone, and
// the points that are left with fewer than two observations or without descriptors. The numbers of
// later sessions decrease by one. Frame and poses stay the same. Points that the session observed
// are triangulated again from the remaining observations. Counts, masks, normals and the mean error
// are computed again, and the forest is built again.
//
// The result equals the map before the session was added, with two exceptions: points that the
// budget removed at that time stay removed, and maps that were merged without
// SceneDatabase::descriptor_sessions keep all descriptors of the remaining points.
//
// Fails if the map has no such session, if it is the first one, which defines the map's camera and
// frame, or if nothing would be left.
Result<RemovedSession> RemoveSession(const vision::SceneDatabase& map,
                                     uint32_t session,
                                     uint64_t seed = 1);

}  // namespace lararium::train
