#pragma once

#include <string_view>

namespace lararium::bundle {

inline constexpr std::string_view kManifestName = "manifest.json";
// Of signed bundles, right behind the manifest, which does not list it.
inline constexpr std::string_view kSignatureName = "manifest.sig";
inline constexpr size_t kMaxMemberName = 200;

// Names of members are relative paths of parts joined by '/'. A part begins with
// a letter, digit or '_' and goes on with these, '-' and '.': no absolute path,
// no "..", no backslash, no drive, nothing that two systems read differently.
bool IsMemberName(std::string_view name);

}  // namespace lararium::bundle
