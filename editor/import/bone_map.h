#pragma once

// Which bone of a foreign skeleton is which joint of H-Anim: by a map that somebody
// saved, by what the file itself says (VRM), by the bones' names, and where names fail
// by the shape of the tree and its rest pose.

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/json.h"
#include "shared/core/status.h"

namespace lararium::import {

// The bones of a file at rest, in its own axes and units; parallel arrays.
struct Rig {
  static constexpr int kNoParent = -1;

  std::vector<std::string> names;
  std::vector<int> parents;  // before their children
  std::vector<glm::vec3> positions;

  size_t size() const { return names.size(); }
  std::optional<size_t> Find(std::string_view name) const;
  bool IsBelow(int ancestor, int bone) const;  // or the same
  int CommonAncestor(int a, int b) const;      // kNoParent: none
  std::vector<std::vector<int>> Children() const;
  // From below ancestor down to bone, bone included. Empty where it is not below.
  std::vector<int> Chain(int ancestor, int bone) const;
};

enum class FoundBy : uint8_t { kSavedMap, kFile, kName, kStructure };

struct MappedBone {
  std::string joint;  // of H-Anim
  size_t bone = 0;    // index into the rig
  FoundBy found_by = FoundBy::kName;
  float confidence = 1.0f;  // 0..1
};

// The bone of an H-Anim joint by name; an empty bone: the figure has no such joint.
using BoneNames = std::map<std::string, std::string>;

struct BoneMap {
  std::vector<MappedBone> bones;  // each joint and each bone at most once

  const MappedBone* Find(std::string_view joint) const;
  // Legs, arms, a pelvis that bears both, a head.
  bool IsHuman() const;
};

// given: maps to trust, the first first. A bone of Rig::kNoParent: the joint is not there.
struct GivenBones {
  std::map<std::string, int> bones;
  FoundBy found_by = FoundBy::kSavedMap;
};
// Bones that the rig does not have are left out.
GivenBones FindGiven(const Rig& rig, const BoneNames& names);
BoneMap MapBones(const Rig& rig, const std::vector<GivenBones>& given = {});

// A joint and the bone that is it, by names: what is left of a map without its rig.
struct NamedBone {
  std::string joint;
  std::string bone;
  FoundBy found_by = FoundBy::kName;
  float confidence = 1.0f;  // 0..1
};
std::vector<NamedBone> NamedBones(const Rig& rig, const BoneMap& map);

// "saved map", "file", "name", "structure".
const char* NameOf(FoundBy found_by);

// Every joint that a map may name, sorted; and those without which a figure is no person.
std::vector<std::string> KnownJointNames();
std::span<const char* const> NeededJointNames();

// The map as people read it: a line for each joint, then the bones that no joint is.
std::string Preview(const Rig& rig, const BoneMap& map);

// The file of a saved map: {"schema": 1, "bones": {"l_shoulder": "LeftArm", ...}}.
// Errors name the field. A joint's name of H-Anim that we do not know is one.
Result<BoneNames> ParseBoneNames(std::string_view json, std::string_view place);
// Of the object "bones" alone.
Result<BoneNames> ParseBoneNames(const JsonView& bones);
Result<BoneNames> LoadBoneNames(const std::filesystem::path& file);
Status SaveBoneNames(const std::filesystem::path& file, const BoneNames& names);
BoneNames NamesOf(const Rig& rig, const BoneMap& map);

}  // namespace lararium::import
