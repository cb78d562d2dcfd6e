#include "editor/import/motion/bml.h"

#include <gmock/gmock.h>

#include "shared/drama/timeline_text.h"

namespace lararium::import {
namespace {

using drama::LaneKind;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Lines and clips of two seconds, whose stroke lasts from 0.5 to 1.5 s.
BmlStage World() {
  const drama::SyncTimes times = {0.0, 0.25, 0.5, 1.0, 1.5, 1.75, 2.0};
  BmlStage stage;
  stage.characters = {{"", "keeper"}, {"Alice", "girl"}, {"girl", "girl"}, {"keeper", "keeper"}};
  stage.clips["keeper"] = {{"wave", times}, {"nod", times}};
  stage.lines["salvete"] = {{"Salvēte, hospitēs!", "Greetings, friends!"}, times};
  stage.objects["counter"] = {1.5, -2.0};
  stage.objects["stool"] = {0.0, 0.0};
  return stage;
}

BmlImport Imported(const std::string& behaviours, const std::string& attributes = "") {
  const auto imported = ImportBml("<bml xmlns=\"http://www.bml-initiative.org/bml/bml-1.0\" " +
                                      attributes + ">\n" + behaviours + "</bml>",
                                  "a.xml", World());
  EXPECT_TRUE(imported.ok()) << imported.message();
  return imported.ok() ? *imported : BmlImport();
}

double At(const BmlImport& imported, const std::string& id) {
  for (const BmlItem& item : imported.items) {
    if (item.fields.value("id", "") == id) {
      return item.fields["at"];
    }
  }
  return -1.0;
}

TEST(Bml, TheCoreBehavioursBecomeItemsOfTheirLanes) {
  const BmlImport imported = Imported(R"(
    <gaze id="g" target="Alice" start="1" end="3"/>
    <gazeShift id="gs" target="counter" start="4"/>
    <head id="h" lexeme="NOD" repetition="2" start="5"/>
    <gesture id="w" lexeme="WAVE" start="6"/>
    <posture id="p" target="stool" start="7"><stance type="SITTING"/></posture>
    <postureShift id="up" start="9"><stance type="STANDING"/></postureShift>
    <locomotion id="l" target="counter" manner="RUN" start="10"/>
    <speech id="s" start="11"><text>Greetings,
      friends!</text></speech>
    <faceLexeme id="f" lexeme="OBJECT_SMILE" amount="0.8" start="12" end="13.5"/>
    <wait id="x" duration="2"/>)");
  EXPECT_THAT(imported.warnings, IsEmpty());
  ASSERT_EQ(imported.items.size(), 10u);
  const auto expect = [&](size_t i, LaneKind lane, const Json& fields) {
    EXPECT_EQ(imported.items[i].lane, lane) << i;
    EXPECT_EQ(imported.items[i].actor, "keeper");
    EXPECT_EQ(imported.items[i].fields, fields);
    for (const auto& [key, value] : fields.items()) {
      const drama::LaneField* field = drama::FindField(drama::SpecOf(lane), key);
      ASSERT_NE(field, nullptr) << key;
      EXPECT_EQ(drama::ProblemOf(*field, value), "") << key;
    }
  };
  expect(0, LaneKind::kGaze, {{"id", "g"}, {"at", 1.0}, {"length", 2.0}, {"target", "girl"}});
  expect(1, LaneKind::kGaze, {{"id", "gs"}, {"at", 4.0}, {"target", "counter"}});
  expect(2, LaneKind::kGestures, {{"id", "h"}, {"at", 5.0}, {"clip", "nod"}, {"part", "head"}});
  expect(3, LaneKind::kGestures, {{"id", "w"}, {"at", 6.0}, {"clip", "wave"}, {"part", "upper"}});
  expect(4, LaneKind::kGestures, {{"at", 7.0}, {"clip", "nod"}, {"part", "head"}});
  expect(5, LaneKind::kUses, {{"id", "p"}, {"at", 7.0}, {"action", "sit"}, {"object", "stool"}});
  expect(6, LaneKind::kUses, {{"id", "up"}, {"at", 9.0}, {"action", "stand"}});
  expect(7, LaneKind::kWalks,
         {{"id", "l"}, {"at", 10.0}, {"to", {{"x", 1.5}, {"z", -2.0}}}, {"speed", 2.5}});
  expect(8, LaneKind::kSpeech, {{"id", "s"}, {"at", 11.0}, {"line", "salvete"}});
  expect(9, LaneKind::kExpressions,
         {{"id", "f"}, {"at", 12.0}, {"length", 1.5}, {"expression", "joy"}, {"intensity", 0.8}});
}

TEST(Bml, PointsOfOthersGiveTimes) {
  const BmlImport imported = Imported(R"(
    <gesture id="late" lexeme="wave" start="other:end"/>
    <gesture id="other" lexeme="wave" stroke="s:half + 0.5"/>
    <gesture id="before" lexeme="wave" end="s:start - 1"/>
    <gaze id="look" target="AUDIENCE" start="s:start" end="other:strokeEnd"/>
    <speech id="s" start="4"><text>Greetings,<sync id="half"/> friends!</text></speech>
    <head id="nod" lexeme="NOD" ready="b1:s:relax"/>)",
                                      "id=\"b1\"");
  EXPECT_THAT(imported.warnings, IsEmpty());
  // "Greetings," has 10 of the 19 letters counted in a stroke from 0.5 to 1.5 s.
  const double half = 4.0 + 0.5 + 10.0 / 20.0;
  EXPECT_NEAR(At(imported, "other"), half + 0.5 - 1.0, 0.03);
  EXPECT_NEAR(At(imported, "late"), At(imported, "other") + 2.0, 0.002);
  EXPECT_DOUBLE_EQ(At(imported, "before"), 1.0);
  EXPECT_DOUBLE_EQ(At(imported, "look"), 4.0);
  EXPECT_DOUBLE_EQ(At(imported, "nod"), 4.0 + 1.75 - 0.25);
}

TEST(Bml, SynchronisedPointsFallTogether) {
  const BmlImport imported = Imported(R"(
    <speech id="s" start="3"><text>Salvēte, hospitēs!</text></speech>
    <gesture id="w" lexeme="wave"/>
    <constraint id="c"><synchronize>
      <sync ref="w:stroke"/><sync ref="s:strokeEnd"/></synchronize></constraint>)");
  EXPECT_THAT(imported.warnings, IsEmpty());
  EXPECT_DOUBLE_EQ(At(imported, "w"), 3.0 + 1.5 - 1.0);
}

TEST(Bml, BlocksAreMergedOrAppended) {
  const auto imported = ImportBml(R"(<act>
    <bml id="a"><gesture id="one" lexeme="wave" start="1"/></bml>
    <bml id="b" composition="APPEND"><gesture id="two" lexeme="wave"/></bml>
    <bml id="c" characterId="Alice"><gaze id="three" target="keeper"/></bml></act>)",
                                  "a.xml", World(), 10.0);
  ASSERT_TRUE(imported.ok()) << imported.message();
  EXPECT_DOUBLE_EQ(At(*imported, "one"), 11.0);
  EXPECT_DOUBLE_EQ(At(*imported, "two"), 13.0);
  EXPECT_DOUBLE_EQ(At(*imported, "three"), 10.0);
  EXPECT_EQ(imported->items[0].actor, "girl");
}

TEST(Bml, WhatIsNotSupportedIsToldWithItsPlace) {
  const BmlImport imported = Imported(R"(<gesture id="x" lexeme="BEAT"/>
<dance id="d"/>
<speech id="s"><text>Nobody says this</text></speech>
<gaze id="g" target="nobody"/>
<locomotion id="l" target="the moon"/>
<posture id="p"><stance type="SITTING"/><pose part="ARMS" lexeme="CROSSED"/></posture>
<faceFacs id="f" au="12" start="2" end="3"/>
<faceFacs id="f99" au="99"/>
<gesture id="loop1" lexeme="wave" start="loop2:end"/>
<gesture id="loop2" lexeme="wave" start="loop1:end"/>
<gesture id="early" lexeme="wave" end="0.5"/>
<gesture id="two" lexeme="wave" start="1" stroke="5"/>
<gesture id="bad" lexeme="wave" start="soon"/>
<constraint><before ref="x:end"><sync ref="d:start"/></before></constraint>)");
  for (const char* warning :
       {"a.xml:2: gesture 'x': 'keeper' has no clip 'beat'", "a.xml:3: dance 'd': is not supported",
        "a.xml:4: speech 's': no line has the text 'Nobody says this'",
        "gaze 'g': there is no actor or object called 'nobody'",
        "locomotion 'l': 'the moon' is neither an object nor a position",
        "posture 'p': sitting needs a seat", "posture 'p': poses of parts",
        "faceFacs 'f': action unit 12 is shown as 'joy'", "faceFacs 'f99': there is no expression",
        "gesture 'loop1': waits for a behaviour that waits for it",
        "gesture 'early': would begin before", "gesture 'two': its stroke comes at 2.00 s",
        "gesture 'bad': start=\"soon\"", "before: is not supported"}) {
    EXPECT_THAT(imported.warnings, Contains(HasSubstr(warning)));
  }
  EXPECT_DOUBLE_EQ(At(imported, "f"), 2.0);
}

TEST(Bml, NobodyItKnowsIsAskedFor) {
  const auto imported =
      ImportBml("<bml characterId=\"Bob\"><gaze target=\"x\"/></bml>", "a.xml", World());
  ASSERT_TRUE(imported.ok());
  EXPECT_THAT(imported->warnings, Contains(HasSubstr("name one with --actor Bob=NAME")));
  EXPECT_THAT(imported->items, IsEmpty());
}

TEST(Bml, IsReadWithPrefixesMarksAndAnyEncoding) {
  const std::string body =
      "<b:bml xmlns:b='x'><b:speech id='s' start='1'><b:text>Salv\u0113te, <b:sync id='m'/>"
      "<e>hospit\u0113s!</e></b:text></b:speech><b:required><b:postureShift id='p' start='2'>"
      "<b:stance type='STANDING'/></b:postureShift></b:required></b:bml>";
  for (const std::string& text :
       {body, "\xEF\xBB\xBF<?xml version='1.0' encoding='UTF-8'?>" + body,
        "<!DOCTYPE bml [<!ENTITY a 'b'>]>" + body, "<act><scene>" + body + "</scene></act>"}) {
    const auto imported = ImportBml(text, "a.xml", World());
    ASSERT_TRUE(imported.ok()) << imported.message();
    EXPECT_THAT(imported->warnings, IsEmpty());
    EXPECT_EQ(imported->items.size(), 2u);
    EXPECT_EQ(imported->items[0].fields["line"], "salvete");
  }
  const auto latin = ImportBml(
      "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?><bml><!-- caff\xE8 -->"
      "<gesture id='caff\xE8' lexeme='wave'/></bml>",
      "a.xml", World());
  ASSERT_TRUE(latin.ok()) << latin.message();
  EXPECT_EQ(latin->items[0].fields["id"], "caffè");
}

TEST(Bml, ABehaviourWithoutATimeIsLeftOut) {
  const BmlImport imported = Imported(R"(
    <gesture id="a" lexeme="wave" start="b:end"/><gesture id="b" lexeme="wave" start="a:end"/>
    <gesture id="c" lexeme="wave" start="1,5"/>)");
  EXPECT_THAT(imported.items, IsEmpty());
  EXPECT_EQ(imported.warnings.size(), 2u);
}

TEST(Bml, BehavioursThatWaitForOneAnotherAreToldInOneLine) {
  const BmlImport imported = Imported(R"(<gesture id="a" lexeme="wave" start="b:end"/>
<gesture id="b" lexeme="wave" start="a:end"/>
<gesture id="c" lexeme="wave" start="none:end"/>
<gesture id="d" lexeme="wave" start="b:end"/>
<gesture id="e" lexeme="wave" start="d:no_mark"/>)");
  EXPECT_THAT(imported.items, IsEmpty());
  EXPECT_THAT(
      imported.warnings,
      UnorderedElementsAre(
          AllOf(HasSubstr("a.xml:2: gesture 'a': waits for a behaviour that waits for it"),
                HasSubstr("left out as well: gesture 'b' in line 3, gesture 'd' in line 5")),
          HasSubstr("a.xml:4: gesture 'c': waits for a point that never occurs"),
          HasSubstr("a.xml:6: gesture 'e': waits for a point that never occurs")));
}

TEST(Bml, HostileFilesAreRefused) {
  const auto refusal = [](const std::string& text) {
    const auto imported = ImportBml(text, "a.xml", World());
    return imported.ok() ? "" : imported.message();
  };
  EXPECT_THAT(refusal(""), HasSubstr("is not valid XML"));
  EXPECT_THAT(refusal("<bml>\n<gaze"), HasSubstr("a.xml:2: is not valid XML"));
  EXPECT_THAT(refusal("<scene/>"), HasSubstr("has no <bml>"));
  std::string bomb = "<!DOCTYPE bml [<!ENTITY a \"ha\">";
  for (char c = 'b'; c <= 'z'; ++c) {
    bomb += std::string("<!ENTITY ") + c + " \"&" + static_cast<char>(c - 1) + ";&" +
            static_cast<char>(c - 1) + ";\">";
  }
  const auto expanded =
      ImportBml(bomb + "]><bml><speech><text>&z;</text></speech></bml>", "a.xml", World());
  ASSERT_TRUE(expanded.ok()) << expanded.message();
  EXPECT_THAT(expanded->warnings, Contains(HasSubstr("the entity '&z;' is left as it is")));
  EXPECT_TRUE(
      ImportBml("<!DOCTYPE bml SYSTEM \"file:///etc/passwd\"><bml/>", "a.xml", World()).ok());
  std::string many = "<bml>";
  for (int i = 0; i < 2001; ++i) {
    many += "<wait/>";
  }
  EXPECT_THAT(refusal(many + "</bml>"), HasSubstr("more than 2000"));
  std::string deep;
  for (int i = 0; i < 100'000; ++i) {
    deep += "<a>";
  }
  EXPECT_THAT(refusal(deep), HasSubstr("is not valid XML"));
  EXPECT_THAT(refusal("<bml>" + std::string(kMaxBmlBytes, ' ') + "</bml>"), HasSubstr("4 MiB"));
}

TEST(Bml, ItsItemsAreThoseOfATrack) {
  const BmlImport imported = Imported(R"(<gaze id="g" target="Alice" start="1" end="3"/>
    <speech id="s" start="0.5"><text>Greetings, friends!</text></speech>)");
  auto text = drama::TimelineText::Read("-- mine\n", "drama.lua");
  ASSERT_TRUE(text.ok());
  for (const BmlItem& item : imported.items) {
    ASSERT_TRUE(text->AddLane(item.lane, item.actor).ok());
    ASSERT_TRUE(text->Insert(text->lanes().size() - 1, item.fields).ok());
  }
  EXPECT_THAT(text->problems(), IsEmpty());
  EXPECT_THAT(text->text(), HasSubstr("-- mine\n"));
  EXPECT_THAT(text->text(), HasSubstr("line = \"salvete\""));
}

}  // namespace
}  // namespace lararium::import
