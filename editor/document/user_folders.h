#pragma once

// Files that belong to the user rather than to a project, and their folders (XDG base directories),
// which need not exist.

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>

#include "shared/core/file.h"
#include "shared/core/json.h"
#include "shared/core/json_fields.h"
#include "shared/core/status.h"

namespace lararium::editor {

std::filesystem::path StateFolder();   // State that is kept between starts.
std::filesystem::path ConfigFolder();  // The user's settings.
std::filesystem::path CacheFolder();   // Files that can be generated again.
std::filesystem::path DataFolder();    // The user's own data.

// Moves an unreadable file to FILE.damaged, so that a new one can be written. Returns an error that
// tells why and where it went. remedy: what the user can do without the file.
Status SetAside(const std::filesystem::path& file, const Status& why, std::string_view remedy);

// Reads a JSON file of the user's; the default value without a file. An unreadable one is set
// aside.
template <typename T>
Result<T> LoadUserFile(const std::filesystem::path& file,
                       std::string_view remedy,
                       Description<T> describe) {
  constexpr size_t kMostBytes = size_t{1} << 20;
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    return T();
  }
  const Result<std::string> text = ReadText(file, kMostBytes);
  Result<T> value = text.ok() ? ParseFields<T>(*text, file.string(), describe) : text.status();
  return value.ok() ? std::move(value) : SetAside(file, value.status(), remedy);
}

// Writes a JSON file of the user's, and its folder where that is missing.
template <typename T>
Status SaveUserFile(const std::filesystem::path& file,
                    const T& value,
                    std::type_identity_t<Description<T>> describe) {
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  return SaveJson(file, FormatFields(value, describe));
}

// The user's home; "/" where the system does not define it.
std::filesystem::path HomeFolder();

}  // namespace lararium::editor
