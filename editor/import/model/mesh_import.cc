#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>

#include "editor/import/model/model_import.h"
#include "editor/import/model/model_isolation.h"
#include "editor/import/model/model_scene.h"
#include "editor/import/model/survey_offset.h"

namespace lararium::import {
namespace {

constexpr size_t kMaxMeshVertices = 2'000'000;

using Bytes = std::vector<std::byte>;

struct MergedMesh {
  std::vector<glm::dvec3> positions;
  std::vector<uint32_t> indices;
  std::vector<std::string> notes;
};

// The positions of a mesh in the scene. Bones move it as they are at rest (linear blend skinning);
// vertices without weights, and meshes without bones, follow the node of the mesh.
std::vector<glm::dvec3> PositionsInScene(const aiMesh& mesh,
                                         size_t node,
                                         const SceneNodes& nodes,
                                         std::span<const glm::mat4> scene_from_node) {
  std::vector<glm::dvec3> sums(mesh.mNumVertices, glm::dvec3(0.0));
  std::vector<double> weights(mesh.mNumVertices, 0.0);
  const auto add = [&](const glm::dmat4& scene_from_mesh, unsigned vertex, double weight) {
    sums[vertex] +=
        weight * glm::dvec3(scene_from_mesh * glm::dvec4(ToGlm(mesh.mVertices[vertex]), 1.0));
    weights[vertex] += weight;
  };
  for (const aiBone* bone : std::span(mesh.mBones, mesh.mNumBones)) {
    const int found = nodes.Find(bone->mName);
    if (found == SceneNodes::kNoParent) {
      continue;
    }
    const glm::dmat4 scene_from_mesh = glm::dmat4(scene_from_node[static_cast<size_t>(found)]) *
                                       glm::dmat4(ToGlm(bone->mOffsetMatrix));
    for (const aiVertexWeight& weight : std::span(bone->mWeights, bone->mNumWeights)) {
      if (weight.mVertexId < mesh.mNumVertices && weight.mWeight > 0.0f) {
        add(scene_from_mesh, weight.mVertexId, static_cast<double>(weight.mWeight));
      }
    }
  }
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    if (weights[v] > 0.0) {
      sums[v] /= weights[v];
    } else {
      add(glm::dmat4(scene_from_node[node]), v, 1.0);
    }
  }
  return sums;
}

Result<MergedMesh> Merge(const ModelScene& model) {
  const SceneNodes& nodes = model.nodes;
  std::vector<glm::mat4> scene_from_node(nodes.size());
  nodes.Globals(nodes.local, scene_from_node);
  MergedMesh merged;
  merged.notes = model.notes.structure;
  for (size_t n = 0; n < nodes.size(); ++n) {
    for (unsigned i = 0; i < nodes.nodes[n]->mNumMeshes; ++i) {
      const aiMesh& mesh = *model.scene->mMeshes[nodes.nodes[n]->mMeshes[i]];
      const auto first = static_cast<uint32_t>(merged.positions.size());
      if (first + size_t{mesh.mNumVertices} > kMaxMeshVertices) {
        return Status::Error(
            model.place(), "there are more than " + std::to_string(kMaxMeshVertices) + " vertices");
      }
      const std::vector<glm::dvec3> positions = PositionsInScene(mesh, n, nodes, scene_from_node);
      merged.positions.insert(merged.positions.end(), positions.begin(), positions.end());
      for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        const aiFace& face = mesh.mFaces[f];
        for (unsigned k = 0; face.mNumIndices == 3 && k < 3; ++k) {
          merged.indices.push_back(first + face.mIndices[k]);
        }
      }
    }
  }
  return merged;
}

// Moves a mesh in survey coordinates near the origin, unless its reader has.
void MoveNear(glm::dvec3 offset, MergedMesh& merged) {
  const bool is_exact = offset != glm::dvec3(0.0);
  if (!is_exact) {
    offset = SurveyOffset(merged.positions);
    for (glm::dvec3& position : merged.positions) {
      position -= offset;
    }
  }
  if (offset == glm::dvec3(0.0)) {
    return;
  }
  char text[512];
  std::snprintf(text, sizeof(text),
                "its coordinates are those of a survey; (%.0f, %.0f, %.0f) is taken off them, so "
                "that it lies near the origin: place it with model points, or with --at",
                offset.x, offset.y, offset.z);
  merged.notes.emplace_back(text);
  const auto largest =
      static_cast<float>(std::max({std::abs(offset.x), std::abs(offset.y), std::abs(offset.z)}));
  if (!is_exact) {
    std::snprintf(text, sizeof(text),
                  "its coordinates are rounded to %.2f, because its format has no more digits: "
                  "export it near the origin, or as OBJ or PLY with all digits",
                  std::nextafter(largest, std::numeric_limits<float>::max()) - largest);
    merged.notes.emplace_back(text);
  }
}

template <typename T>
void Append(const std::vector<T>& values, Bytes& bytes) {
  const uint64_t size = values.size();
  const auto head = std::as_bytes(std::span(&size, 1));
  const auto body = std::as_bytes(std::span(values));
  bytes.insert(bytes.end(), head.begin(), head.end());
  bytes.insert(bytes.end(), body.begin(), body.end());
}

template <typename T>
bool Take(std::span<const std::byte>& bytes, std::vector<T>& values) {
  uint64_t size = 0;
  if (bytes.size() < sizeof(size)) {
    return false;
  }
  std::memcpy(&size, bytes.data(), sizeof(size));
  bytes = bytes.subspan(sizeof(size));
  if (size > bytes.size() / sizeof(T)) {
    return false;
  }
  values.resize(size);
  if (size > 0) {
    std::memcpy(static_cast<void*>(values.data()), bytes.data(), size * sizeof(T));
  }
  bytes = bytes.subspan(size * sizeof(T));
  return true;
}

Result<Bytes> ReadInChild(const std::filesystem::path& file) {
  glm::dvec3 offset(0.0);
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<ModelScene> model, ReadModelScene(file, &offset));
  LARARIUM_ASSIGN_OR_RETURN(MergedMesh merged, Merge(*model));
  MoveNear(offset, merged);
  std::vector<glm::vec3> positions(merged.positions.begin(), merged.positions.end());
  Bytes bytes;
  Append(positions, bytes);
  Append(merged.indices, bytes);
  for (const std::string& note : merged.notes) {
    Append(std::vector<char>(note.begin(), note.end()), bytes);
  }
  return bytes;
}

}  // namespace

Result<geometry::TriangleMesh> ImportMesh(const std::filesystem::path& file,
                                          std::vector<std::string>& notes) {
  const std::string where = file.string();
  LARARIUM_ASSIGN_OR_RETURN(const Bytes packed,
                            RunInChild(where, [&] { return ReadInChild(file); }));
  std::span<const std::byte> bytes(packed);
  geometry::TriangleMesh mesh;
  if (!Take(bytes, mesh.positions) || !Take(bytes, mesh.indices) ||
      mesh.positions.size() > kMaxMeshVertices) {
    return Status::Error(where, "its reader returned invalid data");
  }
  for (std::vector<char> note; Take(bytes, note);) {
    notes.emplace_back(note.begin(), note.end());
  }
  if (mesh.indices.empty()) {
    return Status::Error(where, "there is no triangle in it");
  }
  LARARIUM_RETURN_IF_ERROR(mesh.Validate(where));
  geometry::ComputeNormals(mesh);
  return mesh;
}

}  // namespace lararium::import
