#pragma once

// Finding named entries of a document, and checking the names of new ones.

#include <string>
#include <utility>
#include <vector>

#include "editor/document/document_fields.h"
#include "editor/document/titles.h"
#include "shared/core/status.h"

namespace lararium::editor {

// For example "a, b, c".
std::string JoinNames(const std::vector<std::string>& names);

// The names of the entries, for errors: "a, b".
template <typename Entry>
std::string NamesOf(const std::vector<Entry>& entries) {
  std::string names;
  for (const Entry& entry : entries) {
    names += (names.empty() ? "" : ", ") + entry.name;
  }
  return names;
}

// A pointer to an entry of a vector, which may be const.
template <typename Entries>
using EntryPointer = decltype(std::declval<Entries&>().data());

// Finds the entry with a name. Otherwise the error says that place has no such entry, and lists
// those that exist. has_no: for example "has no occluder".
template <typename Entries>
Result<EntryPointer<Entries>> FindNamed(Entries& entries,
                                        const std::string& name,
                                        const std::string& where,
                                        const std::string& has_no) {
  for (auto& entry : entries) {
    if (entry.name == name) {
      return &entry;
    }
  }
  const std::string known = NamesOf(entries);
  return Status::Error(where, has_no + " \"" + name + "\"",
                       known.empty() ? "there is none yet; add it" : "it has " + known);
}

// The same for places and people, which are also found by their titles.
template <typename Entries>
Result<EntryPointer<Entries>> FindTitled(Entries& entries,
                                         const std::string& name,
                                         const std::string& where,
                                         const std::string& has_no) {
  Result<EntryPointer<Entries>> found = FindNamed(entries, name, where, has_no);
  for (auto& entry : entries) {
    if (!found.ok() && entry.title == name) {
      return &entry;
    }
  }
  return found;
}

// Whether a new entry can have the name: it must be valid as a file name and not in use. option:
// the command line option, for errors.
Status CheckPlainName(const std::string& option, const std::string& name);
// Whether a text can be a title (titles.h).
Status CheckTitle(const std::string& option, const std::string& title);
template <typename Entry>
Status CheckNewName(const std::vector<Entry>& entries,
                    const std::string& option,
                    const std::string& name) {
  LARARIUM_RETURN_IF_ERROR(CheckPlainName(option, name));
  for (const Entry& entry : entries) {
    if (entry.name == name) {
      return Status::Error(option, "there is a \"" + name + "\" already",
                           "choose another name, or change that one with --set");
    }
  }
  return Status();
}

// Names an entry that is new, or renames one, by what the command line gives: its name, or a title
// that a free name is made of. otherwise: the name where nothing of the title can be in one.
template <typename Entry>
Status NameEntry(const std::vector<Entry>& entries,
                 const std::string& option,
                 const std::string& given,
                 const std::string& otherwise,
                 Entry& entry) {
  if (IsPlainName(given)) {
    LARARIUM_RETURN_IF_ERROR(CheckNewName(entries, option, given));
    entry.name = given;
    entry.title.clear();
    return Status();
  }
  LARARIUM_RETURN_IF_ERROR(CheckTitle(option, given));
  for (const Entry& known : entries) {
    if (known.title == given) {
      return Status::Error(option, "there is a \"" + given + "\" already", "choose another title");
    }
  }
  entry.name = FreeNameOf(given, otherwise, [&](const std::string& name) {
    return !CheckNewName(entries, option, name).ok();
  });
  entry.title = given;
  return Status();
}

}  // namespace lararium::editor
