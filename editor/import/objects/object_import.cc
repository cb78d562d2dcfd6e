#include "editor/import/objects/object_import.h"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <string>
#include <vector>

#include "editor/import/model/model_gltf.h"
#include "editor/import/model/model_import.h"
#include "shared/core/file.h"
#include "shared/core/json.h"
#include "shared/human/human.h"

namespace lararium::import {
namespace {

constexpr char kUseExtension[] = ".object.json";
constexpr size_t kMaxUseBytes = size_t{1} << 20;

bool EndsWith(const std::filesystem::path& file, std::string_view ending) {
  return file.filename().string().ends_with(ending);
}

// A real object: no mesh is drawn for it.
Result<stage::Prop> RealThing(const std::filesystem::path& file) {
  stage::Prop prop;
  prop.name = file.filename().string();
  prop.name.resize(prop.name.size() - std::string_view(kUseExtension).size());
  prop.parts.push_back({"body", stage::PropPart::kNoParent, {}, {}});
  LARARIUM_ASSIGN_OR_RETURN(prop.use, ReadText(file, kMaxUseBytes));
  return prop;
}

// The `object` in the extras of the default scene.
Result<std::string> UseInExtras(const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, ReadBytes(file));
  if (!LooksLikeGltf(bytes)) {
    return std::string();
  }
  LARARIUM_ASSIGN_OR_RETURN(const GltfDocument document, ParseGltf(bytes, file.string()));
  const Json& json = document.json;
  const auto scenes = json.find("scenes");
  const size_t shown = json.value("scene", size_t{0});
  if (scenes == json.end() || !scenes->is_array() || shown >= scenes->size()) {
    return std::string();
  }
  const Json& scene = (*scenes)[shown];
  const auto extras = scene.find("extras");
  if (extras == scene.end() || !extras->is_object() || !extras->contains("object")) {
    return std::string();
  }
  return extras->at("object").dump();
}

Result<std::string> FindUse(const std::filesystem::path& file) {
  const std::filesystem::path beside = UseFileBeside(file);
  return FileExists(beside) ? ReadText(beside, kMaxUseBytes) : UseInExtras(file);
}

// The joint with the largest weight at the first vertex of a mesh; parts of objects are rigid.
size_t JointOf(const human::SkinnedMesh& mesh) {
  if (mesh.positions.empty()) {
    return 0;
  }
  int strongest = 0;
  for (int k = 1; k < 4; ++k) {
    strongest = mesh.weights[0][k] > mesh.weights[0][strongest] ? k : strongest;
  }
  return mesh.joints[0][strongest];
}

stage::PropMesh ToPropMesh(const human::SkinnedMesh& mesh, const glm::mat4& part_from_object) {
  stage::PropMesh result;
  const glm::mat3 normals = glm::inverse(glm::transpose(glm::mat3(part_from_object)));
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    result.positions.emplace_back(part_from_object * glm::vec4(mesh.positions[v], 1.0f));
    result.normals.push_back(glm::normalize(normals * mesh.normals[v]));
  }
  result.albedo = mesh.albedo;
  result.uvs = mesh.uvs;
  result.indices = mesh.indices;
  result.material = mesh.material;
  return result;
}

// Says which joints have meshes or are ancestors of such joints.
std::vector<bool> NeededJoints(const human::Human& model) {
  std::vector<bool> needed(model.skeleton.size(), false);
  for (const human::SkinnedMesh& mesh : model.meshes) {
    int joint = static_cast<int>(JointOf(mesh));
    while (joint >= 0 && !needed[static_cast<size_t>(joint)]) {
      needed[static_cast<size_t>(joint)] = true;
      joint = model.skeleton.parents[static_cast<size_t>(joint)];
    }
  }
  return needed;
}

Result<stage::Prop> FromModel(const ImportedHuman& imported, const std::filesystem::path& file) {
  const human::Human& model = imported.human;
  stage::Prop prop;
  prop.name = file.stem().string();
  prop.credits = model.credits;
  prop.textures = model.textures;
  prop.materials = model.materials;
  const std::vector<bool> needed = NeededJoints(model);
  std::vector<int16_t> part_of(needed.size(), stage::PropPart::kNoParent);
  for (size_t joint = 0; joint < needed.size(); ++joint) {
    if (!needed[joint]) {
      continue;
    }
    const int16_t parent = model.skeleton.parents[joint];
    const human::JointTransform& rest = model.skeleton.rest[joint];
    part_of[joint] = static_cast<int16_t>(prop.parts.size());
    prop.parts.push_back({model.skeleton.names[joint],
                          parent < 0 ? stage::PropPart::kNoParent : part_of[size_t(parent)],
                          {rest.translation, rest.rotation},
                          {}});
  }
  if (prop.parts.size() > stage::Prop::kMaxParts) {
    return Status::Error(file.string(),
                         "has more than " + std::to_string(stage::Prop::kMaxParts) + " parts",
                         "join those that do not move against one another");
  }
  for (const human::SkinnedMesh& mesh : model.meshes) {
    const size_t joint = JointOf(mesh);
    std::vector<stage::PropMesh>& meshes = prop.parts[size_t(part_of[joint])].meshes;
    meshes.push_back(ToPropMesh(mesh, model.skeleton.joint_from_actor[joint]));
    if (mesh.material != human::Material::kNone) {
      meshes.back().emission = imported.emissions[size_t(mesh.material)];
    }
  }
  return prop;
}

}  // namespace

std::filesystem::path UseFileBeside(const std::filesystem::path& model) {
  if (EndsWith(model, kUseExtension)) {
    return model;
  }
  std::filesystem::path beside = model;
  return beside.replace_extension(kUseExtension);
}

Result<stage::Prop> ImportObject(const std::filesystem::path& file,
                                 std::vector<std::string>& notes) {
  if (EndsWith(file, kUseExtension)) {
    return RealThing(file);
  }
  LARARIUM_ASSIGN_OR_RETURN(std::string use, FindUse(file));
  LARARIUM_ASSIGN_OR_RETURN(ImportedHuman model, ImportThing(file, !use.empty()));
  notes = std::move(model.notes);
  LARARIUM_ASSIGN_OR_RETURN(stage::Prop prop, FromModel(model, file));
  prop.use = std::move(use);
  LARARIUM_RETURN_IF_ERROR(prop.Validate(file.string()));
  return prop;
}

}  // namespace lararium::import
