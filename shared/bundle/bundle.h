#pragma once

// A show in the form that visitors get: the .larshow file. It is a zip archive of one fixed form
// (docs/file-formats.md): manifest.json comes first, every member is stored and aligned, and each
// byte is either verified or has a known value. The file is mapped, verified and used in place.
// In a browser the members arrive one by one instead, from a folder of files with a manifest of the
// same form.

#include <filesystem>
#include <map>
#include <memory>
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
  // If set, only bundles that are signed with this key are opened; of others, only the archive's
  // structure is read. If not set, signatures are ignored.
  std::optional<PublicKey> trusted = std::nullopt;
};

// Location of a member of a verified bundle, so that it can be read after the bundle is closed.
struct StoredMember {
  std::filesystem::path file;
  std::string name;
  uint64_t offset = 0;
  size_t size = 0;
  Sha256 sha256 = {};

  // Returns an error if the content has changed.
  Result<std::vector<std::byte>> Read() const;
};

// Memory for a member that arrives, aligned to 64 bytes like a mapped one.
class Piece {
 public:
  explicit Piece(size_t size);

  std::span<std::byte> bytes() const { return {bytes_.get(), size_}; }

 private:
  struct Free {
    void operator()(std::byte* bytes) const;
  };
  std::unique_ptr<std::byte, Free> bytes_;
  size_t size_ = 0;
};

class Bundle {
 public:
  // Verifies everything before it returns: the archive's structure, and the size and SHA-256 of
  // every member. Uses constant memory beside the mapped file. Errors say that the file is damaged,
  // not a bundle, or too new, and what to do.
  static Result<Bundle> Open(const std::filesystem::path& path, const OpenOptions& options = {});

  // A bundle without members, to which Add() adds them. Checks the signature before the manifest is
  // used. Errors call the bundle `where`.
  static Result<Bundle> FromManifest(std::string_view manifest,
                                     std::span<const std::byte> signature,
                                     const PublicKey& trusted,
                                     const std::string& where);
  // Verifies and keeps a member of a bundle that FromManifest() made.
  Status Add(std::string_view name, Piece piece);
  // Releases a member that Add() added. Spans of it become invalid.
  void Remove(std::string_view name);

  const ShowManifest& manifest() const { return manifest_; }
  const std::string& place() const { return place_; }
  // True if the bundle has a signature, which is only checked if a key was given.
  bool is_signed() const { return is_signed_; }

  // Returns the mapped bytes of a member, aligned to 64 bytes and valid as long as the bundle. The
  // members that manifest() names always exist in a file.
  Result<std::span<const std::byte>> member(std::string_view name) const;
  bool Has(std::string_view name) const { return members_.contains(name); }
  // Only of a bundle that is a file.
  Result<StoredMember> stored(std::string_view name) const;

 private:
  explicit Bundle(std::string where) : place_(std::move(where)) {}

  std::string place_;  // name of the bundle in errors
  std::optional<MappedFile> file_;
  std::map<std::string, Piece, std::less<>> pieces_;
  ShowManifest manifest_;
  bool is_signed_ = false;
  std::map<std::string, std::span<const std::byte>, std::less<>> members_;
};

}  // namespace lararium::bundle
