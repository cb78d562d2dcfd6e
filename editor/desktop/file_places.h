#pragma once

// The folders that a list of files offers to begin with.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lararium::editor {

struct FilePlace {
  enum class Kind { kHome, kDesktop, kDocuments, kPictures, kVideos, kMedia };
  Kind kind = Kind::kHome;
  std::filesystem::path folder;

  friend bool operator==(const FilePlace&, const FilePlace&) = default;
};

// The user's folders that user-dirs.dirs (xdg-user-dirs) names. A folder that is the home itself is
// none of its own.
std::vector<FilePlace> UserPlaces(std::string_view user_dirs, const std::filesystem::path& home);

// Mounted sticks, cards and disks: what /proc/self/mountinfo has below /media, /run/media and /mnt.
std::vector<FilePlace> MountedMedia(std::string_view mountinfo);

// The home, then both of the above as they are now, without folders that do not exist. config: the
// folder of the settings of all programs, which has user-dirs.dirs.
std::vector<FilePlace> FindFilePlaces(const std::filesystem::path& home,
                                      const std::filesystem::path& config);

}  // namespace lararium::editor
