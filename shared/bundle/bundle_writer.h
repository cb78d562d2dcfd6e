#pragma once

// Writes bundles. A target of its own (lararium_bundle_writer): players read
// bundles without libzip.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "shared/bundle/show_manifest.h"
#include "shared/bundle/signature.h"
#include "shared/core/status.h"

namespace lararium::bundle {

// A member to be: its bytes, which are borrowed, or the file that holds them.
struct MemberContent {
  std::string name;
  std::variant<std::span<const std::byte>, std::filesystem::path> content;
};

// Writes manifest and members to path, in their order, replacing it as a whole
// or leaving it as it was. manifest.members is computed here. The same content
// and key give the same bytes. key: signs the manifest; nullptr leaves it unsigned.
Status WriteBundle(const std::filesystem::path& path,
                   ShowManifest manifest,
                   const std::vector<MemberContent>& members,
                   const SecretKey* key = nullptr);

// Signs a bundle that was written, in the place of a signature that it has.
Status SignBundle(const std::filesystem::path& path, const SecretKey& key);

}  // namespace lararium::bundle
