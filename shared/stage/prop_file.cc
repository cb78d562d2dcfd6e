// Reading and writing .larprop files.

#include "shared/core/flatbuffer_blocks.h"
#include "shared/human/material_blocks.h"
#include "shared/stage/prop.h"
#include "shared/stage/prop_generated.h"

namespace lararium::stage {
namespace {

constexpr uint32_t kPropVersion = 1;
constexpr char kRemedy[] = "import the object again";
constexpr FlatbufferKind kPropKind = {".larprop", kPropVersion, kRemedy};

void ReadLevel(const prop_fb::LevelOfDetail& from, BlockReader& reader, human::LevelOfDetail& to) {
  to.error = from.error();
  reader.Read(from.indices(), to.indices);
}

void ReadMesh(const prop_fb::Mesh& from, BlockReader& reader, PropMesh& to) {
  reader.Read(from.positions(), to.positions);
  reader.Read(from.normals(), to.normals);
  reader.Read(from.albedo(), to.albedo);
  reader.Read(from.uvs(), to.uvs);
  reader.Read(from.indices(), to.indices);
  reader.ReadTables(from.coarser(), to.coarser, ReadLevel);
  to.material = from.material();
  to.emission = human::ReadVec3(from.emission());
}

glm::quat ReadQuaternion(const prop_fb::Quaternion& q) { return {q.w(), q.x(), q.y(), q.z()}; }

prop_fb::Quaternion WriteQuaternion(const glm::quat& q) { return {q.w, q.x, q.y, q.z}; }

void ReadPart(const prop_fb::Part& from, BlockReader& reader, PropPart& to) {
  reader.Read(from.name(), to.name);
  to.parent = from.parent();
  to.parent_from_part.position = human::ReadVec3(from.position());
  if (const prop_fb::Quaternion* q = from.rotation()) {
    to.parent_from_part.rotation = ReadQuaternion(*q);
  }
  reader.ReadTables(from.meshes(), to.meshes, ReadMesh);
}

struct KeyPose {
  std::vector<human::JointTransform> parts;
  uint32_t shown = 0;
};

void ReadKeyPose(const prop_fb::KeyPose& from, BlockReader& reader, KeyPose& to) {
  to.shown = from.shown();
  for (flatbuffers::uoffset_t i = 0; from.parts() != nullptr && i < from.parts()->size(); ++i) {
    if (!reader.Take(sizeof(prop_fb::PartPose))) {
      return;
    }
    const prop_fb::PartPose& part = *from.parts()->Get(i);
    human::JointTransform& joint = to.parts.emplace_back();
    joint.translation = human::ReadVec3(&part.position());
    joint.rotation = ReadQuaternion(part.rotation());
  }
}

void ReadMeshLight(const prop_fb::MeshLight& from,
                   BlockReader& reader,
                   human::LightTransfer::Mesh& to) {
  reader.Read(from.receivers(), to.receivers);
  reader.Read(from.weights(), to.weights);
  reader.Read(from.coefficients(), to.coefficients);
  reader.Read(from.scale(), to.scale);
  reader.Read(from.backs(), to.backs);
}

void ReadLight(const prop_fb::LightTransfer* from, BlockReader& reader, Prop& prop) {
  if (from == nullptr) {
    return;
  }
  prop.light.count = from->count();
  prop.light.bounces = from->bounces();
  std::vector<KeyPose> key_poses;
  reader.ReadTables(from->key_poses(), key_poses, ReadKeyPose);
  for (KeyPose& key_pose : key_poses) {
    prop.light.key_poses.push_back(std::move(key_pose.parts));
    prop.light_shown.push_back(key_pose.shown);
  }
  reader.Read(from->receivers(), prop.light.receivers);
  reader.ReadTables(from->meshes(), prop.light.meshes, ReadMeshLight);
}

// Reads a buffer whose structure has been verified.
Result<Prop> ReadProp(const prop_fb::Prop& from, size_t file_size, const std::string& where) {
  BlockReader reader(file_size);
  Prop prop;
  reader.Read(from.name(), prop.name);
  reader.ReadTables(from.textures(), prop.textures, human::ReadTexture<prop_fb::Texture>);
  reader.ReadTables(from.materials(), prop.materials, human::ReadMaterial<prop_fb::Material>);
  reader.ReadTables(from.parts(), prop.parts, ReadPart);
  reader.Read(from.use(), prop.use);
  reader.Read(from.credits(), prop.credits);
  ReadLight(from.light(), reader, prop);
  if (!reader.ok()) {
    return Status::Error(where, "the file is damaged: its parts overlap", kRemedy);
  }
  LARARIUM_RETURN_IF_ERROR(prop.Validate(where));
  return prop;
}

prop_fb::Vec3 Write(const glm::vec3& v) { return prop_fb::Vec3(v.x, v.y, v.z); }

auto WriteLevel(flatbuffers::FlatBufferBuilder& builder, const human::LevelOfDetail& level) {
  const auto indices = builder.CreateVector(level.indices);
  return prop_fb::CreateLevelOfDetail(builder, level.error, indices);
}

auto WriteMesh(flatbuffers::FlatBufferBuilder& builder, const PropMesh& mesh) {
  const auto positions = WriteBlock<prop_fb::Vec3>(builder, mesh.positions);
  const auto normals = WriteBlock<prop_fb::Vec3>(builder, mesh.normals);
  const auto albedo = WriteBlock<prop_fb::Vec3>(builder, mesh.albedo);
  const auto uvs = WriteBlock<prop_fb::Vec2>(builder, mesh.uvs);
  const auto indices = builder.CreateVector(mesh.indices);
  const prop_fb::Vec3 emission = Write(mesh.emission);
  const auto coarser = WriteTables(builder, mesh.coarser, WriteLevel);
  return prop_fb::CreateMesh(builder, positions, normals, albedo, uvs, indices, mesh.material,
                             &emission, coarser);
}

auto WritePart(flatbuffers::FlatBufferBuilder& builder, const PropPart& part) {
  const auto name = builder.CreateString(part.name);
  const auto meshes = WriteTables(builder, part.meshes, WriteMesh);
  const prop_fb::Vec3 position = Write(part.parent_from_part.position);
  const prop_fb::Quaternion rotation = WriteQuaternion(part.parent_from_part.rotation);
  return prop_fb::CreatePart(builder, name, part.parent, &position, &rotation, meshes);
}

auto WriteKeyPose(flatbuffers::FlatBufferBuilder& builder, const KeyPose& key_pose) {
  std::vector<prop_fb::PartPose> parts;
  for (const human::JointTransform& part : key_pose.parts) {
    parts.emplace_back(Write(part.translation), WriteQuaternion(part.rotation));
  }
  return prop_fb::CreateKeyPose(builder, builder.CreateVectorOfStructs(parts), key_pose.shown);
}

auto WriteMeshLight(flatbuffers::FlatBufferBuilder& builder,
                    const human::LightTransfer::Mesh& mesh) {
  const auto receivers = WriteBlock<prop_fb::VertexReceivers>(builder, mesh.receivers);
  const auto weights = WriteBlock<prop_fb::VertexShares>(builder, mesh.weights);
  const auto coefficients = builder.CreateVector(mesh.coefficients);
  const auto scale = builder.CreateVector(mesh.scale);
  const auto backs = WriteBlock<prop_fb::Shares>(builder, mesh.backs);
  return prop_fb::CreateMeshLight(builder, receivers, weights, coefficients, scale, backs);
}

// Returns a null offset if no light was baked.
flatbuffers::Offset<prop_fb::LightTransfer> WriteLight(flatbuffers::FlatBufferBuilder& builder,
                                                       const Prop& prop) {
  if (prop.light.empty()) {
    return {};
  }
  std::vector<KeyPose> poses;
  for (size_t i = 0; i < prop.light.key_poses.size(); ++i) {
    poses.push_back({prop.light.key_poses[i], prop.light_shown[i]});
  }
  const auto key_poses = WriteTables(builder, poses, WriteKeyPose);
  const auto receivers = WriteBlock<prop_fb::LightReceiver>(builder, prop.light.receivers);
  const auto meshes = WriteTables(builder, prop.light.meshes, WriteMeshLight);
  return prop_fb::CreateLightTransfer(builder, static_cast<uint8_t>(prop.light.count),
                                      static_cast<uint8_t>(prop.light.bounces), key_poses,
                                      receivers, meshes);
}

}  // namespace

Result<Prop> ParseProp(std::span<const std::byte> bytes, const std::string& where) {
  if (reinterpret_cast<uintptr_t>(bytes.data()) % alignof(std::max_align_t) != 0) {
    const std::vector<std::byte> aligned(bytes.begin(), bytes.end());
    return ParseProp(aligned, where);
  }
  LARARIUM_ASSIGN_OR_RETURN(
      const prop_fb::Prop* from,
      OpenFlatbuffer<prop_fb::Prop>(bytes, prop_fb::PropIdentifier(), kPropKind, where));
  return ReadProp(*from, bytes.size(), where);
}

std::vector<std::byte> SerializeProp(const Prop& prop) {
  flatbuffers::FlatBufferBuilder builder(size_t{1} << 16);
  const auto name = builder.CreateString(prop.name);
  const auto textures = human::WriteTextures(builder, prop.textures, prop_fb::CreateTexture);
  const auto materials =
      human::WriteMaterials<prop_fb::Vec3>(builder, prop.materials, prop_fb::CreateMaterial);
  const auto parts = WriteTables(builder, prop.parts, WritePart);
  const auto use = builder.CreateString(prop.use);
  const auto credits = builder.CreateString(prop.credits);
  const auto light = WriteLight(builder, prop);
  prop_fb::FinishPropBuffer(builder, prop_fb::CreateProp(builder, kPropVersion, name, textures,
                                                         materials, parts, use, credits, light));
  const auto bytes = std::as_bytes(std::span(builder.GetBufferPointer(), builder.GetSize()));
  return {bytes.begin(), bytes.end()};
}

}  // namespace lararium::stage
