#pragma once

// The light on one person from frame to frame: distant light as it was baked for key
// poses, less what limbs, other people and things keep off now.
//
// Per receiver (human::LightTransfer): what the person's own blockers hide, against the
// same at the key poses, says which key poses are near and corrects for what is left;
// what others hide comes on top (Ren et al. 2006). Per vertex: the light of its
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

namespace lararium::show {

// Balls in stage axes, metres, as a structure of arrays.
struct SphereSet {
  std::vector<float> x, y, z, radius;

  size_t size() const { return x.size(); }
  void Resize(size_t count);
  void Set(size_t index, const glm::vec3& centre, float ball_radius);
  void Clear();
  void Add(const glm::vec3& centre, float ball_radius);
  void Append(const SphereSet& more);
  light::Spheres spheres() const { return {x, y, z, radius}; }
};

// The transfer vectors of each mesh of a person or thing, as they are read from frame to frame.
using UnpackedLight = std::vector<light::Transfer>;
// Takes them out, so that they are kept once: they are most of a person's memory.
std::shared_ptr<const UnpackedLight> TakeLight(human::LightTransfer& transfer);

class PersonLight {
 public:
  // The human's light transfer must not be empty. light: what was taken out of it; nullptr where
  // nothing was. Meshes are not looked at after this.
  explicit PersonLight(std::shared_ptr<const human::Human> human,
                       std::shared_ptr<const UnpackedLight> light = nullptr);

  // The same person in another detail (human::ParseHuman).
  void SetFigure(std::shared_ptr<const human::Human> human,
                 std::shared_ptr<const UnpackedLight> light);

  // Where the person's blockers are; before Update, and for other people's. Allocates
  // nothing, like all below.
  void Pose(std::span<const glm::mat4> skin, const glm::mat4& stage_from_actor);
  const SphereSet& blockers() const { return blockers_; }
  // The same for somebody whose own blockers are at `seen_from`: what is small from there is
  // one ball, which hides as much as its parts do (Ren et al. 2006, section 5: hierarchies).
  void AppendBlockers(const PersonLight& seen_from, SphereSet& to) const;
  // Coefficients that Update wants its light in.
  int light_count() const { return own_log_.count(); }

  // The light of the stage at the receivers of the last pose. others: blockers that are
  // not the person's own, stage axes. Lamps that give next to nothing are passed over.
  // Where all moves and changes gradually, a third of a person's receivers look anew for what hides
  // their light in each frame, in turn; the others know it as it was one or two frames before.
  void Update(const light::LightMatrix& light,
              const light::Spheres& others,
              std::span<const light::Lamp> lamps);

  // Irradiance, without albedo, of the vertices that each mesh's level of detail takes where
  // `detail` metres may be off (render/detail.h). irradiance: of all vertices of all meshes in
  // a row; the others stay as they are.
  // Vertices whose light has changed by less than can be seen keep it; where all changes
  // gradually, half of the others follow in each frame, in turn.
  void LightVertices(float detail, std::span<glm::vec3> irradiance);

 private:
  // Receivers that follow one joint, next to each other.
  struct Group {
    uint32_t joint = 0;
    size_t begin = 0;
    size_t end = 0;
  };
  // Rotations of receivers, as a structure of arrays.
  struct TurnSet {
    std::vector<float> w, x, y, z;

    light::Turns turns() const { return {w, x, y, z}; }
  };
  struct MeshLight {
    std::vector<light::VertexReceivers> receivers;
    std::vector<render::MeshLevel> levels;
    std::vector<glm::vec3> irradiance;  // as last worked out
    size_t lit = 0;                     // how many of them were
  };

  // Blockers [begin, end) of blockers_, and the one ball for them.
  struct BlockerGroup {
    size_t begin = 0;
    size_t end = 0;
    glm::vec3 centre = glm::vec3(0.0f);
    float radius = 0.0f;
    float extent = 0.0f;  // of a ball about the centre that holds all
  };

  void GroupBlockers();
  void MergeGroups();
  void OrderReceivers();
  // Where receivers are with the joints of the last pose, and how they are turned.
  void PlaceReceivers();
  light::Points points() const { return {stage_points_.x, stage_points_.y, stage_points_.z}; }
  // Which receivers look anew: all of them after leaps, gaps and changes of light.
  light::ReceiverRange ChooseReceivers(const light::LightMatrix& light);
  // What of receiver_light_ differs from what vertices were lit by, by more than is not seen.
  void FindChanged();
  // Lamps as seen from the receivers of the last pose, past their own body and others.
  void AddLamps(const light::Spheres& others, std::span<const light::Lamp> lamps);
  // The first `count` vertices of a mesh, or those of them whose turn it is.
  void LightBlocks(const light::LightVerticesJob& job, size_t count) const;
  void MakeMeshes();
  void FindKeyLogs();
  // The log visibility past own blockers, as posed, in the bind pose's axes.
  void OwnLog(light::ReceiverRange range, light::ShRows& log) const;

  std::shared_ptr<const human::Human> human_;
  std::vector<Group> groups_;
  std::vector<uint16_t> slots_;          // of each receiver of the human
  SphereSet bind_points_;                // receivers, bind pose; radius unused
  SphereSet stage_points_;               // receivers of the last pose
  TurnSet stage_from_bind_;              // likewise: rotations of their joints
  std::vector<uint32_t> blocker_order_;  // those of one group next to each other
  std::vector<BlockerGroup> blocker_groups_;
  SphereSet blockers_;  // of the last pose, stage, in blocker_order_
  glm::vec3 low_ = glm::vec3(0.0f), high_ = glm::vec3(0.0f);  // a box that holds them
  std::vector<glm::mat4> skin_;
  glm::mat4 stage_from_actor_ = glm::mat4(1.0f);
  std::vector<light::ShRows> key_logs_;  // of each key pose
  light::ShRows own_log_;
  light::ShRows own_stage_log_;
  light::ShRows stage_log_;
  light::ShRowsRgb shadowed_;
  light::ShRowsRgb turned_;
  light::ShRowsRgb lamp_light_;
  std::vector<light::Lamp> near_lamps_;
  std::vector<float> pose_weights_;  // [slot][light::kMaxKeyPoses]
  light::ReceiverLight receiver_light_;
  std::shared_ptr<const UnpackedLight> transfers_;  // of each mesh
  bool leapt_ = true;                               // since the last Update
  int poses_ = 0;                                   // likewise
  size_t part_ = 0;                                 // of the receivers that looked anew last
  std::array<float, 25> seen_light_{};  // of the last Update: its mean with each basis function
  // What vertices were lit by, and whether that is new.
  light::ReceiverLight used_light_;
  std::vector<float> used_weights_;
  std::vector<uint8_t> changed_;  // bits
  bool gradual_ = false;          // in the last Update
  bool odd_blocks_ = false;       // of vertices were the last to follow
  std::vector<MeshLight> meshes_;
};

}  // namespace lararium::show
