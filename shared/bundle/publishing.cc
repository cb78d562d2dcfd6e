#include "shared/bundle/publishing.h"

#include <algorithm>
#include <optional>
#include <system_error>

#include "shared/bundle/bundle.h"
#include "shared/bundle/zip_reader.h"
#include "shared/core/file.h"

namespace lararium::bundle {
namespace {

namespace fs = std::filesystem;

Result<std::optional<Publication>> NewestIn(const fs::path& folder, const PublicKey& key) {
  const fs::path file = folder / kNewestName;
  if (!FileExists(file)) {
    return std::optional<Publication>();
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(file, kMaxNewestBytes));
  auto newest = ParsePublication(text, key, file.string());
  return newest.ok()
             ? Result<std::optional<Publication>>(*newest)
             : Status::Error(folder.string(), "holds shows that were published with another key",
                             "name that key with --sign, or name another folder");
}

// Describes a bundle, which is verified first.
Result<Publication> Describe(const fs::path& file, const PublicKey& key) {
  LARARIUM_RETURN_IF_ERROR(Bundle::Open(file, {.trusted = key}).status());
  LARARIUM_ASSIGN_OR_RETURN(const MappedFile mapped, MappedFile::Open(file));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<ZipMember> members,
                            ReadZip(mapped.bytes(), file.string()));
  const std::span<const std::byte> manifest = members.front().data;
  return Publication{.manifest = ComputeSha256(manifest),
                     .manifest_size = manifest.size(),
                     .size = mapped.bytes().size()};
}

// Removes published bundles except the two named.
void RemoveOlder(const fs::path& folder, const std::string& newest, const std::string& former) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const fs::path& file = entry.path();
    if (file.extension() == ".larshow" && ParseSha256(file.stem().string()) &&
        file.filename() != newest && file.filename() != former) {
      fs::remove(file, ignored);
    }
  }
}

}  // namespace

Status CheckPublishing(const fs::path& folder, const PublicKey& key) {
  return NewestIn(folder, key).status();
}

Result<Publication> Publish(const fs::path& bundle,
                            const fs::path& folder,
                            const SecretKey& key,
                            uint64_t time) {
  LARARIUM_ASSIGN_OR_RETURN(const std::optional<Publication> former,
                            NewestIn(folder, key.public_key()));
  LARARIUM_ASSIGN_OR_RETURN(Publication newest, Describe(bundle, key.public_key()));
  const bool is_new = !former || former->manifest != newest.manifest;
  newest.serial = is_new ? std::max(former ? former->serial + 1 : 1, time) : former->serial;
  std::error_code error;
  fs::create_directories(folder, error);
  fs::rename(bundle, folder / newest.file(), error);
  if (error) {
    return Status::Error(folder.string(), "cannot be written: " + error.message());
  }
  LARARIUM_RETURN_IF_ERROR(
      WriteFileAtomically(folder / kNewestName, FormatPublication(newest, key)));
  if (is_new) {
    RemoveOlder(folder, newest.file(), former ? former->file() : "");
  }
  return newest;
}

}  // namespace lararium::bundle
