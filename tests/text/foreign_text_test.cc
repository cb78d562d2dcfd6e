#include "editor/text/foreign_text.h"

#include <gmock/gmock.h>

namespace lararium::editor {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string Read(const std::string& bytes, const std::string& declared = "") {
  const auto read = DecodeText(bytes, "a.txt", declared);
  return read.ok() ? read->text : read.message();
}

TEST(ForeignText, RecognisesEncodingsAndTellsWhich) {
  const struct {
    const char* encoding;
    const char* bytes;
    const char* text;
  } texts[] = {
      {"windows-1252", "Perch\xE9 \xE8 cos\xEC? L\xE0 c'\xE8 un caff\xE8.",
       "Perché è così? Là c'è un caffè."},
      {"windows-1252", "Citt\xE0 \x96 per\xF2\x85 \x93vino\x94", "Città – però… “vino”"},
      {"ISO-8859-7", "\xCA\xE1\xEB\xE7\xF3\xF0\xDD\xF1\xE1 \xF3\xE1\xF2, \xF6\xDF\xEB\xEF\xE9",
       "Καλησπέρα σας, φίλοι"},
      {"windows-1251",
       "\xC4\xEE\xE1\xF0\xEE \xEF\xEE\xE6\xE0\xEB\xEE\xE2\xE0\xF2\xFC, \xE4\xF0\xF3\xE7\xFC\xFF",
       "Добро пожаловать, друзья"},
  };
  for (const auto& text : texts) {
    const auto read = DecodeText(text.bytes, "a.txt");
    ASSERT_TRUE(read.ok()) << read.message();
    EXPECT_EQ(read->text, text.text);
    EXPECT_THAT(read->note, HasSubstr(std::string("read as ") + text.encoding));
    EXPECT_THAT(read->note, HasSubstr("save it as UTF-8"));
  }
}

TEST(ForeignText, UnicodeIsReadWithoutANote) {
  for (const char* text : {"", "Salvēte", "\xEF\xBB\xBFSalvēte"}) {
    EXPECT_THAT(DecodeText(text, "a.txt")->note, IsEmpty());
  }
  EXPECT_EQ(Read("\xEF\xBB\xBFone\rtwo\r\n"), "one\ntwo\n");
}

TEST(ForeignText, TheEncodingThatTheTextDeclaresCounts) {
  EXPECT_EQ(Read("\xA1\xB1", "ISO-8859-2"), "Ąą");
  EXPECT_EQ(Read("\x91", "windows-1252"), "‘");
  EXPECT_EQ(Read("ē", "ISO-8859-1"), "ē") << "valid UTF-8 is UTF-8, whatever it says";
  EXPECT_EQ(Read("caff\xE8 e citt\xE0", "no such encoding"), "caffè e città");
  EXPECT_EQ(Read("caff\xE8 e citt\xE0", "UTF-8"), "caffè e città");
}

TEST(ForeignText, AFewWrongBytesAreShownAndTold) {
  const auto read = DecodeText("Salvēte, ō hospitēs\nvalēte \xC4", "a.txt");
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->text, "Salvēte, ō hospitēs\nvalēte \xEF\xBF\xBD");
  EXPECT_THAT(read->note, HasSubstr("line 2: holds bytes that are not UTF-8"));
}

TEST(ForeignText, RefusesWhatIsNoText) {
  EXPECT_THAT(Read(std::string("RIFF\0\0\0\x10", 8)), HasSubstr("a.txt: is not a text"));
  EXPECT_THAT(Read("\xFF\x01\x02\x03"), HasSubstr("a.txt: is in an encoding that is not known"));
}

TEST(ForeignText, BlanksOfAllKindsAreTrimmed) {
  EXPECT_EQ(TrimBlanks(" \t\xC2\xA0 id\xC2\xA0\n "), "id");
  EXPECT_EQ(TrimBlanks(" \xC2\xA0"), "");
}

}  // namespace
}  // namespace lararium::editor
