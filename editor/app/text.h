#pragma once

// The texts of the interface in the language of whoever uses it: gettext, with the catalogues
// of po/. Subcommands and errors stay English: programs and logs read them too.

#include <filesystem>
#include <string>

namespace lararium::app {

// Where the catalogues of this program lie: share/locale beside its bin/.
std::filesystem::path TextFolder();

// Chooses a language: "it"; empty: that of the environment as it was at the first call
// (LANGUAGE, LC_ALL, LC_MESSAGES, LANG). folder: where LANGUAGE/LC_MESSAGES/lararium.mo lie.
// Without a catalogue texts are English. Only messages change: numbers keep their point.
// May be called again, from one thread, while others translate.
void LoadTexts(const std::filesystem::path& folder, const std::string& language);

// The text, translated. Literals only: they are gathered from the sources.
const char* Tr(const char* text) __attribute__((format_arg(1)));

// The same where an English word has two meanings: context tells them apart.
const char* TrIn(const char* context, const char* text);

// Marks a literal that is translated where it is shown.
constexpr const char* TrLater(const char* text) { return text; }

// The same of a text with a number in it: one for 1, many otherwise, both with %d.
std::string TrCount(const char* one, const char* many, int count);

// A label of a widget whose state outlives a change of language: ImGui knows it by id alone.
std::string Label(const char* translated, const char* id);

// As printf writes it.
std::string Text(const char* format, ...) __attribute__((format(printf, 1, 2)));

}  // namespace lararium::app
