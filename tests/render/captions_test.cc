#include "shared/render/text/captions.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "shared/core/json.h"
#include "tests/render/box_font.h"
#include "tests/support/png.h"

namespace lararium::render {
namespace {

using ::testing::HasSubstr;

using test::Png;

CaptionFont BoxFont() { return test::BoxFont("abc"); }

TEST(CaptionFont, IsReadAsItWasWritten) {
  const CaptionFont font = BoxFont();
  const auto read = ParseCaptionFont(FormatCaptionMetrics(font), Png(font.atlas), "font.json");
  ASSERT_TRUE(read.ok()) << read.message();
  EXPECT_EQ(read->em_px, font.em_px);
  EXPECT_EQ(read->atlas.size(), font.atlas.size());
  ASSERT_NE(read->Find('b'), nullptr);
  EXPECT_EQ(read->Find('b')->atlas_to, glm::vec2(16.0f, 32.0f));
  EXPECT_EQ(read->Find('d'), nullptr);
}

TEST(CaptionFont, RefusesLettersOutsideOfTheAtlasOrOutOfOrder) {
  const CaptionFont font = BoxFont();
  const auto problem = [&](const char* key, const Json& value) {
    Json json = Json::parse(FormatCaptionMetrics(font));
    json["glyphs"][1][key] = value;
    return ParseCaptionFont(json.dump(), Png(font.atlas), "font.json").message();
  };
  EXPECT_THAT(problem("atlas_to", {17.0, 32.0}), HasSubstr("does not lie in the atlas"));
  EXPECT_THAT(problem("atlas_from", {-1.0, 0.0}), HasSubstr("atlas_from"));
  EXPECT_THAT(problem("character", 'a'), HasSubstr("do not ascend"));
  EXPECT_THAT(problem("advance", 1e9), HasSubstr("advance"));
  EXPECT_FALSE(ParseCaptionFont(FormatCaptionMetrics(font), {}, "font.json").ok());
}

TEST(CaptionLayout, RowsAreCentredOneBelowTheOtherInsideTheirGround) {
  const CaptionFont font = BoxFont();
  const Caption caption = {"a", glm::vec3(1.0f, 0.0f, 0.0f), CaptionSide::kHere, "abc\nab"};
  CaptionLayout layout;
  LayOut(font, {&caption, 1}, {}, 1280, 720, layout);
  ASSERT_EQ(layout.rows.size(), 3u);
  ASSERT_EQ(layout.grounds.size(), 1u);
  EXPECT_EQ(layout.rows[0].text, "a");
  EXPECT_EQ(layout.rows[0].colour, caption.colour);
  float above = 0.0f;
  for (const CaptionLayout::Row& row : layout.rows) {
    const float width = row.em * TextWidth(font, row.text);
    EXPECT_NEAR(row.baseline.x + 0.5f * width, 640.0f, 1.0f);
    EXPECT_GT(row.baseline.y, above);
    above = row.baseline.y;
    EXPECT_GT(row.baseline.x, layout.grounds[0].from.x);
    EXPECT_LT(row.baseline.x + width, layout.grounds[0].to.x);
  }
  EXPECT_LT(above, layout.grounds[0].to.y);
  EXPECT_LT(layout.grounds[0].to.y, 720.0f);
}

TEST(CaptionLayout, LongRowsAreSmallerSoThatTheyStayInThePicture) {
  const CaptionFont font = BoxFont();
  const std::string text(100, 'a');
  const Caption caption = {"", glm::vec3(1.0f), CaptionSide::kHere, text};
  CaptionLayout layout;
  LayOut(font, {&caption, 1}, {}, 640, 480, layout);
  ASSERT_EQ(layout.grounds.size(), 1u);
  EXPECT_GE(layout.grounds[0].from.x, 0.0f);
  EXPECT_LE(layout.grounds[0].to.x, 640.0f);
}

TEST(CaptionLayout, TheSecondCaptionStandsAboveTheFirst) {
  const CaptionFont font = BoxFont();
  const Caption captions[] = {{"a", glm::vec3(1.0f), CaptionSide::kHere, "abc"},
                              {"b", glm::vec3(1.0f), CaptionSide::kLeft, "abc\nabc"}};
  CaptionLayout layout;
  LayOut(font, captions, {}, 640, 480, layout);
  ASSERT_EQ(layout.grounds.size(), 2u);
  EXPECT_LT(layout.grounds[1].to.y, layout.grounds[0].from.y);
  LayOut(font, {}, {}, 640, 480, layout);
  EXPECT_TRUE(layout.rows.empty());
}

// BoxFont() with a space.
CaptionFont FontOfWords() {
  CaptionFont font = BoxFont();
  font.glyphs.insert(font.glyphs.begin(), {' ', 0.25f});
  return font;
}

// The longest caption that the editor makes: two rows of 42 letters.
std::string LongCaption() {
  std::string row;
  for (int word = 0; word < 7; ++word) {
    row += word == 0 ? "abcab" : " abcab";
  }
  return row + "\n" + row;
}

TEST(CaptionLayout, LargerLettersAreLargerWhereTheyFit) {
  const CaptionFont font = FontOfWords();
  const Caption caption = {"a", glm::vec3(1.0f), CaptionSide::kHere, "abc ab\nab"};
  CaptionLayout layout;
  std::vector<float> sizes;
  for (const CaptionSize size :
       {CaptionSize::kNormal, CaptionSize::kLarge, CaptionSize::kLargest}) {
    LayOut(font, {&caption, 1}, {size}, 1280, 720, layout);
    ASSERT_EQ(layout.rows.size(), 3u) << "its own rows";
    sizes.push_back(layout.rows[1].em);
  }
  EXPECT_NEAR(sizes[1], 1.5f * sizes[0], 1e-3f);
  EXPECT_NEAR(sizes[2], 2.0f * sizes[0], 1e-3f);
}

TEST(CaptionLayout, TwoLongCaptionsInTheLargestLettersStayInThePicture) {
  const CaptionFont font = FontOfWords();
  const std::string text = LongCaption();
  const Caption both[] = {{"abc", glm::vec3(1.0f), CaptionSide::kLeft, text},
                          {"abc", glm::vec3(1.0f), CaptionSide::kRight, text}};
  for (const auto& [width, height] : {std::pair(1280, 720), {640, 480}, {480, 800}, {1440, 1440}}) {
    CaptionLayout usual;
    LayOut(font, both, {}, width, height, usual);
    CaptionLayout layout;
    LayOut(font, both, {CaptionSize::kLargest}, width, height, layout);
    ASSERT_EQ(layout.grounds.size(), 2u);
    for (const CaptionLayout::Ground& ground : layout.grounds) {
      EXPECT_GE(ground.from.x, 0.0f) << width;
      EXPECT_GE(ground.from.y, 0.0f) << width;
      EXPECT_LE(ground.to.x, static_cast<float>(width)) << width;
      EXPECT_LE(ground.to.y, static_cast<float>(height)) << width;
    }
    EXPECT_LT(layout.grounds[1].to.y, layout.grounds[0].from.y);
    EXPECT_GT(layout.rows[1].em, 1.25f * usual.rows[1].em) << width << "x" << height;
    for (const CaptionLayout::Row& row : layout.rows) {
      const size_t ground = row.baseline.y > layout.grounds[0].from.y ? 0 : 1;
      EXPECT_GE(row.baseline.x, layout.grounds[ground].from.x);
      EXPECT_LE(row.baseline.x + row.em * TextWidth(font, row.text),
                layout.grounds[ground].to.x + 1.0f);
    }
  }
}

TEST(CaptionLayout, NoWordIsLostWhereARowGoesOnOverABreak) {
  const CaptionFont font = FontOfWords();
  const std::string text = LongCaption();
  const Caption caption = {"", glm::vec3(1.0f), CaptionSide::kHere, text};
  CaptionLayout layout;
  LayOut(font, {&caption, 1}, {CaptionSize::kLargest}, 1280, 720, layout);
  size_t letters = 0;
  float right = 0.0f;
  float baseline = 0.0f;
  for (const CaptionLayout::Row& row : layout.rows) {
    letters += static_cast<size_t>(
        std::count_if(row.text.begin(), row.text.end(), [](char letter) { return letter > ' '; }));
    EXPECT_EQ(row.text.find('\n'), std::string_view::npos);
    if (row.baseline.y == baseline) {
      EXPECT_GE(row.baseline.x, right + 0.2f * row.em) << "a space is between the pieces";
    }
    baseline = row.baseline.y;
    right = row.baseline.x + row.em * TextWidth(font, row.text);
  }
  EXPECT_EQ(letters, 70u);
}

TEST(CaptionLayout, AWordThatIsTooWideForLargeLettersMakesThemSmaller) {
  const CaptionFont font = FontOfWords();
  const std::string word(45, 'a');
  const Caption caption = {"", glm::vec3(1.0f), CaptionSide::kHere, word};
  CaptionLayout layout;
  LayOut(font, {&caption, 1}, {CaptionSize::kLargest}, 1280, 720, layout);
  ASSERT_EQ(layout.rows.size(), 1u);
  EXPECT_GE(layout.grounds[0].from.x, 0.0f);
  EXPECT_LE(layout.grounds[0].to.x, 1280.0f);
}

TEST(CaptionLayout, NamesAreYellowInHighContrast) {
  const CaptionFont font = FontOfWords();
  const Caption caption = {"a", glm::vec3(1.0f, 0.0f, 0.0f), CaptionSide::kHere, "abc"};
  CaptionLayout layout;
  LayOut(font, {&caption, 1}, {CaptionSize::kNormal, CaptionContrast::kHigh}, 1280, 720, layout);
  EXPECT_GT(layout.rows[0].colour.g, 0.8f);
  EXPECT_EQ(layout.rows[1].colour, glm::vec3(1.0f));
}

TEST(LegendLayout, StandsInTheUpperLeftCornerWithASwatchBesideEachEntry) {
  const CaptionFont font = BoxFont();
  const LegendEntry entries[] = {{glm::vec3(1.0f, 0.0f, 0.0f), 0, "abc"},
                                 {glm::vec3(0.0f, 1.0f, 0.0f), 2, "ab"}};
  CaptionLayout layout;
  LayOut(font, {}, {}, 1280, 720, layout);
  LayOutLegend(font, {entries, "a", glm::vec3(1.0f), ""}, 1280, 720, layout);
  ASSERT_EQ(layout.swatches.size(), 2u);
  ASSERT_EQ(layout.rows.size(), 3u);
  ASSERT_EQ(layout.grounds.size(), 1u);
  const CaptionLayout::Ground& ground = layout.grounds[0];
  EXPECT_LT(ground.to.x, 640.0f);
  EXPECT_LT(ground.to.y, 360.0f);
  for (size_t i = 0; i < 2; ++i) {
    const CaptionLayout::Swatch& swatch = layout.swatches[i];
    EXPECT_EQ(swatch.stripes, entries[i].stripes);
    EXPECT_LT(swatch.place.to.x, layout.rows[i].baseline.x);
    EXPECT_GT(layout.rows[i].baseline.y, swatch.place.from.y);
    EXPECT_LT(layout.rows[i].baseline.y, swatch.place.to.y);
    EXPECT_GT(swatch.place.from.y, ground.from.y);
  }
  EXPECT_LT(layout.rows[2].baseline.y, ground.to.y);
}

TEST(LegendLayout, ItsTextIsBrokenBetweenWordsAndStaysInTheLeftHalf) {
  const CaptionFont font = BoxFont();
  std::string text;
  for (int i = 0; i < 200; ++i) {
    text += "abc ";
  }
  CaptionLayout layout;
  LayOutLegend(font, {{}, "", glm::vec3(1.0f), text}, 640, 480, layout);
  ASSERT_EQ(layout.rows.size(), 8u);
  EXPECT_LT(layout.grounds[0].to.x, 0.55f * 640.0f);
  for (const CaptionLayout::Row& row : layout.rows) {
    EXPECT_EQ(row.text.front(), 'a');
    EXPECT_EQ(row.text.back(), 'c');
  }
  // A word that is too wide gets a row of its own, and breaks of the text are kept.
  layout = {};
  const std::string wide(300, 'a');
  const std::string words = "abc\nab " + wide + " abc";
  LayOutLegend(font, {{}, "", glm::vec3(1.0f), words}, 640, 480, layout);
  ASSERT_EQ(layout.rows.size(), 4u);
  EXPECT_EQ(layout.rows[0].text, "abc");
  EXPECT_EQ(layout.rows[1].text, "ab");
  EXPECT_EQ(layout.rows[2].text, wide);
}

}  // namespace
}  // namespace lararium::render
