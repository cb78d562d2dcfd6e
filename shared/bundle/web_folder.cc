#include "shared/bundle/web_folder.h"

#include <fcntl.h>
#include <libdeflate.h>
#include <stdio.h>
#include <stdlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <set>
#include <utility>

#include "shared/bundle/member_name.h"
#include "shared/core/check.h"
#include "shared/core/file.h"

namespace lararium::bundle {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kShow = "show";  // The folder of manifest, signature and pieces.
constexpr std::string_view kKeyName = "museum.pub";
// A compressed piece that is not smaller than this share of the member is not worth the time.
constexpr double kPays = 0.97;

std::vector<std::byte> Compress(std::span<const std::byte> bytes) {
  constexpr int kSmallest = 12;
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
      libdeflate_alloc_compressor(kSmallest), libdeflate_free_compressor);
  CHECK(compressor != nullptr);
  std::vector<std::byte> packed(libdeflate_gzip_compress_bound(compressor.get(), bytes.size()));
  packed.resize(libdeflate_gzip_compress(compressor.get(), bytes.data(), bytes.size(),
                                         packed.data(), packed.size()));
  CHECK(!packed.empty());
  return packed;
}

Status SystemError(const fs::path& path, std::string_view what) {
  return Status::Error(path.string(), std::string(what) + ": " + std::strerror(errno));
}

// A folder beside `folder` that is removed with its content.
class FolderBeside {
 public:
  static Result<FolderBeside> Make(const fs::path& folder) {
    std::string path = folder.string() + ".XXXXXX";
    if (::mkdtemp(path.data()) == nullptr) {
      return SystemError(folder, "cannot be made");
    }
    return FolderBeside(path);
  }
  FolderBeside(FolderBeside&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  FolderBeside& operator=(FolderBeside&& other) = delete;
  ~FolderBeside() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }

  fs::path operator/(std::string_view name) const { return path_ / name; }

 private:
  explicit FolderBeside(fs::path path) : path_(std::move(path)) {}

  fs::path path_;
};

Status WriteFile(const fs::path& file, std::span<const std::byte> bytes) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  return WriteFileAtomically(file, bytes);
}

}  // namespace

Status CheckWebFolder(const fs::path& folder) {
  std::error_code error;
  if (!FileExists(folder) || (fs::is_directory(folder, error) && fs::is_empty(folder, error))) {
    return Status();
  }
  constexpr char kRemedy[] = "name another folder, or move what is in this one elsewhere";
  const auto text = ReadText(folder / kShow / kManifestName);
  const auto manifest = text.ok() ? ParseShowManifest(*text, folder.string()) : text.status();
  if (!manifest.ok() || manifest->page.empty()) {
    return Status::Error(folder.string(), "is there and is not a show for browsers", kRemedy);
  }
  std::set<std::string> ours;
  for (const Member& file : manifest->page) {
    ours.insert(file.name);
  }
  const std::string show = std::string(kShow) + "/";
  ours.insert({show + std::string(kManifestName), show + std::string(kSignatureName)});
  for (const Member& member : manifest->members) {
    ours.insert(show + FormatSha256(member.sha256));
  }
  for (auto entry = fs::recursive_directory_iterator(folder, error);
       !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().lexically_relative(folder).string();
    if (!entry->is_directory() && !ours.contains(name)) {
      return Status::Error(folder.string(), "'" + name + "' is no part of the show in it", kRemedy);
    }
  }
  return error ? Status::Error(folder.string(), "cannot be read: " + error.message()) : Status();
}

namespace {

// Lets `made` take the place of `folder`, which may exist. Leaves the old one below `beside`.
Status Replace(const fs::path& made, const fs::path& folder, const FolderBeside& beside) {
  if (!FileExists(folder)) {
    return ::rename(made.c_str(), folder.c_str()) == 0 ? Status()
                                                       : SystemError(folder, "cannot be made");
  }
  if (::renameat2(AT_FDCWD, made.c_str(), AT_FDCWD, folder.c_str(), RENAME_EXCHANGE) == 0) {
    return Status();
  }
  // Some file systems cannot exchange folders.
  const fs::path former = beside / "former";
  if (::rename(folder.c_str(), former.c_str()) != 0) {
    return SystemError(folder, "cannot be replaced");
  }
  if (::rename(made.c_str(), folder.c_str()) != 0) {
    const Status status = SystemError(folder, "cannot be replaced");
    CHECK(::rename(former.c_str(), folder.c_str()) == 0);
    return status;
  }
  return Status();
}

std::string KindOf(const std::string& member) {
  const size_t first = member.find('/');
  const std::string kind = member.substr(0, first);
  return kind == "speech" ? member.substr(0, member.find('/', first + 1)) : kind;
}

// Writes the pieces, and lists them in the manifest.
Status WritePieces(const fs::path& folder,
                   const std::vector<MemberContent>& members,
                   ShowManifest& manifest,
                   WebFolderReport& report) {
  LARARIUM_ASSIGN_OR_RETURN(const ContentBytes bytes, ContentBytes::Open(members));
  std::map<Sha256, uint64_t> written;  // The packed size of each piece.
  manifest.members.clear();
  for (size_t i = 0; i < members.size(); ++i) {
    Member member{members[i].name, bytes[i].size(), ComputeSha256(bytes[i])};
    const auto [known, is_new] = written.try_emplace(member.sha256, 0);
    if (is_new) {
      const std::vector<std::byte> packed = Compress(bytes[i]);
      const bool pays =
          static_cast<double>(packed.size()) < kPays * static_cast<double>(bytes[i].size());
      known->second = pays ? packed.size() : 0;
      LARARIUM_RETURN_IF_ERROR(
          WriteFile(folder / FormatSha256(member.sha256), pays ? packed : bytes[i]));
      report.members[KindOf(member.name)] += pays ? packed.size() : bytes[i].size();
    }
    member.packed = known->second;
    manifest.members.push_back(std::move(member));
  }
  return Status();
}

// Writes the files of the page, and lists them in the manifest. Programs are compressed: many
// servers send them as they are.
Status WritePage(const fs::path& folder,
                 const std::vector<MemberContent>& page,
                 ShowManifest& manifest,
                 WebFolderReport& report) {
  LARARIUM_ASSIGN_OR_RETURN(const ContentBytes bytes, ContentBytes::Open(page));
  for (size_t i = 0; i < page.size(); ++i) {
    const std::string& name = page[i].name;
    const std::vector<std::byte> packed =
        name.ends_with(".wasm") ? Compress(bytes[i]) : std::vector<std::byte>();
    const std::span<const std::byte> file = packed.empty() ? bytes[i] : packed;
    LARARIUM_RETURN_IF_ERROR(WriteFile(folder / name, file));
    manifest.page.push_back({name, file.size(), ComputeSha256(file)});
    report.page += file.size();
  }
  return Status();
}

}  // namespace

Result<WebFolderReport> WriteWebFolder(const fs::path& folder,
                                       ShowManifest manifest,
                                       const std::vector<MemberContent>& members,
                                       std::vector<MemberContent> page,
                                       const SecretKey& key) {
  std::error_code error;
  fs::path target = fs::weakly_canonical(folder, error);
  if (error) {
    return Status::Error(folder.string(), "cannot be reached: " + error.message());
  }
  target = target.has_filename() ? target : target.parent_path();
  LARARIUM_RETURN_IF_ERROR(CheckWebFolder(target));
  LARARIUM_ASSIGN_OR_RETURN(const FolderBeside beside, FolderBeside::Make(target));
  const fs::path made = beside / "folder";
  const std::string public_key = FormatPublicKey(key.public_key());
  page.push_back({std::string(kKeyName), std::as_bytes(std::span(public_key))});
  WebFolderReport report;
  LARARIUM_RETURN_IF_ERROR(WritePage(made, page, manifest, report));
  LARARIUM_RETURN_IF_ERROR(WritePieces(made / kShow, members, manifest, report));
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, FormatChecked(manifest, folder.string()));
  const std::span<const std::byte> bytes = std::as_bytes(std::span(text));
  const Signature signature = Sign(bytes, key);
  LARARIUM_RETURN_IF_ERROR(WriteFile(made / kShow / kManifestName, bytes));
  LARARIUM_RETURN_IF_ERROR(
      WriteFile(made / kShow / kSignatureName, std::as_bytes(std::span(signature))));
  LARARIUM_RETURN_IF_ERROR(Replace(made, target, beside));
  return report;
}

}  // namespace lararium::bundle
