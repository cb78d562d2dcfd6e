#include "shared/core/utf8.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace lararium {
namespace {

TEST(Utf8, CharactersOfBadTextAreReplacedAndEnd) {
  const auto characters = [](std::string_view text) {
    std::vector<uint32_t> found;
    for (size_t at = 0; at < text.size();) {
      found.push_back(NextCharacter(text, at));
    }
    return found;
  };
  EXPECT_THAT(characters("aē→\xF0\x9F\x8D\xB7"),
              ::testing::ElementsAre('a', 0x113, 0x2192, 0x1F377));
  EXPECT_THAT(characters("\x80"
                         "a"),
              ::testing::ElementsAre(0xFFFD, 'a'));
  EXPECT_THAT(characters("\xE2\x86"), ::testing::ElementsAre(0xFFFD));
}

TEST(Utf8, OnlyWellFormedTextIsValid) {
  for (const char* good : {"", "Casa del Fauno", "Größe", "Οἶκος", "\xEF\xBF\xBD"}) {
    EXPECT_TRUE(IsUtf8(good)) << good;
  }
  // Latin 1, a cut character, an overlong "/", a surrogate, and a character beyond Unicode.
  for (const char* bad : {"Gr\xF6\xDF"
                          "e",
                          "\xC3", "\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80", "\xF4\x90\x80\x80"}) {
    EXPECT_FALSE(IsUtf8(bad)) << bad;
  }
}

}  // namespace
}  // namespace lararium
