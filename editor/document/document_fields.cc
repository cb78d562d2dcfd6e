#include "editor/document/document_fields.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "editor/document/titles.h"

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

void DescribeVector(Fields& fields, const FieldKey& key, Eigen::Vector3d& vector) {
  fields.Numbers(key, std::span(vector.data(), 3));
  fields.Require(vector.cwiseAbs().maxCoeff() <= kMaxLength,
                 "\"" + std::string(key.name) + "\" lies beyond a million metres");
}

void DescribeRotation(Fields& fields, Eigen::Quaterniond& rotation) {
  std::array<double, 4> wxyz = {rotation.w(), rotation.x(), rotation.y(), rotation.z()};
  fields.Numbers("rotation", wxyz);
  if (fields.reading()) {
    const Eigen::Quaterniond read(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
    constexpr double kTolerance = 1e-3;
    fields.Require(std::abs(read.norm() - 1.0) <= kTolerance,
                   "\"rotation\" must be a unit quaternion (w, x, y, z)");
    rotation = read.normalized();
  }
}

void DescribeSimilarity(Fields& fields, Similarity3& similarity) {
  DescribeVector(fields, "translation", similarity.translation);
  DescribeRotation(fields, similarity.rotation);
  fields.Number("scale", similarity.scale, 1e-6, 1e6);
}

void DescribePlainName(Fields& fields, const FieldKey& key, std::string& name) {
  fields.Text(key, name);
  fields.Require(IsPlainName(name), "\"" + std::string(key.name) + "\" is also a file name",
                 "use 1 to 64 letters, digits, '_' and '-'");
}

void DescribeTitle(Fields& fields, std::string& title) {
  fields.Text(Optional("title", !title.empty()), title);
  fields.Require(title.empty() || IsTitle(title), "\"title\" cannot be a title",
                 "use one line of at most " + std::to_string(kMaxTitle) + " bytes");
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
