#pragma once

#include <string_view>

namespace lararium::bundle {

inline constexpr std::string_view kManifestName = "manifest.json";
// Member of signed bundles, directly after the manifest, which does not list it.
inline constexpr std::string_view kSignatureName = "manifest.sig";
inline constexpr size_t kMaxMemberName = 200;

// Names of members are relative paths of parts joined by '/'. A part begins with a letter, a digit
// or '_' and continues with these, '-' and '.'. This excludes absolute paths, "..", backslashes,
// drives and all names that two systems read differently.
bool IsMemberName(std::string_view name);

}  // namespace lararium::bundle
