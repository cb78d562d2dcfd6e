#include "player/app/visitor_menu.h"

#include <gmock/gmock.h>

#include <string>

namespace lararium::player {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;

// A font with ASCII characters only.
render::CaptionFont Ascii() {
  render::CaptionFont font;
  for (uint32_t c = 32; c < 127; ++c) {
    font.glyphs.push_back({.character = c, .advance = 0.5f});
  }
  return font;
}

show::ShowContent Content() {
  show::ShowContent content;
  content.caption_font = Ascii();
  content.language = "la";
  content.spoken_languages = {"la", "en"};
  content.caption_languages = {"la", "en", "de"};
  content.has_descriptions = true;
  return content;
}

std::vector<std::string> TextsOf(const std::vector<MenuItem>& items) {
  std::vector<std::string> texts;
  for (const MenuItem& item : items) {
    texts.push_back(item.text);
  }
  return texts;
}

TEST(VisitorMenu, SpeaksTheVisitorsLanguageAndSaysWhatIsChosen) {
  show::ShowContent content = Content();
  EXPECT_THAT(TextsOf(ItemsOf(content, {})),
              ElementsAre("Clarius", "Lenius", "Voces: Latina", "Inscriptiones: Latina",
                          "Litterae: mediae", "Fundus: translucens", "Descriptiones: nullae",
                          "Motus: omnis", "Ab initio", "Locum denuo quaere", "Claude"));
  content.language = "en-GB";
  Choices choices;
  choices.language = "en";
  choices.captions = show::kNoCaptions;
  choices.descriptions = true;
  choices.reduced_motion = true;
  choices.caption_style = {render::CaptionSize::kLargest, render::CaptionContrast::kHigh};
  EXPECT_THAT(
      TextsOf(ItemsOf(content, choices)),
      ElementsAre("Louder", "Quieter", "Voices: English", "Captions: off", "Letters: largest",
                  "Contrast: high", "Descriptions: on", "Motion: reduced", "From the beginning",
                  "Find the place again", "Close"));
}

TEST(VisitorMenu, IsInEnglishWhereTheFontLacksLetters) {
  show::ShowContent content = Content();
  content.language = "de";  // needs "ß" in "Schließen"
  EXPECT_THAT(TextsOf(ItemsOf(content, {})), Contains("Close"));
  content.language = "sux";
  EXPECT_THAT(TextsOf(ItemsOf(content, {})), Contains("Close"));
}

TEST(VisitorMenu, OffersNoChoiceWhereThereIsOne) {
  show::ShowContent content = Content();
  content.spoken_languages = {"la"};
  content.caption_languages.clear();
  content.has_descriptions = false;
  const std::vector<MenuItem> items = ItemsOf(content, {});
  EXPECT_EQ(items.size(), 6u);
  for (const MenuItem& item : items) {
    EXPECT_NE(item.action, Action::kLanguage);
    EXPECT_NE(item.action, Action::kCaptions);
    EXPECT_NE(item.action, Action::kDescriptions);
  }
  content.caption_font.reset();
  EXPECT_TRUE(ItemsOf(content, {}).empty()) << "nothing can be written";
}

TEST(VisitorMenu, LiesWithinThePictureAboutWhereTheVisitorLooks) {
  for (const geometry::CameraModel& picture :
       {geometry::CameraModel{640, 480, 525.0, 525.0, 310.0, 250.0},
        geometry::CameraModel{400, 300, 700.0, 700.0, 199.5, 149.5},
        geometry::CameraModel{1280, 400, 800.0, 800.0, 639.5, 199.5}}) {
    GazeMenu menu;
    const std::vector<MenuItem> items = ItemsOf(Content(), {});
    menu.Open(items, 0.0, ScaleFor(picture, items.size()));
    const render::Menu drawn = PictureOf(menu, picture, {});
    EXPECT_EQ(drawn.cells.size(), items.size());
    EXPECT_NEAR(drawn.gaze.x, picture.cx + 0.5, 1e-3);
    for (const render::MenuCell& cell : drawn.cells) {
      EXPECT_GE(cell.from.x, 0.0f);
      EXPECT_GE(cell.from.y, 0.0f);
      EXPECT_LE(cell.to.x, static_cast<float>(picture.width));
      EXPECT_LE(cell.to.y, static_cast<float>(picture.height));
      const bool hides_gaze = cell.from.x < drawn.gaze.x && cell.to.x > drawn.gaze.x;
      EXPECT_FALSE(hides_gaze);
    }
  }
}

}  // namespace
}  // namespace lararium::player
