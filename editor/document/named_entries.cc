#include "editor/document/named_entries.h"

namespace lararium::editor {

std::string JoinNames(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

Status CheckPlainName(const std::string& option, const std::string& name) {
  return IsPlainName(name) ? Status()
                           : Status::Error(option, "\"" + name + "\" is not a valid name",
                                           "use 1 to 64 letters, digits, '_' and '-'");
}

Status CheckTitle(const std::string& option, const std::string& title) {
  return IsTitle(title)
             ? Status()
             : Status::Error(option, "\"" + title + "\" is not a valid title",
                             "use one line of at most " + std::to_string(kMaxTitle) + " bytes");
}

}  // namespace lararium::editor
