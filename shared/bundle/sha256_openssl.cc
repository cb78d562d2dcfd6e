#include <openssl/sha.h>

#include "shared/bundle/sha256.h"

namespace lararium::bundle {

static_assert(SHA256_DIGEST_LENGTH == std::tuple_size_v<Sha256>);

// Uses OpenSSL, which has the processor's SHA instructions; libsodium does not.
Sha256 ComputeSha256(std::span<const std::byte> bytes) {
  Sha256 hash;
  SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), hash.data());
  return hash;
}

}  // namespace lararium::bundle
