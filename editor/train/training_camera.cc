#include "editor/train/training_camera.h"

#include <algorithm>

#include "editor/train/training_status.h"

namespace lararium::train {

geometry::CameraModel ModelOfArea(const TrainingCamera& camera) {
  geometry::CameraModel model = camera.model;
  if (!camera.area.empty()) {
    model.width = camera.area.width;
    model.height = camera.area.height;
    model.cx -= camera.area.x;
    model.cy -= camera.area.y;
  }
  return model;
}

Result<std::vector<TrainingCamera>> CamerasOf(
    const capture::FrameSource& source, const std::optional<geometry::CameraModel>& intrinsics) {
  constexpr double kUnknownFocal = 1.2;     // Share of the longer side.
  constexpr double kExifFocalDoubt = 0.05;  // Lenses are named by round numbers.
  std::vector<TrainingCamera> cameras;
  bool used = false;
  for (const capture::SourceCamera& from : source.Cameras()) {
    const double side = std::max(from.area.width, from.area.height);
    TrainingCamera& camera = cameras.emplace_back();
    camera.area = from.area;
    camera.assumed = from.assumed;
    if (intrinsics && intrinsics->width == from.size.width &&
        intrinsics->height == from.size.height) {
      used = true;
      camera.given = true;
      camera.model = intrinsics->Resized(from.area.width, from.area.height);
      camera.model.cx += from.area.x;
      camera.model.cy += from.area.y;
    } else {
      camera.model.fx = camera.model.fy = from.focal_px.value_or(kUnknownFocal * side);
      camera.model.cx = from.area.x + 0.5 * (from.area.width - 1);
      camera.model.cy = from.area.y + 0.5 * (from.area.height - 1);
      if (from.focal_px) {
        camera.known_focal_px = *from.focal_px;
        camera.focal_doubt = kExifFocalDoubt;
      }
    }
    camera.model.width = source.width();
    camera.model.height = source.height();
  }
  if (intrinsics && !used) {
    return Status::Error(kTraining,
                         "the intrinsics belong to another image size than that of the source",
                         "give the intrinsics for the size of the source's images");
  }
  return cameras;
}

}  // namespace lararium::train
