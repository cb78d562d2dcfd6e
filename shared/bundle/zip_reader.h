#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"

namespace lararium::bundle {

// The remedy for a damaged bundle.
inline constexpr char kCopyAgain[] = "copy the bundle again, or export it again";

struct ZipMember {
  std::string_view name;
  std::span<const std::byte> data;
  uint32_t crc32 = 0;  // The value in the archive, not verified.
};

// Returns the members of an archive in the form of zip_layout.h, in their order; they point into
// `file`. Any other form is an error: names, order, gaps, overlaps, duplicates and every byte of
// every header are checked. The caller must check the content of the data.
Result<std::vector<ZipMember>> ReadZip(std::span<const std::byte> file, const std::string& where);

}  // namespace lararium::bundle
