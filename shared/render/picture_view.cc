#include "shared/render/picture_view.h"

#include "shared/geometry/glm_convert.h"
#include "shared/render/clip_space.h"

namespace lararium::render {

PictureView ViewOf(const RenderScene& scene, const ImageSize& size) {
  PictureView view;
  view.size = size;
  view.display = scene.display.Resized(size.width, size.height);
  view.near = scene.near;
  view.far = scene.far;
  if (!scene.camera_from_stage) {
    return view;
  }
  const geometry::Rigid3& camera_from_stage = *scene.camera_from_stage;
  view.clip_from_stage =
      ClipFromCamera(view.display, scene.near, scene.far) * geometry::ToGlm(camera_from_stage);
  const geometry::Rigid3 stage_from_camera = camera_from_stage.Inverse();
  view.eye_in_stage = geometry::ToGlm(stage_from_camera.translation);
  const auto turned = [&](double x, double y, double z) {
    return geometry::ToGlm(stage_from_camera.rotation * Eigen::Vector3d(x, y, z));
  };
  // Rows count from the bottom, and the corner is half a pixel off the last one's centre.
  const geometry::CameraModel& display = view.display;
  view.ray_at_corner =
      turned((-0.5 - display.cx) / display.fx, (size.height - 0.5 - display.cy) / display.fy, 1.0);
  view.ray_per_column = turned(1.0 / display.fx, 0.0, 0.0);
  view.ray_per_row = turned(0.0, -1.0 / display.fy, 0.0);
  return view;
}

}  // namespace lararium::render
