#pragma once

// The newest show in a folder on a web server, from which players update themselves. The file
// newest.json names it and is signed; beside it lies the bundle (docs/file-formats.md).

#include <cstdint>
#include <string>
#include <string_view>

#include "shared/bundle/sha256.h"
#include "shared/bundle/signature.h"
#include "shared/core/status.h"

namespace lararium::bundle {

inline constexpr std::string_view kNewestName = "newest.json";
inline constexpr uint64_t kMaxNewestBytes = 1 << 16;

struct Publication {
  // Each publication has a higher serial than those before it.
  uint64_t serial = 0;
  // Hash and size (bytes) of the bundle's manifest.json, which has the hashes of everything else.
  Sha256 manifest = {};
  uint64_t manifest_size = 0;
  // Size of the whole bundle, bytes.
  uint64_t size = 0;

  // Name of the bundle in the folder.
  std::string file() const { return FormatSha256(manifest) + ".larshow"; }
  friend bool operator==(const Publication&, const Publication&) = default;
};

// The content of newest.json.
std::string FormatPublication(const Publication& publication, const SecretKey& key);
// Verifies the signature before it reads anything else. Errors call the text `where`.
Result<Publication> ParsePublication(std::string_view text,
                                     const PublicKey& trusted,
                                     const std::string& where);

}  // namespace lararium::bundle
