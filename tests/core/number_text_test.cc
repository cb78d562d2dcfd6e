#include "shared/core/number_text.h"

#include <gtest/gtest.h>

namespace lararium {
namespace {

TEST(NumberText, TakesTheNumberThatATextBeginsWith) {
  std::string_view text = "-1.5e2 m";
  double value = 0.0;
  EXPECT_TRUE(TakeNumber(text, value));
  EXPECT_EQ(value, -150.0);
  EXPECT_EQ(text, " m");
  EXPECT_FALSE(TakeNumber(text, value));
  EXPECT_EQ(text, " m");
}

TEST(NumberText, TakesNoPlusSignAndNothingTooLarge) {
  for (std::string_view text : {"+1", "e5", ".", "-", "", "1e999", "--1"}) {
    const std::string_view before = text;
    double value = 7.0;
    EXPECT_FALSE(TakeNumber(text, value)) << before;
    EXPECT_EQ(text, before);
    EXPECT_EQ(value, 7.0) << before;
  }
}

TEST(NumberText, TakesHexadecimalDigitsWithoutTheirPrefix) {
  std::string_view text = "a.8p1)";
  double value = 0.0;
  EXPECT_TRUE(TakeHexNumber(text, value));
  EXPECT_EQ(value, 21.0);
  EXPECT_EQ(text, ")");
}

TEST(NumberText, WritesTheShortestTextOfANumber) {
  EXPECT_EQ(FormatNumber(0.1f), "0.1");
  EXPECT_EQ(FormatNumber(0.1), "0.1");
  EXPECT_EQ(FormatNumber(-2.0), "-2");
  EXPECT_EQ(FormatNumber(1e5), "1e+05");
  EXPECT_EQ(FormatNumber(120000.0), "120000");
}

}  // namespace
}  // namespace lararium
