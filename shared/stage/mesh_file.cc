#include "shared/stage/mesh_file.h"

#include <bit>
#include <cstring>
#include <type_traits>

#include "shared/stage/mesh_generated.h"

namespace lararium::stage {
namespace {

static_assert(std::endian::native == std::endian::little, "blocks are copied as they are");
static_assert(sizeof(fb::Vec3) == sizeof(glm::vec3));

constexpr uint32_t kVersion = 1;
constexpr char kRemedy[] = "import the mesh again";

auto WriteVectors(flatbuffers::FlatBufferBuilder& builder, const std::vector<glm::vec3>& from) {
  fb::Vec3* block = nullptr;
  const auto offset = builder.CreateUninitializedVectorOfStructs<fb::Vec3>(from.size(), &block);
  if (!from.empty()) {
    std::memcpy(static_cast<void*>(block), from.data(), from.size() * sizeof(glm::vec3));
  }
  return offset;
}

template <typename To, typename From>
void ReadBlock(const flatbuffers::Vector<From>* from, std::vector<To>& to) {
  static_assert(sizeof(std::remove_cv_t<std::remove_pointer_t<From>>) == sizeof(To));
  if (from != nullptr && from->size() > 0) {
    to.resize(from->size());
    std::memcpy(static_cast<void*>(to.data()), from->Data(), to.size() * sizeof(To));
  }
}

}  // namespace

std::vector<std::byte> SerializeMesh(const geometry::TriangleMesh& mesh) {
  flatbuffers::FlatBufferBuilder builder(size_t{1} << 16);
  const auto positions = WriteVectors(builder, mesh.positions);
  const auto normals = WriteVectors(builder, mesh.normals);
  const auto indices = builder.CreateVector(mesh.indices);
  fb::FinishMeshBuffer(builder, fb::CreateMesh(builder, kVersion, positions, normals, indices));
  const auto bytes = std::as_bytes(std::span(builder.GetBufferPointer(), builder.GetSize()));
  return {bytes.begin(), bytes.end()};
}

Result<geometry::TriangleMesh> ParseMesh(std::span<const std::byte> bytes,
                                         const std::string& place) {
  if (bytes.size() < 8 || bytes.size() >= FLATBUFFERS_MAX_BUFFER_SIZE ||
      !fb::MeshBufferHasIdentifier(bytes.data())) {
    return Status::Error(place, "not a .larmesh file", kRemedy);
  }
  if (reinterpret_cast<uintptr_t>(bytes.data()) % alignof(std::max_align_t) != 0) {
    const std::vector<std::byte> aligned(bytes.begin(), bytes.end());
    return ParseMesh(aligned, place);
  }
  flatbuffers::Verifier verifier(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
  if (!fb::VerifyMeshBuffer(verifier)) {
    return Status::Error(place, "the file is damaged or cut short", kRemedy);
  }
  const fb::Mesh& from = *fb::GetMesh(bytes.data());
  if (from.version() != kVersion) {
    return Status::Error(place,
                         "version " + std::to_string(from.version()) +
                             " of the file is not known here (this program reads version " +
                             std::to_string(kVersion) + ")",
                         kRemedy);
  }
  geometry::TriangleMesh mesh;
  ReadBlock(from.positions(), mesh.positions);
  ReadBlock(from.normals(), mesh.normals);
  ReadBlock(from.indices(), mesh.indices);
  LARARIUM_RETURN_IF_ERROR(mesh.Validate(place));
  return mesh;
}

}  // namespace lararium::stage
