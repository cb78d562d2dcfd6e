#pragma once

// Reads the morph targets of a scene and builds the face from them.

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "editor/import/model/model_parts.h"
#include "editor/import/model/model_scene.h"
#include "editor/import/model/model_skeleton.h"
#include "shared/human/face_shape.h"

namespace lararium::import {

struct ModelMorphs {
  std::vector<human::MorphTarget> targets;
  // Index into `targets` by name or, in a VRM, by "mesh/target" of the glTF. Each earlier
  // target with the same key on the same part adds an apostrophe.
  std::map<std::string, uint32_t> index_of;
};

// `MorphTarget` counts meshes as `parts` does. Parts share a target if it has the same name in
// each; in a VRM, whose expressions refer to meshes, only the primitives of one mesh do.
// Errors: too many targets, or displacements that are not finite.
Result<ModelMorphs> ReadMorphs(const ModelScene& model,
                               std::span<const Part> parts,
                               const ModelSkeleton& skeleton);

// Passes the expressions of a VRM, and every target by its name, to ComposeFace. Adds a note if
// there are targets and none is understood.
std::vector<human::FaceShape> BuildFace(const ModelScene& model,
                                        const ModelMorphs& morphs,
                                        const ModelSkeleton& skeleton,
                                        std::vector<std::string>& notes);

}  // namespace lararium::import
