#pragma once

// Translation of the interface's texts into the user's language: gettext, with the catalogues of
// po/. Subcommands and errors stay English: programs and logs read them too.

#include <filesystem>
#include <string>

namespace lararium::editor {

// The folder of this program's catalogues: share/locale beside its bin/.
std::filesystem::path TextFolder();

// Chooses a language, for example "it". Empty: the language of the environment as it was at the
// first call (LANGUAGE, LC_ALL, LC_MESSAGES, LANG). folder: contains
// LANGUAGE/LC_MESSAGES/lararium.mo. Without a catalogue texts stay English. Only messages change:
// numbers keep their decimal point. May be called again, from one thread, while other threads
// translate.
void LoadTexts(const std::filesystem::path& folder, const std::string& language);

// Translates a text. The argument must be a literal: the catalogue is extracted from the sources.
const char* Tr(const char* text) __attribute__((format_arg(1)));

// Translates an English word that has more than one meaning; context tells them apart.
const char* TrIn(const char* context, const char* text);

// Marks a literal for the catalogue. It is translated where it is shown.
constexpr const char* TrLater(const char* text) { return text; }

// Translates a text with a number: one for 1, many otherwise. Both contain %d.
std::string TrCount(const char* one, const char* many, int count);

// A label of a widget whose state survives a change of language: ImGui identifies it by id alone.
std::string Label(const char* translated, const char* id);

// Formats like printf.
std::string Text(const char* format, ...) __attribute__((format(printf, 1, 2)));

}  // namespace lararium::editor
