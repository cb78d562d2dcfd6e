#include "shared/drama/timeline_text.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "shared/core/random.h"
#include "shared/drama/lua_tokens.h"

namespace lararium::drama {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

TimelineText MustReadTimeline(const std::string& text) {
  auto timeline = TimelineText::Read(text, "drama.lua");
  EXPECT_TRUE(timeline.ok()) << timeline.message() << "\n" << text;
  return timeline.ok() ? *std::move(timeline) : *TimelineText::Read("", "drama.lua");
}

TEST(LuaTokens, NumbersAndTextsMeanWhatLuaMeans) {
  EXPECT_EQ(NumberOf("0x1p4"), 16.0);
  EXPECT_EQ(NumberOf("0xFF"), 255.0);
  EXPECT_EQ(NumberOf(".5e1"), 5.0);
  EXPECT_EQ(NumberOf("3."), 3.0);
  EXPECT_EQ(NumberOf("1e999"), std::nullopt);
  EXPECT_EQ(NumberOf("3x"), std::nullopt);
  EXPECT_EQ(TextOf(R"('a\65\x42\u{e9}\z
     c\n\'')"),
            "aAB\xc3\xa9"
            "c\n'");
  EXPECT_EQ(TextOf("[==[\nx]]y]==]"), "x]]y");
  EXPECT_EQ(TextOf(R"("\q")"), std::nullopt);
  EXPECT_EQ(TextOf(R"("\999")"), std::nullopt);
}

TEST(TimelineText, LanesAndItemsAreFoundAmongScript) {
  const TimelineText timeline = MustReadTimeline(R"(
    -- track{ markers = {{at = 1}} }
    local text = "track{ markers = {{at = 1}} }"
    local long = [=[ track{ markers = {{at = 1}} } ]=]
    my.track{ markers = {{at = 1}} }
    track{ actor = 'keeper',
      speech = { {id = "a", at = 2, length = 1.5, line = "salvete"}; {at = 0x10, line = [[vale]]} },
      gaze = {{at = 3, target = {x = -1, y = 2, z = .5}, ["with head"] = true}},
    }
    track({ markers = {{at = 1, name = "noon"}} })
    function main() keeper:walk_to{x = 1} end)");
  EXPECT_THAT(timeline.problems(), IsEmpty());
  ASSERT_EQ(timeline.lanes().size(), 3u);
  EXPECT_EQ(timeline.lanes()[0].kind, LaneKind::kSpeech);
  EXPECT_EQ(timeline.lanes()[0].actor, "keeper");
  EXPECT_THAT(timeline.lanes()[0].at, ElementsAre(2.0, 16.0));
  EXPECT_THAT(timeline.lanes()[0].length, ElementsAre(1.5, 0.0));
  EXPECT_EQ(timeline.Field({0, 1}, "line"), Json("vale"));
  EXPECT_EQ(timeline.Field({1, 0}, "target"), (Json{{"x", -1.0}, {"y", 2.0}, {"z", 0.5}}));
  EXPECT_EQ(timeline.Field({1, 0}, "with head"), Json(true));
  EXPECT_EQ(timeline.Field({1, 0}, "nothing"), std::nullopt);
  EXPECT_EQ(timeline.LineOf({1, 0}), 8u);
  EXPECT_EQ(timeline.lanes()[2].actor, "");
  EXPECT_EQ(timeline.Duration(), 16.0);
}

TEST(TimelineText, WhatIsNotWrittenOutIsToldWithItsPlaceAndLeftAlone) {
  const struct {
    const char* text;
    const char* problem;
  } kCases[] = {
      {"track{markers = {{at = 1 + 1}}}", "drama.lua:1:26: only numbers, texts"},
      {"track{actor = keeper, gaze = {}}", "drama.lua:1:15: only numbers, texts"},
      {"\ntrack{gaze = {{at = 1}}}", "drama.lua:2:6: 'gaze' need an actor"},
      {"track{dances = {}}", "drama.lua:1:16: track has no lane 'dances'"},
      {"track{markers = {{at = -1}}}", "at must be a number from 0"},
      {"track{markers = {{at = 1, length = 'long'}}}", "length must be a number"},
      {"track{markers = {{name = 'x'}}}", "drama.lua:1:18: this item has no `at`"},
      {"track{markers = {{at = 1, ease = 'jump'}}}", "ease must be one of linear, in"},
      {"track{markers = {1, 2}}", "write an item {at = 0, ...} here"},
      {"track{markers = {{at = 1, 2}}}", "needs a name"},
      {"track{markers = {{at = 1, name = f()}}}", "only numbers, texts"},
      {"track{markers = {{at = 1, x = {1, a = 2}}}}", "have names or none"},
      {"track{markers = {{at = 1, name = '\\q'}}}", "escape"},
  };
  for (const auto& bad : kCases) {
    const TimelineText timeline =
        MustReadTimeline(bad.text + std::string("\ntrack{markers={{at=5}}}"));
    ASSERT_EQ(timeline.problems().size(), 1u) << bad.text;
    EXPECT_THAT(timeline.problems()[0], HasSubstr(bad.problem)) << bad.text;
    ASSERT_EQ(timeline.lanes().size(), 1u) << "the others are read";
    EXPECT_EQ(timeline.lanes()[0].at[0], 5.0);
  }
}

TEST(TimelineText, TextsThatNeverEndAreErrorsWithTheirPlace) {
  for (const char* text : {"x = 'a\nb'", "--[[ a", "x = [==[ ]=]", "x = 12ab"}) {
    const auto timeline = TimelineText::Read(text, "drama.lua");
    ASSERT_FALSE(timeline.ok()) << text;
    EXPECT_THAT(timeline.message(), StartsWith("drama.lua:1:")) << text;
  }
  for (const char* text : {"track{", "track{markers = {", "track{markers = {{at = 1"}) {
    const auto timeline = TimelineText::Read(text, "drama.lua");
    ASSERT_FALSE(timeline.ok()) << text;
  }
  std::string deep = "track{markers = {{at = 1, x = ";
  deep += std::string(100'000, '{') + std::string(100'000, '}') + "}}}";
  EXPECT_THAT(MustReadTimeline(deep).problems()[0], HasSubstr("too deep"));
}

TEST(TimelineText, EditsKeepLinesAndComments) {
  TimelineText timeline = MustReadTimeline(R"(track{ actor = "keeper", -- the old one
  speech = {
    {id = "a", at = 2, line = "salvete"}, -- to the visitor
    -- later
    {id = "b", at = 6 --[[ or 7 ]], length = 2, line = "vale"}
  },
}
)");
  ASSERT_TRUE(timeline.Set({0, 0}, "at", 2.25).ok());
  ASSERT_TRUE(timeline.Set({0, 0}, "ease", "in").ok());
  ASSERT_TRUE(timeline.Insert(0, {{"at", 3}, {"id", "c"}, {"line", "quis \"es\""}}).ok());
  ASSERT_TRUE(timeline.Insert(0, {{"at", 9}, {"line", "x"}}).ok());
  ASSERT_TRUE(timeline.Unset({0, 2}, "at").ok() == false);
  ASSERT_TRUE(timeline.Unset({0, 2}, "length").ok());
  ASSERT_TRUE(timeline.AddLane(LaneKind::kMarkers, "").ok());
  ASSERT_TRUE(timeline.Insert(1, {{"at", 0}, {"name", "begin"}}).ok());
  EXPECT_EQ(timeline.text(), R"(track{ actor = "keeper", -- the old one
  speech = {
    {id = "a", at = 2.25, line = "salvete", ease = "in"}, -- to the visitor
    {id = "c", at = 3, line = "quis \"es\""},
    -- later
    {id = "b", at = 6 --[[ or 7 ]], line = "vale"},
    {at = 9, line = "x"}
  },
}

track{markers = {
  {at = 0, name = "begin"},
}}
)");
  ASSERT_TRUE(timeline.Remove({0, 0}).ok());
  ASSERT_TRUE(timeline.Remove({0, 0}).ok());
  EXPECT_THAT(timeline.text(), HasSubstr(R"(  speech = {
    -- to the visitor
    -- later
    {id = "b", at = 6)"));
  EXPECT_FALSE(timeline.AddLane(LaneKind::kMarkers, "").ok());
  EXPECT_FALSE(timeline.AddLane(LaneKind::kGaze, "").ok());
  EXPECT_FALSE(timeline.Remove({0, 7}).ok());
  EXPECT_FALSE(timeline.Set({0, 0}, "at", -1).ok());
  EXPECT_FALSE(timeline.Set({0, 0}, "x", nullptr).ok());
  EXPECT_FALSE(timeline.Apply({0, "nothing like it", ""}).ok());
}

// ---- generated dramas --------------------------------------------------------

// The contents of a timeline without its formatting.
struct Lane {
  LaneKind kind;
  std::string actor;
  std::vector<Json> items;
  friend bool operator==(const Lane&, const Lane&) = default;
};
using Model = std::vector<Lane>;

Model ModelOf(const TimelineText& timeline) {
  Model model;
  for (size_t l = 0; l < timeline.lanes().size(); ++l) {
    const TimelineLane& lane = timeline.lanes()[l];
    model.push_back({lane.kind, lane.actor, {}});
    for (size_t i = 0; i < lane.size(); ++i) {
      Json item = Json::object();
      for (const TimelineField& field : timeline.Fields({l, i})) {
        item[field.key] = field.value;
      }
      EXPECT_EQ(item["at"], lane.at[i]);
      EXPECT_EQ(item.value("length", 0.0), lane.length[i]);
      model.back().items.push_back(std::move(item));
    }
  }
  return model;
}

class Generator {
 public:
  explicit Generator(uint64_t seed) : random_(seed) {}

  uint32_t Below(uint32_t count) { return random_.Below(count); }
  double Time() {
    const double time = random_.Uniform(0.0, 600.0);
    return Below(2) == 0 ? std::floor(time) : time;
  }

  Json Value(int depth = 0) {
    switch (Below(depth < 2 ? 5 : 3)) {
      case 0:
        return random_.Uniform(-1e3, 1e3);
      case 1:
        return Below(2) == 0;
      case 2: {
        constexpr const char* kTexts[] = {"salvete", "a \"b\" 'c'", "x\\y\n\tz\0017", "--[[",
                                          "]]",      "{,}",         "ātrium",         ""};
        return kTexts[Below(std::size(kTexts))];
      }
      case 3: {
        Json list = Json::array();
        for (uint32_t i = 0; i <= Below(3); ++i) {
          list.push_back(Value(depth + 1));
        }
        return list;
      }
      default: {
        Json fields = Json::object();
        for (uint32_t i = 0; i < Below(4); ++i) {
          fields[Key()] = Value(depth + 1);
        }
        return fields;
      }
    }
  }
  std::string Key() {
    constexpr const char* kKeys[] = {"x", "y", "line", "clip", "end", "two words", "_a1", "on"};
    return kKeys[Below(std::size(kKeys))];
  }
  Json Item() {
    Json item = {{"at", Time()}};
    if (Below(2) == 0) {
      item["length"] = random_.Uniform(0.0, 9.0);
    }
    for (uint32_t i = 0; i < Below(4); ++i) {
      item[Key()] = Value();
    }
    return item;
  }

  // Blanks and comments between two tokens.
  std::string Blank() {
    switch (Below(8)) {
      case 0:
        return " -- c" + std::to_string(++comments_) + "\n  ";
      case 1:
        return " --[==[ c" + std::to_string(++comments_) + " }]] ]==] ";
      case 2:
        return "\n\t";
      default:
        return Below(2) == 0 ? " " : "";
    }
  }
  std::string Script() {
    constexpr const char* kScripts[] = {
        "local s = 'track{ markers = {{at = 1}} }'\n",
        "-- track{ markers = {{at = 2}} }\n",
        "function f(a) if a ~= 1 then return a .. [[ track{ ]] end end\n",
        "--[[ a long\n one ]] local track_of = { 1, 2, x = f }\n",
        "stage.track{ markers = {{at = 3}} }\n",
        "x = 1 <= 2 and #'y' // 3 or -0x1p-2\n",
    };
    return kScripts[Below(std::size(kScripts))];
  }

  std::string Written(const Model& model) {
    std::string text;
    for (const Lane& lane : model) {
      text += Script();
      const std::string who =
          lane.actor.empty() ? "" : "actor" + Blank() + "= " + LuaLiteral(lane.actor) + ",";
      text += "track" + Blank() + "{" + Blank() + who + Blank() + std::string(NameOf(lane.kind)) +
              Blank() + "=" + Blank() + "{" + Blank();
      for (size_t i = 0; i < lane.items.size(); ++i) {
        text += Written(lane.items[i]) + Blank();
        if (i + 1 < lane.items.size() || Below(2) == 0) {
          text += (Below(4) == 0 ? ";" : ",") + Blank();
        }
      }
      text += "}" + Blank() + (Below(2) == 0 ? "," : "") + Blank() + "}\n";
    }
    return text + Script();
  }
  std::string Written(const Json& item) {
    std::string text = "{" + Blank();
    size_t left = item.size();
    for (const auto& [key, value] : item.items()) {
      const bool is_word = key != "end" && key.find(' ') == std::string::npos;
      text += is_word ? key : "[" + Blank() + LuaLiteral(key) + Blank() + "]";
      text += Blank() + "=" + Blank() + LuaLiteral(value) + Blank();
      text += --left > 0 || Below(3) == 0 ? "," : "";
      text += Blank();
    }
    return text + "}";
  }

  Model RandomModel() {
    constexpr LaneKind kKinds[] = {LaneKind::kSpeech, LaneKind::kWalks, LaneKind::kMarkers,
                                   LaneKind::kSounds, LaneKind::kClips};
    Model model;
    for (uint32_t l = 0; l < 1 + Below(4); ++l) {
      const LaneKind kind = kKinds[Below(std::size(kKinds))];
      Lane& lane = model.emplace_back(Lane{kind, IsOfActor(kind) ? "keeper" : "", {}});
      for (uint32_t i = 0; i < Below(6); ++i) {
        lane.items.push_back(Item());
      }
    }
    return model;
  }

 private:
  Random random_;
  int comments_ = 0;
};

std::vector<std::string> CommentsOf(const std::string& text) {
  std::vector<std::string> comments;
  size_t behind = 0;
  LuaTokens tokens(text);
  for (;;) {
    const LuaToken token = tokens.Next();
    for (size_t at = text.find("c", behind); at < token.begin; at = text.find("c", at + 1)) {
      size_t end = at + 1;
      while (end < token.begin && text[end] >= '0' && text[end] <= '9') {
        ++end;
      }
      if (end > at + 1) {
        comments.push_back(text.substr(at, end - at));
      }
    }
    behind = token.end;
    if (token.kind == LuaToken::Kind::kEnd) {
      return comments;
    }
  }
}

bool Contains(const std::vector<std::string>& in, const std::string& text) {
  return std::find(in.begin(), in.end(), text) != in.end();
}

// Makes one random edit of text and model. All other text must stay.
void Edit(Generator& random, TimelineText& timeline, Model& model, std::vector<TextEdit>& edits) {
  const std::string before = timeline.text();
  const auto comments = CommentsOf(before);
  const size_t l = random.Below(static_cast<uint32_t>(model.size()));
  Lane& lane = model[l];
  const size_t i = lane.items.empty() ? 0 : random.Below(static_cast<uint32_t>(lane.items.size()));
  const uint32_t kind = lane.items.empty() ? 0 : random.Below(5);
  std::string gone;  // Text whose comments may be removed.
  size_t from = 0;   // Begin of the range that the edit may change.
  size_t to = before.size();
  Result<TextEdit> edit = Status::Error("test", "no edit");
  if (kind == 0) {
    const Json item = random.Item();
    edit = timeline.Insert(l, item);
    size_t place = lane.items.size();
    for (size_t k = 0; k < lane.items.size(); ++k) {
      if (lane.items[k]["at"] <= item["at"]) {
        place = k;
      }
    }
    lane.items.insert(lane.items.begin() +
                          static_cast<std::ptrdiff_t>(place == lane.items.size() ? 0 : place + 1),
                      item);
  } else if (kind == 1) {
    const TimelineLane& of = timeline.lanes()[l];
    gone = before.substr(of.begin[i], of.end[i] - of.begin[i]);
    edit = timeline.Remove({l, i});
    lane.items.erase(lane.items.begin() + static_cast<std::ptrdiff_t>(i));
  } else {
    const std::string key = kind == 2 ? "at" : random.Key();
    from = timeline.lanes()[l].begin[i];
    to = timeline.lanes()[l].end[i];
    if (kind == 4 && lane.items[i].contains(key)) {
      uint32_t value_end = 0;
      for (const TimelineField& field : timeline.Fields({l, i})) {
        value_end = field.key == key ? field.end : value_end;
      }
      edit = timeline.Unset({l, i}, key);
      ASSERT_TRUE(edit.ok()) << edit.message();
      gone = before.substr(edit->offset, value_end - edit->offset);
      lane.items[i].erase(key);
    } else {
      const Json value = kind == 2 ? Json(random.Time()) : random.Value();
      edit = timeline.Set({l, i}, key, value);
      lane.items[i][key] = value;
    }
  }
  ASSERT_TRUE(edit.ok()) << edit.message() << "\n" << before;
  EXPECT_GE(edit->offset, from);
  EXPECT_LE(edit->offset + edit->removed.size(), to);
  std::string expected = before;
  expected.replace(edit->offset, edit->removed.size(), edit->inserted);
  ASSERT_EQ(timeline.text(), expected) << "but for the edit nothing may change";
  const auto kept = CommentsOf(timeline.text());
  for (const std::string& comment : comments) {
    EXPECT_TRUE(Contains(kept, comment) || Contains(CommentsOf(gone), comment)) << comment;
  }
  edits.push_back(*std::move(edit));
}

TEST(TimelineText, GeneratedDramasSurviveEditsAndWhatWasNotMeantStays) {
  for (uint64_t seed = 1; seed <= 150; ++seed) {
    SCOPED_TRACE(seed);
    Generator random(seed);
    Model model = random.RandomModel();
    const std::string written = random.Written(model);
    TimelineText timeline = MustReadTimeline(written);
    ASSERT_THAT(timeline.problems(), IsEmpty()) << written;
    ASSERT_EQ(ModelOf(timeline), model) << written;
    std::vector<TextEdit> edits;
    for (int i = 0; i < 12; ++i) {
      Edit(random, timeline, model, edits);
      if (HasFatalFailure()) {
        return;
      }
      ASSERT_EQ(ModelOf(timeline), model) << timeline.text();
      ASSERT_EQ(ModelOf(MustReadTimeline(timeline.text())), model) << timeline.text();
    }
    while (!edits.empty()) {
      ASSERT_TRUE(timeline.Apply(edits.back().Reverse()).ok());
      edits.pop_back();
    }
    EXPECT_EQ(timeline.text(), written) << "edits are undone exactly";
  }
}

TEST(TimelineText, WindowsFindWhatALinearSearchFinds) {
  Generator random(7);
  Model model = {{LaneKind::kMarkers, "", {}}};
  for (int i = 0; i < 300; ++i) {
    model[0].items.push_back(random.Item());
  }
  TimelineText timeline = MustReadTimeline(random.Written(model));
  for (int i = 0; i < 200; ++i) {
    if (i == 100) {
      ASSERT_TRUE(timeline.Set({0, 17}, "at", 599.0).ok());
    }
    const double from = random.Time();
    const double to = from + (i % 3 == 0 ? 0.0 : random.Time() / 20.0);
    std::vector<uint32_t> found;
    timeline.Query(0, from, to, found);
    std::sort(found.begin(), found.end());
    std::vector<uint32_t> expected;
    const TimelineLane& lane = timeline.lanes()[0];
    for (uint32_t k = 0; k < lane.size(); ++k) {
      const double end = lane.at[k] + lane.length[k];
      if (lane.at[k] < to && (end > from || lane.at[k] == from)) {
        expected.push_back(k);
      }
    }
    EXPECT_EQ(found, expected);
  }
}

TEST(TimelineText, SetAllDoesWhatOneAfterTheOtherDoes) {
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    Generator random(seed);
    const Model model = random.RandomModel();
    const std::string written = random.Written(model);
    TimelineText one = MustReadTimeline(written);
    TimelineText all = MustReadTimeline(written);
    std::vector<TimelineChange> changes;
    for (size_t lane = 0; lane < one.lanes().size(); ++lane) {
      for (size_t item = 0; item < one.lanes()[lane].size(); item += 2) {
        changes.push_back({{lane, item}, "at", random.Time()});
        changes.push_back({{lane, item}, "length", random.Time()});
        changes.push_back({{lane, item}, "added", "new"});
      }
    }
    for (const TimelineChange& change : changes) {
      ASSERT_TRUE(one.Set(change.item, change.key, change.value).ok());
    }
    const Result<TextEdit> edit = all.SetAll(changes);
    ASSERT_TRUE(edit.ok()) << edit.message();
    EXPECT_EQ(all.text(), one.text());
    EXPECT_EQ(ModelOf(all), ModelOf(one));
    ASSERT_TRUE(all.Apply(edit->Reverse()).ok());
    EXPECT_EQ(all.text(), written);
  }
}

TEST(TimelineText, SetAllFailsAsAWhole) {
  TimelineText timeline =
      MustReadTimeline("track{markers = {{at = 1, name = 'a'}, {at = 2, name = 'b'}}}");
  const std::string before = timeline.text();
  EXPECT_FALSE(
      timeline.SetAll(std::vector<TimelineChange>{{{0, 0}, "at", 3.0}, {{0, 1}, "at", -1.0}}).ok());
  EXPECT_FALSE(
      timeline.SetAll(std::vector<TimelineChange>{{{0, 0}, "at", 3.0}, {{0, 2}, "at", 1.0}}).ok());
  EXPECT_FALSE(
      timeline.SetAll(std::vector<TimelineChange>{{{0, 0}, "at", 3.0}, {{0, 0}, "at", 1.0}}).ok());
  EXPECT_EQ(timeline.text(), before);
}

TEST(Difference, IsTheShortestEditFromOneTextToAnother) {
  const auto made = [](const std::string& before, const std::string& after) {
    const TextEdit edit = Difference(before, after);
    std::string text = before;
    EXPECT_EQ(text.substr(edit.offset, edit.removed.size()), edit.removed);
    text.replace(edit.offset, edit.removed.size(), edit.inserted);
    EXPECT_EQ(text, after);
    return edit.removed.size() + edit.inserted.size();
  };
  EXPECT_EQ(made("", ""), 0u);
  EXPECT_EQ(made("abc", "abc"), 0u);
  EXPECT_EQ(made("aaa", "aaaa"), 1u);
  EXPECT_EQ(made("abab", "ab"), 2u);
  EXPECT_EQ(made("at = 1, x", "at = 2, x"), 2u);
  EXPECT_EQ(made("", "new"), 3u);
  EXPECT_EQ(made("old", ""), 3u);
}

}  // namespace
}  // namespace lararium::drama
