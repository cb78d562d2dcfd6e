#pragma once

// The input for cutting garments and building other parts: a body of the cast in the bind pose
// (arms out and down, as the base mesh is modelled), metres, actor frame: Y up, facing -Z,
// soles at y = 0.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/human/human.h"

namespace lararium::import {

// A named set of quads of the base mesh: "body", or one of the helpers around it that are
// shaped with it and never drawn, such as "helper-tights" (a suit close to trunk, arms and
// legs), "helper-skirt" (a straight one to the ankles) and "helper-hair".
struct BaseGroup {
  std::string name;
  std::vector<std::array<uint32_t, 4>> quads;  // Base vertices, counter-clockwise from outside.
};

// The base mesh in the shape of one person. The indices of base vertices do not depend on the
// shape, so that a vertex is at the same anatomical point of every body.
struct BaseShape {
  std::vector<glm::vec3> positions;  // Positions of all base vertices, including helpers.
  std::vector<std::array<uint8_t, 4>> joints;
  std::vector<glm::vec4> weights;  // The sum is 1.
  std::vector<BaseGroup> groups;

  const BaseGroup* FindGroup(std::string_view name) const;
};

struct FittedBody {
  // Frames are parallel to the actor's. RestPosition(skeleton, "l_shoulder") in
  // editor/import/cast/joint_lookup.h gives positions.
  human::Skeleton skeleton;
  BaseShape base;
  human::SkinnedMesh skin;  // The visible bare body; vertices are doubled at texture seams.
  std::vector<uint32_t> base_of_skin;  // Base vertex of each vertex of `skin`.
  std::vector<human::BodyCapsule> capsules;
  float height = 0.0f;  // Metres to the crown, without hair.
};

// One garment, cut for one body. BuildCast sets mesh.material, the texture indices of material,
// and cloth.mesh.
struct Garment {
  human::SkinnedMesh mesh;
  human::Material material;
  std::optional<human::Texture> colour;
  std::optional<human::Texture> normal;
  std::optional<human::Cloth> cloth;
  // Parallel to the vertices of FittedBody::skin: never visible under this garment. Skin
  // between such vertices is removed.
  std::vector<bool> hidden;
  // Parallel to them too: visible at most from close by, through an opening. Coarser levels of
  // detail omit this skin, because their error may exceed the distance of the cloth above it.
  std::vector<bool> covered;
  std::string credits;  // Authors and licence if the garment is not our own.
};

}  // namespace lararium::import
