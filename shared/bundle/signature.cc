#include "shared/bundle/signature.h"

#include <fcntl.h>
#include <sodium/core.h>
#include <sodium/crypto_sign_ed25519.h>
#include <sodium/utils.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/check.h"
#include "shared/core/file.h"
#include "shared/core/plain_text.h"

namespace lararium::bundle {
namespace {

static_assert(crypto_sign_ed25519_PUBLICKEYBYTES == 32);
static_assert(crypto_sign_ed25519_SECRETKEYBYTES == 64);
static_assert(crypto_sign_ed25519_BYTES == 64);

constexpr std::string_view kPublic = "lararium public key 1 ";
constexpr std::string_view kSecret = "lararium secret key 1 ";
constexpr size_t kMostKeyFile = 4096;  // bytes
// Prefixes of the signed data, by Signed.
constexpr std::array<std::string_view, 2> kPurposes = {"lararium bundle manifest 1\n",
                                                       "lararium publication 1\n"};

void StartSodium() { CHECK(sodium_init() >= 0); }

std::vector<unsigned char> Message(std::span<const std::byte> bytes, Signed what) {
  const std::string_view purpose = kPurposes[static_cast<size_t>(what)];
  std::vector<unsigned char> message(purpose.size() + bytes.size());
  std::memcpy(message.data(), purpose.data(), purpose.size());
  if (!bytes.empty()) {
    std::memcpy(message.data() + purpose.size(), bytes.data(), bytes.size());
  }
  return message;
}

std::string Hex(std::span<const uint8_t> bytes) {
  std::string text(2 * bytes.size() + 1, '\0');
  sodium_bin2hex(text.data(), text.size(), bytes.data(), bytes.size());
  text.pop_back();
  return text;
}

Status ParseKey(std::string_view text,
                const std::string& where,
                std::string_view kind,
                std::span<uint8_t> key) {
  StartSodium();
  std::string_view rest = WithoutByteOrderMark(text);
  while (!rest.empty() && (rest.back() == '\n' || rest.back() == '\r' || rest.back() == ' ')) {
    rest.remove_suffix(1);
  }
  size_t count = 0;
  const bool begins = rest.substr(0, kind.size()) == kind;
  rest.remove_prefix(begins ? kind.size() : rest.size());
  if (!begins || rest.size() != 2 * key.size() ||
      sodium_hex2bin(key.data(), key.size(), rest.data(), rest.size(), nullptr, &count, nullptr) !=
          0 ||
      count != key.size()) {
    const bool wants_public = kind == kPublic;
    return Status::Error(where,
                         std::string("is not a ") + (wants_public ? "public" : "secret") + " key",
                         wants_public ? "name the .pub file that came with the show"
                                      : "make a key with lararium-editor key");
  }
  return Status();
}

}  // namespace

PublicKey SecretKey::public_key() const {
  PublicKey key;
  crypto_sign_ed25519_sk_to_pk(key.bytes.data(), bytes.data());
  return key;
}

SecretKey MakeSecretKey() {
  StartSodium();
  SecretKey secret;
  PublicKey key;
  crypto_sign_ed25519_keypair(key.bytes.data(), secret.bytes.data());
  return secret;
}

Result<PublicKey> LoadPublicKey(const std::filesystem::path& path) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(path, kMostKeyFile));
  return ParsePublicKey(text, path.string());
}

Result<PublicKey> ParsePublicKey(std::string_view text, const std::string& where) {
  PublicKey key;
  LARARIUM_RETURN_IF_ERROR(ParseKey(text, where, kPublic, key.bytes));
  return key;
}

Result<SecretKey> LoadSecretKey(const std::filesystem::path& path) {
  SecretKey key;
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(path, kMostKeyFile));
  LARARIUM_RETURN_IF_ERROR(ParseKey(text, path.string(), kSecret, key.bytes));
  return key;
}

std::string FormatPublicKey(const PublicKey& key) {
  return std::string(kPublic) + Hex(key.bytes) + "\n";
}

Status SavePublicKey(const std::filesystem::path& path, const PublicKey& key) {
  return WriteFileAtomically(path, FormatPublicKey(key));
}

Status SaveSecretKey(const std::filesystem::path& path, const SecretKey& key) {
  const std::string text = std::string(kSecret) + Hex(key.bytes) + "\n";
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file < 0) {
    return Status::Error(path.string(), std::string("cannot be created: ") + std::strerror(errno),
                         errno == EEXIST ? "keys are never replaced: give another name" : "");
  }
  const bool written =
      ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
      ::fsync(file) == 0;
  ::close(file);
  if (!written) {
    ::unlink(path.c_str());
    return Status::Error(path.string(), "cannot be written", "make room on the disk");
  }
  return Status();
}

Signature Sign(std::span<const std::byte> bytes, const SecretKey& key, Signed what) {
  StartSodium();
  const std::vector<unsigned char> message = Message(bytes, what);
  Signature signature = {};
  crypto_sign_ed25519_detached(signature.data(), nullptr, message.data(), message.size(),
                               key.bytes.data());
  return signature;
}

bool Verifies(std::span<const std::byte> bytes,
              std::span<const std::byte> signature,
              const PublicKey& key,
              Signed what) {
  StartSodium();
  if (signature.size() != std::tuple_size_v<Signature>) {
    return false;
  }
  const std::vector<unsigned char> message = Message(bytes, what);
  return crypto_sign_ed25519_verify_detached(
             reinterpret_cast<const unsigned char*>(signature.data()), message.data(),
             message.size(), key.bytes.data()) == 0;
}

std::string FormatSignature(const Signature& signature) { return Hex(signature); }

std::optional<Signature> ParseSignature(std::string_view text) {
  Signature signature = {};
  size_t count = 0;
  const bool parsed = sodium_hex2bin(signature.data(), signature.size(), text.data(), text.size(),
                                     nullptr, &count, nullptr) == 0;
  return parsed && text.size() == 2 * count && count == signature.size() ? std::optional(signature)
                                                                         : std::nullopt;
}

}  // namespace lararium::bundle
