#include "shared/drama/text_pattern.h"

#include <gtest/gtest.h>

#include <string>

#include "shared/core/random.h"
#include "shared/drama/lua_api.h"

namespace lararium::drama {
namespace {

// Compares Lua's string.find with ours for an unanchored pattern.
class Oracle {
 public:
  Oracle() : lua_(luaL_newstate()) { luaL_openlibs(lua_); }
  ~Oracle() { lua_close(lua_); }
  Oracle(const Oracle&) = delete;
  Oracle& operator=(const Oracle&) = delete;

  // "begin end capture capture ...", "none" or "error".
  std::string Find(const std::string& subject, const std::string& pattern) {
    lua_settop(lua_, 0);
    lua_getglobal(lua_, "string");
    lua_getfield(lua_, 1, "find");
    lua_pushlstring(lua_, subject.data(), subject.size());
    lua_pushlstring(lua_, pattern.data(), pattern.size());
    if (lua_pcall(lua_, 2, LUA_MULTRET, 0) != LUA_OK) {
      return "error";
    }
    if (lua_isnil(lua_, 2)) {
      return "none";
    }
    std::string text;
    for (int i = 2; i <= lua_gettop(lua_); ++i) {
      text += lua_tostring(lua_, i) + std::string(" ");
    }
    return text;
  }

 private:
  lua_State* lua_;
};

std::string Find(const std::string& subject, const std::string& pattern) {
  const Result<TextPattern> compiled = TextPattern::Compile(pattern);
  if (!compiled.ok()) {
    return "error";
  }
  std::vector<TextCapture> captures;
  for (size_t begin = 0; begin <= subject.size(); ++begin) {
    int64_t steps = 1'000'000;
    if (const auto end = compiled->MatchAt(subject, begin, steps, captures)) {
      std::string text = std::to_string(begin + 1) + " " + std::to_string(*end) + " ";
      for (const TextCapture& c : captures) {
        text += (c.is_position ? std::to_string(c.begin + 1)
                               : subject.substr(c.begin, c.end - c.begin)) +
                " ";
      }
      return text;
    }
  }
  return "none";
}

TEST(TextPattern, AgreesWithLuaOnChosenPatterns) {
  Oracle oracle;
  const std::string subjects[] = {
      "",          "hello world", "  trim me  ", "key = value", "THE (quick) fox",
      "aaa]b-c^d", "f(a(b)c)d",   "x\0y",        "abcabc",      "1234.5e-6"};
  const std::string patterns[] = {"a*",
                                  "a-b",
                                  "^",
                                  "(%w+)%s*=%s*(%w+)",
                                  "%s*(.-)%s*$",
                                  "()ll()",
                                  "[^%s]+",
                                  "[]]",
                                  "[^]]",
                                  "[a-]",
                                  "[%a-z]",
                                  "%b()",
                                  "%f[%w]%w",
                                  "%f[%W]",
                                  "(a)(b)(c)%1",
                                  "(.)(.)%2%1",
                                  ".-$",
                                  "$",
                                  "$a",
                                  "a$b",
                                  "%d+%.?%d*",
                                  "[%d%.]+",
                                  "(a*(.)%w(%s*))",
                                  "%S+",
                                  "%u%u",
                                  "[A-Z]+",
                                  "%(%a+%)",
                                  "l+o",
                                  "l?l?o",
                                  "%x+",
                                  "((((a))))",
                                  "a+?",
                                  "(a)*",
                                  "%%",
                                  "%.",
                                  "x%z",
                                  "[%]]",
                                  "[a%-c]",
                                  "%g+",
                                  "%p",
                                  "%c",
                                  ".?.?.?x"};
  for (const std::string& subject : subjects) {
    for (const std::string& pattern : patterns) {
      if (pattern[0] == '^' && pattern.size() == 1) {
        continue;  // The callers handle the anchor.
      }
      EXPECT_EQ(Find(subject, pattern), oracle.Find(subject, pattern))
          << "subject '" << subject << "' pattern '" << pattern << "'";
    }
  }
}

TEST(TextPattern, AgreesWithLuaOnRandomPatterns) {
  Oracle oracle;
  Random random(7);
  const std::string pieces[] = {"a", "b", "%a", "%d", ".",  "[ab]", "[^a]", "(",  ")", "*",
                                "+", "-", "?",  "$",  "%1", "%bab", "1",    "()", "%s"};
  for (int round = 0; round < 20000; ++round) {
    std::string pattern;
    for (uint32_t i = 0, count = 1 + random.Below(7); i < count; ++i) {
      pattern += pieces[random.Below(std::size(pieces))];
    }
    std::string subject;
    for (uint32_t i = 0, count = random.Below(12); i < count; ++i) {
      subject += "aab1 "[random.Below(5)];
    }
    const std::string ours = Find(subject, pattern);
    // Lua reports an unclosed or unopened capture only when the match reaches it.
    if (ours != "error") {
      ASSERT_EQ(ours, oracle.Find(subject, pattern))
          << "round " << round << " subject '" << subject << "' pattern '" << pattern << "'";
    }
  }
}

TEST(TextPattern, RefusesMalformedPatterns) {
  for (const char* pattern : {"[a", "[", "[^", "%", "a%", "%b", "%bx", "%f", "%fa", "(", "a)", "%1",
                              "(%1)", "(()", "[%"}) {
    EXPECT_EQ(Find("a", pattern), "error") << pattern;
  }
  EXPECT_EQ(Find("a", std::string(66, '(') + std::string(66, ')')), "error");
}

TEST(TextPattern, GivesUpWhenItsStepsAreUsed) {
  std::string pattern;
  for (int i = 0; i < 30; ++i) {
    pattern += "a*";
  }
  const Result<TextPattern> compiled = TextPattern::Compile(pattern + "b");
  ASSERT_TRUE(compiled.ok());
  std::vector<TextCapture> captures;
  int64_t steps = 100'000;
  EXPECT_FALSE(compiled->MatchAt(std::string(40, 'a'), 0, steps, captures));
  EXPECT_LT(steps, 0);
}

}  // namespace
}  // namespace lararium::drama
