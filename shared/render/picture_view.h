#pragma once

// Size, camera and viewing rays of a picture that is drawn. Private to render.

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "shared/geometry/camera_model.h"
#include "shared/render/passes/screen_bounds.h"
#include "shared/render/render_scene.h"

namespace lararium::render {

struct PictureView {
  ImageSize size;
  ImageSize most;                 // the size of this layer at the picture's full resolution
  int margin = 0;                 // pixels of size, on each side, outside the picture
  geometry::CameraModel display;  // scaled to size
  float near = 0.0f;              // metres
  float far = 0.0f;
  glm::mat4 clip_from_stage = glm::mat4(1.0f);
  glm::vec3 eye_in_stage = glm::vec3(0.0f);
  // Ray from the eye to a point of the picture at a depth of one metre, stage axes: the ray at the
  // lower left corner, and its change per pixel.
  glm::vec3 ray_at_corner = glm::vec3(0.0f);
  glm::vec3 ray_per_column = glm::vec3(0.0f);
  glm::vec3 ray_per_row = glm::vec3(0.0f);
};

// size and most are without the margin. If the scene has no pose, only sizes and display are set.
PictureView ViewOf(const RenderScene& scene,
                   const ImageSize& size,
                   const ImageSize& most,
                   int margin = 0);

// Homography from a picture to an earlier view, for points on a plane across that view at a depth
// in metres. It maps pixels of the picture, with rows counted from the top, to pixels of the view,
// counted from the corner of its bottom row. display: camera of the picture, at its size. pose:
// camera_from_stage of the view.
glm::mat3 ViewFromPicture(const PictureView& view,
                          const geometry::Rigid3& pose,
                          float depth,
                          const geometry::CameraModel& display,
                          const geometry::Rigid3& camera_from_stage);

// Homography from this picture to the one that the camera saw from an earlier pose, for points on a
// plane across the view at a depth in metres. Pixels of both are counted from the corner of the
// bottom row.
glm::mat3 PreviousFromPixel(const geometry::Rigid3& previous_from_now,
                            const PictureView& view,
                            float depth);

}  // namespace lararium::render
