#include "shared/core/plain_text.h"

#include <gtest/gtest.h>

#include "shared/core/json.h"
#include "shared/core/utf8.h"

namespace lararium {
namespace {

// UTF-16 as other programs write it.
std::string Utf16(std::u16string_view text, bool big, bool mark) {
  std::string bytes = !mark ? "" : big ? "\xFE\xFF" : "\xFF\xFE";
  for (const char16_t unit : text) {
    const auto high = static_cast<char>(unit >> 8);
    const auto low = static_cast<char>(unit & 0xFF);
    bytes += big ? high : low;
    bytes += big ? low : high;
  }
  return bytes;
}

TEST(PlainText, ReadsUtf16OfBothByteOrdersWithAndWithoutMark) {
  for (const bool big : {false, true}) {
    for (const bool mark : {false, true}) {
      EXPECT_EQ(PlainText(Utf16(u"Salvēte \U0001F377\r\n→", big, mark)), "Salvēte \U0001F377\n→");
    }
  }
}

TEST(PlainText, LeavesWhatIsNotUtf16AsItIs) {
  for (const std::string& bytes : {std::string("a\0\0\xD8", 4), std::string("a\0b\0\0\0", 6),
                                   std::string("\0", 1), std::string(), std::string("caff\xE8")}) {
    EXPECT_EQ(PlainText(bytes), bytes);
  }
}

TEST(PlainText, RemovesTheMarkAndUnifiesLineEnds) {
  EXPECT_EQ(PlainText("\xEF\xBB\xBF"
                      "one\r\ntwo\rthree\nfour\r"),
            "one\ntwo\nthree\nfour\n");
  EXPECT_EQ(WithUnixLineEnds("\r\r\n\n"), "\n\n\n");
}

TEST(PlainText, EveryCharacterIsWrittenAsItIsRead) {
  for (const uint32_t character :
       {0x41u, 0x7Fu, 0x80u, 0x7FFu, 0x800u, 0xFFFFu, 0x10000u, 0x10FFFFu}) {
    std::string text;
    AppendCharacter(character, text);
    size_t at = 0;
    EXPECT_EQ(NextCharacter(text, at), character);
    EXPECT_EQ(at, text.size());
  }
}

TEST(PlainText, JsonIsReadWithAnyMark) {
  for (const std::string& text :
       {std::string("\xEF\xBB\xBF{\"a\": \"ē\"}"), Utf16(u"{\"a\": \"ē\"}", false, true),
        Utf16(u"{\"a\": \"ē\"}", true, false)}) {
    const auto json = ParseJson(text, "a.json");
    ASSERT_TRUE(json.ok()) << json.message();
    EXPECT_EQ((*json)["a"], "ē");
  }
}

}  // namespace
}  // namespace lararium
