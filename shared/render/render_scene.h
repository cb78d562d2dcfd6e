#pragma once

// All that one picture shows. Borrowed for the call that draws it.

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>

#include "shared/core/id.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/light/spherical_harmonics.h"

namespace lararium::render {

struct GpuMesh;
struct GpuHuman;
using MeshHandle = Id<GpuMesh>;
using HumanHandle = Id<GpuHuman>;

// Real things: hide what is behind them, are not seen themselves.
struct SceneOccluder {
  MeshHandle mesh = {};
  glm::mat4 stage_from_mesh = glm::mat4(1.0f);
};

struct SceneHuman {
  HumanHandle human = {};
  glm::mat4 stage_from_actor = glm::mat4(1.0f);
  std::span<const glm::mat4> skin = {};  // one for each joint (human::ComputeSkinMatrices)
};

struct RenderScene {
  // The camera's image, CV_8UC3, sRGB-encoded, raw; empty draws black instead.
  cv::Mat background = {};
  geometry::CameraModel camera = {};  // of background, with distortion

  // The pinhole that everything is drawn with, scaled to the target's size.
  geometry::CameraModel display = {};
  // Without a pose only the background is drawn: never people in a stale place.
  std::optional<geometry::Rigid3> camera_from_stage = std::nullopt;
  float near = 0.05f;  // metres
  float far = 100.0f;

  std::span<const SceneOccluder> occluders = {};
  std::span<const SceneHuman> humans = {};

  // What falls on people: radiance, stage axes. What is seen of them is
  // multiplied by exposure and by gain (the image over the map's reference).
  light::ShRgb light = {};
  float exposure = 1.0f;
  glm::vec3 gain = glm::vec3(1.0f);
  // How the camera renders highlights (the background has it already): linear up
  // to here, above in an exponential shoulder towards white; 1 clips.
  float knee = 0.6f;
};

}  // namespace lararium::render
