#include "editor/import/cast/cast_parts.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include "editor/import/cast/cast_rig.h"
#include "editor/import/cast/cast_shape.h"

namespace lararium::import {
namespace {

struct PartBox {
  glm::vec3 low{1e9f};
  glm::vec3 high{-1e9f};

  void Add(const glm::vec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  glm::vec3 size() const { return high - low; }
};

PartBox BoxBelow(const CastProxy& proxy, std::span<const glm::vec3> base) {
  PartBox box;
  for (const std::array<uint32_t, 3>& corners : proxy.base) {
    for (const uint32_t v : corners) {
      box.Add(base[v]);
    }
  }
  return box;
}

// Offsets scale with the body below the part, axis by axis.
glm::vec3 OffsetScale(const CastProxy& proxy,
                      std::span<const glm::vec3> base,
                      std::span<const glm::vec3> unshaped) {
  const glm::vec3 now = BoxBelow(proxy, base).size();
  const glm::vec3 then = BoxBelow(proxy, unshaped).size();
  glm::vec3 scale(1.0f);
  for (int axis = 0; axis < 3; ++axis) {
    if (then[axis] > 1e-3f) {
      scale[axis] = now[axis] / then[axis];
    }
  }
  return scale;
}

// The two triangles of a quad, divided along its shorter diagonal.
std::array<std::array<int, 3>, 2> CutQuad(const CastFace& face,
                                          std::span<const glm::vec3> positions) {
  const auto distance = [&](int a, int b) {
    return glm::distance(positions[face.vertices[a]], positions[face.vertices[b]]);
  };
  if (distance(0, 2) <= distance(1, 3)) {
    return {{{0, 1, 2}, {0, 2, 3}}};
  }
  return {{{0, 1, 3}, {1, 2, 3}}};
}

// Collects the indexed triangles of some faces, and doubles vertices where texture coordinates
// differ.
class MeshAssembler {
 public:
  MeshAssembler(const CastMesh& mesh) : mesh_(mesh) {}

  void Add(const CastFace& face) {
    if (face.is_triangle()) {
      AddTriangle(face, {0, 1, 2});
      return;
    }
    for (const std::array<int, 3>& corners : CutQuad(face, mesh_.positions)) {
      AddTriangle(face, corners);
    }
  }

  std::vector<uint32_t> source;
  std::vector<glm::vec2> uvs;
  std::vector<uint32_t> indices;

 private:
  void AddTriangle(const CastFace& face, const std::array<int, 3>& corners) {
    const uint32_t a = face.vertices[corners[0]];
    const uint32_t b = face.vertices[corners[1]];
    const uint32_t c = face.vertices[corners[2]];
    if (a == b || b == c || c == a) {
      return;
    }
    for (const int corner : corners) {
      indices.push_back(Vertex(face.vertices[corner], face.uvs[corner]));
    }
  }

  uint32_t Vertex(uint32_t vertex, uint32_t uv) {
    const auto [found, added] =
        doubled_.try_emplace({vertex, uv}, static_cast<uint32_t>(source.size()));
    if (added) {
      source.push_back(vertex);
      const glm::vec2 from_below = mesh_.uvs.empty() ? glm::vec2(0.0f) : mesh_.uvs[uv];
      uvs.emplace_back(from_below.x, 1.0f - from_below.y);
    }
    return found->second;
  }

  const CastMesh& mesh_;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> doubled_;
};

// A point attached to three base vertices moves with them. Negative weights, of points beside
// their triangle, count as 0.
Influences InfluencesOn(const BaseShape& shape,
                        const std::array<uint32_t, 3>& base,
                        const glm::vec3& weights) {
  std::vector<std::pair<uint8_t, float>> all;
  for (int corner = 0; corner < 3; ++corner) {
    for (int k = 0; k < 4; ++k) {
      all.emplace_back(shape.joints[base[corner]][k],
                       std::max(0.0f, weights[corner]) * shape.weights[base[corner]][k]);
    }
  }
  return Strongest(all);
}

CastPiece Assemble(MeshAssembler&& assembled) {
  CastPiece piece;
  piece.source = std::move(assembled.source);
  piece.mesh.uvs = std::move(assembled.uvs);
  piece.mesh.indices = std::move(assembled.indices);
  piece.mesh.albedo.assign(piece.source.size(), glm::vec3(1.0f));
  return piece;
}

constexpr uint32_t kDropped = 0xffffffffu;

template <typename T>
void Compact(std::vector<T>& values, std::span<const uint32_t> kept) {
  if (values.empty()) {
    return;
  }
  std::vector<T> compact;
  compact.reserve(kept.size());
  for (const uint32_t v : kept) {
    compact.push_back(values[v]);
  }
  values = std::move(compact);
}

}  // namespace

std::vector<glm::vec3> FitPositions(const CastProxy& proxy,
                                    std::span<const glm::vec3> base,
                                    std::span<const glm::vec3> unshaped) {
  constexpr float kMetresPerUnit = 0.1f;
  const glm::vec3 scale = kMetresPerUnit * OffsetScale(proxy, base, unshaped);
  std::vector<glm::vec3> positions;
  positions.reserve(proxy.base.size());
  for (size_t v = 0; v < proxy.base.size(); ++v) {
    const glm::vec3& o = proxy.offsets[v];
    glm::vec3 p = scale * glm::vec3(-o.x, o.y, -o.z);
    for (int corner = 0; corner < 3; ++corner) {
      p += proxy.weights[v][corner] * base[proxy.base[v][corner]];
    }
    positions.push_back(p);
  }
  return positions;
}

std::vector<glm::vec3> SmoothNormals(std::span<const glm::vec3> positions,
                                     std::span<const uint32_t> source,
                                     std::span<const uint32_t> indices) {
  const uint32_t count = source.empty() ? 0 : *std::max_element(source.begin(), source.end()) + 1;
  std::vector<glm::vec3> sums(count, glm::vec3(0.0f));
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    const glm::vec3 p[3] = {positions[indices[i]], positions[indices[i + 1]],
                            positions[indices[i + 2]]};
    const glm::vec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
    const float doubled_area = glm::length(cross);
    if (doubled_area < 1e-14f) {
      continue;
    }
    for (int corner = 0; corner < 3; ++corner) {
      const glm::vec3 a = p[(corner + 1) % 3] - p[corner];
      const glm::vec3 b = p[(corner + 2) % 3] - p[corner];
      const float angle = std::atan2(doubled_area, glm::dot(a, b));
      sums[source[indices[i + corner]]] += cross * (angle / doubled_area);
    }
  }
  std::vector<glm::vec3> normals;
  normals.reserve(source.size());
  for (const uint32_t s : source) {
    const float length = glm::length(sums[s]);
    normals.push_back(length > 1e-12f ? sums[s] / length : glm::vec3(0.0f, 1.0f, 0.0f));
  }
  return normals;
}

CastPiece SkinPiece(const CastLibrary& library, const BaseShape& shape) {
  const CastMesh& mesh = library.base().mesh;
  MeshAssembler assembler(mesh);
  for (const CastFace& face : mesh.faces) {
    if (mesh.materials[face.material].name == "body") {
      assembler.Add(face);
    }
  }
  CastPiece piece = Assemble(std::move(assembler));
  piece.mesh.name = "skin";
  for (const uint32_t v : piece.source) {
    piece.base.push_back({v, v, v});
    piece.base_weights.emplace_back(1.0f, 0.0f, 0.0f);
    piece.mesh.positions.push_back(shape.positions[v]);
    piece.mesh.joints.push_back(shape.joints[v]);
    piece.mesh.weights.push_back(shape.weights[v]);
  }
  piece.mesh.normals = SmoothNormals(piece.mesh.positions, piece.source, piece.mesh.indices);
  return piece;
}

CastPiece FitPart(const CastLibrary& library, const CastProxy& proxy, const BaseShape& shape) {
  MeshAssembler assembler(proxy.mesh);
  for (const CastFace& face : proxy.mesh.faces) {
    assembler.Add(face);
  }
  CastPiece piece = Assemble(std::move(assembler));
  piece.mesh.name = proxy.name;
  const std::vector<glm::vec3> positions =
      FitPositions(proxy, shape.positions, UnshapedBase(library));
  for (const uint32_t v : piece.source) {
    piece.base.push_back(proxy.base[v]);
    piece.base_weights.push_back(proxy.weights[v]);
    piece.mesh.positions.push_back(positions[v]);
    const Influences influences = InfluencesOn(shape, proxy.base[v], proxy.weights[v]);
    piece.mesh.joints.push_back(influences.joints);
    piece.mesh.weights.push_back(influences.weights);
  }
  piece.mesh.normals = SmoothNormals(piece.mesh.positions, piece.source, piece.mesh.indices);
  return piece;
}

void RemoveHidden(CastPiece& piece, const std::vector<bool>& hidden) {
  human::SkinnedMesh& mesh = piece.mesh;
  std::vector<uint32_t> index(mesh.positions.size(), kDropped);
  std::vector<uint32_t> kept;
  std::vector<uint32_t> indices;
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const uint32_t* corners = &mesh.indices[i];
    if (hidden[corners[0]] && hidden[corners[1]] && hidden[corners[2]]) {
      continue;
    }
    for (int k = 0; k < 3; ++k) {
      if (index[corners[k]] == kDropped) {
        index[corners[k]] = static_cast<uint32_t>(kept.size());
        kept.push_back(corners[k]);
      }
      indices.push_back(index[corners[k]]);
    }
  }
  mesh.indices = std::move(indices);
  Compact(mesh.positions, kept);
  Compact(mesh.normals, kept);
  Compact(mesh.albedo, kept);
  Compact(mesh.uvs, kept);
  Compact(mesh.joints, kept);
  Compact(mesh.weights, kept);
  Compact(piece.source, kept);
  Compact(piece.base, kept);
  Compact(piece.base_weights, kept);
  Compact(piece.covered, kept);
}

}  // namespace lararium::import
