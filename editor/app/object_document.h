#pragma once

// A thing on stage as the project writes it down.

#include <Eigen/Core>
#include <string>

#include "shared/core/json.h"
#include "shared/core/status.h"
#include "shared/geometry/transform.h"

namespace lararium::app {

// Exactly one of model and file.
struct ObjectDocument {
  std::string name;   // as the drama calls it
  std::string model;  // of the built-in ones (import::ObjectModelNames())
  std::string file;   // a model that the editor imports; NAME.object.json beside it
  // Where it is at the beginning, stage: metres, and degrees about +Y.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double heading = 0.0;
};

geometry::Rigid3 StageFromObject(const ObjectDocument& object);

Result<ObjectDocument> ParseObject(const JsonView& view);
Json FormatObject(const ObjectDocument& object);

}  // namespace lararium::app
