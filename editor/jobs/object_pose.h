#pragma once

// The pose of an object at the beginning of the drama, stage frame.

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "editor/document/object_document.h"
#include "shared/stage/prop.h"

namespace lararium::editor {

stage::Pose InitialPose(const ObjectDocument& object);

// Sets the pose, rounded to a millimetre and a tenth of a degree. Only the heading of the rotation
// is used.
void PlaceObject(const Eigen::Quaterniond& stage_from_object,
                 const Eigen::Vector3d& position,
                 ObjectDocument& object);

}  // namespace lararium::editor
