#pragma once

// The mapping between pixels of an image and the screen, for picking.

#include <Eigen/Core>
#include <optional>

#include "shared/geometry/camera_model.h"

namespace lararium::panels {

struct ImageView {
  // For a picture that was drawn with another camera at the same position with the same axes.
  struct Redrawn {
    geometry::CameraModel raw;
    geometry::CameraModel display;
  };

  Eigen::Vector2d origin;  // Screen position of the picture's top-left corner.
  double scale = 1.0;      // Screen pixels per pixel of the picture.
  std::optional<Redrawn> redrawn = std::nullopt;  // Not set: the picture is the image.

  // Converts a pixel of the image to a pixel of the picture. Integer coordinates are pixel centres.
  Eigen::Vector2d ToPicture(const Eigen::Vector2d& pixel) const {
    return redrawn ? redrawn->display.PixelFromPlane(redrawn->raw.PlaneFromPixel(pixel)) : pixel;
  }
  Eigen::Vector2d ToScreen(const Eigen::Vector2d& pixel) const {
    return origin + scale * (ToPicture(pixel) + Eigen::Vector2d(0.5, 0.5));
  }
  Eigen::Vector2d ToPixel(const Eigen::Vector2d& screen) const {
    const Eigen::Vector2d picture = (screen - origin) / scale - Eigen::Vector2d(0.5, 0.5);
    return redrawn ? redrawn->raw.PixelFromPlane(redrawn->display.PlaneFromPixel(picture))
                   : picture;
  }
};

}  // namespace lararium::panels
