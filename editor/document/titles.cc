#include "editor/document/titles.h"

#include <algorithm>
#include <cstdint>
#include <sstream>
#include <vector>

#include "editor/document/document_fields.h"
#include "shared/core/utf8.h"

namespace lararium::editor {

namespace {

// A run of characters from `first` on and how ASCII writes them; "." separates words.
struct Letters {
  Letters(uint32_t first_of, const char* in_ascii) : first(first_of) {
    std::istringstream words(in_ascii);
    for (std::string word; words >> word;) {
      ascii.push_back(word == "." ? "" : word);
    }
  }
  uint32_t first;
  std::vector<std::string> ascii;
};

// nullptr: the character is no letter that is known here.
const std::string* InAscii(uint32_t character) {
  static const std::vector<Letters> kLetters = {
      {0xC0,  // Latin, from À to ſ.
       R"(A A A A Ae A AE C E E E E I I I I D N O O O O Oe . O U U U Ue Y Th ss
          a a a a ae a ae c e e e e i i i i d n o o o o oe . o u u u ue y th y
          A a A a A a C c C c C c C c D d D d E e E e E e E e E e G g G g G g G g H h H h
          I i I i I i I i I i IJ ij J j K k k L l L l L l L l L l N n N n N n n N n
          O o O o O o OE oe R r R r R r S s S s S s S s T t T t T t
          U u U u U u U u U u U u W w Y y Y Z z Z z Z z s)"},
      {0x386,  // Greek, from Ά to ώ.
       R"(A . E E I . O . Y O i A B G D E Z E Th I K L M N X O P R . S T Y Ph Ch Ps O I Y
          a e e i y a b g d e z e th i k l m n x o p r s s t y ph ch ps o i y o y o)"}};
  for (const Letters& letters : kLetters) {
    if (character >= letters.first && character - letters.first < letters.ascii.size()) {
      return &letters.ascii[character - letters.first];
    }
  }
  return nullptr;
}

bool IsCombiningAccent(uint32_t character) { return character >= 0x300 && character <= 0x36F; }

}  // namespace

bool IsTitle(std::string_view text) {
  const bool printable = std::none_of(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
  });
  return text.size() <= kMaxTitle && printable && IsUtf8(text) &&
         text.find_first_not_of(' ') != std::string_view::npos;
}

std::string PlainNameOf(std::string_view title) {
  constexpr size_t kMaxLength = 48;  // Numbers behind it remain possible.
  std::string name;
  bool separated = false;
  for (size_t at = 0; at < title.size() && name.size() < kMaxLength;) {
    const uint32_t character = NextCharacter(title, at);
    const std::string plain(1, static_cast<char>(character));
    const std::string* ascii = InAscii(character);
    if (character < 0x80 && (IsPlainName(plain) || character == '-')) {
      ascii = &plain;
    }
    if (ascii == nullptr || ascii->empty()) {
      separated |= !IsCombiningAccent(character);
      continue;
    }
    name += (separated && !name.empty() ? "_" : "") + *ascii;
    separated = false;
  }
  name.erase(0, name.find_first_not_of("-_"));
  name.erase(name.find_last_not_of("-_") + 1);
  return name;
}

std::string FreeNameOf(std::string_view title,
                       std::string_view otherwise,
                       const std::function<bool(const std::string&)>& taken) {
  std::string first = PlainNameOf(title);
  first = first.empty() ? otherwise : first;
  std::string name = first;
  for (int number = 2; taken(name); ++number) {
    name = first + "_" + std::to_string(number);
  }
  return name;
}

}  // namespace lararium::editor
