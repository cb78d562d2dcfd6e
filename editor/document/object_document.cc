#include "editor/document/object_document.h"

#include <Eigen/Geometry>
#include <numbers>

#include "editor/document/document_fields.h"

namespace lararium::editor {

geometry::Rigid3 StageFromObject(const ObjectDocument& object) {
  const double angle = object.heading * std::numbers::pi / 180.0;
  return {Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY())), object.position};
}

void DescribeFields(Fields& fields, ObjectDocument& object) {
  DescribePlainName(fields, "name", object.name);
  const bool has_model = fields.Has("model", object.file.empty());
  const bool has_file = fields.Has("file", !object.file.empty());
  fields.Require(has_model != has_file, "must have either a model of the library or a file");
  fields.Text(Optional("model", has_model), object.model);
  fields.Text(Optional("file", has_file), object.file);
  DescribeVector(fields, "position", object.position);
  fields.Number(Optional("heading"), object.heading, -360.0, 360.0);
}

}  // namespace lararium::editor
