#include "editor/panels/text.h"

#include <libintl.h>

#include <clocale>
#include <cstdarg>
#include <cstdio>

namespace lararium::panels {

namespace {
constexpr const char* kDomain = "lararium";
}

void LoadTexts(const std::string& folder) {
  std::setlocale(LC_MESSAGES, "");
  bindtextdomain(kDomain, folder.c_str());
  bind_textdomain_codeset(kDomain, "UTF-8");
}

const char* Tr(const char* text) { return *text == '\0' ? text : dgettext(kDomain, text); }

std::string TrCount(const char* one, const char* many, int count) {
  char text[256];
  std::snprintf(text, sizeof(text),
                dngettext(kDomain, one, many, static_cast<unsigned long>(count)), count);
  return text;
}

std::string Text(const char* format, ...) {
  char text[1024];
  va_list values;
  va_start(values, format);
  std::vsnprintf(text, sizeof(text), format, values);
  va_end(values);
  return text;
}

}  // namespace lararium::panels
