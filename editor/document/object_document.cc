#include "editor/document/object_document.h"

#include <Eigen/Geometry>
#include <numbers>

#include "editor/document/document_fields.h"

namespace lararium::editor {

geometry::Rigid3 StageFromObject(const ObjectDocument& object) {
  const double angle = object.heading * std::numbers::pi / 180.0;
  return {Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY())), object.position};
}

Result<ObjectDocument> ParseObject(const JsonView& view) {
  LARARIUM_RETURN_IF_ERROR(view.CheckFields({"name", "model", "file", "position", "heading"}));
  ObjectDocument object;
  LARARIUM_ASSIGN_OR_RETURN(object.name, ParsePlainName(view, "name"));
  if (view.Has("model") == view.Has("file")) {
    return view.Problem("must have either a built-in model or a file");
  }
  if (view.Has("model")) {
    LARARIUM_ASSIGN_OR_RETURN(object.model, view.Text("model"));
  } else {
    LARARIUM_ASSIGN_OR_RETURN(object.file, view.Text("file"));
  }
  LARARIUM_ASSIGN_OR_RETURN(object.position, ParseVector(view, "position"));
  if (view.Has("heading")) {
    LARARIUM_ASSIGN_OR_RETURN(object.heading, view.Number("heading", -360.0, 360.0));
  }
  return object;
}

Json FormatObject(const ObjectDocument& object) {
  Json json = {{"name", object.name},
               {"position", FormatVector(object.position)},
               {"heading", object.heading}};
  json[object.file.empty() ? "model" : "file"] = object.file.empty() ? object.model : object.file;
  return json;
}

}  // namespace lararium::editor
