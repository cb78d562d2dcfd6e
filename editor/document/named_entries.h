#pragma once

// Finding named entries of a document, and checking the names of new ones.

#include <string>
#include <vector>

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

// Finds the entry with a name. Otherwise the error says that place has no such entry, and lists
// those that exist. has_no: for example "has no occluder".
template <typename Entry>
Result<Entry*> FindNamed(std::vector<Entry>& entries,
                         const std::string& name,
                         const std::string& where,
                         const std::string& has_no) {
  for (Entry& entry : entries) {
    if (entry.name == name) {
      return &entry;
    }
  }
  const std::string known = NamesOf(entries);
  return Status::Error(where, has_no + " \"" + name + "\"",
                       known.empty() ? "there is none yet; add it" : "it has " + known);
}

// Whether a new entry can have the name: it must be valid as a file name and not in use. option:
// the command line option, for errors.
Status CheckPlainName(const std::string& option, const std::string& name);
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

}  // namespace lararium::editor
