#pragma once

// Identifies the maker of a bundle: Ed25519 signatures (RFC 8032) of its manifest, with libsodium.
// The manifest contains the hash of every member, so its signature covers the whole file. The list
// of the newest show (publication.h) is signed in the same way.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "shared/core/status.h"

namespace lararium::bundle {

struct PublicKey {
  std::array<uint8_t, 32> bytes = {};
  friend bool operator==(const PublicKey&, const PublicKey&) = default;
};

// Only the maker of bundles has it; players never see it.
struct SecretKey {
  std::array<uint8_t, 64> bytes = {};

  PublicKey public_key() const;
};

using Signature = std::array<uint8_t, 64>;

SecretKey MakeSecretKey();

// Key files are one line of text: "lararium public key 1" or "lararium secret key 1", followed by
// the key in hexadecimal digits. Only its owner can read a secret key's file. Existing files are
// not replaced.
Result<PublicKey> LoadPublicKey(const std::filesystem::path& path);
// Errors call the text `where`.
Result<PublicKey> ParsePublicKey(std::string_view text, const std::string& where);
Result<SecretKey> LoadSecretKey(const std::filesystem::path& path);
// The content of a public key's file.
std::string FormatPublicKey(const PublicKey& key);
Status SavePublicKey(const std::filesystem::path& path, const PublicKey& key);
Status SaveSecretKey(const std::filesystem::path& path, const SecretKey& key);

// The kinds of content that are signed. A signature of one is never valid for the other.
enum class Signed : uint8_t { kManifest, kPublication };

Signature Sign(std::span<const std::byte> bytes,
               const SecretKey& key,
               Signed what = Signed::kManifest);
bool Verifies(std::span<const std::byte> bytes,
              std::span<const std::byte> signature,
              const PublicKey& key,
              Signed what = Signed::kManifest);

// Formats and parses 128 hexadecimal digits.
std::string FormatSignature(const Signature& signature);
std::optional<Signature> ParseSignature(std::string_view text);

}  // namespace lararium::bundle
