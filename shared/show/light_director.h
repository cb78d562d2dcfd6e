#pragma once

// Lights the people and objects of a show from frame to frame. Objects in constant light are not
// lit again.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "shared/light/probe_blend.h"
#include "shared/show/lamp_shade.h"
#include "shared/show/show_content.h"
#include "shared/show/stage_light.h"
#include "shared/show/staged_frame.h"
#include "shared/show/thing_light.h"

namespace lararium::show {

// The probes of a place and the hours at which they are blended.
struct PlaceLight {
  std::span<const light::PlacedProbe> probes;
  std::optional<double> hour;  // Hour of the drama; nullopt: that of the first probe.
  float picture_hour = -1.0f;  // Hour of the camera's image; negative: that of the first probe.

  // Light at a position on stage, at the drama's hour.
  light::ProbeLight At(const glm::vec3& position) const;
};

class LightDirector {
 public:
  explicit LightDirector(const ShowContent& content);

  // Changes the occluders of a place, which shade its lamps.
  void SetPlace(size_t index, const stage::Place& place);
  // Replaces the mesh of a member of the cast by the same person at another detail.
  void SetMesh(uint32_t cast,
               std::shared_ptr<const human::Human> human,
               std::shared_ptr<const UnpackedLight> light);
  // Replaces a member of the cast.
  void SetPerson(uint32_t cast,
                 std::shared_ptr<const human::Human> human,
                 std::shared_ptr<const UnpackedLight> light);
  // Replaces an object.
  void SetObject(size_t index, const StageObject& object);

  // Number of vertices of an object that have irradiance; 0: it is lit without shadows.
  uint32_t LitVerticesOf(uint32_t object) const;
  // Gives the lamps their walls (LampShade::SetWalls).
  void ShadeLamps(uint32_t place, std::span<light::Lamp> lamps) { shades_[place].SetWalls(lamps); }

  // Fills `light` for the people and things of a frame. The sun's shadows are drawn separately
  // (render/passes/sun_pass.h). Returns the CPU milliseconds of other threads.
  double Light(const PlaceLight& place,
               const std::optional<geometry::Rigid3>& camera_from_stage,
               const StagedPeople& people,
               const StagedThings& things,
               StagedLight& light);

  // Until Restore(), other moments may be lit: Restore() brings back how objects were lit last.
  void SetAside() { things_before_ = things_; }
  void Restore() { things_ = std::move(things_before_); }

 private:
  struct Thing {
    explicit Thing(const stage::Prop& prop) : skin(prop.parts.size()), memory(RadiusOf(prop)) {}

    std::vector<glm::mat4> skin;        // Matrices of the current frame.
    std::vector<glm::vec3> irradiance;  // Result of the last lighting.
    ThingMemory memory;
  };

  void CollectLit(const StagedPeople& people, const StagedThings& things, StagedLight& light);
  // Takes objects in constant light from their last lighting.
  void SkipUnchanged(size_t people, const StagedThings& things, StagedLight& light);

  size_t cast_count_;
  std::optional<StageLight> stage_light_;  // The figures of objects follow the people.
  std::vector<Thing> things_;              // Parallel to ShowContent::objects.
  std::vector<Thing> things_before_;
  std::vector<LampShade> shades_;  // Parallel to ShowContent::places.
  std::vector<LitActor> lit_;      // People, then objects, of the current frame.
};

}  // namespace lararium::show
