#include "editor/desktop/file_uri.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string>

#include "shared/core/lower_case.h"
#include "shared/core/utf8.h"

namespace lararium::editor {

namespace {

// Long texts are cut in errors.
std::string Shown(std::string_view uri) {
  constexpr size_t kMost = 200;
  std::string shown(uri.substr(0, kMost));
  for (char& c : shown) {
    c = c < ' ' || c > '~' ? '?' : c;
  }
  return shown + (uri.size() > kMost ? "..." : "");
}

bool IsThisHost(std::string_view host) {
  std::array<char, 256> name = {};
  return host.empty() || LowerCase(host) == "localhost" ||
         (gethostname(name.data(), name.size() - 1) == 0 && host == name.data());
}

// Decodes "%HH". Returns false where that is not well formed.
bool Decode(std::string_view text, std::string& decoded) {
  for (size_t at = 0; at < text.size(); ++at) {
    if (text[at] != '%') {
      decoded += text[at];
      continue;
    }
    unsigned char byte = 0;
    const char* const from = text.data() + at + 1;
    if (at + 2 >= text.size() || std::from_chars(from, from + 2, byte, 16).ptr != from + 2 ||
        byte == 0) {
      return false;
    }
    decoded += static_cast<char>(byte);
    at += 2;
  }
  return true;
}

}  // namespace

Result<std::filesystem::path> PathOfUri(std::string_view uri) {
  constexpr std::string_view kScheme = "file:";
  if (LowerCase(uri.substr(0, kScheme.size())) != kScheme) {
    return Status::Error(Shown(uri), "is not a file of this computer",
                         "copy it to a folder of this computer, and choose it there");
  }
  std::string_view rest = uri.substr(kScheme.size());
  if (rest.starts_with("//")) {
    rest.remove_prefix(2);
    const size_t slash = std::min(rest.find('/'), rest.size());
    if (!IsThisHost(rest.substr(0, slash))) {
      return Status::Error(Shown(uri), "is a file of another computer",
                           "copy it to a folder of this computer, and choose it there");
    }
    rest.remove_prefix(slash);
  }
  std::string path;
  if (!rest.starts_with('/') || !Decode(rest, path)) {
    return Status::Error(Shown(uri), "is not a well-formed address of a file",
                         "choose the file in another way");
  }
  if (!IsUtf8(path)) {
    return Status::Error(Shown(uri), "has a name that is not UTF-8", "rename it");
  }
  return std::filesystem::path(path);
}

}  // namespace lararium::editor
