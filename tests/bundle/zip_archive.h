#pragma once

// A zip archive put together by hand, right or wrong in any way.

#include <cstdint>
#include <string>
#include <vector>

namespace lararium::test {

struct ZipEntry {
  std::string name;
  std::string data;
  uint16_t method = 0;
  uint16_t flags = 0;
  uint32_t claimed_size = 0xffffffff;    // in both headers; unless given, the data's
  uint32_t claimed_offset = 0xffffffff;  // in the directory; unless given, the true one
  bool in_directory = true;
};

// In the form that bundles have. claimed_count: in the end record, when not 0.
std::string MakeZip(const std::vector<ZipEntry>& entries, uint16_t claimed_count = 0);

}  // namespace lararium::test
