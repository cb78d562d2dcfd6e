#pragma once

// The body of one cast member from frame to frame: pose, hair, face and cloth.

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "shared/human/cloth.h"
#include "shared/human/morph.h"
#include "shared/human/performance.h"
#include "shared/human/reach.h"
#include "shared/human/spring.h"
#include "shared/stage/actor.h"

namespace lararium::show {

// What of a body is simulated.
struct BodyDetail {
  human::ClothDetail cloth = human::ClothDetail::kFull;
  bool hair = true;
  bool face = true;   // morphs; jaw and eyes turn in any case
  bool drawn = true;  // vertices are wanted

  friend bool operator==(const BodyDetail&, const BodyDetail&) = default;
};

// By the size of a person in the picture, and what was simulated before: what becomes
// smaller loses something only well below where it gets it back. not_seen: outside
// the picture.
BodyDetail ChooseBodyDetail(float height_px, bool not_seen, const BodyDetail& before);

// Where a voice comes from: metres; facing is unit.
struct Mouth {
  glm::vec3 position = glm::vec3(0.0f);
  glm::vec3 facing = glm::vec3(0.0f, 0.0f, -1.0f);
};

// What a body is drawn as: its vertices and what moves them.
struct Figure {
  explicit Figure(std::shared_ptr<const human::Human> drawn)
      : human(std::move(drawn)), cloth(*human), morphs(human::FindMeshMorphs(*human)) {}

  std::shared_ptr<const human::Human> human;
  human::ClothModel cloth;
  std::vector<human::MeshMorphs> morphs;
};

class Body {
 public:
  explicit Body(std::shared_ptr<const human::PerformanceModel> model);

  const human::Human& human() const { return performer_.human(); }
  const std::shared_ptr<const human::Human>& figure() const { return figure_.human; }

  // The same person in another detail (human::ParseHuman); at first that of the model. What moves
  // goes on.
  void SetFigure(Figure figure) { figure_ = std::move(figure); }

  // Poses the body as its actor is at a moment of the show and lets hair and cloth
  // follow. After a gap, a leap or going back they settle at once. Allocates nothing.
  void Step(const stage::ActorState& state, double time, const BodyDetail& detail);

  // In the next step hair and cloth settle at once, whatever was before.
  void Settle() { settles_ = true; }

  // Of the last step.
  std::span<const glm::mat4> skin() const { return skin_; }
  human::GripFrame actor_from_palm(int side) const;
  // Where the mouth is and points; actor frame.
  Mouth actor_from_mouth() const;
  // Meshes whose vertices are not those of the bind pose.
  struct MovingMesh {
    uint32_t mesh = 0;    // index into Human::meshes of the figure
    bool posed = false;   // cloth, in the actor frame; otherwise a morphed bind pose
    uint32_t source = 0;  // of cloth: index into Human::cloths; of morphs: Body's own
  };
  std::span<const MovingMesh> moving_meshes() const { return moving_; }
  // Their vertices, one for each of the mesh.
  void ComputeVertices(const MovingMesh& mesh,
                       std::span<glm::vec3> positions,
                       std::span<glm::vec3> normals) const;

 private:
  void FindMovingMeshes(const BodyDetail& detail);

  human::Performer performer_;
  Figure figure_;
  human::ClothState cloth_;
  human::SpringModel spring_model_;
  human::SpringState springs_;
  std::vector<bool> is_cloth_;  // of each mesh
  std::vector<human::JointTransform> pose_;
  std::vector<glm::mat4> actor_from_joint_;
  std::vector<glm::mat4> skin_;
  std::vector<MovingMesh> moving_;
  std::optional<double> time_;  // of the last step
  bool settles_ = false;        // in the next one
  int head_ = -1;               // joint; -1: it has none
};

}  // namespace lararium::show
