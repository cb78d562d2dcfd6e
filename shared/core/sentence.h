#pragma once

#include <string>
#include <utility>
#include <vector>

namespace lararium {

// A sentence that is stored separately from its parameters, so that it can be translated later:
// programs and logs read English, windows show a translation.
class Sentence {
 public:
  // Returns the translation of an English format, as gettext does.
  using Translate = const char* (*)(const char*);

  Sentence() = default;  // empty text
  // Text that is equal in every language: a name, a number with its unit, or text that is known in
  // English only.
  Sentence(std::string text) : text_(std::move(text)) {}
  // format: a literal that the translation catalogues collect, with %s for each of the parts in
  // their order, or with numbers such as %2$s if a language needs another order. %% is a percent
  // sign.
  explicit Sentence(const char* format, std::vector<Sentence> parts = {});

  std::string English() const;
  std::string Translated(Translate translate) const;

  friend bool operator==(const Sentence&, const Sentence&) = default;

 private:
  std::string text_;  // plain text or a format
  bool is_format_ = false;
  std::vector<Sentence> parts_;
};

// Returns each sentence in English.
std::vector<std::string> EnglishOf(const std::vector<Sentence>& sentences);

}  // namespace lararium
