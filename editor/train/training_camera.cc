#include "editor/train/training_camera.h"

#include <algorithm>
#include <map>

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

geometry::CameraModel Turned(const geometry::CameraModel& camera) {
  return {.width = camera.height,
          .height = camera.width,
          .fx = camera.fy,
          .fy = camera.fx,
          .cx = camera.height - 1 - camera.cy,
          .cy = camera.cx,
          .k1 = camera.k1,
          .k2 = camera.k2,
          .p1 = camera.p2,
          .p2 = -camera.p1};
}

uint32_t LensOf(std::span<const TrainingCamera> cameras, uint32_t camera) {
  return cameras[camera].lens_of.value_or(camera);
}

uint32_t MeanCamera(std::span<const TrainingCamera> cameras, uint32_t camera) {
  return cameras[camera].focal_ratio ? LensOf(cameras, camera) : camera;
}

size_t LensCount(std::span<const TrainingCamera> cameras) {
  return static_cast<size_t>(
      std::ranges::count_if(cameras, [](const TrainingCamera& camera) { return !camera.lens_of; }));
}

int QuarterTurns(const TrainingCamera& from, const TrainingCamera& to) {
  return (to.quarter_turns - from.quarter_turns + 4) % 4;
}

geometry::CameraModel TurnedModel(const TrainingCamera& from, const TrainingCamera& to) {
  geometry::CameraModel model = ModelOfArea(from);
  for (int turn = 0; turn < QuarterTurns(from, to); ++turn) {
    model = Turned(model);
  }
  const double ratio = to.focal_ratio.value_or(1.0) / from.focal_ratio.value_or(1.0);
  model.fx *= ratio;
  model.fy *= ratio;
  model.width = to.model.width;
  model.height = to.model.height;
  model.cx += to.area.x;
  model.cy += to.area.y;
  return model;
}

Eigen::Vector2d TurnedPixel(const TrainingCamera& from,
                            const TrainingCamera& to,
                            Eigen::Vector2d pixel) {
  geometry::CameraModel image = ModelOfArea(from);
  pixel -= Eigen::Vector2d(from.area.x, from.area.y);
  for (int turn = 0; turn < QuarterTurns(from, to); ++turn) {
    pixel = {image.height - 1 - pixel.y(), pixel.x()};
    image = Turned(image);
  }
  return pixel + Eigen::Vector2d(to.area.x, to.area.y);
}

Result<std::vector<TrainingCamera>> CamerasOf(
    const capture::FrameSource& source, const std::optional<geometry::CameraModel>& intrinsics) {
  constexpr double kUnknownFocal = 1.2;     // Share of the longer side.
  constexpr double kExifFocalDoubt = 0.05;  // Lenses are named by round numbers.
  std::vector<TrainingCamera> cameras;
  std::map<uint32_t, uint32_t> given;  // Key: a lens. Value: the camera that the intrinsics fit.
  for (const capture::SourceCamera& from : source.Cameras()) {
    const double side = std::max(from.area.width, from.area.height);
    TrainingCamera& camera = cameras.emplace_back();
    camera.area = from.area;
    camera.assumed = from.assumed;
    camera.quarter_turns = from.quarter_turns;
    if (from.lens_of) {
      camera.lens_of = static_cast<uint32_t>(*from.lens_of);
    }
    const auto index = static_cast<uint32_t>(cameras.size() - 1);
    if (intrinsics && intrinsics->width == from.size.width &&
        intrinsics->height == from.size.height &&
        given.emplace(LensOf(cameras, index), index).second) {
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
  if (intrinsics && given.empty()) {
    return Status::Error(kTraining,
                         "the intrinsics belong to another image size than that of the source",
                         "give the intrinsics for the size of the source's images");
  }
  for (uint32_t i = 0; i < cameras.size(); ++i) {
    if (const auto found = given.find(LensOf(cameras, i)); found != given.end()) {
      cameras[i].model = TurnedModel(cameras[found->second], cameras[i]);
      cameras[i].given = true;
    }
  }
  return cameras;
}

}  // namespace lararium::train
