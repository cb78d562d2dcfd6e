#include "shared/bundle/bundle_parts.h"

#include <zlib.h>

#include <map>
#include <string>
#include <string_view>
#include <system_error>

#include "shared/bundle/member_name.h"
#include "shared/bundle/zip_layout.h"
#include "shared/bundle/zip_reader.h"
#include "shared/core/check.h"

namespace lararium::bundle {
namespace {

// Where the content of a member begins whose local header is at `offset`.
uint64_t ContentBegin(uint64_t offset, std::string_view name) {
  return offset + kLocalSize + name.size() + ExtraSize(offset, name.size());
}

void Append(uint64_t value, size_t bytes, std::vector<std::byte>& to) {
  for (size_t i = 0; i < bytes; ++i) {
    to.push_back(static_cast<std::byte>(value >> (8 * i) & 0xff));
  }
}

std::vector<std::byte> LocalHeader(uint64_t offset,
                                   std::string_view name,
                                   std::span<const std::byte> content) {
  const auto* bytes = reinterpret_cast<const Bytef*>(content.data());
  const size_t extra = ExtraSize(offset, name.size());
  std::vector<std::byte> header;
  Append(kLocalSignature, 4, header);
  Append(kVersionNeeded, 2, header);
  Append(0, 4, header);  // Flags and method.
  Append(kDosTime, 2, header);
  Append(kDosDate, 2, header);
  Append(crc32_z(0, bytes, content.size()), 4, header);
  Append(content.size(), 4, header);
  Append(content.size(), 4, header);
  Append(name.size(), 2, header);
  Append(extra, 2, header);
  for (const char c : name) {
    header.push_back(static_cast<std::byte>(c));
  }
  Append(kAlignmentField, 2, header);
  Append(extra - kExtraHeaderSize, 2, header);
  Append(kAlignment, 2, header);
  header.resize(ContentBegin(offset, name) - offset);
  return header;
}

}  // namespace

uint64_t HeadSize(uint64_t manifest_size) {
  const uint64_t signature = ContentBegin(0, kManifestName) + manifest_size;
  return ContentBegin(signature, kSignatureName) + std::tuple_size_v<Signature>;
}

bool IsBundleOf(const Publication& publication, const std::filesystem::path& bundle) {
  std::error_code error;
  if (std::filesystem::file_size(bundle, error) != publication.size || error) {
    return false;
  }
  const auto manifest = ReadBytesAt(bundle, ContentBegin(0, kManifestName),
                                    static_cast<size_t>(publication.manifest_size));
  return manifest.ok() && ComputeSha256(*manifest) == publication.manifest;
}

Result<ShowManifest> ReadHead(std::span<const std::byte> head,
                              const Publication& publication,
                              const std::string& where) {
  CHECK(head.size() == HeadSize(publication.manifest_size));
  const std::span<const std::byte> manifest =
      head.subspan(static_cast<size_t>(ContentBegin(0, kManifestName)), publication.manifest_size);
  if (ComputeSha256(manifest) != publication.manifest) {
    return Status::Error(where, "does not begin with the manifest that was published", kCopyAgain);
  }
  return ParseShowManifest({reinterpret_cast<const char*>(manifest.data()), manifest.size()},
                           where + ": " + std::string(kManifestName));
}

Result<std::vector<BundlePart>> PartsOf(const Publication& publication,
                                        const ShowManifest& manifest,
                                        const Bundle* former) {
  std::map<Sha256, std::string_view> known;
  if (former != nullptr) {
    for (const Member& member : former->manifest().members) {
      known.emplace(member.sha256, member.name);
    }
  }
  std::vector<BundlePart> parts;
  uint64_t offset = HeadSize(publication.manifest_size);
  const auto fetch_until = [&](uint64_t end) {
    if (parts.empty() || !parts.back().header.empty()) {
      parts.push_back({offset, offset});
    }
    offset = parts.back().end = end;
  };
  for (const Member& member : manifest.members) {
    const uint64_t end = ContentBegin(offset, member.name) + member.size;
    const auto same = known.find(member.sha256);
    if (same == known.end()) {
      fetch_until(end);
    } else {
      const std::span<const std::byte> content = *former->member(same->second);
      parts.push_back({offset, end, LocalHeader(offset, member.name, content), content});
      offset = end;
    }
  }
  if (offset >= publication.size) {
    return Status::Error(publication.file(), "is published with a size that is too small",
                         kCopyAgain);
  }
  fetch_until(publication.size);
  return parts;
}

}  // namespace lararium::bundle
