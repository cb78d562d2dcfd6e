// Reading and writing .larprop files.

#include <bit>
#include <cstring>
#include <type_traits>

#include "shared/stage/prop.h"
#include "shared/stage/prop_generated.h"

namespace lararium::stage {
namespace {

static_assert(std::endian::native == std::endian::little, "blocks are copied as they are");

constexpr uint32_t kVersion = 1;
constexpr char kRemedy[] = "import the object again";

// Copies the vectors of one file. An honest file uses each of its bytes once, so
// one whose vectors add up to more than its size shares them to exhaust memory.
class BlockReader {
 public:
  explicit BlockReader(size_t file_size) : bytes_left_(file_size) {}

  bool ok() const { return ok_; }

  template <typename To, typename From>
  void Read(const flatbuffers::Vector<From>* from, std::vector<To>& to) {
    using Element = std::remove_cv_t<std::remove_pointer_t<From>>;
    static_assert(sizeof(Element) == sizeof(To) && std::is_trivially_copyable_v<To>);
    if (from != nullptr && from->size() > 0 && Take(from->size() * sizeof(To))) {
      to.resize(from->size());
      std::memcpy(static_cast<void*>(to.data()), from->Data(), to.size() * sizeof(To));
    }
  }

  void Read(const flatbuffers::String* from, std::string& to) {
    if (from != nullptr && Take(from->size())) {
      to = from->str();
    }
  }

  // One value of To for each table, by read(table, *this, value).
  template <typename From, typename To>
  void ReadTables(const flatbuffers::Vector<flatbuffers::Offset<From>>* from,
                  std::vector<To>& to,
                  void (*read)(const From&, BlockReader&, To&)) {
    for (flatbuffers::uoffset_t i = 0; from != nullptr && i < from->size(); ++i) {
      if (!Take(sizeof(flatbuffers::uoffset_t))) {
        return;
      }
      read(*from->Get(i), *this, to.emplace_back());
    }
  }

 private:
  bool Take(size_t bytes) {
    ok_ = ok_ && bytes <= bytes_left_;
    bytes_left_ -= ok_ ? bytes : 0;
    return ok_;
  }

  size_t bytes_left_;
  bool ok_ = true;
};

glm::vec3 Read(const prop_fb::Vec3* from) {
  return from == nullptr ? glm::vec3(0.0f) : glm::vec3(from->x(), from->y(), from->z());
}

void ReadTexture(const prop_fb::Texture& from, BlockReader& reader, human::Texture& to) {
  reader.Read(from.name(), to.name);
  reader.Read(from.encoded(), to.encoded);
}

void ReadMaterial(const prop_fb::Material& from, BlockReader& reader, human::Material& to) {
  reader.Read(from.name(), to.name);
  to.surface = static_cast<human::Surface>(from.surface());
  to.colour_texture = from.colour_texture();
  to.normal_texture = from.normal_texture();
  to.colour = Read(from.colour());
  to.roughness = from.roughness();
  to.alpha_cutoff = from.alpha_cutoff();
  to.two_sided = from.two_sided();
}

void ReadMesh(const prop_fb::Mesh& from, BlockReader& reader, PropMesh& to) {
  reader.Read(from.positions(), to.positions);
  reader.Read(from.normals(), to.normals);
  reader.Read(from.albedo(), to.albedo);
  reader.Read(from.uvs(), to.uvs);
  reader.Read(from.indices(), to.indices);
  to.material = from.material();
  to.emission = Read(from.emission());
}

void ReadPart(const prop_fb::Part& from, BlockReader& reader, PropPart& to) {
  reader.Read(from.name(), to.name);
  to.parent = from.parent();
  to.parent_from_part.position = Read(from.position());
  if (const prop_fb::Quaternion* q = from.rotation()) {
    to.parent_from_part.rotation = glm::quat(q->w(), q->x(), q->y(), q->z());
  }
  reader.ReadTables(from.meshes(), to.meshes, ReadMesh);
}

// Of a buffer whose structure has been verified.
Result<Prop> ReadProp(const prop_fb::Prop& from, size_t file_size, const std::string& place) {
  BlockReader reader(file_size);
  Prop prop;
  reader.Read(from.name(), prop.name);
  reader.ReadTables(from.textures(), prop.textures, ReadTexture);
  reader.ReadTables(from.materials(), prop.materials, ReadMaterial);
  reader.ReadTables(from.parts(), prop.parts, ReadPart);
  reader.Read(from.use(), prop.use);
  reader.Read(from.credits(), prop.credits);
  if (!reader.ok()) {
    return Status::Error(place, "the file is damaged: its parts overlap", kRemedy);
  }
  LARARIUM_RETURN_IF_ERROR(prop.Validate(place));
  return prop;
}

template <typename To, typename From>
auto WriteBlock(flatbuffers::FlatBufferBuilder& builder, const std::vector<From>& from) {
  static_assert(sizeof(To) == sizeof(From) && std::is_trivially_copyable_v<From>);
  To* block = nullptr;
  const auto offset = builder.CreateUninitializedVectorOfStructs<To>(from.size(), &block);
  if (!from.empty()) {
    std::memcpy(static_cast<void*>(block), from.data(), from.size() * sizeof(From));
  }
  return offset;
}

// One table for each of a list.
template <typename From, typename Write>
auto WriteTables(flatbuffers::FlatBufferBuilder& builder,
                 const std::vector<From>& from,
                 Write write) {
  std::vector<decltype(write(builder, std::declval<const From&>()))> tables;
  tables.reserve(from.size());
  for (const From& item : from) {
    tables.push_back(write(builder, item));
  }
  return builder.CreateVector(tables);
}

prop_fb::Vec3 Write(const glm::vec3& v) { return prop_fb::Vec3(v.x, v.y, v.z); }

auto WriteTexture(flatbuffers::FlatBufferBuilder& builder, const human::Texture& texture) {
  const auto name = builder.CreateString(texture.name);
  const auto encoded = builder.CreateVector(
      reinterpret_cast<const uint8_t*>(texture.encoded.data()), texture.encoded.size());
  return prop_fb::CreateTexture(builder, name, encoded);
}

auto WriteMaterial(flatbuffers::FlatBufferBuilder& builder, const human::Material& material) {
  const auto name = builder.CreateString(material.name);
  const prop_fb::Vec3 colour = Write(material.colour);
  return prop_fb::CreateMaterial(builder, name, static_cast<uint8_t>(material.surface),
                                 material.colour_texture, material.normal_texture, &colour,
                                 material.roughness, material.alpha_cutoff, material.two_sided);
}

auto WriteMesh(flatbuffers::FlatBufferBuilder& builder, const PropMesh& mesh) {
  const auto positions = WriteBlock<prop_fb::Vec3>(builder, mesh.positions);
  const auto normals = WriteBlock<prop_fb::Vec3>(builder, mesh.normals);
  const auto albedo = WriteBlock<prop_fb::Vec3>(builder, mesh.albedo);
  const auto uvs = WriteBlock<prop_fb::Vec2>(builder, mesh.uvs);
  const auto indices = builder.CreateVector(mesh.indices);
  const prop_fb::Vec3 emission = Write(mesh.emission);
  return prop_fb::CreateMesh(builder, positions, normals, albedo, uvs, indices, mesh.material,
                             &emission);
}

auto WritePart(flatbuffers::FlatBufferBuilder& builder, const PropPart& part) {
  const auto name = builder.CreateString(part.name);
  const auto meshes = WriteTables(builder, part.meshes, WriteMesh);
  const prop_fb::Vec3 position = Write(part.parent_from_part.position);
  const glm::quat& q = part.parent_from_part.rotation;
  const prop_fb::Quaternion rotation(q.w, q.x, q.y, q.z);
  return prop_fb::CreatePart(builder, name, part.parent, &position, &rotation, meshes);
}

}  // namespace

Result<Prop> ParseProp(std::span<const std::byte> bytes, const std::string& place) {
  if (bytes.size() < 8 || bytes.size() >= FLATBUFFERS_MAX_BUFFER_SIZE ||
      !prop_fb::PropBufferHasIdentifier(bytes.data())) {
    return Status::Error(place, "not a .larprop file", kRemedy);
  }
  if (reinterpret_cast<uintptr_t>(bytes.data()) % alignof(std::max_align_t) != 0) {
    const std::vector<std::byte> aligned(bytes.begin(), bytes.end());
    return ParseProp(aligned, place);
  }
  flatbuffers::Verifier verifier(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
  if (!prop_fb::VerifyPropBuffer(verifier)) {
    return Status::Error(place, "the file is damaged or cut short", kRemedy);
  }
  const prop_fb::Prop& from = *prop_fb::GetProp(bytes.data());
  if (from.version() != kVersion) {
    return Status::Error(place,
                         "version " + std::to_string(from.version()) +
                             " of the file is not known here (this program reads version " +
                             std::to_string(kVersion) + ")",
                         kRemedy);
  }
  return ReadProp(from, bytes.size(), place);
}

std::vector<std::byte> SerializeProp(const Prop& prop) {
  flatbuffers::FlatBufferBuilder builder(size_t{1} << 16);
  const auto name = builder.CreateString(prop.name);
  const auto textures = WriteTables(builder, prop.textures, WriteTexture);
  const auto materials = WriteTables(builder, prop.materials, WriteMaterial);
  const auto parts = WriteTables(builder, prop.parts, WritePart);
  const auto use = builder.CreateString(prop.use);
  const auto credits = builder.CreateString(prop.credits);
  prop_fb::FinishPropBuffer(builder, prop_fb::CreateProp(builder, kVersion, name, textures,
                                                         materials, parts, use, credits));
  const auto bytes = std::as_bytes(std::span(builder.GetBufferPointer(), builder.GetSize()));
  return {bytes.begin(), bytes.end()};
}

}  // namespace lararium::stage
