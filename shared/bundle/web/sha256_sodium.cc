#include <sodium/crypto_hash_sha256.h>

#include "shared/bundle/sha256.h"

namespace lararium::bundle {

static_assert(crypto_hash_sha256_BYTES == std::tuple_size_v<Sha256>);

// In a browser there are no SHA instructions for OpenSSL to use.
Sha256 ComputeSha256(std::span<const std::byte> bytes) {
  Sha256 hash;
  crypto_hash_sha256(hash.data(), reinterpret_cast<const unsigned char*>(bytes.data()),
                     bytes.size());
  return hash;
}

}  // namespace lararium::bundle
