#include "editor/panels/dialogs/problem_place.h"

#include <gtest/gtest.h>

namespace lararium::panels {
namespace {

using drama::TimelineItem;
using drama::TimelineText;

TimelineText Timeline() {
  Result<TimelineText> timeline = TimelineText::Read(R"(track{actor = "keeper",
  speech = {
    {id = "hail", at = 1, length = 2, line = "salvete"},
    {id = "ask", at = 5, length = 1, line = "quid"},
  },
}
track{markers = {
  {at = 6, name = "noon"},
}}
)",
                                                     "drama.lua");
  EXPECT_TRUE(timeline.ok()) << timeline.message();
  return *std::move(timeline);
}

TEST(PlaceOfProblem, IsTheLineAndTheTimeThatTheProblemNames) {
  const ProblemPlace place =
      PlaceOfProblem("drama.lua:4: keeper walks through box (at 3.10 s)", "drama.lua");
  EXPECT_EQ(place.script_line, 4);
  EXPECT_DOUBLE_EQ(place.seconds, 3.1);
  EXPECT_EQ(place.line, "");
}

TEST(PlaceOfProblem, OfALineOfSpeechIsItsId) {
  const ProblemPlace place =
      PlaceOfProblem("lines.csv:7: line 'salvete': it has no text in 'la'", "drama.lua");
  EXPECT_EQ(place.line, "salvete");
  EXPECT_EQ(place.script_line, 0);
  EXPECT_LT(place.seconds, 0.0);
}

TEST(PlaceOfProblem, IsNoneWhereNoneIsNamed) {
  for (const char* problem : {"", "project.json: x", "a line 'that never ends", "drama.lua: x"}) {
    const ProblemPlace place = PlaceOfProblem(problem, "drama.lua");
    EXPECT_EQ(place.script_line, 0) << problem;
    EXPECT_LT(place.seconds, 0.0) << problem;
    EXPECT_EQ(place.line, "") << problem;
  }
}

TEST(FindName, FindsWordsNotPartsOfThem) {
  EXPECT_EQ(FindName("keeper2 meets keeper", "keeper"), 14u);
  EXPECT_EQ(FindName("cast/keeper.larhuman: is damaged", "keeper"), 5u);
  EXPECT_EQ(FindName("the 'cup' is held", "cup"), 5u);
  EXPECT_EQ(FindName("housekeeper", "keeper"), std::string_view::npos);
  EXPECT_EQ(FindName("anything", ""), std::string_view::npos);
}

TEST(ItemOnLine, IsTheItemThatBeginsThere) {
  const TimelineText text = Timeline();
  EXPECT_EQ(ItemOnLine(text, 4), (TimelineItem{0, 1}));
  EXPECT_EQ(ItemOnLine(text, 8), (TimelineItem{1, 0}));
  EXPECT_FALSE(ItemOnLine(text, 1).has_value()) << "a track is no item";
}

TEST(ItemSaying, IsTheFirstThatSaysTheLine) {
  const TimelineText text = Timeline();
  EXPECT_EQ(ItemSaying(text, "quid"), (TimelineItem{0, 1}));
  EXPECT_FALSE(ItemSaying(text, "noon").has_value());
}

}  // namespace
}  // namespace lararium::panels
