#include "editor/panels/widgets/icons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "editor/panels/widgets/wrapped_text.h"

namespace lararium::panels {
namespace {

constexpr int kSide = 16;  // Pixels at scale 1.

std::vector<Icon> AllIcons() {
  std::vector<Icon> icons;
  for (int i = 0; i < kIcons; ++i) {
    icons.push_back(static_cast<Icon>(i));
  }
  return icons;
}

// The share of the square that is covered.
double Share(const std::vector<uint8_t>& pixels) {
  double sum = 0.0;
  for (const uint8_t covered : pixels) {
    sum += covered / 255.0;
  }
  return sum / static_cast<double>(pixels.size());
}

TEST(DrawIcon, EveryIconIsMoreThanADotAndLessThanABlot) {
  for (const Icon icon : AllIcons()) {
    const std::vector<uint8_t> pixels = DrawIcon(icon, kSide);
    ASSERT_EQ(pixels.size(), static_cast<size_t>(kSide * kSide));
    EXPECT_GT(Share(pixels), 0.08) << static_cast<int>(icon);
    EXPECT_LT(Share(pixels), 0.5) << static_cast<int>(icon);
    EXPECT_GT(*std::max_element(pixels.begin(), pixels.end()), 180) << static_cast<int>(icon);
  }
}

TEST(DrawIcon, NothingIsCutOffAtTheSidesOfTheBox) {
  // The blurred edge of a stroke is small compared with the grid's border here.
  constexpr int kLarge = 64;
  for (const Icon icon : AllIcons()) {
    const std::vector<uint8_t> pixels = DrawIcon(icon, kLarge);
    for (int i = 0; i < kLarge; ++i) {
      for (const int edge : {i, (kLarge - 1) * kLarge + i, i * kLarge, i * kLarge + kLarge - 1}) {
        EXPECT_EQ(pixels[static_cast<size_t>(edge)], 0) << static_cast<int>(icon) << " at " << i;
      }
    }
  }
}

TEST(DrawIcon, NoTwoIconsLookAlike) {
  for (const Icon a : AllIcons()) {
    const std::vector<uint8_t> pixels = DrawIcon(a, kSide);
    for (int b = 0; b < static_cast<int>(a); ++b) {
      const std::vector<uint8_t> others = DrawIcon(static_cast<Icon>(b), kSide);
      int different = 0;
      for (size_t i = 0; i < pixels.size(); ++i) {
        different += std::abs(pixels[i] - others[i]) > 96 ? 1 : 0;
      }
      EXPECT_GE(different, 18) << static_cast<int>(a) << " and " << b;
    }
  }
}

TEST(DrawIcon, GrowsWithTheScaleAndKeepsItsShape) {
  for (const Icon icon : AllIcons()) {
    EXPECT_NEAR(Share(DrawIcon(icon, kSide)), Share(DrawIcon(icon, 2 * kSide)), 0.03)
        << static_cast<int>(icon);
  }
}

TEST(IconText, IsALetterOfItsOwnInUtf8) {
  std::set<std::string> texts;
  for (const Icon icon : AllIcons()) {
    EXPECT_TRUE(texts.insert(IconText(icon)).second);
    EXPECT_NE(LetterOf(icon), kRowEnd);
    EXPECT_NE(LetterOf(icon), kRowBegin);
  }
  EXPECT_EQ(IconText(Icon::kTrain), "\xee\x84\x80");
  EXPECT_EQ(WithIcon(Icon::kAddSession, "Add"), "\xee\x84\x81  Add");
}

TEST(IconOf, EveryKindOfItemThatNamesAnIconHasItsOwn) {
  std::set<Icon> icons;
  for (const drama::LaneSpec& lane : drama::LaneSpecs()) {
    if (!lane.icon.empty()) {
      EXPECT_NE(IconOf(lane.kind), Icon::kStage) << lane.icon << " is not an icon";
      EXPECT_TRUE(icons.insert(IconOf(lane.kind)).second) << lane.icon;
    }
  }
}

}  // namespace
}  // namespace lararium::panels
