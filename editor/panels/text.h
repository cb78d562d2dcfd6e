#pragma once

// The texts of the interface in the language of whoever uses it (gettext; docs of the
// catalogues in po/).

#include <string>

namespace lararium::panels {

// Chooses the language of the environment (LANGUAGE, LC_MESSAGES, LANG). folder: where
// LANGUAGE/LC_MESSAGES/lararium.mo lie. Without a catalogue texts stay English.
void LoadTexts(const std::string& folder);

// The text, translated. Literals only: they are gathered from the sources.
const char* Tr(const char* text) __attribute__((format_arg(1)));

// Marks a literal that is translated where it is shown.
constexpr const char* TrLater(const char* text) { return text; }

// The same of a text with a number in it: one for 1, many otherwise, both with %d.
std::string TrCount(const char* one, const char* many, int count);

// As printf writes it.
std::string Text(const char* format, ...) __attribute__((format(printf, 1, 2)));

}  // namespace lararium::panels
