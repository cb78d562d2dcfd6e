#pragma once

// Descriptions of fields that several parts of a project's document have.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/json.h"
#include "shared/core/json_fields.h"
#include "shared/core/status.h"
#include "shared/geometry/transform.h"

namespace lararium::editor {

// Whether the name has only letters, digits, '_' and '-', and at most 64 of them. Names of places,
// actors and objects are also file names.
bool IsPlainName(std::string_view name);

inline constexpr double kMaxLength = 1e6;  // metres

// Each component must be within kMaxLength.
void DescribeVector(Fields& fields, const FieldKey& key, Eigen::Vector3d& vector);
// The field "rotation": a unit quaternion (w, x, y, z).
void DescribeRotation(Fields& fields, Eigen::Quaterniond& rotation);
// The fields "translation", "rotation" and "scale".
void DescribeSimilarity(Fields& fields, geometry::Similarity3& similarity);
void DescribePlainName(Fields& fields, const FieldKey& key, std::string& name);

// The field "title", which is missing where it is empty (titles.h).
void DescribeTitle(Fields& fields, std::string& title);

// While reading, two entries of the list with the same name are an error.
template <typename Entry>
void RequireUniqueNames(Fields& fields, const FieldKey& list, const std::vector<Entry>& entries) {
  std::set<std::string_view> names;
  for (const Entry& entry : entries) {
    fields.RequireAt(list, names.insert(entry.name).second,
                     "the name \"" + entry.name + "\" is used twice", "rename one");
  }
}

Json FormatVector(const Eigen::Vector3d& v);
Json FormatRotation(const Eigen::Quaterniond& q);
void FormatSimilarity(const geometry::Similarity3& similarity, Json& json);

}  // namespace lararium::editor
