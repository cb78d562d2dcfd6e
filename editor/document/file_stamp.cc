#include "editor/document/file_stamp.h"

#include <sys/stat.h>

namespace lararium::editor {

std::string FileStamp(const std::filesystem::path& file) {
  struct ::stat found = {};
  if (::stat(file.c_str(), &found) != 0) {
    return "none";
  }
  return std::to_string(found.st_mtim.tv_sec) + '.' + std::to_string(found.st_mtim.tv_nsec) + ' ' +
         std::to_string(found.st_size) + ' ' + std::to_string(found.st_ino);
}

}  // namespace lararium::editor
