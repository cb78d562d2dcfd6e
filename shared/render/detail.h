#pragma once

// How finely people are drawn: as coarse as cannot be seen, and coarser where the
// picture would hold too many triangles.

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/human/human.h"

namespace lararium::render {

// Pixels of a metre at a point of the stage, seen straight on; what is nearer than
// half a metre counts as there.
float PixelsPerMetre(const geometry::CameraModel& display,
                     const geometry::Rigid3& camera_from_stage,
                     const glm::vec3& point_in_stage);

// True when a ball may be seen: it reaches into the picture, and in front of the viewer.
bool MaySee(const geometry::CameraModel& display,
            const geometry::Rigid3& camera_from_stage,
            const glm::vec3& centre_in_stage,
            float radius);

// A level of detail of one mesh.
struct MeshLevel {
  float error = 0.0f;  // metres, from the full detail, times its surface's share
  size_t triangles = 0;
  // How many of the mesh's first vertices this and all coarser levels take. Files that
  // import::OrderVertices has been at have those of coarser levels first.
  size_t vertices = 0;
};
// The finest first, of one of a person's meshes.
std::vector<MeshLevel> FindMeshLevels(const human::Human& human, size_t mesh);

// Which of levels, the finest first, is drawn: the coarsest whose error is allowed, metres.
template <typename Level>
const Level& LevelAllowed(const std::vector<Level>& levels, float allowed_error) {
  const Level* drawn = &levels.front();
  for (const Level& level : levels) {
    drawn = level.error <= allowed_error ? &level : drawn;
  }
  return *drawn;
}

// What each allowed error costs, summed over a person's meshes: ascending errors,
// descending triangles. The first is the finest.
struct DetailLevel {
  float error = 0.0f;  // metres, from the finest
  size_t triangles = 0;
};
std::vector<DetailLevel> FindDetailLevels(const human::Human& human);

struct DetailOptions {
  float tolerance_px = 0.5f;         // error that cannot be seen
  size_t triangle_budget = 300'000;  // of all people together
  // An allowed error stays until it would change by this share, so that nobody flickers
  // between two levels.
  float slack = 0.3f;
};

// One person of a picture.
struct DetailRequest {
  std::span<const DetailLevel> levels;
  float pixels_per_metre = 0.0f;  // 0: not seen, and free
  // Kept from picture to picture, 0 in the first: the error allowed by distance, metres.
  float allowed_error = 0.0f;
  float detail = 0.0f;  // out: SceneHuman::detail
};

// Remembers from picture to picture how much the budget presses.
class DetailChooser {
 public:
  explicit DetailChooser(const DetailOptions& options = {}) : options_(options) {}

  // From the next choice on.
  void SetOptions(const DetailOptions& options) { options_ = options; }
  void Choose(std::span<DetailRequest> requests);

 private:
  DetailOptions options_;
  float pressure_ = 1.0f;  // tolerance is multiplied by it; at least 1
};

}  // namespace lararium::render
