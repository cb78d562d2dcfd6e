#pragma once

// What of the camera's view a picture shows, and how an eye beside the camera sees it.

#include <Eigen/Geometry>
#include <limits>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"

namespace lararium::show {

// Of the camera's plane z = 1; empty: all of it.
using ViewPart = Eigen::AlignedBox2d;

// The display's pinhole of a camera (CameraModel::DisplayPinhole) without what lies outside part;
// whole where the camera sees nothing of part.
geometry::CameraModel PartOfView(const geometry::CameraModel& camera, const ViewPart& part);

// The same, cut to the proportions of width x height about its middle: nothing is stretched, and
// no border stays empty.
geometry::CameraModel PictureCamera(const geometry::CameraModel& camera,
                                    int width,
                                    int height,
                                    const ViewPart& part = {});

// An eye that looks the way the camera does. It sees the camera's image as a plane across its
// view, so far from the camera, and people through it as through a window.
struct PictureEye {
  Eigen::Vector3d in_camera = Eigen::Vector3d::Zero();                // metres
  double picture_distance = std::numeric_limits<double>::infinity();  // metres

  friend bool operator==(const PictureEye& a, const PictureEye& b) {
    return a.in_camera == b.in_camera && a.picture_distance == b.picture_distance;
  }
};

// An eye that looks anywhere at what is real, past the camera and its image.
struct FreeEye {
  geometry::CameraModel camera;  // a pinhole
  geometry::Rigid3 eye_from_stage;
  float opacity = 1.0f;  // of people and things: 0, nobody is there
};

// For points before the eye, in its axes, the pixel of a picture that shows the camera's view:
// what is as far away as the picture falls where the camera saw it.
geometry::CameraModel ForEye(const geometry::CameraModel& picture, const PictureEye& eye);

}  // namespace lararium::show
