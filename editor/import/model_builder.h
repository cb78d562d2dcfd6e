#pragma once

// From a scene of assimp to a human::Human. Internal to editor/import.

#include "editor/import/built_model.h"
#include "editor/import/model_import.h"
#include "editor/import/model_rig.h"
#include "editor/import/model_scene.h"

namespace lararium::import {

// Each stage is a function from plain data to plain data, in a file of its own:
//   FindBindPose    where the nodes were when the meshes were bound
//   GatherParts     the meshes in that pose
//   FindRig         the bones and which joints they are
//   PlaceFigure     axes, unit and place
//   BuildSkeleton   the joints
//   ReadSurfaces    materials and images
//   BuildMeshes     the skinned meshes
//   ReadMorphs      morph targets; BuildFace makes expressions and visemes of them
//   BuildSprings    what swings; BuildCapsules what it collides with
//   SampleClips     the clips
// A motion has only bind pose, rig, place, skeleton and clips. Errors name the file.
Result<BuiltModel> BuildModel(const ModelScene& model,
                              const ImportOptions& options,
                              Content content);

}  // namespace lararium::import
