#pragma once

// The part of the camera's view that a picture shows, and the view of an eye beside the camera.

#include <Eigen/Geometry>
#include <limits>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"

namespace lararium::show {

// A rectangle on the camera's plane z = 1; empty: the whole view.
using ViewPart = Eigen::AlignedBox2d;

// A camera's display pinhole (CameraModel::DisplayPinhole), cropped to `part`; not cropped if the
// camera sees nothing of it.
geometry::CameraModel PartOfView(const geometry::CameraModel& camera, const ViewPart& part);

// The same, cropped around its middle to the aspect ratio width : height, so that nothing is
// stretched and no border is empty.
geometry::CameraModel PictureCamera(const geometry::CameraModel& camera,
                                    int width,
                                    int height,
                                    const ViewPart& part = {});

// An eye that looks in the camera's direction. It sees the camera's image as a plane at
// picture_distance from the camera, and people through it as through a window.
struct PictureEye {
  Eigen::Vector3d in_camera = Eigen::Vector3d::Zero();                // metres
  double picture_distance = std::numeric_limits<double>::infinity();  // metres

  friend bool operator==(const PictureEye& a, const PictureEye& b) {
    return a.in_camera == b.in_camera && a.picture_distance == b.picture_distance;
  }
};

// An eye with a free pose that sees the real surroundings directly, not the camera's image.
struct FreeEye {
  geometry::CameraModel camera;  // A pinhole.
  geometry::Rigid3 eye_from_stage;
  float opacity = 1.0f;  // Opacity of people and objects.
};

// Projects points in the eye's axes to pixels of a picture of the camera's view. Points at the
// picture's distance fall on the pixels where the camera saw them.
geometry::CameraModel ForEye(const geometry::CameraModel& picture, const PictureEye& eye);

}  // namespace lararium::show
