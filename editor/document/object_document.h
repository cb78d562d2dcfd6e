#pragma once

// An object on stage, as the project file describes it.

#include <Eigen/Core>
#include <string>

#include "shared/core/json_fields.h"
#include "shared/geometry/transform.h"

namespace lararium::editor {

// Exactly one of model and file is set.
struct ObjectDocument {
  std::string name;   // The name that the drama uses.
  std::string model;  // An object of the library (import::FindLibraryObject()).
  std::string file;   // A model that the editor imports. NAME.object.json lies beside it.
  // The pose at the beginning of the drama, stage frame: metres, and degrees about +Y.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double heading = 0.0;
};

geometry::Rigid3 StageFromObject(const ObjectDocument& object);

void DescribeFields(Fields& fields, ObjectDocument& object);

}  // namespace lararium::editor
