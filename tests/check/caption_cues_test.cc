#include "editor/check/caption_cues.h"

#include <gmock/gmock.h>

namespace lararium::editor {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Two lines; the first has two captions and is said twice.
stage::CaptionBook Book() {
  stage::CaptionBook book;
  book.lines["salvete"]["en"] = {{0.0, 1.0, "Greetings,"}, {1.0, 3.5, "all of you!"}};
  book.lines["vale"]["en"] = {{0.25, 2.0, "Farewell!"}};
  return book;
}

std::vector<SaidLine> Said() {
  return {{"salvete", "keeper", 10.0, 2.0, false},
          {"vale", "girl", 20.0, 1.5, false},
          {"salvete", "keeper", 30.0, 2.0, false}};
}

TEST(CaptionCues, OfADramaStandAtItsTimeAndAreNumbered) {
  const std::vector<bake::FileCue> cues = CuesOf(Said(), Book(), "en");
  ASSERT_EQ(cues.size(), 5u);
  EXPECT_EQ(cues[0], (bake::FileCue{"salvete/1", 10.0, 11.0, "Greetings,"}));
  EXPECT_EQ(cues[1], (bake::FileCue{"salvete/2", 11.0, 13.5, "all of you!"}));
  EXPECT_EQ(cues[2], (bake::FileCue{"vale/1", 20.25, 22.0, "Farewell!"}));
}

TEST(CaptionCues, ALanguageWithoutCaptionsHasNone) {
  EXPECT_THAT(CuesOf(Said(), Book(), "it"), IsEmpty());
}

TEST(CaptionCues, OneIsGoneWhenTheNextBegins) {
  std::vector<SaidLine> said = Said();
  said[1].begin = 12.0;
  const std::vector<bake::FileCue> cues = CuesOf(said, Book(), "en");
  for (size_t i = 0; i + 1 < cues.size(); ++i) {
    EXPECT_LE(cues[i].end, cues[i + 1].begin);
  }
}

TEST(CaptionCues, ABrokenOffLineIsReadOnlyWhileItIsHeard) {
  std::vector<SaidLine> said = {Said().front()};
  said[0].seconds = 0.6;
  said[0].cut = true;
  const std::vector<bake::FileCue> cues = CuesOf(said, Book(), "en");
  ASSERT_EQ(cues.size(), 1u);
  EXPECT_DOUBLE_EQ(cues[0].end, 10.6);
}

TEST(CaptionCues, ThoseOfADramaComeBackToTheirLines) {
  std::vector<std::string> warnings;
  const auto lines = CuesByLine(CuesOf(Said(), Book(), "en"), Said(), warnings);
  EXPECT_THAT(warnings, IsEmpty());
  const stage::CaptionBook book = Book();
  ASSERT_EQ(lines.size(), book.lines.size());
  for (const auto& [name, cues] : lines) {
    const std::vector<stage::CaptionCue>& wanted = book.lines.at(name).at("en");
    ASSERT_EQ(cues.size(), wanted.size()) << name;
    for (size_t i = 0; i < cues.size(); ++i) {
      EXPECT_NEAR(cues[i].begin, wanted[i].begin, 1e-9) << name;
      EXPECT_NEAR(cues[i].end, wanted[i].end, 1e-9) << name;
      EXPECT_EQ(cues[i].text, wanted[i].text);
    }
  }
}

TEST(CaptionCues, OneThatIsRoundedToSecondsBelongsToTheLineDuringWhichItIsShown) {
  const std::vector<SaidLine> said = {{"salvete", "keeper", 10.9, 2.2, false},
                                      {"vale", "girl", 13.6, 1.5, false}};
  std::vector<std::string> warnings;
  const auto lines = CuesByLine(
      {{"3", 15.0, 17.0, "late"}, {"1", 10.0, 13.0, "first"}, {"2", 13.0, 15.0, "second"}}, said,
      warnings);
  EXPECT_THAT(warnings, IsEmpty());
  ASSERT_EQ(lines.size(), 2u);
  ASSERT_EQ(lines.at("salvete").size(), 1u);
  EXPECT_EQ(lines.at("salvete")[0].text, "first");
  EXPECT_EQ(lines.at("salvete")[0].begin, 0.0);
  ASSERT_EQ(lines.at("vale").size(), 2u);
  EXPECT_EQ(lines.at("vale")[0].text, "second");
  EXPECT_EQ(lines.at("vale")[1].text, "late");
}

TEST(CaptionCues, OneWhileNobodySpeaksIsTold) {
  std::vector<std::string> warnings;
  const auto lines = CuesByLine({{"1", 5.0, 6.0, "Silence"}}, Said(), warnings);
  EXPECT_THAT(lines, IsEmpty());
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("nobody speaks at 5.00 s: 'Silence'")));
}

}  // namespace
}  // namespace lararium::editor
