#pragma once

// The morph targets of a scene, and the face that they give.

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/import/model_parts.h"
#include "editor/import/model_scene.h"
#include "editor/import/model_skeleton.h"
#include "shared/human/face_shape.h"

namespace lararium::import {

struct ModelMorphs {
  std::vector<human::MorphTarget> targets;
  // By name, or, in a VRM, by "mesh/target" of the glTF; with an apostrophe for each that
  // came before on the same part.
  std::map<std::string, uint32_t> index_of;
};

// Meshes are counted as parts are. Parts share a target where its name is theirs in common;
// in a VRM, whose expressions name meshes, only the primitives of one mesh do. Errors: too
// many, or movements that are no numbers.
Result<ModelMorphs> ReadMorphs(const ModelScene& model,
                               std::span<const Part> parts,
                               const ModelSkeleton& skeleton);

// A VRM's expressions, and every target by its name, put together by ComposeFace. Notes
// say where there are targets and none is understood.
std::vector<human::FaceShape> BuildFace(const ModelScene& model,
                                        const ModelMorphs& morphs,
                                        const ModelSkeleton& skeleton,
                                        std::vector<std::string>& notes);

}  // namespace lararium::import
