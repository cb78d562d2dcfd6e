#include "editor/panels/widgets/frame_cover.h"

#include <gtest/gtest.h>

namespace lararium::panels {
namespace {

constexpr ImU32 kOpaque = IM_COL32(10, 20, 30, 255);
constexpr ImU32 kOther = IM_COL32(40, 50, 60, 255);
constexpr ImU32 kTranslucent = IM_COL32(10, 20, 30, 254);
const DamageRect kRect = {20, 30, 60, 70};

class FrameCoverTest : public testing::Test {
 protected:
  void SetUp() override {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    io.Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
    io.Fonts->SetTexID(reinterpret_cast<ImTextureID>(7));
    io.DisplaySize = ImVec2(200, 100);
    ImGui::NewFrame();
    below_ = ImGui::GetBackgroundDrawList();
    above_ = ImGui::GetForegroundDrawList();
  }
  void TearDown() override { ImGui::DestroyContext(); }

  static std::optional<FrameCover> Find() {
    ImGui::Render();
    return FindCover(*ImGui::GetDrawData(), kRect, ImGui::GetIO().Fonts->TexID,
                     ImGui::GetFontTexUvWhitePixel());
  }

  ImDrawList* below_ = nullptr;
  ImDrawList* above_ = nullptr;
};

TEST_F(FrameCoverTest, IsTheLastOpaqueRectangleThatHoldsAllOfIt) {
  below_->AddRectFilled(ImVec2(0, 0), ImVec2(200, 100), kOther);
  below_->AddRectFilled(ImVec2(20, 30), ImVec2(60, 70), kOpaque);  // Exactly the rectangle.
  below_->AddText(ImVec2(22, 32), kOther, "over it");
  const std::optional<FrameCover> cover = Find();
  ASSERT_TRUE(cover.has_value());
  EXPECT_EQ(cover->colour, kOpaque);
  EXPECT_EQ(cover->list, 0);
  EXPECT_EQ(cover->elements, 12u) << "both rectangles, and no letter";
}

TEST_F(FrameCoverTest, MayLieInALaterList) {
  below_->AddRectFilled(ImVec2(0, 0), ImVec2(200, 100), kOther);
  above_->AddTriangleFilled(ImVec2(0, 0), ImVec2(9, 0), ImVec2(0, 9), kOther);
  above_->AddRectFilled(ImVec2(0, 0), ImVec2(100, 100), kOpaque);
  const std::optional<FrameCover> cover = Find();
  ASSERT_TRUE(cover.has_value());
  EXPECT_EQ(cover->list, 1);
  EXPECT_EQ(cover->colour, kOpaque);
}

TEST_F(FrameCoverTest, IsNothingThatIsSeenThroughOrRoundOrTooSmall) {
  below_->AddRectFilled(ImVec2(0, 0), ImVec2(200, 100), kTranslucent);
  below_->AddRectFilled(ImVec2(0, 0), ImVec2(200, 100), kOpaque, 4.0f);
  below_->AddRectFilled(ImVec2(21, 30), ImVec2(60, 70), kOpaque);
  below_->AddRectFilled(ImVec2(20, 30), ImVec2(60, 69), kOpaque);
  below_->AddRectFilledMultiColor(ImVec2(0, 0), ImVec2(200, 100), kOpaque, kOther, kOpaque, kOther);
  below_->AddImage(reinterpret_cast<ImTextureID>(8), ImVec2(0, 0), ImVec2(200, 100));
  EXPECT_FALSE(Find().has_value());
}

TEST_F(FrameCoverTest, IsNothingThatIsCutOff) {
  below_->PushClipRect(ImVec2(0, 0), ImVec2(59, 100));
  below_->AddRectFilled(ImVec2(0, 0), ImVec2(200, 100), kOpaque);
  below_->PopClipRect();
  EXPECT_FALSE(Find().has_value());
}

}  // namespace
}  // namespace lararium::panels
