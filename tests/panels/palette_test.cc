#include "editor/panels/widgets/palette.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "editor/panels/widgets/theme.h"
#include "shared/core/srgb.h"

namespace lararium::panels {
namespace {

constexpr double kText = 4.5;   // WCAG 2.1, 1.4.3, level AA
constexpr double kMarks = 3.0;  // WCAG 2.1, 1.4.11.

using Named = std::pair<std::string, ImVec4>;

// Simulates colour vision without one type of cones: matrices for linear RGB (Machado, Oliveira &
// Fernandes, IEEE TVCG 15(6), 2009, severity 1).
struct Eyes {
  const char* name;
  std::array<std::array<double, 3>, 3> seen_from_linear;
};
constexpr std::array<Eyes, 3> kEyes = {{
    {"all colours", {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
    {"no red",
     {{{0.152286, 1.052583, -0.204868},
       {0.114503, 0.786281, 0.099216},
       {-0.003882, -0.048116, 1.051998}}}},
    {"no green",
     {{{0.367322, 0.860646, -0.227968},
       {0.280085, 0.672501, 0.047413},
       {-0.011820, 0.042940, 0.968881}}}},
}};

using Triple = std::array<double, 3>;

Triple Times(const std::array<Triple, 3>& matrix, const Triple& v) {
  Triple product = {};
  for (size_t i = 0; i < 3; ++i) {
    product[i] = matrix[i][0] * v[0] + matrix[i][1] * v[1] + matrix[i][2] * v[2];
  }
  return product;
}

// CIE L*a*b* under D65.
Triple LabOf(const ImVec4& colour, const Eyes& eyes) {
  Triple rgb = Times(eyes.seen_from_linear,
                     {LinearFromSrgb<double>(colour.x), LinearFromSrgb<double>(colour.y),
                      LinearFromSrgb<double>(colour.z)});
  for (double& v : rgb) {
    v = std::clamp(v, 0.0, 1.0);
  }
  Triple xyz = Times({{{0.4124564, 0.3575761, 0.1804375},
                       {0.2126729, 0.7151522, 0.0721750},
                       {0.0193339, 0.1191920, 0.9503041}}},
                     rgb);
  constexpr Triple kWhite = {0.95047, 1.0, 1.08883};
  for (size_t i = 0; i < 3; ++i) {
    const double t = xyz[i] / kWhite[i];
    xyz[i] = t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
  }
  return {116.0 * xyz[1] - 16.0, 500.0 * (xyz[0] - xyz[1]), 200.0 * (xyz[1] - xyz[2])};
}

// CIE 1976 colour difference; about 2.3 is just noticeable side by side.
double Difference(const ImVec4& a, const ImVec4& b, const Eyes& eyes) {
  const Triple p = LabOf(a, eyes);
  const Triple q = LabOf(b, eyes);
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

void ExpectToldApart(const std::vector<Named>& colours, double least) {
  for (const Eyes& eyes : kEyes) {
    for (size_t i = 0; i < colours.size(); ++i) {
      for (size_t j = 0; j < i; ++j) {
        EXPECT_GE(Difference(colours[i].second, colours[j].second, eyes), least)
            << colours[i].first << " and " << colours[j].first << ", " << eyes.name;
      }
    }
  }
}

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
  ExpectReadable({{"good", p_.good}, {"warning", p_.warning}, {"error", p_.error}},
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

TEST_P(PaletteTest, StatesAreToldApartWithoutSeeingRedOrGreen) {
  ExpectToldApart(
      {{"good", p_.good}, {"warning", p_.warning}, {"error", p_.error}, {"dim", p_.dim}}, 15.0);
}

INSTANTIATE_TEST_SUITE_P(Themes,
                         PaletteTest,
                         testing::Values(Theme::kDark, Theme::kLight),
                         [](const auto& info) {
                           return info.param == Theme::kDark ? "Dark" : "Light";
                         });

TEST(LaneColour, TellsWhatPeopleDoApartWithoutSeeingRedOrGreen) {
  std::vector<Named> colours;
  for (const drama::LaneSpec& lane : drama::LaneSpecs()) {
    if (lane.of_actor) {
      colours.emplace_back(lane.name, LaneColour(lane.kind));
    }
  }
  ExpectToldApart(colours, 12.0);
}

TEST(SessionColour, TellsSessionsApartWithoutSeeingRedOrGreen) {
  std::vector<Named> colours;
  for (uint32_t session = 0; session < kSessionColours; ++session) {
    colours.emplace_back(std::to_string(session), SessionColour(session));
  }
  ExpectToldApart(colours, 15.0);
}

// The simulation confuses the colours that its source describes.
TEST(ColourVision, WithoutRedOrGreenSomeReadsBrownAndGreenAlike) {
  const ImVec4 red = {0.70f, 0.35f, 0.20f, 1.0f};
  const ImVec4 green = {0.45f, 0.50f, 0.18f, 1.0f};
  EXPECT_GT(Difference(red, green, kEyes[0]), 40.0);
  EXPECT_LT(Difference(red, green, kEyes[2]), 5.0);
}

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
