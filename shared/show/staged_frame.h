#pragma once

// A tracked image and the stage at its moment: everything that is drawn or heard of one image.

#include <chrono>
#include <glm/mat4x4.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "shared/audio/sound_scene.h"
#include "shared/human/human.h"
#include "shared/light/lamp.h"
#include "shared/light/probe_blend.h"
#include "shared/show/character_instance.h"
#include "shared/show/pose_stage.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::show {

// A visible actor at the moment of a frame.
struct StagedActor {
  uint32_t cast = 0;  // Index into ShowContent::cast.
  // The human that is drawn: the cast's own, or one read at a finer detail.
  std::shared_ptr<const human::Human> figure;
  glm::mat4 stage_from_actor = glm::mat4(1.0f);
  uint32_t skin_begin = 0;  // First matrix in StagedPeople::skin.
  uint32_t skin_count = 0;
  uint32_t mesh_begin = 0;  // First mesh in StagedPeople::meshes.
  uint32_t mesh_count = 0;
  uint32_t light_begin = 0;  // First vertex in StagedLight::on_people.
  uint32_t light_count = 0;  // 0: lit without shadows.
  light::ProbeLight light;   // Light at the actor's position, stage axes.
  // Error in metres by which the drawn level may differ from the finest one (see
  // human::ErrorShare). Only the vertices of that level have irradiance.
  float detail = 0.0f;
};

// A mesh of an actor whose vertices differ from the bind pose: a speaking face, or cloth.
struct StagedMesh {
  CharacterInstance::MovingMesh mesh;
  uint32_t vertex_begin = 0;  // Index into StagedPeople::positions and ::normals.
  uint32_t vertex_count = 0;
};

// The visible actors and their data, concatenated.
struct StagedPeople {
  std::vector<StagedActor> actors;
  std::vector<glm::mat4> skin;
  std::vector<StagedMesh> meshes;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
};

// A visible object at the moment of a frame.
struct StagedObject {
  uint32_t object = 0;      // Index into ShowContent::objects.
  uint32_t part_begin = 0;  // Index into StagedThings::stage_from_part and ::part_shown.
  uint32_t part_count = 0;
  light::ProbeLight light;   // Light at the object's position, stage axes.
  float glow = 1.0f;         // Factor of the emission of its meshes.
  uint32_t light_begin = 0;  // First vertex in StagedLight::on_things.
  uint32_t light_count = 0;  // 0: lit without shadows.
};

// The visible objects, the concatenated data of their parts, and their lamps.
struct StagedThings {
  std::vector<StagedObject> objects;
  std::vector<glm::mat4> stage_from_part;
  std::vector<uint8_t> part_shown;
  // Burning lamps, stage axes; the brightest light::kMaxLamps of them.
  std::vector<light::Lamp> lamps;
};

struct StagedLight {
  // Light on the real surfaces in view, stage axes. All people and objects use its sun.
  light::ProbeLight surfaces;
  // The sky at the hour when the image was taken; set only if the drama uses another hour.
  std::optional<light::ShRgb> picture;
  // Blending weight of each probe of the place, for the real surfaces in view.
  std::vector<float> probe_weights;
  // Spheres that cast soft shadows: centre and radius, stage axes.
  std::vector<glm::vec4> blockers;
  // Irradiance of the vertices of lit actors and of lit objects.
  std::vector<glm::vec3> on_people;
  std::vector<glm::vec3> on_things;
};

// A line that is spoken at the moment of a frame, or whose caption is still shown.
struct StagedLine {
  static constexpr uint32_t kNobody = ~0u;
  static constexpr uint32_t kDescription = ~0u - 1;

  // Index into ShowContent::cast of the speaker; kNobody: caption without speech; kDescription:
  // audio description.
  uint32_t cast = 0;
  uint32_t line = 0;      // Index into ShowContent::speech.
  double seconds = 0.0;   // Time since the line began.
  bool speaking = false;  // False: the speech has ended.
};

// When a frame was made. A pipeline fills all but helpers_cpu_ms.
struct StagingTimes {
  std::chrono::steady_clock::time_point arrival;  // When the image arrived.
  std::chrono::steady_clock::time_point located;  // When its pose was estimated.
  std::chrono::steady_clock::time_point staged;   // When staging was finished.
  double stage_ms = 0.0;                          // Duration of staging.
  double helpers_cpu_ms = 0.0;  // CPU milliseconds that other threads spent on staging.
};

// Buffers are reused from frame to frame, so that steady play allocates nothing here.
struct StagedFrame {
  vision::TrackedFrame tracked;
  StagedCamera camera;
  double time = 0.0;  // Time of the drama, seconds.
  StagedPeople people;
  StagedThings things;
  StagedLight light;
  std::vector<StagedLine> lines;
  audio::SoundScene sound;
  StagingTimes times;
};

}  // namespace lararium::show
