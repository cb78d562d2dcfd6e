#include "editor/document/user_folders.h"

#include <cstdlib>
#include <string>

namespace lararium::editor {

namespace {

// The XDG specification requires that relative paths are ignored.
std::filesystem::path UserFolder(const char* variable, const char* below_home) {
  const char* folder = std::getenv(variable);
  const std::filesystem::path base = folder != nullptr && folder[0] == '/'
                                         ? std::filesystem::path(folder)
                                         : HomeFolder() / below_home;
  return base / "lararium";
}

}  // namespace

std::filesystem::path HomeFolder() {
  const char* home = std::getenv("HOME");
  return home != nullptr && home[0] == '/' ? home : "/";
}

Status SetAside(const std::filesystem::path& file, const Status& why, std::string_view remedy) {
  std::filesystem::path aside = file;
  aside += ".damaged";
  std::error_code error;
  std::filesystem::rename(file, aside, error);
  const std::string moved = error ? "" : "it was moved to " + aside.string() + "; ";
  return Status::Error("lararium-editor", why.message(), moved + std::string(remedy));
}

std::filesystem::path StateFolder() { return UserFolder("XDG_STATE_HOME", ".local/state"); }
std::filesystem::path ConfigFolder() { return UserFolder("XDG_CONFIG_HOME", ".config"); }
std::filesystem::path CacheFolder() { return UserFolder("XDG_CACHE_HOME", ".cache"); }
std::filesystem::path DataFolder() { return UserFolder("XDG_DATA_HOME", ".local/share"); }

}  // namespace lararium::editor
