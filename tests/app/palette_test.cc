#include "editor/panels/palette.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "editor/panels/theme.h"

namespace lararium::panels {
namespace {

constexpr double kText = 4.5;   // WCAG 2.1, 1.4.3, level AA
constexpr double kMarks = 3.0;  // 1.4.11

using Named = std::pair<std::string, ImVec4>;

class PaletteTest : public testing::TestWithParam<Theme> {
 protected:
  static void ExpectReadable(const std::vector<Named>& texts,
                             const std::vector<Named>& grounds,
                             double least) {
    for (const auto& [text, front] : texts) {
      for (const auto& [ground, back] : grounds) {
        EXPECT_GE(Contrast(front, back), least) << text << " on " << ground;
      }
    }
  }
  const Palette& p_ = PaletteOf(GetParam());
};

TEST(RampColour, GrowsLighterFromEndToEndAndStandsOutFromTheView) {
  const ImVec4 view = {0.075f, 0.082f, 0.094f, 1.0f};
  double before = 0.0;
  for (int i = 0; i <= 20; ++i) {
    const double luminance = Luminance(RampColour(i / 20.0));
    EXPECT_GT(luminance, before) << i;
    EXPECT_GE(Contrast(RampColour(i / 20.0), view), kMarks) << i;
    before = luminance;
  }
  EXPECT_EQ(Luminance(RampColour(7.0)), Luminance(RampColour(1.0)));
}

TEST(SessionColour, DiffersBetweenSessionsAndStandsOutFromTheView) {
  const ImVec4 view = {0.075f, 0.082f, 0.094f, 1.0f};
  for (uint32_t a = 0; a < kSessionColours; ++a) {
    EXPECT_GE(Contrast(SessionColour(a), view), kMarks) << a;
    for (uint32_t b = 0; b < a; ++b) {
      const ImVec4 p = SessionColour(a);
      const ImVec4 q = SessionColour(b);
      EXPECT_GT(std::abs(p.x - q.x) + std::abs(p.y - q.y) + std::abs(p.z - q.z), 0.3f) << a << b;
    }
  }
  EXPECT_EQ(SessionColour(31).x, SessionColour(31 % kSessionColours).x);
}

TEST_P(PaletteTest, TextReadsWellOnEverythingBelowIt) {
  const ImVec4 selected = Over(WithAlpha(p_.accent, kSelectedTint), p_.panel);
  const ImVec4 pressed = Over(WithAlpha(p_.accent, kPressedTint), p_.panel);
  const ImVec4 selected_field = Over(WithAlpha(p_.accent, kPressedTint), p_.frame);
  const std::vector<Named> plain = {
      {"window", p_.window}, {"panel", p_.panel}, {"frame", p_.frame}, {"hover", p_.hover}};
  ExpectReadable({{"text", p_.text}, {"dim", p_.dim}}, plain, kText);
  ExpectReadable({{"text", p_.text}},
                 {{"chosen", p_.chosen},
                  {"selected", selected},
                  {"pressed", pressed},
                  {"selected in a field", selected_field}},
                 kText);
  ExpectReadable({{"warning", p_.warning}, {"error", p_.error}},
                 {{"window", p_.window}, {"panel", p_.panel}}, kText);
}

TEST_P(PaletteTest, WordsOfScriptsReadWellAlsoWhereALineIsWrong) {
  const ImVec4 wrong = Over(WithAlpha(p_.error, kErrorTint), p_.panel);
  ExpectReadable({{"text", p_.text},
                  {"dim", p_.dim},
                  {"keyword", p_.keyword},
                  {"string", p_.string},
                  {"number", p_.number},
                  {"call", p_.call},
                  {"error", p_.error}},
                 {{"panel", p_.panel}, {"wrong line", wrong}}, kText);
}

TEST_P(PaletteTest, MarksStandOut) {
  ExpectReadable({{"accent", p_.accent}}, {{"window", p_.window}, {"panel", p_.panel}}, kMarks);
}

INSTANTIATE_TEST_SUITE_P(Themes,
                         PaletteTest,
                         testing::Values(Theme::kDark, Theme::kLight),
                         [](const auto& info) {
                           return info.param == Theme::kDark ? "Dark" : "Light";
                         });

TEST(Palette, InkReadsWellOnAnyColour) {
  for (int i = 0; i < 16 * 16 * 16; ++i) {
    const ImVec4 ground(static_cast<float>(i % 16) / 15.0f, static_cast<float>(i / 16 % 16) / 15.0f,
                        static_cast<float>(i / 256) / 15.0f, 1.0f);
    ASSERT_GE(Contrast(InkOn(ground), ground), kText) << i;
  }
}

TEST(Palette, ContrastIsThatOfTheStandard) {
  const ImVec4 black(0, 0, 0, 1);
  const ImVec4 white(1, 1, 1, 1);
  EXPECT_NEAR(Contrast(black, white), 21.0, 1e-9);
  EXPECT_NEAR(Contrast(white, white), 1.0, 1e-9);
  // #777777 on white: the grey that just fails level AA.
  const float grey = 119.0f / 255.0f;
  EXPECT_NEAR(Contrast(ImVec4(grey, grey, grey, 1), white), 4.48, 0.005);
}

TEST(Theme, NoTextIsSmallerThan14PixelsAtScale1) {
  EXPECT_GE(std::min({kTextPx, kCodePx, kTitlePx}), 14.0f);
}

}  // namespace
}  // namespace lararium::panels
