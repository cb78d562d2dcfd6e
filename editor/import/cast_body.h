#pragma once

// A body of the cast as the cutters of garments and the builders of its other parts
// take it. Everything is in the bind pose (arms out and down, as the base mesh is
// modelled), metres, actor frame: Y up, facing -Z, soles at y = 0.

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

// A named set of quads of the base mesh: "body", or one of the helpers around it that
// are shaped with it and never drawn: "helper-tights" (a suit close to trunk, arms and
// legs), "helper-skirt" (a straight one to the ankles), "helper-hair", ...
struct BaseGroup {
  std::string name;
  std::vector<std::array<uint32_t, 4>> quads;  // base vertices, outward faces anticlockwise
};

// The base mesh in the shape of one person. Base vertices keep their ids whatever the
// shape, so that a place on one body is the same place on every other.
struct BaseShape {
  std::vector<glm::vec3> positions;  // of every base vertex, helpers included
  std::vector<std::array<uint8_t, 4>> joints;
  std::vector<glm::vec4> weights;  // sum 1
  std::vector<BaseGroup> groups;

  const BaseGroup* FindGroup(std::string_view name) const;
};

struct FittedBody {
  human::Skeleton skeleton;  // frames parallel to the actor's; editor/import/plain_skeleton.h
                             // has RestPosition(skeleton, "l_shoulder")
  BaseShape base;
  human::SkinnedMesh skin;  // the bare body that is drawn: vertices doubled at texture seams
  std::vector<uint32_t> base_of_skin;  // base vertex of each vertex of skin
  std::vector<human::BodyCapsule> capsules;
  float height = 0.0f;  // metres, of the crown without hair
};

// One garment, cut for one body. The builder of the cast sets mesh.material,
// the texture indices of material, and cloth.mesh.
struct Garment {
  human::SkinnedMesh mesh;
  human::Material material;
  std::optional<human::Texture> colour;
  std::optional<human::Texture> normal;
  std::optional<human::Cloth> cloth;
  // Of each vertex of FittedBody::skin: never seen under this garment. Skin between
  // such vertices is left out.
  std::vector<bool> hidden;
  // Likewise: seen at most from close by, through an opening. Coarser levels of detail go
  // without that skin, for they may be further off than cloth lies above it.
  std::vector<bool> covered;
  std::string credits;  // where it is not our own
};

}  // namespace lararium::import
