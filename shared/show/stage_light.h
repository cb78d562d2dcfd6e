#pragma once

// The light on everybody and everything on stage, frame by frame.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "shared/light/spherical_harmonics.h"
#include "shared/show/person_light.h"

namespace lararium::show {

// So many metres up is what is not there: a blocker there is none.
inline constexpr float kNowhere = 1e5f;

// Who or what is lit by what, and where the result goes.
struct LitActor {
  uint32_t cast = 0;
  const light::ShRgb* light = nullptr;  // where they stand, without the sun; stage axes
  std::span<const glm::mat4> skin;
  glm::mat4 stage_from_actor = glm::mat4(1.0f);
  std::span<glm::vec3> irradiance;  // of all vertices of all meshes; empty: not wanted
  float detail = 0.0f;              // StagedActor::detail
};

class StageLight {
 public:
  // cast: who may be on stage, figures of things among them (thing_light.h). Those without
  // baked transfer take no shade; those without blockers cast none. light: what was taken out of
  // each (TakeLight); empty where nothing was.
  explicit StageLight(std::span<const std::shared_ptr<const human::Human>> cast,
                      std::span<const std::shared_ptr<const UnpackedLight>> light = {});

  // The same member in another detail (human::ParseHuman).
  void SetFigure(uint32_t cast,
                 std::shared_ptr<const human::Human> human,
                 std::shared_ptr<const UnpackedLight> light);

  bool Lights(uint32_t cast) const { return lights_[cast]; }
  // Vertices of all meshes of a member.
  size_t vertex_count(uint32_t cast) const { return vertex_counts_[cast]; }

  // Where the frame's actors are, each of whom has another cast. Returns the processor
  // milliseconds of other threads, as Light does.
  double Pose(std::span<const LitActor> actors);

  // Lights the actors of the last Pose, who cast shade on each other, by the light of where they
  // stand and by lamps. Spread over the cores. After the first frame nothing is allocated while
  // as many are there.
  double Light(std::span<const light::Lamp> lamps, std::span<const LitActor> actors);

  // Blockers of the last Pose, stage axes: centre and radius.
  std::span<const glm::vec4> blockers() const { return all_blockers_; }

 private:
  void CollectBlockers(std::span<const LitActor> actors);
  void CollectOthers(std::span<const LitActor> actors, size_t index);
  void LightActor(const LitActor& actor, std::span<const light::Lamp> lamps, size_t index);

  // The light of a person as a matrix; made again when the light has changed.
  struct PersonMatrix {
    light::ShRgb light = {};
    std::optional<light::LightMatrix> matrix;
  };
  const light::LightMatrix& MatrixFor(const LitActor& actor);

  std::vector<std::unique_ptr<PersonLight>> people_;  // of each member, or none
  std::vector<PersonMatrix> matrices_;                // likewise
  std::vector<bool> lights_;  // likewise: takes light, rather than only giving shade
  std::vector<size_t> vertex_counts_;
  std::vector<SphereSet> others_;  // of each lit actor of the frame
  std::vector<glm::vec4> all_blockers_;
};

}  // namespace lararium::show
