#pragma once

// Fields that several parts of a project's document have, read with checks and
// written.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include "shared/core/json.h"
#include "shared/core/status.h"
#include "shared/geometry/transform.h"

namespace lararium::app {

// Names of places, actors and objects name files too: letters, digits, '_' and '-',
// at most 64 of them.
bool IsPlainName(std::string_view name);

// Fields that are not known are an error, so that saving never drops them.
Status CheckFields(const JsonView& view, std::span<const std::string_view> known);
Status CheckFields(const JsonView& view, std::initializer_list<std::string_view> known);

inline constexpr double kMaxLength = 1e6;  // metres

// Within kMaxLength.
Result<Eigen::Vector3d> ParseVector(const JsonView& view, std::string_view key);
Result<Eigen::Quaterniond> ParseRotation(const JsonView& view);
Result<geometry::Similarity3> ParseSimilarity(const JsonView& view);
Result<std::string> ParsePlainName(const JsonView& view, std::string_view key);

Json FormatVector(const Eigen::Vector3d& v);
Json FormatRotation(const Eigen::Quaterniond& q);
void FormatSimilarity(const geometry::Similarity3& similarity, Json& json);

}  // namespace lararium::app
