#include "player/kiosk/secret_file.h"

#include <sys/stat.h>

#include <cstring>

#include "shared/core/file.h"
#include "shared/core/plain_text.h"

namespace lararium::player {
namespace {

constexpr uint64_t kMostSecretBytes = 4096;

}  // namespace

Status CheckSecretFile(const std::filesystem::path& path) {
  struct stat info = {};
  if (::stat(path.c_str(), &info) == 0 && (info.st_mode & (S_IROTH | S_IWOTH)) != 0) {
    return Status::Error(path.string(), "other users of this machine can read or write it",
                         "chmod 600 " + path.string());
  }
  return Status();
}

Result<std::string> ReadSecretLine(const std::filesystem::path& path) {
  LARARIUM_RETURN_IF_ERROR(CheckSecretFile(path));
  LARARIUM_ASSIGN_OR_RETURN(std::string bytes, ReadText(path, kMostSecretBytes));
  std::string text = PlainText(bytes);
  std::string line = text.substr(0, text.find('\n'));
  line.resize(line.find_last_not_of(" \t") + 1);
  ::explicit_bzero(bytes.data(), bytes.size());
  ::explicit_bzero(text.data(), text.size());
  return line;
}

}  // namespace lararium::player
