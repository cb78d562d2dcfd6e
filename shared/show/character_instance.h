#pragma once

// The body of one cast member, simulated from frame to frame: pose, hair, face and cloth.

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "shared/human/animator.h"
#include "shared/human/cloth.h"
#include "shared/human/morph.h"
#include "shared/human/reach.h"
#include "shared/human/spring.h"
#include "shared/stage/actor.h"

namespace lararium::show {

// Which parts of a body are simulated.
struct BodyDetail {
  human::ClothDetail cloth = human::ClothDetail::kFull;
  bool hair = true;
  bool face = true;   // Morphs of the face. Jaw and eyes always turn.
  bool drawn = true;  // True: vertices are computed.

  friend bool operator==(const BodyDetail&, const BodyDetail&) = default;
};

// Chooses by a person's height in the picture and by the previous choice. A part is dropped only
// well below the height at which it is added. not_seen: the person is outside the picture.
BodyDetail ChooseBodyDetail(float height_px, bool not_seen, const BodyDetail& before);

// Source of a voice: position in metres, and unit direction of facing.
struct Mouth {
  glm::vec3 position = glm::vec3(0.0f);
  glm::vec3 facing = glm::vec3(0.0f, 0.0f, -1.0f);
};

// The mesh as which a body is drawn, and its deformers.
struct CharacterMesh {
  explicit CharacterMesh(std::shared_ptr<const human::Human> drawn)
      : human(std::move(drawn)), cloth(*human), morphs(human::FindMeshMorphs(*human)) {}

  std::shared_ptr<const human::Human> human;
  human::ClothModel cloth;
  std::vector<human::MeshMorphs> morphs;
};

class CharacterInstance {
 public:
  explicit CharacterInstance(std::shared_ptr<const human::AnimationRig> model);

  const human::Human& human() const { return animator_.human(); }
  const std::shared_ptr<const human::AnimationRig>& model() const { return model_; }
  const std::shared_ptr<const human::Human>& figure() const { return figure_.human; }

  // Height of the highest vertex above the soles in the bind pose, but at least that of the eyes;
  // metres.
  float height() const { return height_; }

  // Replaces the mesh by the same person at another detail (human::ParseHuman). Initially the mesh
  // is that of the rig. The simulation continues.
  void SetMesh(CharacterMesh figure) { figure_ = std::move(figure); }

  // Poses the body for its actor's state at a show time in seconds, then steps hair and cloth.
  // After a gap, a jump or a step back, hair and cloth settle at once. Allocates nothing.
  void Step(const stage::ActorState& state, double time, const BodyDetail& detail);

  // Makes hair and cloth settle at once in the next step.
  void Settle() { settles_ = true; }

  // Skin matrices of the last step.
  std::span<const glm::mat4> skin() const { return skin_; }
  human::GripFrame actor_from_palm(int side) const;
  // Position and direction of the mouth, actor frame.
  Mouth actor_from_mouth() const;
  // A mesh whose vertices differ from the bind pose.
  struct MovingMesh {
    uint32_t mesh = 0;   // Index into Human::meshes of figure().
    bool posed = false;  // True: cloth in the actor frame; false: morphed bind pose.
    // Cloth: index into Human::cloths; morphs: index into CharacterMesh::morphs.
    uint32_t source = 0;
  };
  std::span<const MovingMesh> moving_meshes() const { return moving_; }
  // Writes the positions and normals of all vertices of a moving mesh.
  void ComputeVertices(const MovingMesh& mesh,
                       std::span<glm::vec3> positions,
                       std::span<glm::vec3> normals) const;

 private:
  void FindMovingMeshes(const BodyDetail& detail);

  std::shared_ptr<const human::AnimationRig> model_;
  human::Animator animator_;
  CharacterMesh figure_;
  human::ClothState cloth_;
  human::SpringModel spring_model_;
  human::SpringState springs_;
  std::vector<bool> is_cloth_;  // Parallel to Human::meshes.
  std::vector<human::JointTransform> pose_;
  std::vector<glm::mat4> actor_from_joint_;
  std::vector<glm::mat4> skin_;
  std::vector<MovingMesh> moving_;
  float height_ = 0.0f;
  std::optional<double> time_;  // Time of the last step.
  bool settles_ = false;        // True: hair and cloth settle in the next step.
  int head_ = -1;               // Joint of the head; -1: none.
};

}  // namespace lararium::show
