#include "editor/panels/timeline/lua_colours.h"

#include <algorithm>
#include <array>

#include "shared/drama/lua_tokens.h"

namespace lararium::panels {

namespace {

using drama::LuaToken;

bool IsKeyword(std::string_view word) {
  constexpr std::array<std::string_view, 22> kWords = {
      "and",      "break",  "do",   "else", "elseif", "end",  "false", "for",
      "function", "goto",   "if",   "in",   "local",  "nil",  "not",   "or",
      "repeat",   "return", "then", "true", "until",  "while"};
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

// Adds the comments between two tokens.
void AddComments(std::string_view text, size_t begin, size_t end, std::vector<ColouredWord>& out) {
  const size_t first = text.substr(begin, end - begin).find("--");
  if (first != std::string_view::npos) {
    out.push_back(
        {static_cast<uint32_t>(begin + first), static_cast<uint32_t>(end), LuaPart::kComment});
  }
}

}  // namespace

std::vector<ColouredWord> ColourLua(std::string_view text) {
  std::vector<ColouredWord> words;
  drama::LuaTokens tokens(text);
  size_t behind = 0;
  size_t name = 0;  // Index into words of a name that a call may follow.
  bool is_name = false;
  for (LuaToken token = tokens.Next(); token.kind != LuaToken::Kind::kEnd; token = tokens.Next()) {
    if (token.kind == LuaToken::Kind::kBad) {
      words.push_back(
          {static_cast<uint32_t>(token.begin), static_cast<uint32_t>(text.size()), LuaPart::kBad});
      return words;
    }
    AddComments(text, behind, token.begin, words);
    behind = token.end;
    if (is_name && (token.Is('(') || token.Is('{'))) {
      words[name].part = LuaPart::kCall;
    }
    is_name = false;
    const auto add = [&](LuaPart part) {
      words.push_back({static_cast<uint32_t>(token.begin), static_cast<uint32_t>(token.end), part});
    };
    if (token.kind == LuaToken::Kind::kText) {
      add(LuaPart::kText);
    } else if (token.kind == LuaToken::Kind::kNumber) {
      add(LuaPart::kNumber);
    } else if (token.kind == LuaToken::Kind::kName) {
      const bool keyword = IsKeyword(text.substr(token.begin, token.end - token.begin));
      is_name = !keyword;
      name = words.size();
      add(keyword ? LuaPart::kKeyword : LuaPart::kPlain);
    }
  }
  AddComments(text, behind, text.size(), words);
  return words;
}

std::vector<size_t> LineStarts(std::string_view text) {
  std::vector<size_t> starts = {0};
  for (size_t at = text.find('\n'); at != std::string_view::npos; at = text.find('\n', at + 1)) {
    starts.push_back(at + 1);
  }
  return starts;
}

}  // namespace lararium::panels
