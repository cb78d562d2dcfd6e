#pragma once

// Maps the bones of a foreign skeleton to the joints of H-Anim: by a map that the user saved,
// by what the file states (VRM), by the names of the bones, and if names do not suffice by the
// shape of the tree and its rest pose.

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/json_fields.h"
#include "shared/core/status.h"

namespace lararium::import {

// The bones of a file at rest in the axes and units of the file. The arrays are parallel.
struct Rig {
  static constexpr int kNoParent = -1;

  std::vector<std::string> names;
  std::vector<int> parents;  // Indices; parents come before their children.
  std::vector<glm::vec3> positions;

  size_t size() const { return names.size(); }
  std::optional<size_t> Find(std::string_view name) const;
  bool IsBelow(int ancestor, int bone) const;  // Says whether `bone` is `ancestor` or below it.
  int CommonAncestor(int a, int b) const;      // kNoParent if there is none.
  std::vector<std::vector<int>> Children() const;
  // The bones from below `ancestor` down to and including `bone`; empty if `bone` is not below.
  std::vector<int> Chain(int ancestor, int bone) const;
};

enum class FoundBy : uint8_t { kSavedMap, kFile, kName, kStructure };

struct MappedBone {
  std::string joint;  // H-Anim name.
  size_t bone = 0;    // Index into the rig.
  FoundBy found_by = FoundBy::kName;
  float confidence = 1.0f;  // 0..1
};

// Bone names by H-Anim joint; an empty name means that the figure lacks the joint.
using BoneNames = std::map<std::string, std::string>;

struct BoneMap {
  std::vector<MappedBone> bones;  // Each joint and each bone occurs at most once.

  const MappedBone* Find(std::string_view joint) const;
  // Says whether the map has legs, arms, a head, and a pelvis that connects them.
  bool IsHuman() const;
};

// Maps to trust, in order of priority. The value kNoParent means that the figure lacks the
// joint.
struct GivenBones {
  std::map<std::string, int> bones;
  FoundBy found_by = FoundBy::kSavedMap;
};
// Looks up the bones of a map; leaves out those that the rig lacks.
GivenBones FindGiven(const Rig& rig, const BoneNames& names);
BoneMap MapBones(const Rig& rig, const std::vector<GivenBones>& given = {});

// A joint and its bone by name, so that the map can be read without the rig.
struct NamedBone {
  std::string joint;
  std::string bone;
  FoundBy found_by = FoundBy::kName;
  float confidence = 1.0f;  // 0..1
};
std::vector<NamedBone> NamedBones(const Rig& rig, const BoneMap& map);

// "saved map", "file", "name", "structure".
const char* NameOf(FoundBy found_by);

// All joints that a map may name, sorted, and those that a human figure must have.
std::vector<std::string> KnownJointNames();
std::span<const char* const> NeededJointNames();

// The map as text for people: a line for each joint, then the bones that are not mapped.
std::string Preview(const Rig& rig, const BoneMap& map);

// Reads the file of a saved map: {"schema": 1, "bones": {"l_shoulder": "LeftArm", ...}}. Errors
// name the field. An unknown H-Anim joint is an error.
Result<BoneNames> ParseBoneNames(std::string_view json, std::string_view where);
// Describes only the object "bones".
void DescribeBoneNames(Fields& fields, const FieldKey& key, BoneNames& names);
Result<BoneNames> LoadBoneNames(const std::filesystem::path& file);
Status SaveBoneNames(const std::filesystem::path& file, const BoneNames& names);
BoneNames NamesOf(const Rig& rig, const BoneMap& map);

}  // namespace lararium::import
