#pragma once

// From where and how a picture is seen. Private to render.

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "shared/geometry/camera_model.h"
#include "shared/render/render_scene.h"
#include "shared/render/screen_bounds.h"

namespace lararium::render {

struct PictureView {
  ImageSize size;
  ImageSize most;                 // what images are allocated for: no view will be larger
  geometry::CameraModel display;  // scaled to size
  float near = 0.0f;              // metres
  float far = 0.0f;
  glm::mat4 clip_from_stage = glm::mat4(1.0f);
  glm::vec3 eye_in_stage = glm::vec3(0.0f);
  // From the eye through a point of the picture, one metre deep, stage axes: at its left
  // lower corner, and how it changes from one pixel to the next.
  glm::vec3 ray_at_corner = glm::vec3(0.0f);
  glm::vec3 ray_per_column = glm::vec3(0.0f);
  glm::vec3 ray_per_row = glm::vec3(0.0f);
};

// Without a pose only size and display are set.
PictureView ViewOf(const RenderScene& scene, const ImageSize& size, const ImageSize& most);

// For CameraLook: where a plane across the view, so far away, was seen one frame ago.
// Maps this picture's pixels to that one's, both from the corner of the bottom row.
glm::mat3 PreviousFromPixel(const RenderScene& scene, const PictureView& view, float depth);

}  // namespace lararium::render
