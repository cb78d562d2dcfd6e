#include "shared/bundle/bundle_writer.h"

#include <zip.h>

#include <memory>
#include <utility>

#include "shared/bundle/bundle.h"
#include "shared/bundle/member_name.h"
#include "shared/bundle/zip_layout.h"
#include "shared/core/file.h"

namespace lararium::bundle {
namespace {

// Discards an archive that was not written.
struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
using Archive = std::unique_ptr<zip_t, Discard>;

Status ZipError(const std::filesystem::path& path, zip_error_t* error) {
  return Status::Error(path.string(), std::string("cannot write: ") + zip_error_strerror(error));
}

Result<Archive> OpenArchive(const std::filesystem::path& path) {
  int code = 0;
  zip_t* archive = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code);
  if (archive == nullptr) {
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    const Status status = ZipError(path, &error);
    zip_error_fini(&error);
    return status;
  }
  return Archive(archive);
}

// The bytes of a member while the archive is written.
struct Source {
  std::string name;
  std::span<const std::byte> bytes;
};

// Adds a member whose local header begins at `offset`, and advances `offset`.
bool AddMember(zip_t* archive, const Source& source, uint64_t& offset) {
  zip_source_t* buffer = zip_source_buffer(archive, source.bytes.data(), source.bytes.size(), 0);
  if (buffer == nullptr) {
    return false;
  }
  const zip_int64_t added = zip_file_add(archive, source.name.c_str(), buffer, ZIP_FL_ENC_GUESS);
  if (added < 0) {
    zip_source_free(buffer);
    return false;
  }
  const auto index = static_cast<zip_uint64_t>(added);
  const size_t extra_size = ExtraSize(offset, source.name.size());
  std::vector<zip_uint8_t> extra(extra_size - kExtraHeaderSize, 0);
  extra[0] = kAlignment;
  offset += kLocalSize + source.name.size() + extra_size + source.bytes.size();
  return zip_set_file_compression(archive, index, ZIP_CM_STORE, 0) == 0 &&
         zip_file_set_dostime(archive, index, kDosTime, kDosDate, 0) == 0 &&
         zip_file_set_external_attributes(archive, index, 0, ZIP_OPSYS_DOS, 0) == 0 &&
         zip_file_extra_field_set(archive, index, kAlignmentField, ZIP_EXTRA_FIELD_NEW,
                                  extra.data(), static_cast<zip_uint16_t>(extra.size()),
                                  ZIP_FL_LOCAL) == 0;
}

Status WriteArchive(const std::filesystem::path& path, const std::vector<Source>& sources) {
  LARARIUM_ASSIGN_OR_RETURN(Archive archive, OpenArchive(path));
  uint64_t offset = 0;
  for (const Source& source : sources) {
    if (!AddMember(archive.get(), source, offset)) {
      return ZipError(path, zip_get_error(archive.get()));
    }
  }
  if (offset > kMaxBundleBytes) {
    return Status::Error(path.string(), "the bundle would be larger than 4 GiB",
                         "remove large files from the show, or make them smaller");
  }
  if (zip_close(archive.get()) != 0) {
    return ZipError(path, zip_get_error(archive.get()));
  }
  static_cast<void>(archive.release());  // zip_close() has freed it.
  return Status();
}

}  // namespace

Result<ContentBytes> ContentBytes::Open(const std::vector<MemberContent>& contents) {
  ContentBytes opened;
  for (const MemberContent& content : contents) {
    if (const auto* file = std::get_if<std::filesystem::path>(&content.content)) {
      LARARIUM_ASSIGN_OR_RETURN(MappedFile mapped, MappedFile::Open(*file));
      opened.bytes_.push_back(mapped.bytes());
      opened.files_.push_back(std::move(mapped));
    } else {
      opened.bytes_.push_back(std::get<std::span<const std::byte>>(content.content));
    }
  }
  return opened;
}

Result<std::string> FormatChecked(const ShowManifest& manifest, const std::string& where) {
  std::string text = FormatShowManifest(manifest);
  LARARIUM_RETURN_IF_ERROR(ParseShowManifest(text, where + ": manifest.json").status());
  return text;
}

Status WriteBundle(const std::filesystem::path& path,
                   ShowManifest manifest,
                   const std::vector<MemberContent>& members,
                   const SecretKey* key) {
  LARARIUM_ASSIGN_OR_RETURN(const ContentBytes bytes, ContentBytes::Open(members));
  std::vector<Source> sources = {{std::string(kManifestName), {}}};
  manifest.members.clear();
  for (size_t i = 0; i < members.size(); ++i) {
    sources.push_back({members[i].name, bytes[i]});
    manifest.members.push_back({members[i].name, bytes[i].size(), ComputeSha256(bytes[i])});
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, FormatChecked(manifest, path.string()));
  sources[0].bytes = std::as_bytes(std::span(text));
  Signature signature = {};
  if (key != nullptr) {
    signature = Sign(sources[0].bytes, *key);
    sources.insert(sources.begin() + 1,
                   {std::string(kSignatureName), std::as_bytes(std::span(signature))});
  }

  LARARIUM_ASSIGN_OR_RETURN(FileReplacement replacement, FileReplacement::Begin(path));
  LARARIUM_RETURN_IF_ERROR(WriteArchive(replacement.unfinished(), sources));
  return replacement.Commit();
}

}  // namespace lararium::bundle
