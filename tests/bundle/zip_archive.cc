#include "tests/bundle/zip_archive.h"

#include <zlib.h>

#include "shared/bundle/zip_layout.h"

namespace lararium::test {
namespace {

void Append(std::string& out, uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) {
    out += static_cast<char>(value >> (8 * i) & 0xff);
  }
}

// Writes the fields from "version needed" to the lengths of name and extra field.
void AppendCommon(std::string& out, const ZipEntry& entry, uint32_t size, uint32_t extra_size) {
  const auto crc = crc32(0, reinterpret_cast<const Bytef*>(entry.data.data()),
                         static_cast<uInt>(entry.data.size()));
  Append(out, 10, 2);
  Append(out, entry.flags, 2);
  Append(out, entry.method, 2);
  Append(out, bundle::kDosTime, 2);
  Append(out, bundle::kDosDate, 2);
  Append(out, static_cast<uint32_t>(crc), 4);
  Append(out, size, 4);
  Append(out, size, 4);
  Append(out, static_cast<uint32_t>(entry.name.size()), 2);
  Append(out, extra_size, 2);
}

}  // namespace

std::string MakeZip(const std::vector<ZipEntry>& entries, uint16_t claimed_count) {
  std::string file;
  std::string directory;
  uint16_t count = 0;
  for (const ZipEntry& entry : entries) {
    const auto offset = static_cast<uint32_t>(file.size());
    const auto true_size = static_cast<uint32_t>(entry.data.size());
    const uint32_t size = entry.claimed_size == 0xffffffff ? true_size : entry.claimed_size;
    const size_t extra = bundle::ExtraSize(offset, entry.name.size());
    Append(file, bundle::kLocalSignature, 4);
    AppendCommon(file, entry, size, static_cast<uint32_t>(extra));
    file += entry.name;
    Append(file, bundle::kAlignmentField, 2);
    Append(file, static_cast<uint32_t>(extra - bundle::kExtraHeaderSize), 2);
    Append(file, bundle::kAlignment, 2);
    file.append(extra - bundle::kExtraHeaderSize - 2, '\0');
    file += entry.data;
    if (entry.in_directory) {
      ++count;
      Append(directory, bundle::kCentralSignature, 4);
      Append(directory, 63, 2);
      AppendCommon(directory, entry, size, 0);
      directory.append(10, '\0');  // comment, disk, attributes
      Append(directory, entry.claimed_offset == 0xffffffff ? offset : entry.claimed_offset, 4);
      directory += entry.name;
    }
  }
  const auto directory_begin = static_cast<uint32_t>(file.size());
  file += directory;
  Append(file, bundle::kEndSignature, 4);
  Append(file, 0, 4);  // disks
  Append(file, claimed_count != 0 ? claimed_count : count, 2);
  Append(file, claimed_count != 0 ? claimed_count : count, 2);
  Append(file, static_cast<uint32_t>(directory.size()), 4);
  Append(file, directory_begin, 4);
  Append(file, 0, 2);  // comment
  return file;
}

}  // namespace lararium::test
