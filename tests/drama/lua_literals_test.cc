#include "shared/drama/lua_literals.h"

#include <gtest/gtest.h>

#include "shared/drama/timeline_text.h"

namespace lararium::drama {
namespace {

// The value of a text; null if it cannot be read.
Json Read(const std::string& text) {
  LuaLiterals literals(text, 0);
  Json value;
  size_t end = 0;
  return literals.Value(0, value, end) && end == text.size() ? value : Json();
}

// `count` nested tables.
Json Nested(int count) {
  Json value = 1.0;
  for (int i = 0; i < count; ++i) {
    value = Json::array({value});
  }
  return value;
}

TEST(LuaLiterals, ReadBackWhatIsWritten) {
  for (const Json& value :
       {Json(0.1), Json(-1e300), Json(true), Json("tab\t, \"quote\" and \\ and \x01 and salvē"),
        Json::array({1.0, "two", false}),
        Json{{"end", 1.0}, {"two words", 2.0}, {"plain", Json::array({3.0})}}}) {
    EXPECT_EQ(Read(LuaLiteral(value)), value) << LuaLiteral(value);
  }
}

TEST(LuaLiterals, ReadTablesThatLieSoDeepAndNoDeeper) {
  EXPECT_FALSE(Read(LuaLiteral(Nested(LuaLiterals::kMaxDepth))).is_null());
  EXPECT_TRUE(Read(LuaLiteral(Nested(LuaLiterals::kMaxDepth + 1))).is_null());
}

TEST(LuaLiterals, SayWhereAndWhyTheyCannotReadOn) {
  const std::pair<const char*, std::pair<size_t, const char*>> cases[] = {
      {"{1, f()}", {4, "only numbers, texts, true, false and tables are allowed here"}},
      {"{1, 2", {0, "this brace is never closed"}},
      {"{[1] = 2}", {2, "only a text can be a key"}},
      {"{1, a = 2}", {0, "either all entries of a table have names or none"}}};
  for (const auto& [text, expected] : cases) {
    LuaLiterals literals(text, 0);
    Json value;
    size_t end = 0;
    ASSERT_FALSE(literals.Value(0, value, end)) << text;
    EXPECT_EQ(literals.problem().offset, expected.first) << text;
    EXPECT_EQ(literals.problem().text, expected.second) << text;
  }
}

TEST(EntriesOf, TellsWhereEachEntryStands) {
  const std::string text = "x{ at = 2 , 7}";
  const std::vector<LuaEntry> entries = EntriesOf(text, 1, true);
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].key, "at");
  EXPECT_EQ(entries[0].value, Json(2.0));
  EXPECT_EQ(entries[0].begin, 3u);
  EXPECT_EQ(text.substr(entries[0].value_begin, entries[0].value_end - entries[0].value_begin),
            "2");
  EXPECT_EQ(entries[0].separator, 10u);
  EXPECT_EQ(entries[1].key, "");
  EXPECT_EQ(entries[1].separator, 0u);
}

}  // namespace
}  // namespace lararium::drama
