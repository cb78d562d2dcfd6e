#include "shared/core/sentence.h"

#include <string_view>
#include <utility>

namespace lararium {
namespace {

const char* AsItIs(const char* text) { return text; }

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// A conversion that begins with a percent sign.
struct Conversion {
  size_t length = 1;  // length including the percent sign
  bool is_part = false;
  size_t number = 0;  // Number of the part, from 1; 0: the next part.
};

Conversion ReadConversion(std::string_view text) {
  if (text.starts_with("%s")) {
    return {2, true, 0};
  }
  if (text.size() >= 4 && IsDigit(text[1]) && text.substr(2, 2) == "$s") {
    return {4, true, static_cast<size_t>(text[1] - '0')};
  }
  return {text.starts_with("%%") ? size_t{2} : size_t{1}};
}

}  // namespace

Sentence::Sentence(const char* format, std::vector<Sentence> parts)
    : text_(format), is_format_(true), parts_(std::move(parts)) {}

std::string Sentence::English() const { return Translated(AsItIs); }

std::string Sentence::Translated(Translate translate) const {
  if (!is_format_) {
    return text_;
  }
  const std::string_view format = translate(text_.c_str());
  std::string text;
  size_t next = 0;
  for (size_t i = 0; i < format.size();) {
    if (format[i] != '%') {
      text += format[i++];
      continue;
    }
    const Conversion found = ReadConversion(format.substr(i));
    i += found.length;
    if (!found.is_part) {
      text += '%';
      continue;
    }
    const size_t part = found.number > 0 ? found.number - 1 : next++;
    text += part < parts_.size() ? parts_[part].Translated(translate) : "";
  }
  return text;
}

std::vector<std::string> EnglishOf(const std::vector<Sentence>& sentences) {
  std::vector<std::string> texts;
  for (const Sentence& sentence : sentences) {
    texts.push_back(sentence.English());
  }
  return texts;
}

}  // namespace lararium
