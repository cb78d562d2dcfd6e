#include "editor/import/model/model_builder.h"

#include <algorithm>
#include <utility>

#include "editor/import/model/model_bind_pose.h"
#include "editor/import/model/model_clips.h"
#include "editor/import/model/model_face.h"
#include "editor/import/model/model_meshes.h"
#include "editor/import/model/model_parts.h"
#include "editor/import/model/model_placement.h"
#include "editor/import/model/model_rest_pose.h"
#include "editor/import/model/model_skeleton.h"
#include "editor/import/model/model_springs.h"
#include "editor/import/model/model_surfaces.h"

namespace lararium::import {
namespace {

void DescribeRig(const ModelRig& rig, BuiltModel& built) {
  built.is_human = rig.map.IsHuman();
  built.bones = NamesOf(rig.bones, rig.map);
  built.bone_table = Preview(rig.bones, rig.map);
  built.joints = NamedBones(rig.bones, rig.map);
  built.bone_names = rig.bones.names;
}

// Adds everything that a figure has in addition to skeleton and clips.
Status AddBody(const ModelScene& model,
               const BindPose& bind,
               std::span<const Part> parts,
               const ModelSkeleton& skeleton,
               Content content,
               BuiltModel& built) {
  human::Human& human = built.human;
  built.notes.insert(built.notes.end(), model.notes.surface.begin(), model.notes.surface.end());
  ModelSurfaces surfaces = ReadSurfaces(model, parts, !IsRigid(content), built.notes);
  human.meshes = BuildMeshes(parts, skeleton, surfaces, built.notes);
  human.materials = std::move(surfaces.materials);
  built.images = std::move(surfaces.images);
  built.uses = std::move(surfaces.uses);
  built.emissions = std::move(surfaces.emissions);
  if (IsRigid(content)) {
    return Status();
  }
  if (std::ranges::any_of(built.emissions,
                          [](const glm::vec3& e) { return e != glm::vec3(0.0f); })) {
    built.notes.emplace_back("people do not shine: the emission of its materials is left out");
  }
  LARARIUM_ASSIGN_OR_RETURN(ModelMorphs morphs, ReadMorphs(model, parts, skeleton));
  human.face = BuildFace(model, morphs, skeleton, built.notes);
  human.morphs = std::move(morphs.targets);
  human.springs = BuildSprings(model, skeleton);
  human.capsules = BuildCapsules(model, bind, skeleton);
  return Status();
}

// Says what a rigid object does not take over.
void TellWhatMoves(const ModelScene& model,
                   std::span<const Part> parts,
                   std::vector<std::string>& notes) {
  if (model.scene->mNumAnimations > 0 || (model.vrm && !model.vrm->springs.empty()) ||
      std::any_of(parts.begin(), parts.end(),
                  [](const Part& part) { return part.mesh->mNumAnimMeshes > 0; })) {
    notes.emplace_back("objects are rigid: its clips, morph targets and springs are left out");
  }
}

std::string CreditsOf(const ModelScene& model, const ImportOptions& options) {
  if (!options.credits.empty() || !model.gltf) {
    return options.credits;
  }
  if (model.vrm && !model.vrm->credits.empty()) {
    return model.vrm->credits;
  }
  constexpr size_t kMostBytes = 1024;  // Longer texts are no credits.
  const std::string text = TextOr(*Find(model.gltf->json, "asset"), "copyright", "");
  return text.size() <= kMostBytes ? text : std::string();
}

}  // namespace

Result<BuiltModel> BuildModel(const ModelScene& model,
                              const ImportOptions& options,
                              Content content) {
  BuiltModel built;
  built.notes = model.notes.structure;
  LARARIUM_ASSIGN_OR_RETURN(BindPose bind, FindBindPose(model, IsRigid(content)));
  std::vector<Part> parts;
  if (content != Content::kMotion) {
    LARARIUM_ASSIGN_OR_RETURN(parts, GatherParts(model, bind));
  }
  LARARIUM_ASSIGN_OR_RETURN(ModelRig rig,
                            FindRig(model, bind, content, options.bones, built.notes));
  if (content == Content::kMotion && !bind.HasSkin()) {
    if (auto rest = FindRestInMotion(model, rig, built.notes)) {
      bind.scene_from_node = *std::move(rest);
      std::vector<std::string> told_before;
      LARARIUM_ASSIGN_OR_RETURN(rig, FindRig(model, bind, content, options.bones, told_before));
      rig.is_posed = true;
    }
  }
  DescribeRig(rig, built);
  LARARIUM_ASSIGN_OR_RETURN(const glm::mat4 actor_from_scene,
                            PlaceFigure(model, parts, rig, options.metres_per_unit, built.notes));
  LARARIUM_ASSIGN_OR_RETURN(ModelSkeleton skeleton,
                            BuildSkeleton(model, bind, parts, rig, content, actor_from_scene));
  if (content != Content::kMotion) {
    LARARIUM_RETURN_IF_ERROR(AddBody(model, bind, parts, skeleton, content, built));
  }
  if (IsRigid(content)) {
    TellWhatMoves(model, parts, built.notes);
  } else {
    LARARIUM_ASSIGN_OR_RETURN(built.human.clips, SampleClips(model, bind, skeleton,
                                                             options.keys_per_second, built.notes));
  }
  built.human.skeleton = std::move(skeleton.joints);
  built.human.name = options.name.empty() ? model.file.stem().string() : options.name;
  built.human.credits = CreditsOf(model, options);
  LARARIUM_RETURN_IF_ERROR(built.human.Validate(model.place()));
  return built;
}

}  // namespace lararium::import
