#include "shared/render/picture_view.h"

#include "shared/geometry/glm_convert.h"
#include "shared/render/clip_space.h"

namespace lararium::render {

PictureView ViewOf(const RenderScene& scene, const ImageSize& size, const ImageSize& most) {
  PictureView view;
  view.size = size;
  view.most = most;
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

glm::mat3 PreviousFromPixel(const RenderScene& scene, const PictureView& view, float depth) {
  if (!scene.look.previous_camera_from_stage || !scene.camera_from_stage) {
    return glm::mat3(1.0f);
  }
  const geometry::CameraModel& display = view.display;
  Eigen::Matrix3d image_from_ray = Eigen::Matrix3d::Identity();
  image_from_ray(0, 0) = display.fx;
  image_from_ray(0, 2) = display.cx + 0.5;
  image_from_ray(1, 1) = -display.fy;
  image_from_ray(1, 2) = view.size.height - 0.5 - display.cy;
  const geometry::Rigid3 previous_from_now =
      *scene.look.previous_camera_from_stage * scene.camera_from_stage->Inverse();
  // Of a plane z = depth: R + t (0, 0, 1 / depth).
  Eigen::Matrix3d moved = previous_from_now.rotation.toRotationMatrix();
  moved.col(2) += previous_from_now.translation / static_cast<double>(depth);
  const Eigen::Matrix3d homography = image_from_ray * moved * image_from_ray.inverse();
  glm::mat3 result;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      result[column][row] = static_cast<float>(homography(row, column));
    }
  }
  return result;
}

}  // namespace lararium::render
