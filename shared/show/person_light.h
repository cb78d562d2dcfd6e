#pragma once

// The light on one person from frame to frame: distant light as baked for key poses, minus the
// light that limbs, other people and objects block now.
//
// Per receiver (human::LightTransfer): the log visibility past the person's own blockers is
// compared with that of the key poses. This gives the weights of the key poses and a correction for
// the rest. Blockers of others are added on top (Ren et al. 2006). Per vertex: the light of its
// receivers times its transfer vector (Sloan et al. 2002).

#include <array>
#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "shared/human/human.h"
#include "shared/light/key_poses.h"
#include "shared/light/lamp.h"
#include "shared/light/receivers.h"
#include "shared/light/transfer.h"
#include "shared/render/detail.h"
#include "shared/show/person_blockers.h"
#include "shared/show/person_receivers.h"

namespace lararium::show {

// The transfer vectors of each mesh of a person or object, unpacked for use in every frame.
using UnpackedLight = std::vector<light::Transfer>;
// Moves the vectors out of `transfer`, so that they are kept only once: they are most of a person's
// memory.
std::shared_ptr<const UnpackedLight> TakeLight(human::LightTransfer& transfer);

class PersonLight {
 public:
  // The human's light transfer must not be empty. light: the vectors that TakeLight() moved out of
  // the human; nullptr: they are still inside it. The human's meshes are not read after
  // construction.
  explicit PersonLight(std::shared_ptr<const human::Human> human,
                       std::shared_ptr<const UnpackedLight> light = nullptr);

  // Replaces the mesh by the same person at another detail (human::ParseHuman).
  void SetMesh(std::shared_ptr<const human::Human> human,
               std::shared_ptr<const UnpackedLight> light);

  // Computes the person's blockers for a pose. Call it before Update(), and for all people before
  // any of them is updated. Allocates nothing, like all functions below.
  void Pose(std::span<const glm::mat4> skin, const glm::mat4& stage_from_actor);
  const PersonBlockers& blockers() const { return blockers_; }
  // Number of coefficients that Update() needs in `light`.
  int light_count() const { return own_log_.count(); }

  // Computes the light at the receivers of the last pose. others: blockers of other people and
  // objects, stage axes. Lamps with a negligible contribution are skipped. If everything moves and
  // changes gradually, each frame updates the visibility of a third of the receivers in turn; the
  // others are one or two frames old.
  void Update(const light::LightMatrix& light,
              const light::Spheres& others,
              std::span<const light::Lamp> lamps);

  // Computes the irradiance, without albedo, of the vertices in each mesh's level of detail for an
  // allowed error of `detail` metres (render/detail.h). irradiance: all vertices of all meshes,
  // concatenated; the other vertices keep their values. Vertices whose light has changed by less
  // than can be seen keep their values too. If the light changes gradually, each frame updates half
  // of the remaining vertices in turn.
  void LightVertices(float detail, std::span<glm::vec3> irradiance);

 private:
  struct MeshLight {
    std::vector<light::VertexReceivers> receivers;
    std::vector<render::MeshLevel> levels;
    std::vector<glm::vec3> irradiance;  // Last computed values.
    size_t lit = 0;                     // How many of the first vertices have values.
  };

  // Chooses the receivers to update: all of them after jumps, gaps and changes of light.
  light::ReceiverRange ChooseReceivers(const light::LightMatrix& light);
  // Finds the receivers whose light differs visibly from the light that vertices used.
  void FindChanged();
  // Adds the light of lamps at the receivers of the last pose, past the person's own body and
  // others.
  void AddLamps(const light::Spheres& others, std::span<const light::Lamp> lamps);
  // Lights the first `count` vertices of a mesh, or the part of them whose turn it is.
  void LightBlocks(const light::LightVerticesJob& job, size_t count) const;
  void MakeMeshes();
  void FindKeyLogs();
  // The log visibility past the person's own blockers in the last pose, in the bind pose's axes.
  void OwnLog(light::ReceiverRange range, light::ShRows& log) const;

  std::shared_ptr<const human::Human> human_;
  PersonBlockers blockers_;
  PersonReceivers receivers_;
  std::vector<glm::mat4> skin_;
  glm::mat4 stage_from_actor_ = glm::mat4(1.0f);
  std::vector<light::ShRows> key_logs_;  // Log visibility of each key pose.
  light::ShRows own_log_;
  light::ShRows own_stage_log_;
  light::ShRows stage_log_;
  light::ShRowsRgb shadowed_;
  light::ShRowsRgb turned_;
  light::ShRowsRgb lamp_light_;
  std::vector<light::Lamp> near_lamps_;
  std::vector<float> pose_weights_;  // [slot][light::kMaxKeyPoses]
  light::ReceiverLight receiver_light_;
  std::shared_ptr<const UnpackedLight> transfers_;  // Parallel to the human's meshes.
  bool jumped_ = true;  // True if a blocker has jumped since the last Update().
  int poses_ = 0;       // Calls of Pose() since the last Update().
  size_t part_ = 0;     // Index of the part of the receivers that was updated last.
  // Green channel of the last Update()'s light: its mean with each basis function.
  std::array<float, 25> seen_light_{};
  // The light that vertices last used, and which receivers have changed since.
  light::ReceiverLight used_light_;
  std::vector<float> used_weights_;
  std::vector<uint8_t> changed_;  // Bits kChangedNow and kChangedBefore.
  bool gradual_ = false;          // True if the last Update() updated only a part.
  bool odd_blocks_ = false;       // True if the odd blocks of vertices were updated last.
  std::vector<MeshLight> meshes_;
};

}  // namespace lararium::show
