#pragma once

// Reading with checks, and writing, of fields that several parts of a project's document have.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include "shared/core/json.h"
#include "shared/core/status.h"
#include "shared/geometry/transform.h"

namespace lararium::editor {

// Whether the name has only letters, digits, '_' and '-', and at most 64 of them. Names of places,
// actors and objects are also file names.
bool IsPlainName(std::string_view name);

inline constexpr double kMaxLength = 1e6;  // metres

// Each component must be within kMaxLength.
Result<Eigen::Vector3d> ParseVector(const JsonView& view, std::string_view key);
Result<Eigen::Quaterniond> ParseRotation(const JsonView& view);
Result<geometry::Similarity3> ParseSimilarity(const JsonView& view);
Result<std::string> ParsePlainName(const JsonView& view, std::string_view key);

Json FormatVector(const Eigen::Vector3d& v);
Json FormatRotation(const Eigen::Quaterniond& q);
void FormatSimilarity(const geometry::Similarity3& similarity, Json& json);

}  // namespace lararium::editor
