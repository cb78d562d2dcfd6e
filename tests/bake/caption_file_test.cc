#include "editor/bake/caption_file.h"

#include <gmock/gmock.h>

namespace lararium::bake {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

CaptionFile Read(const std::string& text) {
  const auto file = ParseCaptionFile(text, "a.srt");
  EXPECT_TRUE(file.ok()) << file.message() << "\n" << text;
  return file.ok() ? *file : CaptionFile();
}

std::vector<std::string> TextsOf(const std::string& text) {
  std::vector<std::string> texts;
  for (const FileCue& cue : Read(text).cues) {
    texts.push_back(cue.text);
  }
  return texts;
}

TEST(CaptionFile, ReadsWhatOtherProgramsWrite) {
  const CaptionFile srt = Read(
      "\xEF\xBB\xBF"
      "1\r\n00:00:01,000 --> 00:00:02,500\r\n<i>Salvēte,</i>\r\nhospitēs!\r\n\r\n"
      "2\r\n01:00:00,000 --> 01:00:01,000 X1:0\r\n{\\an8}Valē\r\n");
  EXPECT_THAT(srt.notes, IsEmpty());
  EXPECT_THAT(srt.cues, ElementsAre(FileCue{"1", 1.0, 2.5, "Salvēte,\nhospitēs!"},
                                    FileCue{"2", 3600.0, 3601.0, "Valē"}));
  const CaptionFile web = Read(
      "WEBVTT - a title\n\nNOTE nothing\nof interest\n\nSTYLE\n::cue {}\n\n"
      "salvete\n00:01.250 --> 00:02.000 align:start\n<v Placidus>A &lt; B &amp; C</v>\n\n"
      "00:00:03.000 --> 00:00:04.000\nlast\n");
  EXPECT_THAT(web.notes, IsEmpty());
  EXPECT_THAT(web.cues, ElementsAre(FileCue{"salvete", 1.25, 2.0, "A < B & C"},
                                    FileCue{"", 3.0, 4.0, "last"}));
}

TEST(CaptionFile, IsReadAsItWasWritten) {
  const std::vector<FileCue> cues = {{"1", 0.0, 1.999, "One <two> & three"},
                                     {"2", 3661.007, 3662.5, "Rows\nof text"}};
  EXPECT_EQ(Read(FormatVtt(cues)).cues, cues);
  std::vector<FileCue> plain = cues;
  plain[0].text = "One two";
  EXPECT_EQ(Read(FormatSrt(plain)).cues, plain);
}

TEST(CaptionFile, ReadsTimesAsPeopleWriteThem) {
  const struct {
    const char* row;
    double begin;
    double end;
  } rows[] = {
      {"00:00:01,000 --> 00:00:02,500", 1.0, 2.5},
      {"00:00:01 --> 00:00:02", 1.0, 2.0},
      {"00:00:01,25 --> 00:00:02,5", 1.25, 2.5},
      {"0:0:1,5 --> 0:0:2,5", 1.5, 2.5},
      {"1:02.5 --> 1:03.5", 62.5, 63.5},
      {"00:00:01.000-->00:00:02.500", 1.0, 2.5},
      {"00:00:01,000 -> 00:00:02,500", 1.0, 2.5},
      {"00: 00: 01, 000 -> 00: 00: 02, 500", 1.0, 2.5},
      {"00:00:01,000 - -> 00:00:02,500", 1.0, 2.5},
      {"00:00:01,000 –> 00:00:02,500", 1.0, 2.5},
      {"00:00:01.1234567 --> 00:00:02,5", 1.123, 2.5},
      {"100:00:01,0 --> 100:00:02,0", 360001.0, 0.0},
      {"00:00:01,000\t-->\t00:00:02,500  X1:1 Y1:2", 1.0, 2.5},
  };
  for (const auto& row : rows) {
    const auto file = ParseCaptionFile(std::string("1\n") + row.row + "\ntext\n", "a.srt");
    if (row.end == 0.0) {
      EXPECT_THAT(file.message(), HasSubstr("is not a time"));
    } else {
      ASSERT_TRUE(file.ok()) << row.row << ": " << file.message();
      EXPECT_THAT(file->cues, ElementsAre(FileCue{"1", row.begin, row.end, "text"})) << row.row;
    }
  }
}

constexpr char kA[] = "00:00:01,000 --> 00:00:02,000\n";
constexpr char kB[] = "00:00:03,000 --> 00:00:04,000\n";

TEST(CaptionFile, BlankRowsAndNumbersMayStandAnywhere) {
  const std::string a = kA;
  const std::string b = kB;
  for (const std::string& text :
       {"1\n" + a + "one\ntwo\n\n2\n" + b + "three\n",  // A well-formed file.
        "\n\n1\n" + a + "one\n\ntwo\n\n2\n" + b +
            "three",  // Blank rows stand before and within a caption.
        "1\n\n" + a + "\none\n\n\ntwo\n\n\n2\n\n" + b + "\nthree\n\n\n",
        a + "one\ntwo\n\n" + b + "three\n",           // The numbers are missing.
        "1\n" + a + "one\ntwo\n2\n" + b + "three\n",  // Blank rows are missing.
        a + "one\ntwo\n" + b + "three\n",             // Numbers and blank rows are missing.
        "1 \n" + a + "one\ntwo\n\n2\t\n" + b + "three\n",
        "1\r" + std::string("00:00:01,000 --> 00:00:02,000\rone\rtwo\r\r2\r") +
            "00:00:03,000 --> 00:00:04,000\rthree\r"}) {
    const CaptionFile file = Read(text);
    EXPECT_THAT(file.notes, IsEmpty()) << text;
    ASSERT_EQ(file.cues.size(), 2u) << text;
    EXPECT_EQ(file.cues[0].text, "one\ntwo") << text;
    EXPECT_EQ(file.cues[1].text, "three") << text;
  }
  EXPECT_THAT(TextsOf("1\n" + a + "2\n\n2\n" + b + "10:30 is late\n"),
              ElementsAre("2", "10:30 is late"))
      << "numbers are texts too";
}

TEST(CaptionFile, ABadCaptionCostsThatCaptionAndIsTold) {
  const std::string good = std::string("9\n") + kB + "good\n\n";
  const struct {
    const char* text;
    const char* note;
  } mistakes[] = {
      {"1\n00:00:05,000 --> 00:00:04,000\ny\n\n", "line 2: the caption ends before it begins"},
      {"1\n00:00:05,000 --> 00:00:05,000\ny\n\n", "line 2: the caption ends before it begins"},
      {"1\n00:00:01,000 --> 00:00:02,000\n\n", "line 2: the caption has no text"},
      {"1\n-00:00:01,000 --> 00:00:02,000\ny\n\n", "line 2: \"-00:00:01,000 --> 00:00:02,000\""},
      {"1\n00:00:01,000 00:00:02,000\ny\n\n",
       "line 2: \"00:00:01,000 00:00:02,000\" is not a time"},
      {"hello\n\n", "line 1: \"hello\" has no time"},
  };
  for (const auto& mistake : mistakes) {
    const CaptionFile file = Read(mistake.text + good);
    ASSERT_EQ(file.cues.size(), 1u) << mistake.text;
    EXPECT_EQ(file.cues[0].text, "good");
    EXPECT_THAT(file.notes, ElementsAre(HasSubstr(mistake.note)));
    EXPECT_THAT(file.notes[0], HasSubstr("left out"));
    EXPECT_FALSE(ParseCaptionFile(mistake.text, "a.srt").ok()) << "nothing can be read";
  }
  const CaptionFile trailed = Read(good + "9999\n");
  EXPECT_EQ(trailed.cues.size(), 1u);
  EXPECT_THAT(trailed.notes, ElementsAre(HasSubstr("line 5: the caption \"9999\" has no time")));
}

TEST(CaptionFile, CaptionsOfWebVttNeedNoBlankRowAndAreNoNotes) {
  const std::string cue = "00:01.000 --> 00:02.000\none\n";
  for (const std::string head :
       {"WEBVTT\n", "WEBVTT\n\n", "WEBVTT\nKind: captions\nLanguage: it\n\n",
        "WEBVTT\nX-TIMESTAMP-MAP=LOCAL:00:00:00.000,MPEGTS:0\n\n", "WEBVTT\n\nNOTEBOOK-1\n",
        "WEBVTT\n\nSTYLED\n", "WEBVTT\n\nREGION 5\nid:a\n\n", "WEBVTT\nfirst\n"}) {
    const CaptionFile file = Read(head + cue);
    ASSERT_EQ(file.cues.size(), 1u) << head;
    EXPECT_EQ(file.cues[0].text, "one");
    EXPECT_THAT(file.notes, IsEmpty());
  }
  EXPECT_EQ(Read("WEBVTT\n\nNOTEBOOK-1\n" + cue).cues[0].id, "NOTEBOOK-1");
  EXPECT_THAT(TextsOf("WEBVTT\n\n" + cue + "\nNOTE a remark\nof two rows\n\n" + cue),
              ElementsAre("one", "one"));
  EXPECT_THAT(ParseCaptionFile("webvtt\n\n" + cue, "a.vtt").message(),
              HasSubstr("a.vtt: line 1: a WebVTT file begins with WEBVTT in capital letters"));
}

TEST(CaptionFile, TagsGoAndEntitiesAreLetters) {
  EXPECT_THAT(
      TextsOf(std::string("1\n") + kA +
              "<font color=\"#f00\"><b>Hic</b></font> &#39;x&#x2019; &quot;a&quot; <3 &amp;lt;\n"),
      ElementsAre("Hic 'x’ \"a\" <3 &lt;"));
  const CaptionFile named =
      Read(std::string("1\n") + kA +
           "&Egrave; cos&igrave;&hellip; &laquo;perch&eacute;&raquo; &nbsp;&yuml; A&B; &e; R&D\n");
  EXPECT_EQ(named.cues[0].text, "È così… «perché» \u00A0ÿ A&B; &e; R&D");
  EXPECT_THAT(named.notes,
              ElementsAre("line 3: \"&B;\" is not the name of a character; it is shown as it is"));
}

TEST(CaptionFile, OtherEncodingsAreRecognisedAndTold) {
  const CaptionFile file =
      Read(std::string("1\n") + kA + "Perch\xE9 \xE8 cos\xEC? L\xE0 c'\xE8.\n");
  EXPECT_EQ(file.cues[0].text, "Perché è così? Là c'è.");
  EXPECT_THAT(file.notes, ElementsAre(HasSubstr("windows-1252")));
}

TEST(ShownCues, AreInOrderWithoutOverlapAndOfTwoRows) {
  const auto cues = ShownCues({{"", 3.0, 5.0, "b"},
                               {"", 1.0, 3.5, "a\nlong caption\nof\nmany rows"},
                               {"", 3.0, 6.0, "with b"}});
  EXPECT_TRUE(stage::CheckCues(cues, "cues").ok());
  EXPECT_THAT(cues, ElementsAre(stage::CaptionCue{1.0, 3.0, "a long caption\nof many rows"},
                                stage::CaptionCue{3.0, 6.0, "b\nwith b"}));
}

TEST(ShownCues, ThoseOfOneTimeShareTheRows) {
  const auto cues = ShownCues({{"", 0.0, 6.0, "a\nsign"},
                               {"", 1.0, 2.0, "b"},
                               {"", 3.0, 8.0, "c\nc"},
                               {"", 5.0, 5.5, "d"},
                               {"", 9.0, 9.2, "e"}});
  EXPECT_TRUE(stage::CheckCues(cues, "cues").ok());
  EXPECT_THAT(
      cues,
      ElementsAre(
          stage::CaptionCue{0.0, 1.0, "a\nsign"}, stage::CaptionCue{1.0, 2.0, "a sign\nb"},
          stage::CaptionCue{2.0, 3.0, "a\nsign"}, stage::CaptionCue{3.0, 5.0, "a sign\nc c"},
          stage::CaptionCue{5.0, 5.5, "a sign\nc c d"}, stage::CaptionCue{5.5, 6.0, "a sign\nc c"},
          stage::CaptionCue{6.0, 8.0, "c\nc"}, stage::CaptionCue{9.0, 9.2, "e"}));
}

}  // namespace
}  // namespace lararium::bake
