#pragma once

// Path-traced reference images (Kajiya, SIGGRAPH 1986): matte surfaces in the light of a probe,
// exact except for noise. The renderer of the player is compared with them.

#include <cstdint>
#include <limits>
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
  int samples = 256;  // Per pixel.
  // Reflections between surfaces before the path reaches the light; 0 gives direct light only.
  int bounces = 4;
  uint64_t seed = 1;
  // Index of the first mesh that is a real surface. Real surfaces take part in the light, but
  // the camera records them in `RadianceImage::real`.
  size_t first_real = std::numeric_limits<size_t>::max();
};

// Pixels hold linear radiance times coverage, then coverage, row by row from the top left.
struct RadianceImage {
  int width = 0;
  int height = 0;
  std::vector<glm::vec4> pixels;
  std::vector<glm::vec4> real;  // The same for the real surfaces; empty if there are none.
};

// Renders meshes in stage axes with an ideal pinhole camera; a pixel is the mean over its
// square. Reflection is Lambertian. Normals are interpolated between the corners of a triangle,
// and no light arrives from below the triangle itself. Direct light is sampled from the probe
// and from the surface, combined by the power heuristic (Veach & Guibas, SIGGRAPH 1995). The
// same seed gives the same image for any number of cores.
Result<RadianceImage> TracePaths(std::span<const SurfaceMesh> meshes,
                                 const Environment& environment,
                                 const geometry::CameraModel& pinhole,
                                 const geometry::Rigid3& camera_from_stage,
                                 const PathTracing& tracing,
                                 Progress& progress);

}  // namespace lararium::bake
