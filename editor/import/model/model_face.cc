#include "editor/import/model/model_face.h"

#include <algorithm>
#include <cctype>
#include <glm/geometric.hpp>
#include <utility>

#include "editor/import/model/model_expressions.h"
#include "editor/import/model/model_matrix.h"
#include "shared/human/finite.h"

namespace lararium::import {
namespace {

constexpr size_t kMaxTargets = 4096;
constexpr size_t kMaxDeltas = 20'000'000;  // Moved vertices in all targets.
constexpr float kSmallestDelta = 1e-5f;    // metres

// The glTF mesh of a part ("m<i>" or "m<i>-<primitive>"); nullopt for other formats.
std::optional<size_t> GltfMesh(const ModelScene& model, const Part& part) {
  const std::string name = part.mesh->mName.C_Str();
  if (!model.gltf || name.size() < 2 || name.size() > 16 || name[0] != 'm' ||
      std::isdigit(static_cast<unsigned char>(name[1])) == 0) {
    return std::nullopt;
  }
  return std::stoul(name.substr(1));
}

std::string VrmKey(size_t mesh, size_t target) {
  return std::to_string(mesh) + "/" + std::to_string(target);
}

class MorphReader {
 public:
  MorphReader(const ModelScene& model, const ModelSkeleton& skeleton)
      : model_(model), turn_(skeleton.actor_from_scene) {}

  Result<ModelMorphs> Read(std::span<const Part> parts) {
    for (size_t p = 0; p < parts.size(); ++p) {
      LARARIUM_RETURN_IF_ERROR(ReadPart(parts[p], static_cast<uint32_t>(p)));
    }
    return std::move(read_);
  }

 private:
  Status ReadPart(const Part& part, uint32_t index) {
    const auto gltf_mesh = GltfMesh(model_, part);
    const std::vector<std::string> names =
        gltf_mesh ? model_.gltf->TargetNames(*gltf_mesh) : std::vector<std::string>();
    for (unsigned t = 0; t < part.mesh->mNumAnimMeshes; ++t) {
      const aiAnimMesh& target = *part.mesh->mAnimMeshes[t];
      std::string name = t < names.size() ? names[t] : target.mName.C_Str();
      if (name.empty()) {
        name = "target " + std::to_string(t);
      }
      LARARIUM_ASSIGN_OR_RETURN(human::MorphTarget::Part moved, Movement(part, target));
      moved.mesh = index;
      delta_count_ += moved.vertices.size();
      if (delta_count_ > kMaxDeltas || read_.targets.size() > kMaxTargets) {
        return Status::Error(model_.place(), "its morph targets are too many or too large",
                             "remove those that are not needed");
      }
      const std::string key = model_.vrm && gltf_mesh ? VrmKey(*gltf_mesh, t) : name;
      human::MorphTarget& morph = TargetFor(key, name, index);
      if (!moved.vertices.empty()) {
        morph.parts.push_back(std::move(moved));
      }
    }
    return Status();
  }

  // The displacements of a target without vertices that do not move.
  Result<human::MorphTarget::Part> Movement(const Part& part, const aiAnimMesh& target) const {
    human::MorphTarget::Part moved;
    if (!target.HasPositions() || target.mNumVertices != part.mesh->mNumVertices) {
      return moved;
    }
    for (unsigned v = 0; v < target.mNumVertices; ++v) {
      const glm::mat3 actor_from_mesh = turn_ * part.turns[v];
      const glm::vec3 delta =
          actor_from_mesh * (ToGlm(target.mVertices[v]) - ToGlm(part.mesh->mVertices[v]));
      if (!human::Finite(delta)) {
        return Status::Error(model_.place(),
                             "part '" + part.name + "': a morph target is not a number",
                             "export the figure again");
      }
      if (glm::length(delta) < kSmallestDelta) {
        continue;
      }
      glm::vec3 normal_delta(0.0f);
      if (target.HasNormals()) {
        normal_delta = Unit(actor_from_mesh * ToGlm(target.mNormals[v])) -
                       Unit(actor_from_mesh * ToGlm(part.mesh->mNormals[v]));
      }
      moved.vertices.push_back(v);
      moved.position_deltas.push_back(delta);
      moved.normal_deltas.push_back(human::Finite(normal_delta) ? normal_delta : glm::vec3(0.0f));
    }
    return moved;
  }

  human::MorphTarget& TargetFor(std::string key, const std::string& name, uint32_t mesh) {
    const auto has_mesh = [&](const human::MorphTarget& target) {
      return std::any_of(target.parts.begin(), target.parts.end(),
                         [&](const auto& part) { return part.mesh == mesh; });
    };
    while (read_.index_of.contains(key) && has_mesh(read_.targets[read_.index_of.at(key)])) {
      key += "'";  // One mesh has two targets with the same name.
    }
    const auto [index, is_new] =
        read_.index_of.try_emplace(key, static_cast<uint32_t>(read_.targets.size()));
    if (is_new) {
      read_.targets.push_back({name.substr(0, 256), {}});
    }
    return read_.targets[index->second];
  }

  const ModelScene& model_;
  const glm::mat3 turn_;  // actor_from_scene for directions.
  ModelMorphs read_;
  size_t delta_count_ = 0;
};

ForeignShape ShapeOf(const Vrm::Expression& expression, const ModelMorphs& morphs) {
  ForeignShape shape{expression.name, {}};
  for (const Vrm::Expression::Bind& bind : expression.binds) {
    const auto morph = morphs.index_of.find(VrmKey(bind.mesh, bind.target));
    if (morph != morphs.index_of.end()) {
      shape.morphs.push_back({morph->second, bind.weight});
    }
  }
  return shape;
}

}  // namespace

Result<ModelMorphs> ReadMorphs(const ModelScene& model,
                               std::span<const Part> parts,
                               const ModelSkeleton& skeleton) {
  return MorphReader(model, skeleton).Read(parts);
}

std::vector<human::FaceShape> BuildFace(const ModelScene& model,
                                        const ModelMorphs& morphs,
                                        const ModelSkeleton& skeleton,
                                        std::vector<std::string>& notes) {
  std::vector<ForeignShape> shapes;
  if (model.vrm) {
    for (const Vrm::Expression& expression : model.vrm->expressions) {
      shapes.push_back(ShapeOf(expression, morphs));
    }
  }
  for (size_t m = 0; m < morphs.targets.size(); ++m) {
    shapes.push_back({morphs.targets[m].name, {{static_cast<uint32_t>(m), 1.0f}}});
  }
  std::optional<uint32_t> jaw;
  if (const auto joint = skeleton.joints.Find("temporomandibular")) {
    jaw = static_cast<uint32_t>(*joint);
  }
  std::vector<human::FaceShape> face = ComposeFace(shapes, jaw);
  if (!shapes.empty() && face.empty()) {
    notes.push_back("no expression or viseme was recognised among its " +
                    std::to_string(shapes.size()) + " morph targets");
  }
  return face;
}

}  // namespace lararium::import
