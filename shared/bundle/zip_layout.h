#pragma once

// The only form of zip archive that a bundle may have (docs/file-formats.md), shared by the reader
// and the writer. Names and numbers are those of PKWARE's APPNOTE.TXT, sections 4.3.7, 4.3.12 and
// 4.3.16; all values are little-endian.
//
// There is no compression, no encryption, no data descriptors, no zip64, no comments and no gaps.
// Each local header has one extra field, whose payload is the alignment (2 bytes) followed by
// zeros, so that the data after it begin at a multiple of kAlignment. Every other byte has exactly
// one possible value, so a reader detects any change.

#include <cstddef>
#include <cstdint>

namespace lararium::bundle {

inline constexpr uint32_t kLocalSignature = 0x04034b50;
inline constexpr uint32_t kCentralSignature = 0x02014b50;
inline constexpr uint32_t kEndSignature = 0x06054b50;
inline constexpr size_t kLocalSize = 30;
inline constexpr size_t kCentralSize = 46;
inline constexpr size_t kEndSize = 22;

inline constexpr uint16_t kVersionMadeBy = 63;  // 6.3, MS-DOS
inline constexpr uint16_t kVersionNeeded = 10;  // 1.0: stored files

inline constexpr size_t kAlignment = 64;
inline constexpr uint16_t kAlignmentField = 0xd935;  // the id that Android's zipalign uses
inline constexpr size_t kExtraHeaderSize = 4;        // id, length

// 1980-01-01 00:00:00. Bundles have no dates, so that equal content gives equal files.
inline constexpr uint16_t kDosTime = 0;
inline constexpr uint16_t kDosDate = 1 << 5 | 1;

inline constexpr size_t kMaxMembers = 16384;
inline constexpr uint64_t kMaxBundleBytes = (uint64_t{1} << 32) - 1;
inline constexpr uint64_t kMaxManifestBytes = 16 << 20;

// Size of the extra field, including its header, of a member whose local header begins at `offset`.
inline constexpr size_t ExtraSize(uint64_t offset, size_t name_size) {
  const uint64_t shortest = offset + kLocalSize + name_size + kExtraHeaderSize + 2;
  return kExtraHeaderSize + 2 + (kAlignment - shortest % kAlignment) % kAlignment;
}

}  // namespace lararium::bundle
