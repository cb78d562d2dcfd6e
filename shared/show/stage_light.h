#pragma once

// The light on all people and objects on stage, frame by frame.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "shared/light/spherical_harmonics.h"
#include "shared/show/person_light.h"

namespace lararium::show {

// Height in metres at which hidden parts are placed; a blocker there has no effect.
inline constexpr float kNowhere = 1e5f;

// Number of vertices of all meshes that are lit: 0 without baked transfer.
size_t LitVertices(const human::Human& human);

// A person or object to be lit, its light, and the output.
struct LitActor {
  uint32_t cast = 0;
  const light::ShRgb* light = nullptr;  // Light at its position without the sun, stage axes.
  std::span<const glm::mat4> skin;
  glm::mat4 stage_from_actor = glm::mat4(1.0f);
  std::span<glm::vec3> irradiance;  // All vertices of all meshes; empty: not needed.
  float detail = 0.0f;              // See StagedActor::detail.
};

class StageLight {
 public:
  // cast: the people that may be on stage, followed by figures of objects (thing_light.h). Members
  // without baked transfer receive no shadow; members without blockers cast none. light: the
  // vectors that TakeLight() moved out of each member; may be empty.
  explicit StageLight(std::span<const std::shared_ptr<const human::Human>> cast,
                      std::span<const std::shared_ptr<const UnpackedLight>> light = {});

  // Replaces the mesh by the same member at another detail (human::ParseHuman).
  void SetMesh(uint32_t cast,
               std::shared_ptr<const human::Human> human,
               std::shared_ptr<const UnpackedLight> light);

  // Replaces a member, whose light is computed as if it had just come.
  void SetMember(uint32_t cast,
                 std::shared_ptr<const human::Human> human,
                 std::shared_ptr<const UnpackedLight> light);

  bool Lights(uint32_t cast) const { return lights_[cast]; }
  // Number of vertices of all meshes of a member.
  size_t vertex_count(uint32_t cast) const { return vertex_counts_[cast]; }

  // Poses the blockers of the frame's actors. Each actor has a different `cast`. Returns CPU
  // milliseconds of other threads, like Light().
  double Pose(std::span<const LitActor> actors);

  // Lights the actors of the last Pose(), which shadow each other, by the light at their positions
  // and by lamps. Runs in parallel. Allocates nothing while the number of actors stays the same.
  double Light(std::span<const light::Lamp> lamps, std::span<const LitActor> actors);

  // Blockers of the last Pose(), stage axes: centre and radius.
  std::span<const glm::vec4> blockers() const { return all_blockers_; }

 private:
  void CollectBlockers(std::span<const LitActor> actors);
  void CollectOthers(std::span<const LitActor> actors, size_t index);
  void LightActor(const LitActor& actor, std::span<const light::Lamp> lamps, size_t index);

  // The light of a person as a matrix; computed again when the light changes.
  struct PersonMatrix {
    light::ShRgb light = {};
    std::optional<light::LightMatrix> matrix;
  };
  const light::LightMatrix& MatrixFor(const LitActor& actor);

  // Parallel to the cast; nullptr: neither lit nor casting shadows.
  std::vector<std::unique_ptr<PersonLight>> people_;
  std::vector<PersonMatrix> matrices_;  // Parallel to the cast.
  // Parallel to the cast: whether the member has baked transfer and is lit.
  std::vector<bool> lights_;
  std::vector<size_t> vertex_counts_;
  std::vector<SphereSet> others_;  // Blockers of the others, for each lit actor of the frame.
  std::vector<glm::vec4> all_blockers_;
};

}  // namespace lararium::show
