#pragma once

// Where a project's objects are at the beginning of the drama.

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "editor/app/object_document.h"
#include "shared/stage/prop.h"

namespace lararium::app {

stage::Pose InitialPose(const ObjectDocument& object);

// Puts an object elsewhere, to the millimetre and a tenth of a degree; of the rotation its heading
// counts.
void PlaceObject(const Eigen::Quaterniond& stage_from_object,
                 const Eigen::Vector3d& position,
                 ObjectDocument& object);

}  // namespace lararium::app
