// The computations of the timeline, without drawing.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "editor/check/timeline_edits.h"
#include "editor/panels/timeline/lua_colours.h"
#include "editor/panels/timeline/timeline_maths.h"
#include "editor/panels/timeline/timeline_rows.h"
#include "editor/panels/timeline/timeline_selection.h"
#include "editor/panels/timeline/timeline_steps.h"

namespace lararium::panels {
namespace {

using drama::LaneKind;
using drama::TaskRecord;
using drama::TimelineText;
using testing::ElementsAre;
using testing::HasSubstr;

TimelineText MustRead(std::string text) {
  Result<TimelineText> timeline = TimelineText::Read(std::move(text), "drama.lua");
  CHECK(timeline.ok());
  return *std::move(timeline);
}

const char* const kScript = R"(track{actor = "keeper",
  speech = {
    {id = "hail", at = 1, length = 2, line = "salvete"},  -- to all
    {id = "ask", at = 5, length = 1, line = "quid"},
  },
  clips = {
    {at = 0, length = 2, clip = "idle"},
    {at = 3, length = 2, clip = "walk"},
    {at = 8, length = 1, clip = "idle"},
  },
}
track{markers = {{at = 6, name = "noon"}}}
)";

std::vector<double> Times(const TimelineText& text, size_t lane) { return text.lanes()[lane].at; }

TEST(TimeScale, ZoomingHoldsTheTimeUnderTheMouse) {
  TimeScale scale{10.0, 0.02, 100.0f, 800.0f};
  const double held = scale.TimeAt(400.0f);
  Zoom(scale, 0.5, 400.0f);
  EXPECT_NEAR(scale.TimeAt(400.0f), held, 1e-9);
  EXPECT_NEAR(scale.seconds_per_px, 0.01, 1e-12);
  for (int i = 0; i < 100; ++i) {
    Zoom(scale, 2.0, 400.0f);
  }
  EXPECT_EQ(scale.first, 0.0) << "never before the beginning";
  EXPECT_EQ(scale.seconds_per_px, TimeScale::kCoarsest);
}

TEST(TimeScale, ScrollsAsLittleAsShowsATime) {
  TimeScale scale{10.0, 0.01, 0.0f, 1000.0f};
  ScrollTo(scale, 15.0);
  EXPECT_EQ(scale.first, 10.0);
  ScrollTo(scale, 25.0);
  EXPECT_GT(scale.last(), 25.0);
  EXPECT_LT(scale.first, 25.0);
  ScrollTo(scale, 0.0);
  EXPECT_EQ(scale.first, 0.0);
}

TEST(Ruler, NumbersNeverTouchAndTimesAreTold) {
  for (double pixel = TimeScale::kFinest; pixel <= TimeScale::kCoarsest; pixel *= 1.07) {
    const RulerStep step = ChooseStep(pixel, 70.0f);
    EXPECT_GE(step.seconds / pixel, 70.0);
    EXPECT_NE(FormatTime(step.seconds, step.seconds), FormatTime(2 * step.seconds, step.seconds));
  }
  EXPECT_EQ(FormatTime(0.0, 1.0), "0:00");
  EXPECT_EQ(FormatTime(67.5, 0.5), "1:07.5");
  EXPECT_EQ(FormatTime(59.999, 0.01), "1:00.00") << "rounding carries over";
  EXPECT_EQ(FormatTime(3725.0, 60.0), "1:02:05");
}

TEST(Snap, TakesTheNearestWithinReach) {
  const std::vector<double> marks = {1.0, 2.05};
  EXPECT_EQ(Snap(1.04, marks, 0.0, 0.1), 1.0);
  EXPECT_EQ(Snap(1.5, marks, 0.0, 0.1), 1.5);
  EXPECT_EQ(Snap(2.03, marks, 1.0, 0.1), 2.05) << "the mark is nearer than the grid";
  EXPECT_EQ(Snap(3.02, marks, 1.0, 0.1), 3.0);
}

TEST(MoveItems, MovesThemAndLeavesTheRestOfTheTextAlone) {
  TimelineText text = MustRead(kScript);
  ASSERT_TRUE(editor::MoveItems(text, {{0, 0}}, 0.25, false).ok());
  EXPECT_THAT(text.text(), HasSubstr("{id = \"hail\", at = 1.25, length = 2, line = \"salvete\"},  "
                                     "-- to all"));
  EXPECT_THAT(Times(text, 0), ElementsAre(1.25, 5));
  ASSERT_TRUE(editor::MoveItems(text, {{0, 0}}, -10.0, false).ok());
  EXPECT_THAT(Times(text, 0), ElementsAre(0, 5)) << "not before the beginning";
}

TEST(MoveItems, RipplesAllThatComesLater) {
  TimelineText text = MustRead(kScript);
  ASSERT_TRUE(editor::MoveItems(text, {{0, 1}}, 2.0, true).ok());
  EXPECT_THAT(Times(text, 0), ElementsAre(1, 7));
  EXPECT_THAT(Times(text, 1), ElementsAre(0, 3, 10));
  EXPECT_THAT(Times(text, 2), ElementsAre(8));
}

TEST(MoveItems, ClipsDoNotRunIntoTheirNeighbours) {
  const TimelineText text = MustRead(kScript);
  EXPECT_EQ(editor::ClampMove(text, {{1, 1}}, 10.0, false), 3.0);
  EXPECT_EQ(editor::ClampMove(text, {{1, 1}}, -10.0, false), -1.0);
  EXPECT_EQ(editor::ClampMove(text, {{1, 1}, {1, 2}}, 10.0, false), 10.0);
  EXPECT_EQ(editor::ClampMove(text, {{0, 0}}, 10.0, false), 10.0) << "speech may lie over speech";
}

TEST(TrimItems, MoveOneEndAndHoldTheOther) {
  TimelineText text = MustRead(kScript);
  const std::vector<double> natural = {1.0};
  ASSERT_TRUE(editor::TrimBegins(text, {{0, 0}}, natural, 0.5).ok());
  EXPECT_EQ(text.lanes()[0].at[0], 1.5);
  EXPECT_EQ(text.lanes()[0].length[0], 1.5);
  ASSERT_TRUE(editor::TrimBegins(text, {{0, 0}}, natural, 9.0).ok());
  EXPECT_EQ(text.lanes()[0].length[0], editor::kShortest);
  ASSERT_TRUE(editor::TrimEnds(text, {{0, 0}}, natural, 1.0, false).ok());
  EXPECT_EQ(text.lanes()[0].length[0], 1.0 + editor::kShortest);
}

TEST(TrimItems, AnItemWithoutALengthGetsTheOneThatIsSeen) {
  TimelineText text = MustRead("track{actor = 'a', walks = {{at = 2, to = {x = 0, z = 0}}}}");
  const std::vector<double> natural = {4.0};
  ASSERT_TRUE(editor::TrimEnds(text, {{0, 0}}, natural, -1.0, false).ok());
  EXPECT_EQ(text.lanes()[0].length[0], 3.0);
}

TEST(DeleteItems, ClosesTheGapWhereItRipples) {
  TimelineText text = MustRead(kScript);
  ASSERT_TRUE(editor::DeleteItems(text, {{0, 0}}, true).ok());
  EXPECT_THAT(Times(text, 0), ElementsAre(3));
  EXPECT_THAT(Times(text, 1), ElementsAre(0, 1, 6));
  EXPECT_THAT(Times(text, 2), ElementsAre(4));
}

TEST(CopyItems, ComeBackThroughTheClipboardWithOtherIds) {
  TimelineText text = MustRead(kScript);
  const std::string clipboard =
      editor::FormatCopied(editor::CopyItems(text, {{0, 0}, {0, 1}, {2, 0}}));
  const auto items = editor::ParseCopied(clipboard);
  ASSERT_TRUE(items);
  editor::ItemSet inserted;
  ASSERT_TRUE(editor::PasteItems(text, *items, 10.0, inserted).ok());
  EXPECT_THAT(Times(text, 0), ElementsAre(1, 5, 10, 14));
  EXPECT_THAT(Times(text, 2), ElementsAre(6, 15));
  ASSERT_EQ(inserted.size(), 3u);
  EXPECT_EQ(*text.Field(inserted[0], "id"), "hail 2");
  EXPECT_EQ(*text.Field(inserted[1], "line"), "quid");
  EXPECT_EQ(*text.Field(inserted[2], "name"), "noon");
  ASSERT_TRUE(editor::PasteItems(text, *items, 20.0, inserted).ok());
  EXPECT_EQ(*text.Field(inserted[0], "id"), "hail 3");
}

TEST(CopyItems, PasteBetweenOthersKeepsTrackOfWhatIsNew) {
  TimelineText text = MustRead("track{markers = {{at = 1, name = 'a'}, {at = 9, name = 'z'}}}");
  const std::vector<editor::CopiedItem> items = {
      {LaneKind::kMarkers, "", {{"at", 4.0}, {"name", "late"}}},
      {LaneKind::kMarkers, "", {{"at", 0.0}, {"name", "early"}}}};
  editor::ItemSet inserted;
  ASSERT_TRUE(editor::PasteItems(text, items, 2.0, inserted).ok());
  EXPECT_THAT(Times(text, 0), ElementsAre(1, 2, 6, 9));
  ASSERT_EQ(inserted.size(), 2u);
  EXPECT_EQ(*text.Field(inserted[0], "name"), "early");
  EXPECT_EQ(*text.Field(inserted[1], "name"), "late");
}

TEST(CopyItems, OtherTextsOfTheClipboardAreNothing) {
  EXPECT_FALSE(editor::ParseCopied(""));
  EXPECT_FALSE(editor::ParseCopied("hello"));
  EXPECT_FALSE(editor::ParseCopied("{\"lararium_timeline\": 3}"));
  EXPECT_FALSE(editor::ParseCopied("{\"lararium_timeline\": [{\"lane\": \"speech\"}]}"));
  EXPECT_FALSE(editor::ParseCopied(
      R"({"lararium_timeline": [{"lane": "speech", "actor": "a", "item": {"at": -1}}]})"));
}

TEST(AddItem, MakesTheLaneThatIsMissing) {
  TimelineText text = MustRead("function main()\nend\n");
  editor::ItemSet inserted;
  ASSERT_TRUE(editor::AddItem(text, LaneKind::kSpeech, "keeper", {{"at", 2.0}, {"line", "salvete"}},
                              inserted)
                  .ok());
  ASSERT_EQ(text.lanes().size(), 1u);
  EXPECT_EQ(text.lanes()[0].actor, "keeper");
  EXPECT_THAT(text.text(), HasSubstr("function main()\nend\n"));
  EXPECT_THAT(text.text(), HasSubstr("{at = 2, line = \"salvete\"}"));
  EXPECT_THAT(inserted, ElementsAre(drama::TimelineItem{0, 0}));
}

TEST(Rows, AreThoseOfPeopleTheStageAndObjects) {
  const TimelineText text = MustRead(kScript);
  TaskRecord said;
  said.began = 1;
  said.ended = 2;
  said.where = "drama.lua:3";
  said.actor = "guest";
  said.action = "say ave";
  TaskRecord used = said;
  used.began = 2;
  used.ended = 4;
  used.action = "take";
  used.object = "cup";
  TaskRecord written = said;
  written.from_timeline = true;
  const std::vector<TaskRecord> tasks = {said, used, written};
  const std::vector<std::string> people = {"keeper"};
  const std::vector<TimelineRow> rows = MakeRows(&text, people, tasks);
  std::vector<std::string> seen;
  for (const TimelineRow& row : rows) {
    const char* kind = row.kind == TimelineRow::Kind::kHeading ? "="
                       : row.kind == TimelineRow::Kind::kItems ? "items "
                                                               : "blocks ";
    seen.push_back(kind + (row.kind == TimelineRow::Kind::kHeading
                               ? row.group
                               : std::string(drama::NameOf(row.lane))));
  }
  EXPECT_THAT(seen, ElementsAre("=keeper", "items speech", "items clips", "=guest", "blocks speech",
                                "blocks uses", "=", "items markers", "=cup", "blocks uses"));
  EXPECT_THAT(rows[4].blocks, ElementsAre(0u)) << "what was written is no block";
}

// Two people and an object: speech of keeper (1, 5 s) and clips (0, 3, 8 s); a line that the script
// lets guest say (1 s); a marker (6 s); a cup that guest takes (2 s).
class TimelineSteps : public testing::Test {
 protected:
  TimelineSteps() {
    TaskRecord said;
    said.began = 1;
    said.ended = 2;
    said.actor = "guest";
    said.action = "say ave";
    TaskRecord used = said;
    used.began = 2;
    used.action = "take";
    used.object = "cup";
    tasks_ = {said, used};
    rows_ = MakeRows(&text_, std::vector<std::string>{"keeper"}, tasks_);
  }

  std::vector<TimelineLine> Lines() const { return LinesOf(rows_, text_, tasks_, folded_); }
  // "0/1" for an item, "#0" for a block.
  std::string Step(const TimelineStep& step, double time = 0.0) {
    at_ = StepFrom(Lines(), at_, time, step);
    if (!at_) {
      return "";
    }
    return at_->item ? std::to_string(at_->item->lane) + "/" + std::to_string(at_->item->item)
                     : "#" + std::to_string(at_->block);
  }
  static constexpr TimelineStep kBefore{-1, 0};
  static constexpr TimelineStep kAfter{1, 0};
  static constexpr TimelineStep kAbove{0, -1};
  static constexpr TimelineStep kBelow{0, 1};

  const TimelineText text_ = MustRead(kScript);
  std::vector<TaskRecord> tasks_;
  std::vector<TimelineRow> rows_;
  std::set<std::string> folded_;
  std::optional<TimelineStop> at_;
};

TEST_F(TimelineSteps, GoAlongALineAndStopAtItsEnds) {
  EXPECT_EQ(Step(kAfter, 4.5), "0/1") << "the nearest in time at first";
  EXPECT_EQ(Step(kBefore), "0/0");
  EXPECT_EQ(Step(kBefore), "0/0");
  EXPECT_EQ(Step(kAfter), "0/1");
  EXPECT_EQ(Step(kAfter), "0/1");
}

TEST_F(TimelineSteps, GoFromLineToLineAlsoToWhatTheScriptDidAndBack) {
  std::vector<std::string> seen = {Step(kAfter, 4.5)};
  for (int i = 0; i < 6; ++i) {
    seen.push_back(Step(kBelow));
  }
  // Speech, clips, the line of guest, the object that guest uses, markers, the cup, and then the
  // end.
  EXPECT_THAT(seen, ElementsAre("0/1", "1/1", "#0", "#1", "2/0", "#1", "#1"));
  EXPECT_EQ(at_->group, "object cup");
  EXPECT_EQ(Step(kAbove), "2/0");
  EXPECT_EQ(Step(kAbove), "#1");
  EXPECT_EQ(at_->group, "person guest");
}

TEST_F(TimelineSteps, PassOverFoldedLanesButGoOnFromWithinThem) {
  folded_ = {"person guest"};
  EXPECT_EQ(Step(kAfter, 3.2), "0/1");
  EXPECT_EQ(Step(kBelow), "1/1");
  EXPECT_EQ(Step(kBelow), "2/0");
  folded_ = {"person "};
  EXPECT_EQ(Step(kAbove), "#1") << "though its own line is folded now";
  folded_ = {"person keeper", "person guest", "person ", "object cup"};
  at_.reset();
  EXPECT_EQ(Step(kAfter), "") << "nothing is shown";
}

TEST_F(TimelineSteps, ThatAddItemsPassOverBlocks) {
  EXPECT_EQ(Step({1, 0, true}, 3.2), "0/1");
  EXPECT_EQ(Step({0, 1, true}), "1/1");
  EXPECT_EQ(Step({0, 1, true}), "2/0");
  EXPECT_EQ(Step({0, 1, true}), "2/0");
}

TEST(Extend, AddsAndTakesAwayAgainOnTheWayBack) {
  editor::ItemSet chosen = {{0, 1}};
  Extend(chosen, drama::TimelineItem{0, 1}, {0, 2});
  Extend(chosen, drama::TimelineItem{0, 2}, {0, 3});
  EXPECT_THAT(chosen, ElementsAre(drama::TimelineItem{0, 1}, drama::TimelineItem{0, 2},
                                  drama::TimelineItem{0, 3}));
  Extend(chosen, drama::TimelineItem{0, 3}, {0, 2});
  EXPECT_THAT(chosen, ElementsAre(drama::TimelineItem{0, 1}, drama::TimelineItem{0, 2}));
  Extend(chosen, drama::TimelineItem{0, 2}, {0, 2});
  EXPECT_EQ(chosen.size(), 2u) << "at the end of a line nothing changes";
  Extend(chosen, std::nullopt, {1, 0});
  EXPECT_EQ(chosen.size(), 3u);
}

TEST(Rows, ReadPlacesInMessages) {
  EXPECT_EQ(LineOfPlace("drama.lua:12", "drama.lua"), 12);
  EXPECT_EQ(LineOfPlace("drama.lua:12:5: this brace is never closed", "drama.lua"), 12);
  EXPECT_EQ(LineOfPlace("/a/b/drama.lua:7: x", "drama.lua"), 7);
  EXPECT_EQ(LineOfPlace("project.json: x", "drama.lua"), 0);
  EXPECT_EQ(LineOfPlace("drama.lua: is missing", "drama.lua"), 0);
}

TEST(LuaColours, TellPartsApart) {
  const std::string text = "-- hi\nlocal a = say(\"x\", 12) --[[ b\n]] end";
  std::vector<std::string> parts;
  for (const ColouredWord& word : ColourLua(text)) {
    if (word.part != LuaPart::kPlain) {
      parts.push_back(std::to_string(static_cast<int>(word.part)) + ":" +
                      text.substr(word.begin, word.end - word.begin));
    }
  }
  EXPECT_THAT(parts, ElementsAre(HasSubstr("4:-- hi"), "1:local", "5:say", "2:\"x\"", "3:12",
                                 HasSubstr("4:--[[ b\n]]"), "1:end"));
  EXPECT_EQ(ColourLua("a = \"never").back().part, LuaPart::kBad);
  EXPECT_THAT(LineStarts("a\n\nb"), ElementsAre(0u, 2u, 3u));
  EXPECT_THAT(LineStarts(""), ElementsAre(0u));
}

TEST(TimelineSelection, IsEitherItemsOrATask) {
  TimelineSelection selection;
  EXPECT_FALSE(selection.Last().has_value());
  selection.SelectItem({0, 1});
  selection.SelectBlock(3, "person keeper");
  EXPECT_FALSE(selection.HasItems());
  ASSERT_TRUE(selection.Last().has_value());
  EXPECT_EQ(selection.Last()->block, 3u);
  EXPECT_EQ(selection.Last()->group, "person keeper");
  selection.SelectItem({0, 0});
  EXPECT_EQ(selection.block(), std::nullopt);
}

TEST(TimelineSelection, StepsOnFromTheItemThatWasSelectedLast) {
  TimelineSelection selection;
  selection.SelectItem({0, 0});
  selection.SetItems({{0, 0}, {1, 2}});
  EXPECT_EQ(selection.Last()->item, (drama::TimelineItem{0, 0}));
  selection.SetItems({{1, 0}, {1, 2}});
  EXPECT_EQ(selection.Last()->item, (drama::TimelineItem{1, 2}))
      << "the former one is not selected";
}

TEST(TimelineSelection, KeepsOnlyItemsThatExist) {
  TimelineSelection selection;
  const TimelineText text = MustRead(kScript);
  selection.SelectAll(text);
  EXPECT_EQ(selection.items().size(), 6u);
  selection.SetItems({{0, 0}, {0, 7}});
  selection.KeepValid(&text);
  EXPECT_THAT(selection.items(), ElementsAre(drama::TimelineItem{0, 0}));
  selection.KeepValid(nullptr);
  EXPECT_FALSE(selection.HasItems());
}

}  // namespace
}  // namespace lararium::panels
