#include "editor/import/model/model_meshes.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <utility>

#include "editor/import/model/model_matrix.h"
#include "shared/human/finite.h"

namespace lararium::import {
namespace {

glm::vec3 ColourOf(const aiMesh& mesh, size_t vertex) {
  if (!mesh.HasVertexColors(0)) {
    return glm::vec3(1.0f);
  }
  const aiColor4D& c = mesh.mColors[0][vertex];
  const glm::vec3 colour(c.r, c.g, c.b);
  return human::Finite(colour) ? glm::clamp(colour, 0.0f, 1.0f) : glm::vec3(1.0f);
}

bool IsColour(const aiColor4D& c) {
  constexpr float kRounding = 1e-3f;
  const glm::vec3 colour(c.r, c.g, c.b);
  return human::Finite(colour) &&
         glm::all(glm::lessThan(glm::abs(colour - 0.5f), glm::vec3(0.5f + kRounding)));
}

void TellInvalid(std::span<const Part> parts, std::vector<std::string>& notes) {
  size_t colours = 0, uvs = 0, normals = 0, skins = 0;
  for (const Part& part : parts) {
    const aiMesh& mesh = *part.mesh;
    skins += part.cut_skins;
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      colours += mesh.HasVertexColors(0) && !IsColour(mesh.mColors[0][v]);
      uvs += mesh.HasTextureCoords(0) && !human::Finite(ToGlm(mesh.mTextureCoords[0][v]));
      normals += !(glm::length(ToGlm(mesh.mNormals[v])) > 1e-6f);
    }
  }
  for (const auto& [count, what] :
       {std::pair{colours, "a colour outside 0 to 1, which is cut to it, or white if no number"},
        {uvs, "texture coordinates that are no numbers and become 0"},
        {normals, "a normal without a direction, which points upwards"},
        {skins, "more than four bones, of which the four strongest are taken"}}) {
    if (count > 0) {
      notes.push_back("vertices with " + std::string(what) + ": " + std::to_string(count));
    }
  }
}

void AddSkin(const Influences& influences,
             const ModelSkeleton& skeleton,
             human::SkinnedMesh& skinned) {
  std::array<uint8_t, 4> joints = {};
  glm::vec4 weights(0.0f);
  for (size_t k = 0; k < influences.size(); ++k) {
    if (influences[k].weight > 0.0f) {
      const auto node = static_cast<size_t>(influences[k].node);
      joints[k] = static_cast<uint8_t>(skeleton.joint_of_node[node]);
      weights[static_cast<int>(k)] = influences[k].weight;
    }
  }
  skinned.joints.push_back(joints);
  skinned.weights.push_back(weights);
}

// Assimp counts v from the bottom.
void AddUvs(const aiMesh& mesh, human::SkinnedMesh& skinned) {
  if (!mesh.HasTextureCoords(0)) {
    return;
  }
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    const glm::vec2 uv(mesh.mTextureCoords[0][v].x, 1.0f - mesh.mTextureCoords[0][v].y);
    skinned.uvs.push_back(human::Finite(uv) ? uv : glm::vec2(0.0f));
  }
}

void AddTriangles(const Part& part, human::SkinnedMesh& skinned) {
  for (unsigned f = 0; f < part.mesh->mNumFaces; ++f) {
    const aiFace& face = part.mesh->mFaces[f];
    if (face.mNumIndices == 3) {
      const unsigned* i = face.mIndices;
      skinned.indices.insert(skinned.indices.end(),
                             {i[0], i[part.mirrored ? 2 : 1], i[part.mirrored ? 1 : 2]});
    }
  }
}

}  // namespace

std::vector<human::SkinnedMesh> BuildMeshes(std::span<const Part> parts,
                                            const ModelSkeleton& skeleton,
                                            const ModelSurfaces& surfaces,
                                            std::vector<std::string>& notes) {
  TellInvalid(parts, notes);
  const glm::mat4& actor_from_scene = skeleton.actor_from_scene;
  std::vector<human::SkinnedMesh> meshes;
  for (const Part& part : parts) {
    const aiMesh& mesh = *part.mesh;
    human::SkinnedMesh skinned;
    skinned.name = part.name;
    if (mesh.mMaterialIndex < surfaces.material_of.size()) {
      skinned.material = surfaces.material_of[mesh.mMaterialIndex];
    }
    const glm::vec3 colour = skinned.material == human::Material::kNone
                                 ? glm::vec3(1.0f)
                                 : surfaces.vertex_colours[static_cast<size_t>(skinned.material)];
    for (size_t v = 0; v < part.positions.size(); ++v) {
      skinned.positions.push_back(Apply(actor_from_scene, part.positions[v]));
      skinned.normals.push_back(Unit(glm::mat3(actor_from_scene) * part.normals[v]));
      skinned.albedo.push_back(colour * ColourOf(mesh, v));
      AddSkin(part.influences[v], skeleton, skinned);
    }
    AddUvs(mesh, skinned);
    AddTriangles(part, skinned);
    meshes.push_back(std::move(skinned));
  }
  return meshes;
}

}  // namespace lararium::import
