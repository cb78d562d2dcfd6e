#include "editor/bake/caption_file.h"

#include <gmock/gmock.h>

namespace lararium::bake {
namespace {

using ::testing::HasSubstr;

TEST(CaptionFile, ReadsWhatOtherProgramsWrite) {
  constexpr char kSrt[] =
      "\xEF\xBB\xBF"
      "1\r\n00:00:01,000 --> 00:00:02,500\r\n<i>Salvēte,</i>\r\nhospitēs!\r\n\r\n"
      "2\r\n01:00:00,000 --> 01:00:01,000 X1:0\r\n{\\an8}Valē\r\n";
  const auto cues = ParseCaptionFile(kSrt, "a.srt");
  ASSERT_TRUE(cues.ok()) << cues.message();
  ASSERT_EQ(cues->size(), 2u);
  EXPECT_EQ((*cues)[0], (FileCue{"1", 1.0, 2.5, "Salvēte,\nhospitēs!"}));
  EXPECT_EQ((*cues)[1], (FileCue{"2", 3600.0, 3601.0, "Valē"}));

  constexpr char kVtt[] =
      "WEBVTT - a title\n\nNOTE nothing\nof interest\n\nSTYLE\n::cue {}\n\n"
      "salvete\n00:01.250 --> 00:02.000 align:start\n<v Placidus>A &lt; B &amp; C</v>\n\n"
      "00:00:03.000 --> 00:00:04.000\nlast\n";
  const auto web = ParseCaptionFile(kVtt, "a.vtt");
  ASSERT_TRUE(web.ok()) << web.message();
  ASSERT_EQ(web->size(), 2u);
  EXPECT_EQ((*web)[0], (FileCue{"salvete", 1.25, 2.0, "A < B & C"}));
  EXPECT_EQ((*web)[1].id, "");
}

TEST(CaptionFile, IsReadAsItWasWritten) {
  const std::vector<FileCue> cues = {{"1", 0.0, 1.999, "One <two> & three"},
                                     {"2", 3661.007, 3662.5, "Rows\nof text"}};
  EXPECT_EQ(*ParseVtt(FormatVtt(cues), "a.vtt"), cues);
  std::vector<FileCue> plain = cues;
  plain[0].text = "One two";
  EXPECT_EQ(*ParseSrt(FormatSrt(plain), "a.srt"), plain);
}

TEST(CaptionFile, SaysWhichLineIsWrong) {
  const struct {
    const char* text;
    const char* problem;
  } mistakes[] = {
      {"1\n00:00:01,000 -> 00:00:02,500\nx\n", "a.srt: line 1: a time such as"},
      {"1\n00:00:01,000 --> 00:00:02,500\nx\n\n2\n00:00:05,000 --> 00:00:04,000\ny\n",
       "line 5: the caption ends before"},
      {"1\n00:00:01,00 --> 00:00:02,500\nx\n", "a time such as"},
      {"1\n99999999:00:01,000 --> 00:00:02,500\nx\n", "a time such as"},
      {"hello\n", "a time such as"},
  };
  for (const auto& mistake : mistakes) {
    const auto cues = ParseCaptionFile(mistake.text, "a.srt");
    ASSERT_FALSE(cues.ok()) << mistake.text;
    EXPECT_THAT(cues.message(), HasSubstr(mistake.problem));
  }
  EXPECT_THAT(ParseVtt("hello", "a.vtt").message(), HasSubstr("WEBVTT"));
}

}  // namespace
}  // namespace lararium::bake
