#pragma once

#include <string>
#include <utility>
#include <vector>

namespace lararium {

// A sentence that is kept apart from what it speaks of, so that it can be said in another language
// later: English where programs and logs read it, a translation where a window shows it.
class Sentence {
 public:
  // The English text of a format in another language; gettext's.
  using Translate = const char* (*)(const char*);

  Sentence() = default;  // says nothing
  // The same in every language: a name, a number with its unit, what is known in English alone.
  Sentence(std::string text) : text_(std::move(text)) {}
  // format: a literal, which the catalogues gather, with %s for each of the parts: in their order,
  // or by number, as %2$s, where another language wants another order; %% is a percent sign.
  explicit Sentence(const char* format, std::vector<Sentence> parts = {});

  std::string English() const;
  std::string Translated(Translate translate) const;

  friend bool operator==(const Sentence&, const Sentence&) = default;

 private:
  std::string text_;  // as it is, or a format
  bool is_format_ = false;
  std::vector<Sentence> parts_;
};

// Each in English.
std::vector<std::string> EnglishOf(const std::vector<Sentence>& sentences);

}  // namespace lararium
