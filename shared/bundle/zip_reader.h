#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"

namespace lararium::bundle {

struct ZipMember {
  std::string_view name;
  std::span<const std::byte> data;
  uint32_t crc32 = 0;  // as the archive states it; not computed
};

// The members of an archive of the form that zip_layout.h describes, in their
// order; they point into file. Any other form is an error: names, order, gaps,
// overlaps, duplicates and every byte of every header are checked. What remains
// for the caller to check is the content of data.
Result<std::vector<ZipMember>> ReadZip(std::span<const std::byte> file, const std::string& place);

}  // namespace lararium::bundle
