#pragma once

// Builds a human::Human from a scene of assimp. Internal to editor/import.

#include "editor/import/model/built_model.h"
#include "editor/import/model/model_import.h"
#include "editor/import/model/model_rig.h"
#include "editor/import/model/model_scene.h"

namespace lararium::import {

// Each stage is a function from plain data to plain data, in its own file:
//  FindBindPose    the pose of the nodes when the meshes were bound
//  GatherParts     the meshes in that pose
//  FindRig         the bones and their joints
//  FindRestInMotion  for a motion without a skin, the pose at rest
//  PlaceFigure     axes, unit and position
//  BuildSkeleton   the joints
//  ReadSurfaces    materials and images
//  BuildMeshes     the skinned meshes
//  ReadMorphs      morph targets; BuildFace makes expressions and visemes from them
//  BuildSprings    springs; BuildCapsules their colliders
//  SampleClips     the clips
// A motion uses only bind pose, rig, placement, skeleton and clips. Errors name the file.
Result<BuiltModel> BuildModel(const ModelScene& model,
                              const ImportOptions& options,
                              Content content);

}  // namespace lararium::import
