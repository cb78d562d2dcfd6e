#include "shared/render/picture_view.h"

#include "shared/geometry/glm_convert.h"
#include "shared/render/clip_space.h"

namespace lararium::render {
namespace {

// Maps rays (x, y, 1) to pixels, counted from the corner of the bottom row.
Eigen::Matrix3d PixelFromRay(const PictureView& view) {
  Eigen::Matrix3d pixel_from_ray = Eigen::Matrix3d::Identity();
  pixel_from_ray(0, 0) = view.display.fx;
  pixel_from_ray(0, 2) = view.display.cx + 0.5;
  pixel_from_ray(1, 1) = -view.display.fy;
  pixel_from_ray(1, 2) = view.size.height - 0.5 - view.display.cy;
  return pixel_from_ray;
}

// Maps rays (x, y, 1) to pixels, counted from the corner of the top row.
Eigen::Matrix3d PixelFromRay(const geometry::CameraModel& display) {
  Eigen::Matrix3d pixel_from_ray = Eigen::Matrix3d::Identity();
  pixel_from_ray(0, 0) = display.fx;
  pixel_from_ray(0, 2) = display.cx + 0.5;
  pixel_from_ray(1, 1) = display.fy;
  pixel_from_ray(1, 2) = display.cy + 0.5;
  return pixel_from_ray;
}

// Maps rays of a view to rays of another, for points on the plane z = depth of the view:
// R + t (0, 0, 1 / depth).
Eigen::Matrix3d PlaneHomography(const geometry::Rigid3& other_from_view, float depth) {
  Eigen::Matrix3d other_from_ray = other_from_view.rotation.toRotationMatrix();
  other_from_ray.col(2) += other_from_view.translation / static_cast<double>(depth);
  return other_from_ray;
}

glm::mat3 ToGlm(const Eigen::Matrix3d& matrix) {
  glm::mat3 result;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      result[column][row] = static_cast<float>(matrix(row, column));
    }
  }
  return result;
}

}  // namespace

PictureView ViewOf(const RenderScene& scene,
                   const ImageSize& size,
                   const ImageSize& most,
                   int margin) {
  PictureView view;
  view.margin = margin;
  view.size = {size.width + 2 * margin, size.height + 2 * margin};
  const int most_margin = (margin * most.width + size.width - 1) / size.width;
  view.most = {most.width + 2 * most_margin, most.height + 2 * most_margin};
  view.display = scene.display.Resized(size.width, size.height);
  view.display.width = view.size.width;
  view.display.height = view.size.height;
  view.display.cx += margin;
  view.display.cy += margin;
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
  // Rows are counted from the bottom. The corner is half a pixel away from the centre of the first
  // pixel.
  const geometry::CameraModel& display = view.display;
  view.ray_at_corner = turned((-0.5 - display.cx) / display.fx,
                              (view.size.height - 0.5 - display.cy) / display.fy, 1.0);
  view.ray_per_column = turned(1.0 / display.fx, 0.0, 0.0);
  view.ray_per_row = turned(0.0, -1.0 / display.fy, 0.0);
  return view;
}

glm::mat3 PreviousFromPixel(const geometry::Rigid3& previous_from_now,
                            const PictureView& view,
                            float depth) {
  const Eigen::Matrix3d pixel_from_ray = PixelFromRay(view);
  return ToGlm(pixel_from_ray * PlaneHomography(previous_from_now, depth) *
               pixel_from_ray.inverse());
}

glm::mat3 ViewFromPicture(const PictureView& view,
                          const geometry::Rigid3& pose,
                          float depth,
                          const geometry::CameraModel& display,
                          const geometry::Rigid3& camera_from_stage) {
  const Eigen::Matrix3d picture_from_view =
      PlaneHomography(camera_from_stage * pose.Inverse(), depth);
  return ToGlm(PixelFromRay(view) * picture_from_view.inverse() * PixelFromRay(display).inverse());
}

}  // namespace lararium::render
