#include "shared/stage/mesh_file.h"

#include <cstring>
#include <type_traits>

#include "shared/core/flatbuffer_blocks.h"
#include "shared/stage/mesh_generated.h"

namespace lararium::stage {
namespace {

static_assert(sizeof(fb::Vec3) == sizeof(glm::vec3));

constexpr uint32_t kMeshVersion = 1;
constexpr FlatbufferKind kMeshKind = {".larmesh", kMeshVersion, "import the mesh again"};

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
  const auto positions = WriteBlock<fb::Vec3>(builder, mesh.positions);
  const auto normals = WriteBlock<fb::Vec3>(builder, mesh.normals);
  const auto indices = builder.CreateVector(mesh.indices);
  fb::FinishMeshBuffer(builder, fb::CreateMesh(builder, kMeshVersion, positions, normals, indices));
  const auto bytes = std::as_bytes(std::span(builder.GetBufferPointer(), builder.GetSize()));
  return {bytes.begin(), bytes.end()};
}

Result<geometry::TriangleMesh> ParseMesh(std::span<const std::byte> bytes,
                                         const std::string& where) {
  if (reinterpret_cast<uintptr_t>(bytes.data()) % alignof(std::max_align_t) != 0) {
    const std::vector<std::byte> aligned(bytes.begin(), bytes.end());
    return ParseMesh(aligned, where);
  }
  LARARIUM_ASSIGN_OR_RETURN(
      const fb::Mesh* from,
      OpenFlatbuffer<fb::Mesh>(bytes, fb::MeshIdentifier(), kMeshKind, where));
  geometry::TriangleMesh mesh;
  ReadBlock(from->positions(), mesh.positions);
  ReadBlock(from->normals(), mesh.normals);
  ReadBlock(from->indices(), mesh.indices);
  LARARIUM_RETURN_IF_ERROR(mesh.Validate(where));
  return mesh;
}

}  // namespace lararium::stage
