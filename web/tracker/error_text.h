#pragma once

#include <string>

#include "shared/core/status.h"

namespace lararium::web {

// An error's text for JavaScript, which stays until the next call, or nullptr.
inline const char* ErrorText(const Status& status) {
  static std::string text;
  text = status.message();
  return status.ok() ? nullptr : text.c_str();
}

}  // namespace lararium::web
