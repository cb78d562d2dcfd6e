#pragma once

// Who made a bundle: Ed25519 signatures (RFC 8032) of its manifest, by libsodium. The manifest
// has the hash of every member, so that its signature vouches for the whole file.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "shared/core/status.h"

namespace lararium::bundle {

struct PublicKey {
  std::array<uint8_t, 32> bytes = {};
  friend bool operator==(const PublicKey&, const PublicKey&) = default;
};

// Kept by whoever makes bundles; players never see it.
struct SecretKey {
  std::array<uint8_t, 64> bytes = {};

  PublicKey public_key() const;
};

using Signature = std::array<uint8_t, 64>;

SecretKey MakeSecretKey();

// Key files are one line of text: "lararium public key 1" or "lararium secret key 1", and the key
// in hexadecimal digits. A secret key's file can be read by its owner alone; none is replaced.
Result<PublicKey> LoadPublicKey(const std::filesystem::path& path);
// place: what errors call the text.
Result<PublicKey> ParsePublicKey(std::string_view text, const std::string& place);
Result<SecretKey> LoadSecretKey(const std::filesystem::path& path);
Status SavePublicKey(const std::filesystem::path& path, const PublicKey& key);
Status SaveSecretKey(const std::filesystem::path& path, const SecretKey& key);

Signature Sign(std::span<const std::byte> manifest, const SecretKey& key);
bool Verifies(std::span<const std::byte> manifest,
              std::span<const std::byte> signature,
              const PublicKey& key);

}  // namespace lararium::bundle
