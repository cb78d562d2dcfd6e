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

// The map without the keyframes and observations of a session, without what points look like in
// it alone, and without the points that fewer than two other observations show or that look like
// nothing else; later sessions move up by one. Frame and poses stay. Points that the session saw
// are located anew by the sights that stay; counts, masks, directions and the mean error are those
// of what is left, and the forest is new. So the map is as it was before the session was added,
// but for points that the budget took away when it was, and for maps that were merged before
// descriptors said whose they are (SceneDatabase::descriptor_sessions): what the points that stay
// look like stays whole in these.
// An error where the map has no such session, where it is the first, whose camera and frame are
// the map's, or where nothing would be left.
Result<RemovedSession> RemoveSession(const vision::SceneDatabase& map,
                                     uint32_t session,
                                     uint64_t seed = 1);

}  // namespace lararium::train
