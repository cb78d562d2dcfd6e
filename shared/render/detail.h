#pragma once

// Chooses the level of detail of each person: the coarsest one whose error stays invisible, and a
// coarser one if the picture would exceed its triangle budget.

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/human/human.h"

namespace lararium::render {

// Size on screen, in pixels, of one metre at a point of the stage, measured across the viewing
// direction. Points nearer than 0.5 m count as 0.5 m away.
float PixelsPerMetre(const geometry::CameraModel& display,
                     const geometry::Rigid3& camera_from_stage,
                     const glm::vec3& point_in_stage);

// True if a ball may be visible: it overlaps the picture and reaches in front of the viewer.
bool MaySee(const geometry::CameraModel& display,
            const geometry::Rigid3& camera_from_stage,
            const glm::vec3& centre_in_stage,
            float radius);

// A level of detail of one mesh.
struct MeshLevel {
  // Metres from the finest level, multiplied by human::ErrorShare of the mesh's surface.
  float error = 0.0f;
  size_t triangles = 0;
  // This level and all coarser ones use only the first `vertices` vertices of the mesh.
  // import::OrderVertices stores the vertices of coarser levels first.
  size_t vertices = 0;
};
// The levels of one mesh of a person, finest first. mesh: index into Human::meshes.
std::vector<MeshLevel> FindMeshLevels(const human::Human& human, size_t mesh);

// Returns the coarsest of levels (ordered finest first) whose error is at most allowed_error,
// metres; the finest if there is none.
template <typename Level>
const Level& LevelAllowed(const std::vector<Level>& levels, float allowed_error) {
  const Level* drawn = &levels.front();
  for (const Level& level : levels) {
    drawn = level.error <= allowed_error ? &level : drawn;
  }
  return *drawn;
}

// Number of triangles for each allowed error, summed over a person's meshes. FindDetailLevels
// returns ascending errors and descending triangle counts; the first entry is the finest.
struct DetailLevel {
  float error = 0.0f;  // metres from the finest level
  size_t triangles = 0;
};
std::vector<DetailLevel> FindDetailLevels(const human::Human& human);

struct DetailOptions {
  float tolerance_px = 0.5f;         // largest error that stays invisible
  size_t triangle_budget = 300'000;  // sum over all people
  // Hysteresis: an allowed error is kept until it would change by more than this share, so that
  // people do not flicker between two levels.
  float slack = 0.3f;
};

// One person in a picture.
struct DetailRequest {
  std::span<const DetailLevel> levels;
  // 0: the person is not visible and costs no triangles.
  float pixels_per_metre = 0.0f;
  // Input and output: error allowed at this distance, metres. The caller keeps it from picture to
  // picture; 0 in the first.
  float allowed_error = 0.0f;
  // Output: value for SceneHuman::detail, metres.
  float detail = 0.0f;
};

// Chooses levels for one picture after another. It remembers how far the tolerance had to be
// raised to meet the triangle budget.
class DetailChooser {
 public:
  explicit DetailChooser(const DetailOptions& options = {}) : options_(options) {}

  // Takes effect with the next call of Choose.
  void SetOptions(const DetailOptions& options) { options_ = options; }
  void Choose(std::span<DetailRequest> requests);

 private:
  DetailOptions options_;
  float pressure_ = 1.0f;  // factor on DetailOptions::tolerance_px, at least 1
};

}  // namespace lararium::render
