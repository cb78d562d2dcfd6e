#include "editor/panels/widgets/icons.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <set>
#include <string>
#include <vector>

#include "editor/panels/widgets/theme.h"

namespace lararium::panels {
namespace {

std::vector<Icon> AllIcons() {
  std::vector<Icon> icons;
  for (int i = 0; i < kIcons; ++i) {
    icons.push_back(static_cast<Icon>(i));
  }
  return icons;
}

TEST(LetterOf, EveryIconIsInTheFontOfTheInterface) {
  ImGui::CreateContext();
  ApplyTheme(editor::Theme::kDark, 1.0f);
  ImGui::GetIO().Fonts->Build();
  for (const Icon icon : AllIcons()) {
    const ImFontGlyph* glyph =
        ThemeFonts().regular->FindGlyphNoFallback(static_cast<ImWchar>(LetterOf(icon)));
    ASSERT_NE(glyph, nullptr) << static_cast<int>(icon);
    EXPECT_GE(glyph->AdvanceX, kIconPx) << static_cast<int>(icon);
    EXPECT_GT(glyph->X1, glyph->X0) << static_cast<int>(icon);
  }
  ImGui::DestroyContext();
}

TEST(IconText, IsALetterOfItsOwnInUtf8) {
  std::set<std::string> texts;
  for (const Icon icon : AllIcons()) {
    EXPECT_TRUE(texts.insert(IconText(icon)).second);
  }
  EXPECT_EQ(IconText(Icon::kTrain), "\xef\x95\xa7");
  EXPECT_EQ(WithIcon(Icon::kAddSession, "Add"), "\xef\x95\xa9  Add");
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
