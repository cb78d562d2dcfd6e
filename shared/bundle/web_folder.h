#pragma once

// Writes a show as a folder of files that any web server can serve: a page, and the show in pieces
// (docs/file-formats.md).

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "shared/bundle/bundle_writer.h"

namespace lararium::bundle {

// Bytes of files in the folder.
struct WebFolderReport {
  uint64_t page = 0;
  // Key: the first part of the members' names, such as "cast"; for speech also the language.
  std::map<std::string, uint64_t> members;
};

// A folder may be written if it is new, empty, or as WriteWebFolder() left it.
Status CheckWebFolder(const std::filesystem::path& folder);

// Writes the files of the page and the members, each of which gets a file of its own that is named
// by its hash. Replaces a folder that CheckWebFolder() accepts, completely or not at all. Equal
// content and key give equal files. Adds the public key as a file of the page.
Result<WebFolderReport> WriteWebFolder(const std::filesystem::path& folder,
                                       ShowManifest manifest,
                                       const std::vector<MemberContent>& members,
                                       std::vector<MemberContent> page,
                                       const SecretKey& key);

}  // namespace lararium::bundle
