#include "editor/panels/widgets/wrapped_text.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>
#include <vector>

namespace lararium::panels {
namespace {

constexpr std::string_view kBreak = "\xee\x80\x80\n\xee\x80\x81";

// A width of one pixel for each character.
float Letters(std::string_view text) {
  float letters = 0.0f;
  for (const char byte : text) {
    letters += (static_cast<unsigned char>(byte) & 0xc0) != 0x80 ? 1.0f : 0.0f;
  }
  return letters;
}

std::string Wrapped(std::string_view text, float width) { return WrapText(text, width, Letters); }

std::vector<std::string> Rows(const std::string& wrapped) {
  std::vector<std::string> rows;
  size_t begin = 0;
  for (size_t end = wrapped.find(kBreak); end != std::string::npos;
       end = wrapped.find(kBreak, begin)) {
    rows.push_back(wrapped.substr(begin, end - begin));
    begin = end + kBreak.size();
  }
  rows.push_back(wrapped.substr(begin));
  return rows;
}

// The text without `count` bytes at `at`.
std::string Without(std::string text, size_t at, size_t count) { return text.erase(at, count); }

TEST(WrappedText, BreaksAfterSpacesWhereRowsWouldBeTooWide) {
  EXPECT_EQ(Rows(Wrapped("salve domine  quid bibis", 12)),
            (std::vector<std::string>{"salve domine  ", "quid bibis"}));
  EXPECT_EQ(Rows(Wrapped("salve", 12)), std::vector<std::string>{"salve"});
  EXPECT_EQ(Rows(Wrapped("", 12)), std::vector<std::string>{""});
}

TEST(WrappedText, BreaksWordsThatAreWiderThanARowBetweenLetters) {
  EXPECT_EQ(Rows(Wrapped("\xce\xb1\xce\xb2\xce\xb3\xce\xb4\xce\xb5", 2)),
            (std::vector<std::string>{"\xce\xb1\xce\xb2", "\xce\xb3\xce\xb4", "\xce\xb5"}));
  // Each row has at least one character, even if none fits.
  EXPECT_EQ(Rows(Wrapped("abc", 0)), (std::vector<std::string>{"a", "b", "c"}));
}

TEST(WrappedText, KeepsLineBreaksThatWereTyped) {
  EXPECT_EQ(Wrapped("a\n\nb\n", 5), "a\n\nb\n");
  EXPECT_EQ(UnwrapText(Wrapped("one two\nthree four\n", 5)), "one two\nthree four\n");
}

TEST(WrappedText, UnwrapsToTheSameTextAtAnyWidth) {
  std::mt19937 random(7);
  const std::array<std::string, 6> pieces = {"a", "\xc5\xab", " ", "  ", "\n", "verbum"};
  for (int i = 0; i < 300; ++i) {
    std::string text;
    for (int k = 0; k < 20; ++k) {
      text += pieces[random() % pieces.size()];
    }
    const float width = static_cast<float>(random() % 12);
    EXPECT_EQ(UnwrapText(Wrapped(text, width)), text) << "width " << width;
  }
}

TEST(WrappedText, DeletingBackwardsAtTheBeginningOfARowDeletesTheLetterBefore) {
  const std::string wrapped = Wrapped(
      "ab \xc3\xa9"
      "cd",
      3);
  const size_t at = wrapped.find(kBreak);
  // The rest of a row break after its last character was deleted.
  EXPECT_EQ(UnwrapText(Without(wrapped, at + 4, 3)),
            "ab\xc3\xa9"
            "cd");
}

TEST(WrappedText, DeletingForwardsAtTheEndOfARowDeletesTheLetterBehind) {
  const std::string wrapped = Wrapped(
      "ab \xc3\xa9"
      "cd",
      3);
  const size_t at = wrapped.find(kBreak);
  EXPECT_EQ(UnwrapText(Without(wrapped, at, 3)), "ab cd");
}

TEST(WrappedText, ALineBreakTypedAtTheEndOfARowStays) {
  std::string wrapped = Wrapped("ab cd", 3);
  wrapped.insert(wrapped.find(kBreak), "\n");
  EXPECT_EQ(UnwrapText(wrapped), "ab \ncd");
}

TEST(WrappedText, PositionsMoveWithTheText) {
  const std::string text = "unus duo tres quattuor";
  const std::string wrapped = Wrapped(text, 6);
  ASSERT_EQ(Rows(wrapped).size(), 5u);
  for (size_t at = 0; at <= text.size(); ++at) {
    std::array<size_t, 1> position = {PositionInWrapped(wrapped, at)};
    if (at < text.size()) {
      EXPECT_EQ(wrapped[position[0]], text[at]);
    } else {
      EXPECT_EQ(position[0], wrapped.size());
    }
    EXPECT_EQ(UnwrapText(wrapped, position), text);
    EXPECT_EQ(position[0], at);
  }
}

TEST(WrappedText, NoPositionStaysWithinARowBreak) {
  const std::string wrapped = Wrapped("ab cd", 3);
  const size_t at = wrapped.find(kBreak);
  const size_t behind = at + kBreak.size();
  for (const size_t inside : {at + 3, at + 4}) {
    EXPECT_EQ(OutOfRowBreak(wrapped, inside, true), behind);
    EXPECT_EQ(OutOfRowBreak(wrapped, inside, false), at);
  }
  for (const size_t outside : {size_t{0}, at, behind, wrapped.size()}) {
    EXPECT_EQ(OutOfRowBreak(wrapped, outside, true), outside);
    EXPECT_EQ(OutOfRowBreak(wrapped, outside, false), outside);
  }
}

}  // namespace
}  // namespace lararium::panels
