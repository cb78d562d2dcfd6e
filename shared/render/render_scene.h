#pragma once

// All that one picture shows. Borrowed for the call that draws it.

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>

#include "shared/core/id.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/light/camera_response.h"
#include "shared/light/lamp.h"
#include "shared/light/probe_light.h"

namespace lararium::render {

struct GpuMesh;
struct GpuModel;
using MeshHandle = Id<GpuMesh>;
using ModelHandle = Id<GpuModel>;  // of a person or a prop

// Real things: hide what is behind them, are not seen themselves.
struct SceneOccluder {
  MeshHandle mesh = {};
  glm::mat4 stage_from_mesh = glm::mat4(1.0f);
  bool receives_shadow = true;  // of RenderScene::blockers, where it is seen
};

// A mesh whose vertices are not those of the bind pose in this picture. Parallel to
// its vertices.
struct SceneVertices {
  uint32_t mesh = 0;                          // index into Human::meshes
  std::span<const glm::vec3> positions = {};  // metres, actor frame
  std::span<const glm::vec3> normals = {};    // unit
  bool posed =
      false;  // as they are to be drawn (simulated cloth); otherwise skinned (a morphed face)
};

// Says what something is, whatever it looks like: a colour, told apart without seeing colours
// by stripes.
struct SceneMark {
  glm::vec3 colour = glm::vec3(0.0f);  // linear
  float share = 0.0f;                  // of the picture; 0: no mark
  int stripes = 0;                     // in so many directions: 0, 1, or 2, which cross
  float stripe_px = 16.0f;             // of the target, from one to the next
};

struct SceneHuman {
  ModelHandle human = {};
  glm::mat4 stage_from_actor = glm::mat4(1.0f);
  std::span<const glm::mat4> skin = {};  // one for each joint (human::ComputeSkinMatrices)
  std::span<const SceneVertices> vertices = {};
  // What falls on each vertex, all meshes in a row, with the shadows of body, people and
  // things (show/person_light.h); empty: unshadowed light. Only those vertices count that the
  // levels of detail take.
  std::span<const glm::vec3> irradiance = {};
  // Metres by which what is drawn may differ from the finest level of detail
  // as errors count (shared/render/detail.h).
  float detail = 0.0f;
  // Where they stand. Its sun is taken for as bright, in the scene's direction; none: the scene's.
  const light::ProbeLight* light = nullptr;
  SceneMark mark = {};
};

struct SceneProp {
  ModelHandle prop = {};
  std::span<const glm::mat4> stage_from_part = {};  // one for each part
  std::span<const uint8_t> shown = {};              // likewise: 0 hides it; empty: all are there
  const light::ProbeLight* light = nullptr;         // as of people
  // What falls on each vertex, all meshes in a row, as of SceneHuman.
  std::span<const glm::vec3> irradiance = {};
  float glow = 1.0f;  // times the emission of its meshes
  SceneMark mark = {};
};

// What the camera does to its image and people would lack: all off unless set.
struct CameraLook {
  // Gaussian noise of the encoded picture, 0..1: variance = floor^2 + slope * value, as
  // vision::EstimateNoise measures it. Repeatable: frame alone seeds it.
  float noise_floor = 0.0f;
  float noise_slope = 0.0f;
  uint32_t frame = 0;
  // The point spread of the lens, a Gaussian: standard deviation, pixels of the picture.
  float blur_px = 0.0f;
  // The pose one frame ago; people are smeared by what the camera moved since, times the
  // share of the time between frames that the shutter is open.
  std::optional<geometry::Rigid3> previous_camera_from_stage = std::nullopt;
  float shutter = 0.0f;
};

struct RenderScene {
  // What is real is seen through the picture, on a display that shows it by itself: the picture has
  // people and props alone, sRGB-encoded, times their coverage, and alpha says how much they and
  // their shadows hide of what is behind. Without background and look.
  bool see_through = false;
  // The camera's image, CV_8UC3, sRGB-encoded, raw; empty draws black instead.
  cv::Mat background = {};
  geometry::CameraModel camera = {};  // of background, with distortion

  // The pinhole that everything is drawn with, scaled to the target's size.
  geometry::CameraModel display = {};
  // With which the background is drawn, of an eye that is not where the camera is; none: display.
  std::optional<geometry::CameraModel> background_display = std::nullopt;
  // Without a pose only the background is drawn: never people in a stale place.
  std::optional<geometry::Rigid3> camera_from_stage = std::nullopt;
  float near = 0.05f;  // metres
  float far = 100.0f;

  std::span<const SceneOccluder> occluders = {};
  std::span<const SceneHuman> humans = {};
  std::span<const SceneProp> props = {};
  // Balls that stand for people and props where they keep the sky's light off occluders:
  // centre, stage axes, and radius, metres. Up to 512 as they are; of more, neighbours are
  // merged.
  std::span<const glm::vec4> blockers = {};

  // What falls on people and props: radiance, stage axes. What is seen of them is
  // multiplied by exposure and by gain (the image over the map's reference).
  light::ShRgb light = {};
  // Apart from light: casts shadows with edges, from people and props on each other and on
  // occluders that receive shadows, and from occluders on people.
  std::optional<light::Sun> sun = std::nullopt;
  // Small lights, at most light::kMaxLamps. They light props, glint on people, whose
  // irradiance has them already, and brighten occluders that receive shadows.
  std::span<const light::Lamp> lamps = {};
  // The sky of the hour at which the camera's image was taken, where that of light is another's:
  // lamps brighten real surfaces by their light over this. None: light.
  std::optional<light::ShRgb> picture_light = std::nullopt;
  // What rough surfaces mirror of light: light::GlossyMap::texels, which stay the same while
  // the number does. Empty: highlights come from the harmonics.
  std::span<const uint32_t> glossy = {};
  uint64_t glossy_number = 0;
  float exposure = 1.0f;
  glm::vec3 gain = glm::vec3(1.0f);
  // How the camera renders highlights (the background has it already): linear up
  // to here, above in an exponential shoulder towards white; 1 clips. Far above
  // 1, what is drawn stays linear.
  float knee = 0.6f;
  // As it was measured, in place of the knee; nullptr: it was not.
  const light::CameraResponse* response = nullptr;
  CameraLook look = {};
  // Of people and props, and of what they do to the light on real surfaces: 0, nobody is there.
  float people_opacity = 1.0f;
  // Only Lambert's reflection, as path-traced references have it.
  bool matte = false;
};

}  // namespace lararium::render
