// Reading and writing .larhuman files.

#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>

#include "shared/core/file.h"
#include "shared/human/human.h"
#include "shared/human/human_generated.h"

namespace lararium::human {
namespace {

static_assert(std::endian::native == std::endian::little, "blocks are copied as they are");

constexpr uint32_t kVersion = 1;
constexpr char kRemedy[] = "bake or export it again";

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
    if (Take(from == nullptr ? 0 : from->size() * sizeof(To)) && from != nullptr) {
      to.resize(from->size());
      if (!to.empty()) {
        std::memcpy(static_cast<void*>(to.data()), from->Data(), to.size() * sizeof(To));
      }
    }
  }

  void Read(const flatbuffers::Vector<const fb::JointTransform*>* from,
            std::vector<JointTransform>& to) {
    if (Take(from == nullptr ? 0 : from->size() * sizeof(fb::JointTransform)) && from != nullptr) {
      to.reserve(from->size());
      for (const fb::JointTransform* item : *from) {
        const fb::Quaternion& q = item->rotation();
        const fb::Vec3& t = item->translation();
        const fb::Vec3& s = item->scale();
        to.push_back({glm::quat(q.w(), q.x(), q.y(), q.z()), glm::vec3(t.x(), t.y(), t.z()),
                      glm::vec3(s.x(), s.y(), s.z())});
      }
    }
  }

  void Read(const flatbuffers::String* from, std::string& to) {
    if (Take(from == nullptr ? 0 : from->size()) && from != nullptr) {
      to = from->str();
    }
  }

  void Read(const flatbuffers::Vector<flatbuffers::Offset<flatbuffers::String>>* from,
            std::vector<std::string>& to) {
    for (flatbuffers::uoffset_t i = 0; ok_ && from != nullptr && i < from->size(); ++i) {
      Take(sizeof(flatbuffers::uoffset_t));
      Read(from->Get(i), to.emplace_back());
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

void ReadSkeleton(const fb::Skeleton* from, BlockReader& reader, Skeleton& to) {
  if (from != nullptr) {
    reader.Read(from->names(), to.names);
    reader.Read(from->parents(), to.parents);
    reader.Read(from->rest(), to.rest);
    reader.Read(from->joint_from_actor(), to.joint_from_actor);
  }
}

void ReadMesh(const fb::SkinnedMesh& from, BlockReader& reader, SkinnedMesh& to) {
  reader.Read(from.name(), to.name);
  reader.Read(from.positions(), to.positions);
  reader.Read(from.normals(), to.normals);
  reader.Read(from.albedo(), to.albedo);
  reader.Read(from.joints(), to.joints);
  reader.Read(from.weights(), to.weights);
  reader.Read(from.indices(), to.indices);
}

void ReadClip(const fb::Clip& from, BlockReader& reader, Clip& to) {
  reader.Read(from.name(), to.name);
  to.duration = from.duration();
  to.keys_per_second = from.keys_per_second();
  to.loops = from.loops();
  to.stride = from.stride();
  reader.Read(from.keys(), to.keys);
}

// Of a buffer whose structure has been verified.
Result<Human> ReadHuman(const fb::Human& from, size_t file_size, const std::string& place) {
  BlockReader reader(file_size);
  Human human;
  reader.Read(from.name(), human.name);
  reader.Read(from.credits(), human.credits);
  ReadSkeleton(from.skeleton(), reader, human.skeleton);
  for (size_t i = 0; reader.ok() && from.meshes() != nullptr && i < from.meshes()->size(); ++i) {
    ReadMesh(*from.meshes()->Get(i), reader, human.meshes.emplace_back());
  }
  for (size_t i = 0; reader.ok() && from.clips() != nullptr && i < from.clips()->size(); ++i) {
    ReadClip(*from.clips()->Get(i), reader, human.clips.emplace_back());
  }
  if (!reader.ok()) {
    return Status::Error(place, "the file is damaged: its parts overlap", kRemedy);
  }
  LARARIUM_RETURN_IF_ERROR(human.Validate(place));
  return human;
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

auto WriteMesh(flatbuffers::FlatBufferBuilder& builder, const SkinnedMesh& mesh) {
  const auto name = builder.CreateString(mesh.name);
  const auto positions = WriteBlock<fb::Vec3>(builder, mesh.positions);
  const auto normals = WriteBlock<fb::Vec3>(builder, mesh.normals);
  const auto albedo = WriteBlock<fb::Vec3>(builder, mesh.albedo);
  const auto joints = WriteBlock<fb::JointIndices>(builder, mesh.joints);
  const auto weights = WriteBlock<fb::Vec4>(builder, mesh.weights);
  const auto indices = builder.CreateVector(mesh.indices);
  return fb::CreateSkinnedMesh(builder, name, positions, normals, albedo, joints, weights, indices);
}

auto WriteClip(flatbuffers::FlatBufferBuilder& builder, const Clip& clip) {
  const auto name = builder.CreateString(clip.name);
  const auto keys = WriteTransforms(builder, clip.keys);
  return fb::CreateClip(builder, name, clip.duration, clip.keys_per_second, clip.loops, clip.stride,
                        keys);
}

}  // namespace

Result<Human> ParseHuman(std::span<const std::byte> bytes, const std::string& place) {
  if (bytes.size() < 8 || bytes.size() >= FLATBUFFERS_MAX_BUFFER_SIZE ||
      !fb::HumanBufferHasIdentifier(bytes.data())) {
    return Status::Error(place, "not a .larhuman file", "import the figure again");
  }
  if (reinterpret_cast<uintptr_t>(bytes.data()) % alignof(std::max_align_t) != 0) {
    const std::vector<std::byte> aligned(bytes.begin(), bytes.end());
    return ParseHuman(aligned, place);
  }
  flatbuffers::Verifier verifier(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
  // FlatBuffers pads to whole words; the verifier would not miss the padding.
  if (bytes.size() % sizeof(flatbuffers::uoffset_t) != 0 || !fb::VerifyHumanBuffer(verifier)) {
    return Status::Error(place, "the file is damaged or cut short", kRemedy);
  }
  const fb::Human& human = *fb::GetHuman(bytes.data());
  if (human.version() != kVersion) {
    return Status::Error(place,
                         "version " + std::to_string(human.version()) +
                             " of the file is not known here (this program reads version " +
                             std::to_string(kVersion) + ")",
                         kRemedy);
  }
  return ReadHuman(human, bytes.size(), place);
}

Result<Human> LoadHuman(const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, ReadBytes(file));
  return ParseHuman(bytes, file.string());
}

std::vector<std::byte> SerializeHuman(const Human& human) {
  flatbuffers::FlatBufferBuilder builder(size_t{1} << 20);
  std::vector<flatbuffers::Offset<fb::SkinnedMesh>> meshes;
  for (const SkinnedMesh& mesh : human.meshes) {
    meshes.push_back(WriteMesh(builder, mesh));
  }
  std::vector<flatbuffers::Offset<fb::Clip>> clips;
  for (const Clip& clip : human.clips) {
    clips.push_back(WriteClip(builder, clip));
  }
  const auto name = builder.CreateString(human.name);
  const auto credits = builder.CreateString(human.credits);
  const auto skeleton = WriteSkeleton(builder, human.skeleton);
  const auto mesh_vector = builder.CreateVector(meshes);
  const auto clip_vector = builder.CreateVector(clips);
  fb::FinishHumanBuffer(builder, fb::CreateHuman(builder, kVersion, name, credits, skeleton,
                                                 mesh_vector, clip_vector));
  const auto bytes = std::as_bytes(std::span(builder.GetBufferPointer(), builder.GetSize()));
  return {bytes.begin(), bytes.end()};
}

Status SaveHuman(const std::filesystem::path& file, const Human& human) {
  LARARIUM_RETURN_IF_ERROR(human.Validate(file.string()));
  return WriteFileAtomically(file, SerializeHuman(human));
}

}  // namespace lararium::human
