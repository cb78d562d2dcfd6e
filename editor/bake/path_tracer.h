#pragma once

// Reference images by path tracing (Kajiya, SIGGRAPH 1986): matte surfaces under a
// probe's light, nothing approximated but by noise. What the player draws is compared
// with them.

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "editor/bake/environment.h"
#include "editor/bake/posed_surface.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"

namespace lararium::bake {

struct PathTracing {
  int samples = 256;  // of each pixel
  // Reflections between surfaces before the light is reached; 0: only direct light.
  int bounces = 4;
  uint64_t seed = 1;
  // Meshes from here on are real surfaces: they take part in the light, but what the camera
  // sees of them is kept apart.
  size_t first_real = std::numeric_limits<size_t>::max();
};

// Linear radiance times coverage, and coverage: row by row from the top left.
struct RadianceImage {
  int width = 0;
  int height = 0;
  std::vector<glm::vec4> pixels;
  std::vector<glm::vec4> real;  // likewise of real surfaces; empty where there are none
};

// The meshes (stage axes) as an ideal pinhole sees them; a pixel is the mean over its
// square. Lambert's reflection; a normal between the corners of a triangle is
// interpolated, and no light comes from below the triangle itself. Direct light is
// sampled from the probe and from the surface, weighed by the power heuristic (Veach &
// Guibas, SIGGRAPH 1995). The same seed gives the same image, whatever the number of cores.
Result<RadianceImage> TracePaths(std::span<const SurfaceMesh> meshes,
                                 const Environment& environment,
                                 const geometry::CameraModel& pinhole,
                                 const geometry::Rigid3& camera_from_stage,
                                 const PathTracing& tracing,
                                 Progress& progress);

}  // namespace lararium::bake
