#include "shared/bundle/member_name.h"

namespace lararium::bundle {
namespace {

bool IsWordCharacter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

}  // namespace

bool IsMemberName(std::string_view name) {
  if (name.empty() || name.size() > kMaxMemberName) {
    return false;
  }
  bool at_start = true;  // start of a part
  for (const char c : name) {
    if (c == '/' ? at_start : !IsWordCharacter(c) && (at_start || (c != '-' && c != '.'))) {
      return false;
    }
    at_start = c == '/';
  }
  return !at_start;
}

}  // namespace lararium::bundle
