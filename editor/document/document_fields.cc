#include "editor/document/document_fields.h"

#include <algorithm>
#include <cmath>

namespace lararium::editor {

using geometry::Similarity3;

bool IsPlainName(std::string_view name) {
  constexpr size_t kMaxName = 64;
  return !name.empty() && name.size() <= kMaxName && name.front() != '-' &&
         std::all_of(name.begin(), name.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                  c == '_' || c == '-';
         });
}

Result<Eigen::Vector3d> ParseVector(const JsonView& view, std::string_view key) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> values, view.Numbers(key, 3));
  for (const double value : values) {
    if (std::abs(value) > kMaxLength) {
      return view.Problem("\"" + std::string(key) + "\" lies beyond a million metres");
    }
  }
  return Eigen::Vector3d(values[0], values[1], values[2]);
}

Result<Eigen::Quaterniond> ParseRotation(const JsonView& view) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> v, view.Numbers("rotation", 4));
  const Eigen::Quaterniond rotation(v[0], v[1], v[2], v[3]);
  constexpr double kTolerance = 1e-3;
  if (std::abs(rotation.norm() - 1.0) > kTolerance) {
    return view.Problem("\"rotation\" must be a unit quaternion (w, x, y, z)");
  }
  return rotation.normalized();
}

Result<Similarity3> ParseSimilarity(const JsonView& view) {
  Similarity3 similarity;
  LARARIUM_ASSIGN_OR_RETURN(similarity.translation, ParseVector(view, "translation"));
  LARARIUM_ASSIGN_OR_RETURN(similarity.rotation, ParseRotation(view));
  LARARIUM_ASSIGN_OR_RETURN(similarity.scale, view.Number("scale", 1e-6, 1e6));
  return similarity;
}

Result<std::string> ParsePlainName(const JsonView& view, std::string_view key) {
  LARARIUM_ASSIGN_OR_RETURN(std::string name, view.Text(key));
  if (!IsPlainName(name)) {
    return view.Problem("\"" + std::string(key) + "\" is also a file name",
                        "use 1 to 64 letters, digits, '_' and '-'");
  }
  return name;
}

Json FormatVector(const Eigen::Vector3d& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json FormatRotation(const Eigen::Quaterniond& q) {
  return Json::array({q.w(), q.x(), q.y(), q.z()});
}

void FormatSimilarity(const Similarity3& similarity, Json& json) {
  json["translation"] = FormatVector(similarity.translation);
  json["rotation"] = FormatRotation(similarity.rotation);
  json["scale"] = similarity.scale;
}

}  // namespace lararium::editor
