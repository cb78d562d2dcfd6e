#pragma once

// Builds zip archives by hand, valid or with any defect.

#include <cstdint>
#include <string>
#include <vector>

namespace lararium::test {

struct ZipEntry {
  std::string name;
  std::string data;
  uint16_t method = 0;
  uint16_t flags = 0;
  // Size in both headers; the default stands for the real size.
  uint32_t claimed_size = 0xffffffff;
  // Offset in the directory; the default stands for the real offset.
  uint32_t claimed_offset = 0xffffffff;
  bool in_directory = true;
};

// Builds an archive in the form of bundles. claimed_count is written to the end record if it is not
// 0.
std::string MakeZip(const std::vector<ZipEntry>& entries, uint16_t claimed_count = 0);

}  // namespace lararium::test
