// Reading and writing .larhuman files.

#include <algorithm>

#include "shared/core/check.h"
#include "shared/core/file.h"
#include "shared/core/flatbuffer_blocks.h"
#include "shared/human/human.h"
#include "shared/human/human_generated.h"
#include "shared/human/material_blocks.h"

namespace lararium::human {
namespace {

constexpr uint32_t kVersion = 3;
constexpr char kRemedy[] = "bake or export it again";

glm::quat ReadQuaternion(const fb::Quaternion& q) { return glm::quat(q.w(), q.x(), q.y(), q.z()); }

void ReadTransforms(const flatbuffers::Vector<const fb::JointTransform*>* from,
                    BlockReader& reader,
                    std::vector<JointTransform>& to) {
  if (from != nullptr && reader.Take(from->size() * sizeof(fb::JointTransform))) {
    to.reserve(from->size());
    for (const fb::JointTransform* item : *from) {
      to.push_back({ReadQuaternion(item->rotation()), ReadVec3(&item->translation()),
                    ReadVec3(&item->scale())});
    }
  }
}

void ReadTurns(const flatbuffers::Vector<const fb::JointTurn*>* from,
               BlockReader& reader,
               std::vector<FaceShape::Turn>& to) {
  if (from != nullptr && reader.Take(from->size() * sizeof(fb::JointTurn))) {
    for (const fb::JointTurn* item : *from) {
      to.push_back({item->joint(), ReadQuaternion(item->rotation())});
    }
  }
}

void ReadSkeleton(const fb::Skeleton* from, BlockReader& reader, Skeleton& to) {
  if (from != nullptr) {
    reader.Read(from->names(), to.names);
    reader.Read(from->parents(), to.parents);
    ReadTransforms(from->rest(), reader, to.rest);
    reader.Read(from->joint_from_actor(), to.joint_from_actor);
  }
}

void ReadLevel(const fb::LevelOfDetail& from, BlockReader& reader, LevelOfDetail& to) {
  to.error = from.error();
  reader.Read(from.indices(), to.indices);
}

// The number of a mesh's vertices in the file, and the number of those, from the first on, that are
// read.
struct VertexCount {
  size_t all = 0;
  size_t read = 0;
};

// Returns the counts of a mesh. The index comes from a file and may be invalid.
VertexCount CountOf(std::span<const VertexCount> counts, size_t mesh) {
  return mesh < counts.size() ? counts[mesh] : VertexCount();
}

// Returns how many levels, starting with the finest, are left out at this acceptable error.
flatbuffers::uoffset_t LevelsLeftOut(const fb::SkinnedMesh& mesh, float finest) {
  const flatbuffers::uoffset_t coarser = mesh.coarser() == nullptr ? 0 : mesh.coarser()->size();
  flatbuffers::uoffset_t left_out = 0;
  for (flatbuffers::uoffset_t i = 0; i < coarser && finest > 0.0f; ++i) {
    left_out = mesh.coarser()->Get(i)->error() <= finest ? i + 1 : left_out;
  }
  return left_out;
}

// Vertices of coarser levels come first (import::OrderVertices).
size_t CountVertices(const SkinnedMesh& mesh) {
  size_t count = 0;
  const auto take = [&](const std::vector<uint32_t>& indices) {
    for (const uint32_t index : indices) {
      count = std::max(count, size_t{index} + 1);
    }
  };
  take(mesh.indices);
  for (const LevelOfDetail& level : mesh.coarser) {
    take(level.indices);
  }
  return count;
}

VertexCount ReadTriangles(const fb::SkinnedMesh& from,
                          float finest,
                          BlockReader& reader,
                          SkinnedMesh& to) {
  const size_t all = from.positions() == nullptr ? 0 : from.positions()->size();
  const flatbuffers::uoffset_t left_out = LevelsLeftOut(from, finest);
  if (left_out == 0) {
    to.error = from.error();
    reader.Read(from.indices(), to.indices);
    reader.ReadTables(from.coarser(), to.coarser, ReadLevel);
    return {all, all};
  }
  LevelOfDetail level;
  ReadLevel(*from.coarser()->Get(left_out - 1), reader, level);
  to.indices = std::move(level.indices);
  to.error = level.error;
  for (flatbuffers::uoffset_t i = left_out; i < from.coarser()->size(); ++i) {
    ReadLevel(*from.coarser()->Get(i), reader, to.coarser.emplace_back());
  }
  return {all, std::min(all, CountVertices(to))};
}

VertexCount ReadMesh(const fb::SkinnedMesh& from,
                     std::span<const Material> materials,
                     float finest,
                     BlockReader& reader,
                     SkinnedMesh& to) {
  reader.Read(from.name(), to.name);
  to.material = from.material();
  const VertexCount count =
      ReadTriangles(from, finest / ErrorShare(to.SurfaceIn(materials)), reader, to);
  reader.ReadFirst(from.positions(), count.read, count.all, to.positions);
  reader.ReadFirst(from.normals(), count.read, count.all, to.normals);
  reader.ReadFirst(from.albedo(), count.read, count.all, to.albedo);
  reader.ReadFirst(from.uvs(), count.read, count.all, to.uvs);
  reader.ReadFirst(from.joints(), count.read, count.all, to.joints);
  reader.ReadFirst(from.weights(), count.read, count.all, to.weights);
  return count;
}

void ReadMorphPart(const fb::MorphPart& from,
                   std::span<const VertexCount> counts,
                   BlockReader& reader,
                   MorphTarget::Part& to) {
  to.mesh = from.mesh();
  const VertexCount count = CountOf(counts, to.mesh);
  const size_t all = from.vertices() == nullptr ? 0 : from.vertices()->size();
  size_t read = all;
  if (count.read < count.all && all > 0) {
    const uint32_t* vertices = from.vertices()->data();
    read = static_cast<size_t>(std::lower_bound(vertices, vertices + all, count.read) - vertices);
  }
  reader.ReadFirst(from.vertices(), read, all, to.vertices);
  reader.ReadFirst(from.position_deltas(), read, all, to.position_deltas);
  reader.ReadFirst(from.normal_deltas(), read, all, to.normal_deltas);
}

void ReadMorph(const fb::MorphTarget& from,
               std::span<const VertexCount> counts,
               BlockReader& reader,
               MorphTarget& to) {
  reader.Read(from.name(), to.name);
  reader.ReadTables(
      from.parts(), to.parts,
      [counts](const fb::MorphPart& part, BlockReader& blocks, MorphTarget::Part& read) {
        ReadMorphPart(part, counts, blocks, read);
      });
}

void ReadFaceShape(const fb::FaceShape& from, BlockReader& reader, FaceShape& to) {
  reader.Read(from.name(), to.name);
  reader.Read(from.morphs(), to.morphs);
  ReadTurns(from.turns(), reader, to.turns);
}

void ReadCloth(const fb::Cloth& from,
               std::span<const VertexCount> counts,
               BlockReader& reader,
               Cloth& to) {
  reader.Read(from.name(), to.name);
  to.mesh = from.mesh();
  reader.Read(from.positions(), to.positions);
  reader.Read(from.joints(), to.joints);
  reader.Read(from.weights(), to.weights);
  reader.Read(from.reach(), to.reach);
  reader.Read(from.triangles(), to.triangles);
  const VertexCount count = CountOf(counts, to.mesh);
  reader.ReadFirst(from.vertex_triangle(), count.read, count.all, to.vertex_triangle);
  reader.ReadFirst(from.vertex_weights(), count.read, count.all, to.vertex_weights);
  to.density = from.density();
  to.stretch_compliance = from.stretch_compliance();
  to.bend_compliance = from.bend_compliance();
  to.friction = from.friction();
  to.thickness = from.thickness();
}

void ReadSpring(const fb::SpringChain& from, BlockReader& reader, SpringChain& to) {
  reader.Read(from.name(), to.name);
  reader.Read(from.joints(), to.joints);
  to.stiffness = from.stiffness();
  to.drag = from.drag();
  to.gravity = from.gravity();
  to.radius = from.radius();
}

void ReadClip(const fb::Clip& from, BlockReader& reader, Clip& to) {
  reader.Read(from.name(), to.name);
  to.duration = from.duration();
  to.keys_per_second = from.keys_per_second();
  to.loops = from.loops();
  to.stride = from.stride();
  ReadTransforms(from.keys(), reader, to.keys);
}

void ReadKeyPose(const fb::KeyPose& from, BlockReader& reader, std::vector<JointTransform>& to) {
  ReadTransforms(from.joints(), reader, to);
}

// Reads [key pose][vertex] arrays with `values` values for each vertex.
template <typename T>
void ReadVectors(const flatbuffers::Vector<T>* from,
                 size_t poses,
                 VertexCount count,
                 size_t values,
                 BlockReader& reader,
                 std::vector<T>& to) {
  if (from == nullptr || count.read >= count.all || from->size() != poses * count.all * values) {
    reader.Read(from, to);
  } else if (reader.Take(from->size() * sizeof(T))) {
    to.reserve(poses * count.read * values);
    for (size_t pose = 0; pose < poses; ++pose) {
      const T* first = from->data() + pose * count.all * values;
      to.insert(to.end(), first, first + count.read * values);
    }
  }
}

void ReadMeshLight(const fb::MeshLight& from,
                   const LightTransfer& light,
                   VertexCount count,
                   BlockReader& reader,
                   LightTransfer::Mesh& to) {
  const size_t poses = light.key_poses.size();
  reader.ReadFirst(from.receivers(), count.read, count.all, to.receivers);
  reader.ReadFirst(from.weights(), count.read, count.all, to.weights);
  ReadVectors(from.coefficients(), poses, count, 3 * static_cast<size_t>(light.count), reader,
              to.coefficients);
  ReadVectors(from.scale(), poses, count, 1, reader, to.scale);
  reader.ReadFirst(from.backs(), count.read, count.all, to.backs);
}

void ReadLight(const fb::LightTransfer* from,
               std::span<const VertexCount> counts,
               BlockReader& reader,
               LightTransfer& to) {
  if (from != nullptr) {
    to.count = from->count();
    to.bounces = from->bounces();
    reader.ReadTables(from->key_poses(), to.key_poses, ReadKeyPose);
    reader.Read(from->blockers(), to.blockers);
    reader.Read(from->receivers(), to.receivers);
    reader.ReadTables(
        from->meshes(), to.meshes,
        [&](const fb::MeshLight& mesh, BlockReader& blocks, LightTransfer::Mesh& read) {
          ReadMeshLight(mesh, to, CountOf(counts, to.meshes.size() - 1), blocks, read);
        });
  }
}

// Reads a buffer whose structure has been verified.
Result<Human> ReadHuman(const fb::Human& from,
                        size_t file_size,
                        const std::string& where,
                        float finest) {
  BlockReader reader(file_size);
  Human human;
  reader.Read(from.name(), human.name);
  reader.Read(from.credits(), human.credits);
  ReadSkeleton(from.skeleton(), reader, human.skeleton);
  human.skinning = static_cast<Skinning>(from.skinning());
  reader.ReadTables(from.textures(), human.textures, ReadTexture<fb::Texture>);
  reader.ReadTables(from.materials(), human.materials, ReadMaterial<fb::Material>);
  std::vector<VertexCount> counts;  // index: mesh
  reader.ReadTables(from.meshes(), human.meshes,
                    [&](const fb::SkinnedMesh& mesh, BlockReader& blocks, SkinnedMesh& to) {
                      counts.push_back(ReadMesh(mesh, human.materials, finest, blocks, to));
                    });
  reader.ReadTables(from.morphs(), human.morphs,
                    [&](const fb::MorphTarget& morph, BlockReader& blocks, MorphTarget& to) {
                      ReadMorph(morph, counts, blocks, to);
                    });
  reader.ReadTables(from.face(), human.face, ReadFaceShape);
  reader.ReadTables(from.cloths(), human.cloths,
                    [&](const fb::Cloth& cloth, BlockReader& blocks, Cloth& to) {
                      ReadCloth(cloth, counts, blocks, to);
                    });
  reader.ReadTables(from.springs(), human.springs, ReadSpring);
  reader.Read(from.capsules(), human.capsules);
  reader.ReadTables(from.clips(), human.clips, ReadClip);
  ReadLight(from.light(), counts, reader, human.light);
  if (!reader.ok()) {
    return Status::Error(where, "the file is damaged: its parts overlap", kRemedy);
  }
  LARARIUM_RETURN_IF_ERROR(human.Validate(where));
  return human;
}

auto WriteTransforms(flatbuffers::FlatBufferBuilder& builder,
                     const std::vector<JointTransform>& from) {
  std::vector<fb::JointTransform> items;
  items.reserve(from.size());
  for (const JointTransform& t : from) {
    items.emplace_back(fb::Quaternion(t.rotation.w, t.rotation.x, t.rotation.y, t.rotation.z),
                       fb::Vec3(t.translation.x, t.translation.y, t.translation.z),
                       fb::Vec3(t.scale.x, t.scale.y, t.scale.z));
  }
  return builder.CreateVectorOfStructs(items);
}

auto WriteSkeleton(flatbuffers::FlatBufferBuilder& builder, const Skeleton& skeleton) {
  const auto names = builder.CreateVectorOfStrings(skeleton.names);
  const auto parents = builder.CreateVector(skeleton.parents);
  const auto rest = WriteTransforms(builder, skeleton.rest);
  const auto joint_from_actor = WriteBlock<fb::Matrix4>(builder, skeleton.joint_from_actor);
  return fb::CreateSkeleton(builder, names, parents, rest, joint_from_actor);
}

auto WriteLevel(flatbuffers::FlatBufferBuilder& builder, const LevelOfDetail& level) {
  const auto indices = builder.CreateVector(level.indices);
  return fb::CreateLevelOfDetail(builder, level.error, indices);
}

auto WriteMesh(flatbuffers::FlatBufferBuilder& builder, const SkinnedMesh& mesh) {
  const auto name = builder.CreateString(mesh.name);
  const auto positions = WriteBlock<fb::Vec3>(builder, mesh.positions);
  const auto normals = WriteBlock<fb::Vec3>(builder, mesh.normals);
  const auto albedo = WriteBlock<fb::Vec3>(builder, mesh.albedo);
  const auto uvs = WriteBlock<fb::Vec2>(builder, mesh.uvs);
  const auto joints = WriteBlock<fb::JointIndices>(builder, mesh.joints);
  const auto weights = WriteBlock<fb::Vec4>(builder, mesh.weights);
  const auto indices = builder.CreateVector(mesh.indices);
  const auto coarser = WriteTables(builder, mesh.coarser, WriteLevel);
  return fb::CreateSkinnedMesh(builder, name, positions, normals, albedo, uvs, joints, weights,
                               indices, coarser, mesh.material, mesh.error);
}

auto WriteMorphPart(flatbuffers::FlatBufferBuilder& builder, const MorphTarget::Part& part) {
  const auto vertices = builder.CreateVector(part.vertices);
  const auto positions = WriteBlock<fb::Vec3>(builder, part.position_deltas);
  const auto normals = WriteBlock<fb::Vec3>(builder, part.normal_deltas);
  return fb::CreateMorphPart(builder, part.mesh, vertices, positions, normals);
}

auto WriteMorph(flatbuffers::FlatBufferBuilder& builder, const MorphTarget& morph) {
  const auto name = builder.CreateString(morph.name);
  const auto parts = WriteTables(builder, morph.parts, WriteMorphPart);
  return fb::CreateMorphTarget(builder, name, parts);
}

auto WriteFaceShape(flatbuffers::FlatBufferBuilder& builder, const FaceShape& shape) {
  const auto name = builder.CreateString(shape.name);
  const auto morphs = WriteBlock<fb::MorphWeight>(builder, shape.morphs);
  std::vector<fb::JointTurn> items;
  for (const FaceShape::Turn& turn : shape.turns) {
    const glm::quat& q = turn.rotation;
    items.emplace_back(turn.joint, fb::Quaternion(q.w, q.x, q.y, q.z));
  }
  const auto turns = builder.CreateVectorOfStructs(items);
  return fb::CreateFaceShape(builder, name, morphs, turns);
}

auto WriteCloth(flatbuffers::FlatBufferBuilder& builder, const Cloth& cloth) {
  const auto name = builder.CreateString(cloth.name);
  const auto positions = WriteBlock<fb::Vec3>(builder, cloth.positions);
  const auto joints = WriteBlock<fb::JointIndices>(builder, cloth.joints);
  const auto weights = WriteBlock<fb::Vec4>(builder, cloth.weights);
  const auto reach = builder.CreateVector(cloth.reach);
  const auto triangles = builder.CreateVector(cloth.triangles);
  const auto vertex_triangle = builder.CreateVector(cloth.vertex_triangle);
  const auto vertex_weights = WriteBlock<fb::Vec3>(builder, cloth.vertex_weights);
  return fb::CreateCloth(builder, name, cloth.mesh, positions, joints, weights, reach, triangles,
                         vertex_triangle, vertex_weights, cloth.density, cloth.stretch_compliance,
                         cloth.bend_compliance, cloth.friction, cloth.thickness);
}

auto WriteSpring(flatbuffers::FlatBufferBuilder& builder, const SpringChain& spring) {
  const auto name = builder.CreateString(spring.name);
  const auto joints = builder.CreateVector(spring.joints);
  return fb::CreateSpringChain(builder, name, joints, spring.stiffness, spring.drag, spring.gravity,
                               spring.radius);
}

auto WriteClip(flatbuffers::FlatBufferBuilder& builder, const Clip& clip) {
  const auto name = builder.CreateString(clip.name);
  const auto keys = WriteTransforms(builder, clip.keys);
  return fb::CreateClip(builder, name, clip.duration, clip.keys_per_second, clip.loops, clip.stride,
                        keys);
}

auto WriteKeyPose(flatbuffers::FlatBufferBuilder& builder,
                  const std::vector<JointTransform>& pose) {
  const auto joints = WriteTransforms(builder, pose);
  return fb::CreateKeyPose(builder, joints);
}

auto WriteMeshLight(flatbuffers::FlatBufferBuilder& builder, const LightTransfer::Mesh& mesh) {
  const auto receivers = WriteBlock<fb::VertexReceivers>(builder, mesh.receivers);
  const auto weights = WriteBlock<fb::JointIndices>(builder, mesh.weights);
  const auto coefficients = builder.CreateVector(mesh.coefficients);
  const auto scale = builder.CreateVector(mesh.scale);
  const auto backs = WriteBlock<fb::Shares>(builder, mesh.backs);
  return fb::CreateMeshLight(builder, receivers, weights, coefficients, scale, backs);
}

auto WriteLight(flatbuffers::FlatBufferBuilder& builder, const LightTransfer& light) {
  const auto key_poses = WriteTables(builder, light.key_poses, WriteKeyPose);
  const auto blockers = WriteBlock<fb::LightBlocker>(builder, light.blockers);
  const auto receivers = WriteBlock<fb::LightReceiver>(builder, light.receivers);
  const auto meshes = WriteTables(builder, light.meshes, WriteMeshLight);
  return fb::CreateLightTransfer(builder, static_cast<uint8_t>(light.count),
                                 static_cast<uint8_t>(light.bounces), key_poses, blockers,
                                 receivers, meshes);
}

}  // namespace

Result<Human> ParseHuman(std::span<const std::byte> bytes, const std::string& where, float finest) {
  if (bytes.size() < 8 || bytes.size() >= FLATBUFFERS_MAX_BUFFER_SIZE ||
      !fb::HumanBufferHasIdentifier(bytes.data())) {
    return Status::Error(where, "not a .larhuman file", "import the figure again");
  }
  if (reinterpret_cast<uintptr_t>(bytes.data()) % alignof(std::max_align_t) != 0) {
    const std::vector<std::byte> aligned(bytes.begin(), bytes.end());
    return ParseHuman(aligned, where, finest);
  }
  flatbuffers::Verifier verifier(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
  // FlatBuffers pads files to whole words, but the verifier does not notice missing padding.
  if (bytes.size() % sizeof(flatbuffers::uoffset_t) != 0 || !fb::VerifyHumanBuffer(verifier)) {
    return Status::Error(where, "the file is damaged or cut short", kRemedy);
  }
  const fb::Human& human = *fb::GetHuman(bytes.data());
  if (human.version() != kVersion) {
    return Status::Error(where,
                         "version " + std::to_string(human.version()) +
                             " of the file is not supported (this program reads version " +
                             std::to_string(kVersion) + ")",
                         kRemedy);
  }
  return ReadHuman(human, bytes.size(), where, finest);
}

Result<Human> LoadHuman(const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, ReadBytes(file));
  return ParseHuman(bytes, file.string());
}

std::vector<std::byte> SerializeHuman(const Human& human) {
  flatbuffers::FlatBufferBuilder builder(size_t{1} << 20);
  const auto name = builder.CreateString(human.name);
  const auto credits = builder.CreateString(human.credits);
  const auto skeleton = WriteSkeleton(builder, human.skeleton);
  const auto textures = WriteTextures(builder, human.textures, fb::CreateTexture);
  const auto materials = WriteMaterials<fb::Vec3>(builder, human.materials, fb::CreateMaterial);
  const auto meshes = WriteTables(builder, human.meshes, WriteMesh);
  const auto morphs = WriteTables(builder, human.morphs, WriteMorph);
  const auto face = WriteTables(builder, human.face, WriteFaceShape);
  const auto cloths = WriteTables(builder, human.cloths, WriteCloth);
  const auto springs = WriteTables(builder, human.springs, WriteSpring);
  const auto capsules = WriteBlock<fb::BodyCapsule>(builder, human.capsules);
  const auto clips = WriteTables(builder, human.clips, WriteClip);
  const auto light = WriteLight(builder, human.light);
  fb::FinishHumanBuffer(
      builder, fb::CreateHuman(builder, kVersion, name, credits, skeleton,
                               static_cast<uint8_t>(human.skinning), textures, materials, meshes,
                               morphs, face, cloths, springs, capsules, clips, light));
  const auto bytes = std::as_bytes(std::span(builder.GetBufferPointer(), builder.GetSize()));
  return {bytes.begin(), bytes.end()};
}

}  // namespace lararium::human
