#include "editor/import/cast/cast_recipe.h"

#include <gtest/gtest.h>

namespace lararium::import {
namespace {

Result<CastRecipe> Parse(const std::string& text) {
  const auto json = ParseJson(text, "person.json");
  EXPECT_TRUE(json.ok());
  return ParseFields<CastRecipe>(JsonView(*json, "person.json"));
}

TEST(CastRecipe, ReadsWhatPeopleWrite) {
  const auto recipe = Parse(R"({"schema": 1, "name": "keeper", "sex": "male", "age": 45,
      "height": 1.7, "ethnicity": {"caucasian": 0.7, "african": 0.3},
      "modifiers": {"nose-hump-lesshump|morehump": 0.5},
      "skin": {"tint": "#ff8000", "stubble": 0.4}, "hair": {"name": "short01", "volume": 0.5},
      "beard": ["Full_beard"], "eyebrows": "eyebrow001",
      "garments": [{"name": "tunic", "length": "knee"}], "seed": 7})");
  ASSERT_TRUE(recipe.ok()) << recipe.message();
  EXPECT_EQ(recipe->sex, 1.0f);
  EXPECT_EQ(recipe->ethnicity, glm::vec3(0.7f, 0.3f, 0.0f));
  ASSERT_TRUE(recipe->skin_tint);
  EXPECT_EQ(*recipe->skin_tint, glm::vec3(1.0f, 128.0f / 255.0f, 0.0f));
  ASSERT_TRUE(recipe->hair);
  EXPECT_EQ(recipe->hair->volume, 0.5f);
  EXPECT_EQ(recipe->eyebrows.name, "eyebrow001");
  EXPECT_EQ(recipe->garments.at(0)["length"], "knee");
}

TEST(CastRecipe, ComesBackAsItWasWritten) {
  const auto recipe = Parse(R"({"schema": 1, "name": "girl", "sex": "female", "age": 9,
      "modifiers": {"head-round": 0.5}, "skin": {"name": "young_caucasian_female"},
      "hair": {"name": "ponytail01", "colour": "#4b3018"}, "garments": [{"name": "tunic"}]})");
  ASSERT_TRUE(recipe.ok()) << recipe.message();
  const Json written = FormatFields(*recipe);
  const auto again = ParseFields<CastRecipe>(JsonView(written, "again.json"));
  ASSERT_TRUE(again.ok()) << again.message();
  EXPECT_EQ(FormatFields(*again), written);
  EXPECT_EQ(again->modifiers, recipe->modifiers);
  EXPECT_EQ(again->hair->colour, recipe->hair->colour);
}

TEST(CastRecipe, NamesTheFieldThatIsWrong) {
  const std::pair<const char*, const char*> kWrong[] = {
      {R"({"schema": 2})", "schema"},
      {R"({"schema": 1, "hight": 1.7})", "hight"},
      {R"({"schema": 1, "age": 120})", "age"},
      {R"({"schema": 1, "sex": "other"})", "sex"},
      {R"({"schema": 1, "ethnicity": {"caucasian": 0}})", "ethnicity"},
      {R"({"schema": 1, "ethnicity": {"roman": 1}})", "roman"},
      {R"({"schema": 1, "skin": {"tint": "brown"}})", "tint"},
      {R"({"schema": 1, "skin": {"tint": "#12345g"}})", "tint"},
      {R"({"schema": 1, "hair": {"colour": "#123456"}})", "name"},
      {R"({"schema": 1, "modifiers": {"head-round": 9}})", "head-round"},
      {R"({"schema": 1, "garments": [{"length": 2}]})", "garments"},
      {R"([])", "object"}};
  for (const auto& [text, field] : kWrong) {
    const auto recipe = Parse(text);
    ASSERT_FALSE(recipe.ok()) << text;
    EXPECT_NE(recipe.message().find(field), std::string::npos) << recipe.message();
    EXPECT_NE(recipe.message().find("person.json"), std::string::npos) << recipe.message();
  }
}

}  // namespace
}  // namespace lararium::import
