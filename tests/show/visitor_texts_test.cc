#include "shared/show/visitor_texts.h"

#include <gtest/gtest.h>

#include "shared/core/json.h"

namespace lararium::show {
namespace {

// Each language has the texts of English, and none of them is empty.
void ExpectAlike(const Json& texts, const Json& english, const std::string& where) {
  ASSERT_EQ(texts.type(), english.type()) << where;
  ASSERT_EQ(texts.size(), english.size()) << where;
  if (english.is_string()) {
    EXPECT_FALSE(texts.get_ref<const std::string&>().empty()) << where;
    return;
  }
  for (const auto& [key, text] : english.items()) {
    const std::string path = where + "." + key;
    if (english.is_object()) {
      ASSERT_TRUE(texts.contains(key)) << path;
    }
    ExpectAlike(english.is_object() ? texts.at(key) : texts.at(std::stoul(key)), text, path);
  }
}

TEST(VisitorTexts, AreCompleteInEachLanguage) {
  const Result<Json> all = ParseJson(VisitorTexts().front().text, "visitor_texts.json");
  ASSERT_TRUE(all.ok()) << all.message();
  EXPECT_GT(all->size(), 1u);
  for (const auto& [language, texts] : all->items()) {
    ExpectAlike(texts, all->at("en"), language);
  }
}

}  // namespace
}  // namespace lararium::show
