#pragma once

// A show as visitors get it: the .larshow file. A zip archive of one fixed form
// (docs/file-formats.md): manifest.json first, every member stored and aligned,
// each byte either checked or known. It is mapped, verified and used in place.

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/bundle/sha256.h"
#include "shared/bundle/show_manifest.h"
#include "shared/bundle/signature.h"
#include "shared/core/file.h"
#include "shared/core/status.h"

namespace lararium::bundle {

struct OpenOptions {
  // Only what its owner signed is opened, and nothing of anything else is looked at but the
  // archive's structure. None: signatures do not count.
  std::optional<PublicKey> trusted = std::nullopt;
};

// Where a member of a bundle that was verified lies, so that it can be read when the bundle is
// closed.
struct StoredMember {
  std::filesystem::path file;
  std::string name;
  uint64_t offset = 0;
  size_t size = 0;
  Sha256 sha256 = {};

  // Fails where it is not what it was.
  Result<std::vector<std::byte>> Read() const;
};

class Bundle {
 public:
  // Verifies everything before it returns: the archive's structure, and the size
  // and SHA-256 of every member. Uses constant memory beside the mapped file.
  // Errors say that the file is damaged, foreign or too new, and what to do.
  static Result<Bundle> Open(const std::filesystem::path& path, const OpenOptions& options = {});

  const ShowManifest& manifest() const { return manifest_; }
  const std::string& place() const { return place_; }
  // Whether it carries a signature, which counts for nothing unless a key was given.
  bool is_signed() const { return is_signed_; }

  // The bytes of a member where they are mapped, aligned to 64 bytes; they live
  // as long as the bundle. The members that manifest() names always exist.
  Result<std::span<const std::byte>> member(std::string_view name) const;
  Result<StoredMember> stored(std::string_view name) const;

 private:
  Bundle(std::string place, MappedFile file) : place_(std::move(place)), file_(std::move(file)) {}

  std::string place_;  // what errors call it
  MappedFile file_;
  ShowManifest manifest_;
  bool is_signed_ = false;
  std::map<std::string, std::span<const std::byte>, std::less<>> members_;
};

}  // namespace lararium::bundle
