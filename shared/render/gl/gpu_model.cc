#include "shared/render/gl/gpu_model.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_precision.hpp>
#include <glm/gtx/component_wise.hpp>
#include <string>

#include "shared/core/check.h"
#include "shared/render/detail.h"
#include "shared/render/passes/closed_surface.h"

namespace lararium::render {
namespace {

// Share of unshadowed light on the back of a sheet whose light was not baked. Most backs face
// something near.
constexpr std::array<uint8_t, 4> kBack = {128, 128, 128, 0};

// Constant attributes of a vertex. Albedo and weights are in units of 1/65535.
struct Attributes {
  glm::u16vec4 albedo;  // w is unused
  glm::u16vec4 weights;
  glm::vec2 uv;
  std::array<uint8_t, 4> joints;
  std::array<uint8_t, 4> back = kBack;
};

Attributes AttributesOf(const glm::vec3& albedo,
                        const glm::vec4& weights,
                        const glm::vec2& uv,
                        const std::array<uint8_t, 4>& joints) {
  const auto share = [](const glm::vec4& of) {
    return glm::u16vec4(glm::round(65535.0f * glm::clamp(of, 0.0f, 1.0f)));
  };
  return {share(glm::vec4(albedo, 0.0f)), share(weights), uv, joints};
}

// The arrays of one part, of a human or a prop.
struct PartSource {
  std::span<const glm::vec3> positions;
  std::span<const glm::vec3> normals;
  std::vector<Attributes> attributes;
  struct Level {
    std::span<const uint32_t> indices;
    float error = 0.0f;
    size_t vertices = 0;
  };
  std::vector<Level> levels;
  int16_t material = human::Material::kNone;
};

void DefineFloats(GLuint location, int count, size_t stride, size_t offset) {
  glVertexAttribPointer(location, count, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride),
                        reinterpret_cast<const void*>(offset));
  glEnableVertexAttribArray(location);
}

// Declares an attribute in units of 1/65535.
void DefineShares(GLuint location, int count, size_t stride, size_t offset) {
  glVertexAttribPointer(location, count, GL_UNSIGNED_SHORT, GL_TRUE, static_cast<GLsizei>(stride),
                        reinterpret_cast<const void*>(offset));
  glEnableVertexAttribArray(location);
}

void DefineAttributes() {
  constexpr size_t kStride = sizeof(Attributes);
  DefineShares(2, 3, kStride, offsetof(Attributes, albedo));
  DefineFloats(5, 2, kStride, offsetof(Attributes, uv));
  glVertexAttribIPointer(3, 4, GL_UNSIGNED_BYTE, kStride,
                         reinterpret_cast<const void*>(offsetof(Attributes, joints)));
  glEnableVertexAttribArray(3);
  DefineShares(4, 4, kStride, offsetof(Attributes, weights));
  glVertexAttribPointer(8, 3, GL_UNSIGNED_BYTE, GL_TRUE, kStride,
                        reinterpret_cast<const void*>(offsetof(Attributes, back)));
  glEnableVertexAttribArray(8);
}

// Replaces the whole content of a buffer. If its size stays the same, drivers that use the main
// memory reuse it instead of allocating.
void Upload(const GlBuffer& buffer, std::span<const glm::vec3> data, GLenum use) {
  glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(data.size_bytes()), data.data(), use);
}

GpuModel::Vertices CreateVertices() { return {GlBuffer::Generate(), GlBuffer::Generate()}; }

void Upload(const GpuModel::Vertices& vertices,
            std::span<const glm::vec3> positions,
            std::span<const glm::vec3> normals,
            GLenum use) {
  Upload(vertices.positions, positions, use);
  Upload(vertices.normals, normals, use);
}

GlVertexArray CreateVertexArray(const GpuModel::Part& part, const GpuModel::Vertices& vertices) {
  GlVertexArray array = GlVertexArray::Generate();
  glBindVertexArray(array.id());
  glBindBuffer(GL_ARRAY_BUFFER, vertices.positions.id());
  DefineFloats(0, 3, sizeof(glm::vec3), 0);
  glBindBuffer(GL_ARRAY_BUFFER, vertices.normals.id());
  DefineFloats(1, 3, sizeof(glm::vec3), 0);
  glBindBuffer(GL_ARRAY_BUFFER, part.attributes.id());
  DefineAttributes();
  glBindBuffer(GL_ARRAY_BUFFER, part.irradiance.id());
  DefineFloats(6, 3, sizeof(glm::vec3), 0);
  // Normals of the bind pose: light transfer was baked for them.
  glBindBuffer(GL_ARRAY_BUFFER, part.bind_vertices.normals.id());
  DefineFloats(7, 3, sizeof(glm::vec3), 0);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, part.indices.id());
  glBindVertexArray(0);
  return array;
}

// Index is uint16_t if the number of vertices allows it, which halves the memory.
template <typename Index>
void UploadIndices(const PartSource& source, GpuModel::Part& part) {
  std::vector<Index> indices;
  for (const PartSource::Level& level : source.levels) {
    part.levels.push_back(
        {indices.size(), static_cast<int>(level.indices.size()), level.error, level.vertices});
    indices.insert(indices.end(), level.indices.begin(), level.indices.end());
  }
  // WebGL wants indices under this target from the beginning, which belongs to a vertex array.
  const GlVertexArray array = GlVertexArray::Generate();
  glBindVertexArray(array.id());
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, part.indices.id());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(Index)),
               indices.data(), GL_STATIC_DRAW);
  glBindVertexArray(0);
}

void ApplyMaterial(const human::Material& material, GpuModel::Part& part) {
  part.surface = material.surface;
  part.colour = material.colour;
  part.roughness = material.roughness;
  part.alpha_cutoff = material.alpha_cutoff;
}

float LongestSide(std::span<const glm::vec3> positions) {
  Box box;
  for (const glm::vec3& position : positions) {
    box.Extend(position);
  }
  return box.empty() ? 0.0f : glm::compMax(box.high - box.low);
}

GpuModel::Part CreatePart(const PartSource& source, std::span<const human::Material> materials) {
  GpuModel::Part part;
  part.length = LongestSide(source.positions);
  part.vertex_count = source.positions.size();
  part.attributes = GlBuffer::Generate();
  part.bind_vertices = CreateVertices();
  part.indices = GlBuffer::Generate();
  part.irradiance = GlBuffer::Generate();
  glBindBuffer(GL_ARRAY_BUFFER, part.irradiance.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(part.vertex_count * sizeof(glm::vec3)),
               nullptr, GL_STREAM_DRAW);
  bool two_sided = true;
  if (source.material != human::Material::kNone) {
    ApplyMaterial(materials[static_cast<size_t>(source.material)], part);
    two_sided = materials[static_cast<size_t>(source.material)].two_sided;
  }
  // Back faces of a closed surface are never visible, even if its material is two-sided.
  part.culls_back_faces =
      !two_sided ||
      (!part.covered() && IsClosedSurface(source.positions, source.levels.front().indices));
  if (part.short_indices()) {
    UploadIndices<uint16_t>(source, part);
  } else {
    UploadIndices<uint32_t>(source, part);
  }
  glBindBuffer(GL_ARRAY_BUFFER, part.attributes.id());
  glBufferData(GL_ARRAY_BUFFER,
               static_cast<GLsizeiptr>(source.attributes.size() * sizeof(Attributes)),
               source.attributes.data(), GL_STATIC_DRAW);
  Upload(part.bind_vertices, source.positions, source.normals, GL_STATIC_DRAW);
  part.bind_pose = CreateVertexArray(part, part.bind_vertices);
  return part;
}

PartSource Source(const human::Human& human, size_t index) {
  const human::SkinnedMesh& mesh = human.meshes[index];
  const std::vector<MeshLevel> levels = FindMeshLevels(human, index);
  PartSource source{mesh.positions,
                    mesh.normals,
                    {},
                    {{mesh.indices, levels.front().error, levels.front().vertices}},
                    mesh.material};
  source.attributes.resize(mesh.positions.size());
  for (size_t v = 0; v < source.attributes.size(); ++v) {
    source.attributes[v] =
        AttributesOf(mesh.albedo[v], mesh.weights[v],
                     mesh.uvs.empty() ? glm::vec2(0.0f) : mesh.uvs[v], mesh.joints[v]);
  }
  for (size_t i = 0; i < mesh.coarser.size(); ++i) {
    source.levels.push_back({mesh.coarser[i].indices, levels[i + 1].error, levels[i + 1].vertices});
  }
  return source;
}

PartSource Source(const stage::PropMesh& mesh, uint8_t joint) {
  PartSource source{mesh.positions,
                    mesh.normals,
                    {},
                    {{mesh.indices, 0.0f, mesh.positions.size()}},
                    mesh.material};
  source.attributes.resize(mesh.positions.size());
  for (size_t v = 0; v < source.attributes.size(); ++v) {
    source.attributes[v] = AttributesOf(mesh.albedo[v], {1.0f, 0.0f, 0.0f, 0.0f},
                                        mesh.uvs.empty() ? glm::vec2(0.0f) : mesh.uvs[v],
                                        {joint, joint, joint, joint});
  }
  const float share = human::ErrorShare(human::Surface::kPlain);
  for (const human::LevelOfDetail& level : mesh.coarser) {
    source.levels.push_back({level.indices, share * level.error, mesh.positions.size()});
  }
  return source;
}

// light: one entry for each source, or empty.
void SetBacks(std::span<const human::LightTransfer::Mesh> light, std::span<PartSource> sources) {
  for (size_t i = 0; i < light.size(); ++i) {
    for (size_t v = 0; v < light[i].backs.size(); ++v) {
      const std::array<uint8_t, 3>& back = light[i].backs[v];
      sources[i].attributes[v].back = {back[0], back[1], back[2], 0};
    }
  }
}

// The textures that the materials of a model use. A texture has one entry for each use.
class TextureList {
 public:
  // owner: the human or prop that owns the textures; it must outlive this object.
  template <typename Owner>
  explicit TextureList(const Owner& owner) : place_(owner.name), textures_(owner.textures) {}

  // Returns the index of a texture in sources(); adds it if it is new.
  int Want(int16_t texture, TextureUse use) {
    if (texture == human::Material::kNone) {
      return GpuModel::kNoTexture;
    }
    const std::shared_ptr<const human::Texture>& wanted = textures_[static_cast<size_t>(texture)];
    auto found = std::find_if(sources_.begin(), sources_.end(), [&](const TextureSource& source) {
      return source.texture == wanted && source.use == use;
    });
    if (found == sources_.end()) {
      sources_.push_back({wanted, use, place_ + ": texture '" + wanted->name + "'"});
      found = sources_.end() - 1;
    }
    return static_cast<int>(found - sources_.begin());
  }

  std::span<const TextureSource> sources() const { return sources_; }

 private:
  std::string place_;
  std::span<const std::shared_ptr<const human::Texture>> textures_;
  std::vector<TextureSource> sources_;
};

Status AddParts(std::span<const PartSource> sources,
                std::span<const human::Material> materials,
                TextureList wanted,
                TextureStore& textures,
                GpuModel& model) {
  for (const PartSource& source : sources) {
    const size_t first_vertex = model.vertex_count();
    GpuModel::Part& part = model.parts.emplace_back(CreatePart(source, materials));
    part.first_vertex = first_vertex;
    if (source.material != human::Material::kNone) {
      const human::Material& material = materials[static_cast<size_t>(source.material)];
      part.colour_texture = wanted.Want(material.colour_texture, TextureUse::kColour);
      part.normal_texture = wanted.Want(material.normal_texture, TextureUse::kNormal);
    }
  }
  LARARIUM_ASSIGN_OR_RETURN(model.textures, textures.Load(wanted.sources()));
  return Status();
}

// The largest displacement by morph targets of each vertex of each mesh, along each axis.
std::vector<std::vector<glm::vec3>> MorphReach(const human::Human& human) {
  std::vector<std::vector<glm::vec3>> reach;
  for (const human::SkinnedMesh& mesh : human.meshes) {
    reach.emplace_back(mesh.positions.size(), glm::vec3(0.0f));
  }
  for (const human::MorphTarget& morph : human.morphs) {
    for (const human::MorphTarget::Part& part : morph.parts) {
      for (size_t i = 0; i < part.vertices.size(); ++i) {
        reach[part.mesh][part.vertices[i]] += glm::abs(part.position_deltas[i]);
      }
    }
  }
  return reach;
}

void ExtendJointBoxes(const human::SkinnedMesh& mesh,
                      std::span<const glm::vec3> reach,
                      std::vector<Box>& boxes) {
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    for (int i = 0; i < 4; ++i) {
      if (mesh.weights[v][i] > 0.0f) {
        boxes[mesh.joints[v][i]].Extend(mesh.positions[v] - reach[v]);
        boxes[mesh.joints[v][i]].Extend(mesh.positions[v] + reach[v]);
      }
    }
  }
}

// Widens boxes for dual quaternions: between two joints they move a vertex on an arc, which leaves
// the convex hull of both boxes.
void WidenForArcs(std::vector<Box>& boxes) {
  constexpr float kShare = 0.25f;  // margin as a share of the box's diagonal
  for (Box& box : boxes) {
    if (!box.empty()) {
      const glm::vec3 margin(kShare * glm::distance(box.low, box.high));
      box.low -= margin;
      box.high += margin;
    }
  }
}

}  // namespace

Result<GpuModel> GpuModel::Create(const std::shared_ptr<const human::Human>& added,
                                  TextureStore& textures) {
  const human::Human& human = *added;
  GpuModel model;
  const bool dual = human.skinning == human::Skinning::kDualQuaternion;
  model.skin = dual ? Skin::kDualQuaternion : Skin::kLinear;
  std::vector<PartSource> sources;
  for (size_t i = 0; i < human.meshes.size(); ++i) {
    sources.push_back(Source(human, i));
  }
  SetBacks(human.light.meshes, sources);
  LARARIUM_RETURN_IF_ERROR(
      AddParts(sources, human.materials, TextureList(*added), textures, model));
  model.joint_boxes.resize(human.skeleton.size());
  const auto reach = MorphReach(human);
  for (size_t i = 0; i < human.meshes.size(); ++i) {
    ExtendJointBoxes(human.meshes[i], reach[i], model.joint_boxes);
  }
  if (dual) {
    WidenForArcs(model.joint_boxes);
  }
  return model;
}

Result<GpuModel> GpuModel::Create(const std::shared_ptr<const stage::Prop>& added,
                                  TextureStore& textures) {
  const stage::Prop& prop = *added;
  GpuModel model;
  model.skin = Skin::kRigid;
  std::vector<PartSource> sources;
  std::vector<glm::vec3> emissions;
  std::vector<uint8_t> prop_parts;
  model.joint_boxes.resize(prop.parts.size());
  for (size_t joint = 0; joint < prop.parts.size(); ++joint) {
    for (const stage::PropMesh& mesh : prop.parts[joint].meshes) {
      sources.push_back(Source(mesh, static_cast<uint8_t>(joint)));
      emissions.push_back(mesh.emission);
      prop_parts.push_back(static_cast<uint8_t>(joint));
      for (const glm::vec3& position : mesh.positions) {
        model.joint_boxes[joint].Extend(position);
      }
    }
  }
  SetBacks(prop.light.meshes, sources);
  LARARIUM_RETURN_IF_ERROR(AddParts(sources, prop.materials, TextureList(*added), textures, model));
  for (size_t i = 0; i < emissions.size(); ++i) {
    model.parts[i].emission = emissions[i];
    model.parts[i].prop_part = prop_parts[i];
  }
  return model;
}

void GpuModel::Stream(size_t part_index,
                      uint64_t picture,
                      std::span<const glm::vec3> positions,
                      std::span<const glm::vec3> normals) {
  Part& part = parts[part_index];
  CHECK(positions.size() == part.vertex_count && normals.size() == part.vertex_count);
  const Sent sent = {picture, positions.data(), positions.size()};
  if (part.sent_vertices == sent) {
    return;
  }
  if (part.streamed.id() == 0) {
    part.streamed_vertices = CreateVertices();
    part.streamed = CreateVertexArray(part, part.streamed_vertices);
  }
  Upload(part.streamed_vertices, positions, normals, GL_STREAM_DRAW);
  part.sent_vertices = sent;
}

void GpuModel::StreamIrradiance(size_t part_index,
                                uint64_t picture,
                                std::span<const glm::vec3> irradiance) {
  Part& part = parts[part_index];
  CHECK(irradiance.size() <= part.vertex_count);
  const Sent sent = {picture, irradiance.data(), irradiance.size()};
  if (part.sent_irradiance != sent) {
    Upload(part.irradiance, irradiance, GL_STREAM_DRAW);
    part.sent_irradiance = sent;
  }
}

void GpuModel::Draw(size_t part_index, float allowed_error, bool streamed) const {
  const Part& part = parts[part_index];
  const Part::Level& drawn = LevelAllowed(part.levels, allowed_error);
  glBindVertexArray(streamed ? part.streamed.id() : part.bind_pose.id());
  const GLenum type = part.short_indices() ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT;
  const size_t size = part.short_indices() ? sizeof(uint16_t) : sizeof(uint32_t);
  glDrawElements(GL_TRIANGLES, drawn.count, type,
                 reinterpret_cast<const void*>(drawn.first * size));
}

}  // namespace lararium::render
