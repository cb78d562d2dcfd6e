#include "editor/text/text.h"

#include <libintl.h>

#include <algorithm>
#include <clocale>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <list>
#include <shared_mutex>

#include "shared/core/fork.h"
#include "shared/core/program.h"

namespace lararium::editor {

namespace {

constexpr const char* kDomain = "lararium";
// A locale in which gettext follows LANGUAGE. It does not in "C" nor, in the glibc of Debian 13, in
// "C.UTF-8". The C library finds no territory XX and takes C.UTF-8, which every system has.
constexpr const char* kPlainLocale = "C_XX.UTF-8";

std::string Variable(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

// The languages that gettext would use, also where their locale is not installed.
std::string LanguagesOfEnvironment() {
  std::string locale;
  for (const char* name : {"LC_ALL", "LC_MESSAGES", "LANG"}) {
    locale = locale.empty() ? Variable(name) : locale;
  }
  if (locale.empty() || locale == "C" || locale == "POSIX") {
    return "en";
  }
  const std::string languages = Variable("LANGUAGE");
  return languages.empty() ? locale : languages;
}

// Sets LANGUAGE, which gettext follows in every locale except "C". Other threads may read the
// environment at the same time, so strings that were put there are never freed.
void SetLanguages(const std::string& languages) {
  static std::list<std::string> kept;
  kept.push_back("LANGUAGE=" + languages);
  putenv(kept.back().data());
}

}  // namespace

std::filesystem::path TextFolder() { return ShippedData("locale", "po"); }

void LoadTexts(const std::filesystem::path& folder, const std::string& language) {
  static const std::string of_environment = LanguagesOfEnvironment();
  const std::shared_lock gate(ForkGate());
  SetLanguages(language.empty() ? of_environment : language);
  std::setlocale(LC_MESSAGES, "C");  // A change of the locale makes gettext clear its cache.
  std::setlocale(LC_MESSAGES, kPlainLocale);
  bindtextdomain(kDomain, folder.c_str());
  bind_textdomain_codeset(kDomain, "UTF-8");
}

const char* Tr(const char* text) {
  const std::shared_lock gate(ForkGate());
  return *text == '\0' ? text : dgettext(kDomain, text);
}

const char* TrIn(const char* context, const char* text) {
  const std::string key = std::string(context) + '\004' + text;  // The separator that msgfmt uses.
  const std::shared_lock gate(ForkGate());
  const char* translated = dgettext(kDomain, key.c_str());
  return translated == key.c_str() ? text : translated;
}

std::string TrCount(const char* one, const char* many, int count) {
  char text[256];
  const std::shared_lock gate(ForkGate());
  std::snprintf(text, sizeof(text),
                dngettext(kDomain, one, many, static_cast<unsigned long>(count)), count);
  return text;
}

std::string Label(const char* translated, const char* id) {
  return std::string(translated) + "###" + id;
}

std::string Text(const char* format, ...) {
  va_list values;
  va_start(values, format);
  va_list again;
  va_copy(again, values);
  std::string text(static_cast<size_t>(std::max(std::vsnprintf(nullptr, 0, format, values), 0)),
                   '\0');
  std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  va_end(values);
  return text;
}

}  // namespace lararium::editor
