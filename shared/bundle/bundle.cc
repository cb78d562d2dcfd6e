#include "shared/bundle/bundle.h"

#include <zlib.h>

#include <algorithm>
#include <new>

#include "shared/bundle/member_name.h"
#include "shared/bundle/zip_layout.h"
#include "shared/bundle/zip_reader.h"
#include "shared/core/parallel.h"

namespace lararium::bundle {
namespace {

constexpr size_t kPieceAlignment = 64;

// The manifest contains the hashes of all other members. The manifest itself is checked by the
// archive's CRC-32, which detects every change of a few bytes.
Result<ShowManifest> ReadManifest(const ZipMember& member, const std::string& where) {
  if (member.name != kManifestName || member.data.size() > kMaxManifestBytes) {
    return Status::Error(where, "not a bundle of this program: it does not begin with a manifest",
                         "export the bundle with lararium-editor");
  }
  const auto* bytes = reinterpret_cast<const Bytef*>(member.data.data());
  if (crc32_z(0, bytes, member.data.size()) != member.crc32) {
    return Status::Error(where, "the bundle is damaged: its manifest was changed", kCopyAgain);
  }
  const std::string_view text(reinterpret_cast<const char*>(bytes), member.data.size());
  return ParseShowManifest(text, where + ": " + std::string(kManifestName));
}

// Checks the CRC-32 of a member that the manifest does not list.
bool IsWhole(const ZipMember& member, size_t size) {
  const auto* bytes = reinterpret_cast<const Bytef*>(member.data.data());
  return member.data.size() == size && crc32_z(0, bytes, size) == member.crc32;
}

// Checks the signature before the content of the manifest is used.
Status CheckSignature(std::span<const std::byte> manifest,
                      std::span<const std::byte> signature,
                      const PublicKey& trusted,
                      const std::string& where) {
  constexpr char kAsk[] =
      "ask the makers of the show for a bundle that is signed with the museum's key";
  if (signature.empty()) {
    return Status::Error(where, "the bundle is not signed", kAsk);
  }
  if (!Verifies(manifest, signature, trusted)) {
    return Status::Error(where, "the bundle is not signed with the trusted key, or was altered",
                         kAsk);
  }
  return Status();
}

// Checks that the archive contains what the manifest lists, in the same order.
Status CheckListing(const ShowManifest& manifest,
                    std::span<const ZipMember> members,
                    const std::string& where) {
  for (size_t i = 0; i < manifest.members.size(); ++i) {
    const Member& listed = manifest.members[i];
    if (i >= members.size() || members[i].name != listed.name) {
      return Status::Error(
          where, "the bundle is damaged: the member '" + listed.name + "' is not in its place",
          kCopyAgain);
    }
    if (members[i].data.size() != listed.size) {
      return Status::Error(where,
                           "the bundle is damaged: '" + listed.name + "' has " +
                               std::to_string(members[i].data.size()) + " bytes instead of " +
                               std::to_string(listed.size),
                           kCopyAgain);
    }
  }
  if (members.size() > manifest.members.size()) {
    const std::string name(members[manifest.members.size()].name);
    return Status::Error(where, "the bundle is damaged: the manifest does not list '" + name + "'",
                         kCopyAgain);
  }
  return Status();
}

Status Changed(const std::string& where, std::string_view name) {
  return Status::Error(where, "the bundle is damaged: '" + std::string(name) + "' was changed",
                       kCopyAgain);
}

Status CheckHashes(const ShowManifest& manifest,
                   std::span<const ZipMember> members,
                   const std::string& where) {
  std::vector<char> intact(members.size(), 0);
  ParallelFor(members.size(), [&](size_t i) {
    intact[i] = ComputeSha256(members[i].data) == manifest.members[i].sha256 ? 1 : 0;
  });
  for (size_t i = 0; i < members.size(); ++i) {
    if (intact[i] == 0) {
      return Changed(where, manifest.members[i].name);
    }
  }
  return Status();
}

}  // namespace

Piece::Piece(size_t size)
    : bytes_(static_cast<std::byte*>(
          ::operator new(std::max<size_t>(size, 1), std::align_val_t(kPieceAlignment)))),
      size_(size) {}

void Piece::Free::operator()(std::byte* bytes) const {
  ::operator delete(bytes, std::align_val_t(kPieceAlignment));
}

Result<Bundle> Bundle::Open(const std::filesystem::path& path, const OpenOptions& options) {
  const std::string place = path.string();
  Bundle bundle(place);
  LARARIUM_ASSIGN_OR_RETURN(bundle.file_, MappedFile::Open(path));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<ZipMember> all,
                            ReadZip(bundle.file_->bytes(), place));
  if (all.empty()) {
    return Status::Error(place, "the bundle has no members", kCopyAgain);
  }
  bundle.is_signed_ = all.size() > 1 && all[1].name == kSignatureName;
  if (options.trusted) {
    LARARIUM_RETURN_IF_ERROR(
        CheckSignature(all[0].data, bundle.is_signed_ ? all[1].data : std::span<const std::byte>(),
                       *options.trusted, place));
  }
  if (bundle.is_signed_ && !IsWhole(all[1], std::tuple_size_v<Signature>)) {
    return Status::Error(place, "the bundle is damaged: its signature was changed", kCopyAgain);
  }
  LARARIUM_ASSIGN_OR_RETURN(bundle.manifest_, ReadManifest(all[0], place));
  const std::span<const ZipMember> members = std::span(all).subspan(bundle.is_signed_ ? 2 : 1);
  LARARIUM_RETURN_IF_ERROR(CheckListing(bundle.manifest_, members, place));
  LARARIUM_RETURN_IF_ERROR(CheckHashes(bundle.manifest_, members, place));
  for (const ZipMember& member : members) {
    bundle.members_.emplace(member.name, member.data);
  }
  return bundle;
}

Result<Bundle> Bundle::FromManifest(std::string_view manifest,
                                    std::span<const std::byte> signature,
                                    const PublicKey& trusted,
                                    const std::string& where) {
  const std::span<const char> text(manifest.data(), manifest.size());
  LARARIUM_RETURN_IF_ERROR(CheckSignature(std::as_bytes(text), signature, trusted, where));
  Bundle bundle(where);
  bundle.is_signed_ = true;
  LARARIUM_ASSIGN_OR_RETURN(bundle.manifest_,
                            ParseShowManifest(manifest, where + ": " + std::string(kManifestName)));
  return bundle;
}

Status Bundle::Add(std::string_view name, Piece piece) {
  CHECK(!file_);
  const auto listed = std::find_if(manifest_.members.begin(), manifest_.members.end(),
                                   [&](const Member& member) { return member.name == name; });
  if (listed == manifest_.members.end()) {
    return Status::Error(place_, "the manifest does not list '" + std::string(name) + "'",
                         kCopyAgain);
  }
  if (piece.bytes().size() != listed->size || ComputeSha256(piece.bytes()) != listed->sha256) {
    return Changed(place_, name);
  }
  members_.insert_or_assign(listed->name, piece.bytes());
  pieces_.insert_or_assign(listed->name, std::move(piece));
  return Status();
}

void Bundle::Remove(std::string_view name) {
  const auto piece = pieces_.find(name);
  if (piece != pieces_.end()) {
    members_.erase(members_.find(name));
    pieces_.erase(piece);
  }
}

Result<std::span<const std::byte>> Bundle::member(std::string_view name) const {
  const auto found = members_.find(name);
  if (found == members_.end()) {
    return Status::Error(place_, "there is no member '" + std::string(name) + "'");
  }
  return found->second;
}

Result<StoredMember> Bundle::stored(std::string_view name) const {
  CHECK(file_);
  LARARIUM_ASSIGN_OR_RETURN(const std::span<const std::byte> bytes, member(name));
  const auto listed = std::find_if(manifest_.members.begin(), manifest_.members.end(),
                                   [&](const Member& member) { return member.name == name; });
  return StoredMember{place_, listed->name,
                      static_cast<uint64_t>(bytes.data() - file_->bytes().data()), bytes.size(),
                      listed->sha256};
}

Result<std::vector<std::byte>> StoredMember::Read() const {
  LARARIUM_ASSIGN_OR_RETURN(std::vector<std::byte> bytes, ReadBytesAt(file, offset, size));
  if (ComputeSha256(bytes) != sha256) {
    return Status::Error(file.string(), "'" + name + "' was changed since it was opened",
                         "start the show again");
  }
  return bytes;
}

}  // namespace lararium::bundle
