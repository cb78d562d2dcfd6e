#include "editor/desktop/file_places.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>

namespace lararium::editor {

namespace fs = std::filesystem;

namespace {

// Calls visit(line) for each line.
template <typename Visit>
void ForEachLine(std::string_view text, Visit visit) {
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    visit(line);
  }
}

// Undoes the escapes of /proc: "\040" is a space.
std::string Unescaped(const std::string& text) {
  const auto is_octal = [](char c) { return c >= '0' && c <= '7'; };
  std::string plain;
  for (size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '\\' && at + 3 < text.size() &&
        std::all_of(text.begin() + static_cast<ptrdiff_t>(at) + 1,
                    text.begin() + static_cast<ptrdiff_t>(at) + 4, is_octal)) {
      plain += static_cast<char>(std::stoi(text.substr(at + 1, 3), nullptr, 8));
      at += 3;
    } else {
      plain += text[at];
    }
  }
  return plain;
}

std::string FileText(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

std::vector<FilePlace> UserPlaces(std::string_view user_dirs, const fs::path& home) {
  using Kind = FilePlace::Kind;
  constexpr std::array<std::pair<const char*, Kind>, 4> kNames = {
      {{"XDG_DESKTOP_DIR", Kind::kDesktop},
       {"XDG_DOCUMENTS_DIR", Kind::kDocuments},
       {"XDG_PICTURES_DIR", Kind::kPictures},
       {"XDG_VIDEOS_DIR", Kind::kVideos}}};
  constexpr std::string_view kHome = "$HOME/";
  std::vector<FilePlace> places;
  ForEachLine(user_dirs, [&](const std::string& line) {
    for (const auto& [name, kind] : kNames) {
      const std::string begins = std::string(name) + "=\"";
      if (!line.starts_with(begins) || !line.ends_with('"') || line.size() <= begins.size()) {
        continue;
      }
      const std::string value = line.substr(begins.size(), line.size() - begins.size() - 1);
      fs::path folder =
          value.starts_with(kHome) ? home / value.substr(kHome.size()) : fs::path(value);
      folder = folder.lexically_normal();
      if (folder.is_absolute() && folder != home && folder != home / "") {
        places.push_back({kind, folder});
      }
    }
  });
  return places;
}

std::vector<FilePlace> MountedMedia(std::string_view mountinfo) {
  constexpr size_t kMountPoint = 4;  // The field of a line, from 0.
  std::vector<FilePlace> places;
  ForEachLine(mountinfo, [&](const std::string& line) {
    std::istringstream fields(line);
    std::string field;
    for (size_t i = 0; i <= kMountPoint; ++i) {
      field.clear();
      fields >> field;
    }
    const std::string folder = Unescaped(field);
    for (const char* parent : {"/media/", "/run/media/", "/mnt/"}) {
      if (folder.starts_with(parent)) {
        places.push_back({FilePlace::Kind::kMedia, folder});
      }
    }
  });
  return places;
}

std::vector<FilePlace> FindFilePlaces(const fs::path& home, const fs::path& config) {
  std::vector<FilePlace> places = {{FilePlace::Kind::kHome, home}};
  for (const std::vector<FilePlace>& more : {UserPlaces(FileText(config / "user-dirs.dirs"), home),
                                             MountedMedia(FileText("/proc/self/mountinfo"))}) {
    places.insert(places.end(), more.begin(), more.end());
  }
  std::erase_if(places, [](const FilePlace& place) {
    std::error_code ignored;
    return !fs::is_directory(place.folder, ignored);
  });
  return places;
}

}  // namespace lararium::editor
