#pragma once

// Writes bundles. This is a separate target (lararium_bundle_writer), because players read bundles
// without libzip.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "shared/bundle/show_manifest.h"
#include "shared/bundle/signature.h"
#include "shared/core/file.h"
#include "shared/core/status.h"

namespace lararium::bundle {

// A member to write: its bytes, which are borrowed, or the file that holds them.
struct MemberContent {
  std::string name;
  std::variant<std::span<const std::byte>, std::filesystem::path> content;
};

// The bytes of contents, whose files are mapped; contents that are bytes are borrowed.
class ContentBytes {
 public:
  static Result<ContentBytes> Open(const std::vector<MemberContent>& contents);
  std::span<const std::byte> operator[](size_t index) const { return bytes_[index]; }

 private:
  std::vector<MappedFile> files_;
  std::vector<std::span<const std::byte>> bytes_;
};

// The text of a manifest that players accept, or what is wrong with it.
Result<std::string> FormatChecked(const ShowManifest& manifest, const std::string& where);

// Writes manifest and members to `path` in this order. Replaces the file completely or leaves it
// unchanged. Computes manifest.members. Equal content and key give equal bytes. key: signs the
// manifest; nullptr leaves it unsigned.
Status WriteBundle(const std::filesystem::path& path,
                   ShowManifest manifest,
                   const std::vector<MemberContent>& members,
                   const SecretKey* key = nullptr);

}  // namespace lararium::bundle
