#pragma once

// Everything that one picture shows. Spans are borrowed during the call that draws it.

#include <Eigen/Core>
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
using ModelHandle = Id<GpuModel>;  // a person or a prop

// A real object: it hides what is behind it and is not drawn itself.
struct SceneOccluder {
  MeshHandle mesh = {};
  glm::mat4 stage_from_mesh = glm::mat4(1.0f);
  bool receives_shadow = true;  // shadows of RenderScene::blockers and of the sun fall on it
};

// Replaces the bind pose vertices of one mesh in this picture. Both spans are parallel to the
// vertices of the mesh.
struct SceneVertices {
  uint32_t mesh = 0;                          // index into Human::meshes
  std::span<const glm::vec3> positions = {};  // metres, actor frame
  std::span<const glm::vec3> normals = {};    // unit
  // True: positions are final (simulated cloth). False: they are still skinned (a morphed face).
  bool posed = false;
};

// A colour with stripes that classifies an object, independent of its own look. The stripes let
// colour-blind visitors tell the classes apart.
struct SceneMark {
  glm::vec3 colour = glm::vec3(0.0f);  // linear
  float share = 0.0f;                  // blend weight, 0 (no mark) to 1
  int stripes = 0;                     // number of directions: 0, 1, or 2 (crossed)
  float stripe_px = 16.0f;             // distance of stripes, pixels of the target
};

struct SceneHuman {
  ModelHandle human = {};
  glm::mat4 stage_from_actor = glm::mat4(1.0f);
  std::span<const glm::mat4> skin = {};  // one for each joint (human::ComputeSkinMatrices)
  std::span<const SceneVertices> vertices = {};
  // Irradiance of each vertex, all meshes one after another, shadowed by the person's own body,
  // other people and objects (show/person_light.h); empty: unshadowed light. Only vertices that
  // the chosen levels of detail use are read.
  std::span<const glm::vec3> irradiance = {};
  // Error allowed for the level of detail, metres (DetailRequest::detail in
  // shared/render/detail.h).
  float detail = 0.0f;
  // Light at the person's position; nullptr: the scene's light. The brightness of its sun is used;
  // the direction is always that of the scene's sun.
  const light::ProbeLight* light = nullptr;
  SceneMark mark = {};
};

struct SceneProp {
  ModelHandle prop = {};
  std::span<const glm::mat4> stage_from_part = {};  // one for each part
  std::span<const uint8_t> shown = {};              // one for each part, 0: hidden; empty: all
  const light::ProbeLight* light = nullptr;         // same meaning as SceneHuman::light
  // Irradiance of each vertex, all meshes one after another; empty: unshadowed light.
  std::span<const glm::vec3> irradiance = {};
  float glow = 1.0f;  // factor on the emission of its meshes
  SceneMark mark = {};
};

// Artefacts of the camera that are added to people, so that they match its image. The defaults
// add nothing.
struct CameraLook {
  // Gaussian noise of the encoded picture (values 0..1): variance = floor^2 + slope * value, as
  // measured by vision::EstimateNoise. `frame` alone seeds it, so it can be reproduced.
  float noise_floor = 0.0f;
  float noise_slope = 0.0f;
  uint32_t frame = 0;
  // Standard deviation of the lens's Gaussian point spread, pixels of the picture.
  float blur_px = 0.0f;
  // Motion blur: the camera's pose one frame ago. People are blurred along the camera's motion
  // since then, times `shutter`, the share of the frame time during which the shutter is open.
  std::optional<geometry::Rigid3> previous_camera_from_stage = std::nullopt;
  float shutter = 0.0f;
};

// A rolling shutter, whose rows see people at different times. RenderScene::camera_from_stage
// belongs to the middle of the background.
struct SceneShutter {
  geometry::Rigid3 previous_camera_from_stage;        // one frame time ago
  Eigen::Vector2d readout = Eigen::Vector2d::Zero();  // see vision::RollingShutter
};

struct RenderScene {
  // For displays that show the real world themselves. The picture then contains people and props
  // only: sRGB-encoded colours times coverage; alpha says how much they and their shadows hide of
  // the real world. background and look must not be used then.
  bool see_through = false;
  // The camera's image, CV_8UC3, sRGB-encoded, not rectified; empty: black.
  cv::Mat background = {};
  geometry::CameraModel camera = {};  // camera of background, with distortion

  // What stands before the real surfaces in the background and hides people:
  // vision::TrackedFrame::foreground. Empty: nothing.
  cv::Mat foreground = {};

  // Pinhole camera of the picture; it is scaled to the target's size.
  geometry::CameraModel display = {};
  // Pinhole camera for the background alone, for an eye that is not at the camera's position;
  // nullopt: display.
  std::optional<geometry::CameraModel> background_display = std::nullopt;
  // If there is no pose, only the background is drawn, so that people never stand in a stale
  // position.
  std::optional<geometry::Rigid3> camera_from_stage = std::nullopt;
  float near = 0.05f;  // metres
  float far = 100.0f;

  std::span<const SceneOccluder> occluders = {};
  std::span<const SceneHuman> humans = {};
  std::span<const SceneProp> props = {};
  // Balls that approximate people and props when they block the sky's light from occluders: centre
  // (stage axes) and radius, metres. If there are more than 512, neighbours are merged.
  std::span<const glm::vec4> blockers = {};

  // Radiance around people and props, stage axes. Their colours are multiplied by exposure and by
  // gain (brightness of the camera's image divided by that of the map's reference).
  light::ShRgb light = {};
  // The sun, not included in light. It casts shadows with edges: from people and props on each
  // other and on occluders that receive shadows, and from occluders on people.
  std::optional<light::Sun> sun = std::nullopt;
  // At most light::kMaxLamps lamps. They light props and brighten occluders that receive shadows.
  // On people they add only highlights: SceneHuman::irradiance contains their diffuse light.
  std::span<const light::Lamp> lamps = {};
  // Light at the hour at which the camera's image was taken, if `light` belongs to another hour.
  // Lamps brighten real surfaces by the ratio of their light to this. nullopt: same as `light`.
  std::optional<light::ShRgb> picture_light = std::nullopt;
  // Reflections of `light` on rough surfaces: light::GlossyMap::texels. Change glossy_number
  // whenever the texels change. Empty: highlights are computed from the harmonics.
  std::span<const uint32_t> glossy = {};
  uint64_t glossy_number = 0;
  float exposure = 1.0f;
  glm::vec3 gain = glm::vec3(1.0f);
  // How the camera compresses highlights (the background contains this already): linear up to the
  // knee, above it an exponential shoulder towards white. 1 clips; values far above 1 keep the
  // result linear.
  float knee = 0.6f;
  // Measured response of the camera, used instead of the knee; nullptr: not measured.
  const light::CameraResponse* response = nullptr;
  CameraLook look = {};
  // Moves people to where each row of the background sees them; exact at their mean distance.
  std::optional<SceneShutter> shutter = std::nullopt;
  // Opacity of people and props and of their shadows and light on real surfaces; 0: not visible.
  float people_opacity = 1.0f;
  // Lambertian reflection only, as in path-traced references.
  bool matte = false;
};

}  // namespace lararium::render
