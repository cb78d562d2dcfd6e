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
  ImageSize most;                 // what size would be in a layer as fine as the picture
  int margin = 0;                 // pixels of size, on each side, beyond what the picture shows
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

// size, most: without the margin. Without a pose only sizes and display are set.
PictureView ViewOf(const RenderScene& scene,
                   const ImageSize& size,
                   const ImageSize& most,
                   int margin = 0);

// Where a picture shows what an earlier view showed, on a plane across that view so far away.
// Maps the picture's pixels, rows from the top, to the view's, from the corner of its bottom row.
// display: the picture's, at its size. pose: of the camera that took the view.
glm::mat3 ViewFromPicture(const PictureView& view,
                          const geometry::Rigid3& pose,
                          float depth,
                          const geometry::CameraModel& display,
                          const geometry::Rigid3& camera_from_stage);

// For CameraLook: where a plane across the view, so far away, was seen one frame ago.
// Maps this picture's pixels to that one's, both from the corner of the bottom row.
glm::mat3 PreviousFromPixel(const RenderScene& scene, const PictureView& view, float depth);

}  // namespace lararium::render
