#include "editor/check/line_checks.h"

#include <gmock/gmock.h>

#include "editor/bake/speech.h"
#include "editor/text/text.h"
#include "shared/core/file.h"
#include "shared/stage/viseme_file.h"
#include "tests/stage/test_human.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class LineChecksTest : public ::testing::Test {
 protected:
  LineChecksTest() {
    document_.cast = {{}, {}};
    document_.cast[0].name = "keeper";
    document_.cast[1].name = "girl";
    document_.speech = {{"la"}, {"en"}};
    SetTable(
        "id,speaker,la,en\n"
        "keeper,,Placidus,Placidus\n"
        "salvete,keeper,Salvēte!,Greetings!\n"
        "vale,keeper,Valē!,Farewell!\n");
  }

  void SetTable(std::string_view csv) {
    ASSERT_TRUE(WriteFileAtomically(folder_ / "lines.csv", csv).ok());
    auto lines = LoadProjectLines(paths_, document_);
    ASSERT_TRUE(lines.ok()) << lines.message();
    lines_ = *std::move(lines);
    auto spoken = SpokenLines(paths_, document_, lines_);
    ASSERT_TRUE(spoken.ok()) << spoken.message();
    spoken_ = *std::move(spoken);
    for (const SpokenLine& line : spoken_) {  // Baked lines of one second each.
      std::filesystem::create_directories(line.visemes.parent_path());
      human::VisemeTrack track;
      track.duration = 1.0f;
      ASSERT_TRUE(WriteFileAtomically(line.visemes, stage::FormatVisemes(track)).ok());
    }
  }

  test::TemporaryFolder folder_;
  ProjectPaths paths_{folder_.path()};
  ProjectDocument document_;
  ProjectLines lines_;
  std::vector<SpokenLine> spoken_;
};

TEST_F(LineChecksTest, AWholeTableHasNoProblems) {
  EXPECT_THAT(CheckTable(paths_, document_, lines_, spoken_), IsEmpty());
  EXPECT_THAT(CheckScriptLines(paths_, document_, lines_, spoken_,
                               "-- keeper:say('nothing')\nkeeper:say('salvete')\nx:say\"vale\""),
              IsEmpty());
}

TEST_F(LineChecksTest, MissingTextsSpeakersAndTimeToReadAreTold) {
  SetTable(
      "id,speaker,la,en\n"
      "salvete,nobody,,Greetings!\n"
      "longa,keeper,Longa.,"
      "It takes far longer to read all of these words than it took to say that one word aloud "
      "just now in the bar of Placidus and then there are even more of them for the visitor\n"
      "vale,,Valē!,\n");
  const auto problems = EnglishOf(CheckTable(paths_, document_, lines_, spoken_));
  EXPECT_THAT(problems, Contains(HasSubstr("line 'salvete': it has no text in 'la', which is")));
  EXPECT_THAT(problems, Contains(HasSubstr("no person of the cast is called 'nobody'")));
  EXPECT_THAT(problems, Contains(HasSubstr("line 'vale': it has no text in 'en'")));
  EXPECT_THAT(problems, Contains(HasSubstr("line 'vale': it has no speaker")));
  EXPECT_THAT(problems, Contains(HasSubstr("letters a second")));
}

TEST_F(LineChecksTest, UnknownLinesOfTheScriptAreToldWithTheirPlace) {
  const auto problems = EnglishOf(CheckScriptLines(paths_, document_, lines_, spoken_,
                                                   "function main()\n"
                                                   "  keeper:say(\"salve\")\n"
                                                   "end\n"
                                                   "track{actor = \"girl\", speech = {\n"
                                                   "  {at = 1, length = 0.5, line = \"salvete\"},\n"
                                                   "  {at = 3, length = 2, line = \"ave\"},\n"
                                                   "}}\n"));
  EXPECT_THAT(problems, Contains("drama.lua:2: there is no line 'salve'; add it to lines.csv"));
  EXPECT_THAT(problems,
              Contains(HasSubstr("drama.lua:5: the line 'salvete' lasts 1.00 s, its item 0.50")));
  EXPECT_THAT(problems, Contains(HasSubstr("drama.lua:6: there is no line 'ave'")));
}

TEST_F(LineChecksTest, ProblemsAreSaidInTheLanguageOfTheInterfaceAndAsBeforeInEnglish) {
  SetTable(
      "id,speaker,la,en\n"
      "salvete,nobody,,Greetings!\n");
  LoadTexts(LARARIUM_LOCALE_DIR, "it");
  std::vector<std::string> italian;
  for (const Sentence& problem : CheckTable(paths_, document_, lines_, spoken_)) {
    italian.push_back(problem.Translated(Tr));
  }
  const auto english = EnglishOf(CheckTable(paths_, document_, lines_, spoken_));
  LoadTexts(LARARIUM_LOCALE_DIR, "en");
  EXPECT_THAT(
      italian,
      ::testing::ElementsAre(
          "lines.csv:2: battuta 'salvete': nessuna persona del cast si chiama 'nobody'",
          "lines.csv:2: battuta 'salvete': non ha testo in 'la', che è una lingua parlata"));
  EXPECT_THAT(english, ::testing::ElementsAre(
                           "lines.csv:2: line 'salvete': no person of the cast is called 'nobody'",
                           "lines.csv:2: line 'salvete': it has no text in 'la', which is spoken"));
}

TEST_F(LineChecksTest, WhoSaysWhatIsHeardAndWhatIsBrokenOff) {
  stage::Stage stage;
  const stage::ActorId keeper = *stage.Add("keeper", test::MakeTestHuman());
  const stage::ActorId girl = *stage.Add("girl", test::MakeTestHuman());
  show::ShowContent content;
  human::VisemeTrack track;
  track.duration = 1.0f;
  for (const char* name : {"salvete", "vale"}) {
    content.speech.push_back({name, track});
    ASSERT_TRUE(stage.AddSpeech(name, track).ok());
  }
  LineListener listener(stage, content);
  for (int tick = 1; tick <= 400; ++tick) {
    stage.Advance();
    if (tick == 60) {
      stage.Say(keeper, 0);
    } else if (tick == 200) {
      stage.Say(girl, 1);
    } else if (tick == 260) {
      stage.Say(girl, 0);
    }
    listener.Listen(tick * stage::Stage::kTickSeconds);
  }
  const std::vector<SaidLine>& said = listener.said();
  ASSERT_EQ(said.size(), 3u);
  EXPECT_EQ(said[0].line, "salvete");
  EXPECT_EQ(said[0].actor, "keeper");
  EXPECT_NEAR(said[0].begin, 0.5, 1e-9);
  EXPECT_NEAR(said[0].seconds, 1.0, 1e-9);
  EXPECT_FALSE(said[0].cut);
  EXPECT_TRUE(said[1].cut);
  EXPECT_NEAR(said[1].seconds, 0.5, 0.02);
  EXPECT_FALSE(said[2].cut);
  const auto problems = EnglishOf(CheckSaid(paths_, lines_, said, {}));
  EXPECT_THAT(problems, Contains(HasSubstr("'girl' says 'vale', which has the voice of 'keeper'")));
  EXPECT_THAT(problems, Contains(HasSubstr("'girl' does not finish 'vale'")));
  EXPECT_THAT(problems, Not(Contains(HasSubstr("'keeper' says"))));
}

TEST_F(LineChecksTest, DescriptionsAreHeardInTheLanguagesOfCaptions) {
  document_.speech = {{"la"}, {"en", "la"}};
  document_.speech.description.rate = 170;
  SetTable(
      "id,speaker,la,en\n"
      "salvete,keeper,Salvēte!,Greetings!\n"
      "d_bar,description,Taberna.,A bar.\n"
      "d_cup,description,Pōculum.,\n");
  std::vector<std::string> said;
  for (const SpokenLine& line : spoken_) {
    said.push_back(line.line->id + " " + line.language + (line.describes ? " described" : ""));
    EXPECT_EQ(line.source.voice.rate, line.describes ? 170 : 150);
  }
  EXPECT_THAT(said, ::testing::ElementsAre("salvete la", "d_bar en described", "d_bar la described",
                                           "d_cup la described"));
  EXPECT_THAT(EnglishOf(CheckTable(paths_, document_, lines_, spoken_)),
              ::testing::ElementsAre(HasSubstr("line 'd_cup': it has no text in 'en'")));
  EXPECT_FALSE(MakeCaptions(document_, lines_, spoken_, "la")->lines.contains("d_bar"));
  const auto book = MakeDescriptions(spoken_, "en");
  ASSERT_TRUE(book.ok()) << book.message();
  EXPECT_EQ(book->lines.at("d_bar").at("en")[0].text, "A bar.");
  EXPECT_FALSE(book->lines.contains("salvete"));
}

TEST_F(LineChecksTest, WhatIsDescribedMustBeADescription) {
  SetTable(
      "id,speaker,la,en\n"
      "salvete,keeper,Salvēte!,Greetings!\n"
      "d_bar,description,Taberna.,A bar.\n");
  const auto problems = EnglishOf(CheckScriptLines(paths_, document_, lines_, spoken_,
                                                   "track{descriptions = {\n"
                                                   "  {at = 1, line = \"d_bar\"},\n"
                                                   "  {at = 3, line = \"salvete\"},\n"
                                                   "}}\n"
                                                   "function main()\n"
                                                   "  describe(\"d_bar\")\n"
                                                   "  describe \"nothing\"\n"
                                                   "end\n"));
  EXPECT_THAT(problems, ::testing::UnorderedElementsAre(
                            HasSubstr("drama.lua:3: the line 'salvete' is described, so its "
                                      "speaker must be 'description'"),
                            HasSubstr("drama.lua:7: there is no line 'nothing'")));
}

TEST_F(LineChecksTest, DescriptionsWithoutAPauseAndLinesOverThemAreTold) {
  stage::Stage stage;
  const stage::ActorId keeper = *stage.Add("keeper", test::MakeTestHuman());
  show::ShowContent content;
  human::VisemeTrack track;
  track.duration = 1.0f;
  for (const char* name : {"salvete", "d_bar"}) {
    content.speech.push_back({name, track});
    ASSERT_TRUE(stage.AddSpeech(name, track).ok());
  }
  DescriptionListener listener(stage, content, {{"d_bar", 1.5}});
  for (int tick = 1; tick <= 900; ++tick) {
    stage.Advance();
    if (tick == 60) {
      stage.Describe(1, 1.0);  // Audible until 2 s in its longest language.
    } else if (tick == 216) {
      stage.Say(keeper, 0);  // Lasts 1.8 s.
    } else if (tick == 600) {
      stage.Say(keeper, 0);
      stage.Describe(1, 0.5);  // Finds no pause.
    }
    listener.Listen(tick * stage::Stage::kTickSeconds);
  }
  EXPECT_THAT(listener.described(), ::testing::ElementsAre("d_bar"));
  EXPECT_THAT(EnglishOf(listener.problems()),
              ::testing::ElementsAre(HasSubstr("'keeper' says 'salvete' over the description"),
                                     HasSubstr("the description 'd_bar' finds no pause")));
}

TEST_F(LineChecksTest, CaptionsPlacedByHandCountMore) {
  std::filesystem::create_directories(paths_.Recordings("la"));
  ASSERT_TRUE(WriteFileAtomically(paths_.Recordings("la") / "salvete.en.srt",
                                  std::string_view("1\n00:00:00,250 --> 00:00:01,500\nHail!\n"))
                  .ok());
  spoken_ = SpokenLines(paths_, document_, lines_).value();
  const auto book = MakeCaptions(document_, lines_, spoken_, "la");
  ASSERT_TRUE(book.ok()) << book.message();
  const auto& cues = book->lines.at("salvete").at("en");
  ASSERT_EQ(cues.size(), 1u);
  EXPECT_EQ(cues[0].text, "Hail!");
  EXPECT_EQ(cues[0].begin, 0.25);
  EXPECT_EQ(book->names.at("keeper").at("en"), "Placidus");
  EXPECT_EQ(book->lines.at("vale").at("en")[0].text, "Farewell!");
}

}  // namespace
}  // namespace lararium::editor
