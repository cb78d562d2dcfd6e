#pragma once

// Puts a bundle together from the members that it has in common with another one, and from bytes
// that are fetched. The form of the archive (zip_layout.h) tells from the manifest where everything
// lies, except for the directory at the end, which is fetched.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "shared/bundle/bundle.h"
#include "shared/bundle/publication.h"
#include "shared/core/status.h"

namespace lararium::bundle {

// Number of bytes up to the end of a signed bundle's manifest and signature.
uint64_t HeadSize(uint64_t manifest_size);

// Whether a bundle has the size and the manifest of a publication. Nothing else is verified.
bool IsBundleOf(const Publication& publication, const std::filesystem::path& bundle);

// Reads the manifest of a publication from the first HeadSize() bytes of its bundle, of which it
// verifies nothing else. Errors call them `where`.
Result<ShowManifest> ReadHead(std::span<const std::byte> head,
                              const Publication& publication,
                              const std::string& where);

// Consecutive bytes of a bundle.
struct BundlePart {
  uint64_t begin = 0;
  uint64_t end = 0;
  // The local header and the content of a member that is known; empty: to be fetched.
  std::vector<std::byte> header = {};
  std::span<const std::byte> content = {};
};

// The parts of a publication's bundle after its head, without gaps. former: a bundle that is at
// hand, which must outlive the parts; nullptr: none. Fails if the published size is too small.
Result<std::vector<BundlePart>> PartsOf(const Publication& publication,
                                        const ShowManifest& manifest,
                                        const Bundle* former);

}  // namespace lararium::bundle
