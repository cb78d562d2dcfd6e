#pragma once

// Titles of projects, places and people, and the plain names of their folders and in scripts.

#include <functional>
#include <string>
#include <string_view>

namespace lararium::editor {

inline constexpr size_t kMaxTitle = 200;  // bytes

// Whether a text can be a title: UTF-8 without control characters, not only spaces, and at most
// kMaxTitle bytes.
bool IsTitle(std::string_view text);

// The plain name (IsPlainName) that is nearest to a title: "Casa del Fauno, atrio" gives
// "Casa_del_Fauno_atrio", and "Größe" gives "Groesse". Latin and Greek letters are written in
// ASCII; empty where nothing remains.
std::string PlainNameOf(std::string_view title);

// The plain name of a new entry: that of the title, or `otherwise`, with a number behind it where
// that name is taken.
std::string FreeNameOf(std::string_view title,
                       std::string_view otherwise,
                       const std::function<bool(const std::string&)>& taken);

// Stores the title and the name of an entry. The title stays empty where it is the name.
template <typename Entry>
void SetTitle(const std::string& title, Entry& entry) {
  entry.title = title == entry.name ? "" : title;
}

}  // namespace lararium::editor
