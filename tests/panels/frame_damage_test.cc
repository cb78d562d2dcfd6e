#include "editor/panels/widgets/frame_damage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

namespace lararium::panels {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Frames of rectangles that ImGui's draw lists draw.
class Frames {
 public:
  struct Box {
    float x = 0, y = 0, width = 10, height = 10;
    ImU32 colour = IM_COL32_WHITE;
    ImTextureID texture = nullptr;
  };
  struct Layer {
    const char* name = "";
    std::vector<Box> boxes;
  };

  std::vector<DamageRect> Next(const std::vector<Layer>& layers) {
    lists_.clear();
    pointers_.clear();
    for (const Layer& layer : layers) {
      auto& list = lists_.emplace_back(std::make_unique<ImDrawList>(&shared_));
      list->_OwnerName = layer.name;
      list->_ResetForNewFrame();
      list->PushClipRect(ImVec2(0, 0), ImVec2(200, 100));
      for (const Box& box : layer.boxes) {
        list->PushTextureID(box.texture);
        list->PrimReserve(6, 4);
        list->PrimRect(ImVec2(box.x, box.y), ImVec2(box.x + box.width, box.y + box.height),
                       box.colour);
        list->PopTextureID();
      }
      pointers_.push_back(list.get());
    }
    ImDrawData data;
    data.DisplaySize = ImVec2(200, 100);
    data.FramebufferScale = ImVec2(1, 1);
    SetLists(pointers_, data.CmdLists);
    data.CmdListsCount = static_cast<int>(pointers_.size());
    const auto rects = damage.Next(data);
    return {rects.begin(), rects.end()};
  }

  FrameDamage damage;

 private:
  // Dear ImGui has a pointer here before version 1.90, a vector since.
  static void SetLists(std::vector<ImDrawList*>& from, ImDrawList**& lists) { lists = from.data(); }
  static void SetLists(std::vector<ImDrawList*>& from, ImVector<ImDrawList*>& lists) {
    lists.resize(static_cast<int>(from.size()));
    std::copy(from.begin(), from.end(), lists.begin());
  }

  ImDrawListSharedData shared_;
  std::vector<std::unique_ptr<ImDrawList>> lists_;
  std::vector<ImDrawList*> pointers_;
};

const DamageRect kAll{0, 0, 200, 100};

TEST(FrameDamage, IsAllOfTheFirstFrameAndNothingOfTheSameAgain) {
  Frames frames;
  EXPECT_THAT(frames.Next({{"a", {{10, 10}}}}), ElementsAre(kAll));
  EXPECT_THAT(frames.Next({{"a", {{10, 10}}}}), IsEmpty());
  frames.damage.Forget();
  EXPECT_THAT(frames.Next({{"a", {{10, 10}}}}), ElementsAre(kAll));
}

TEST(FrameDamage, IsWhereABoxWasAndWhereItIs) {
  Frames frames;
  frames.Next({{"a", {{10, 10}, {50, 50}}}});
  EXPECT_THAT(
      frames.Next({{"a", {{10, 10}, {150, 50}}}}),
      testing::UnorderedElementsAre(DamageRect{50, 50, 60, 60}, DamageRect{150, 50, 160, 60}));
}

TEST(FrameDamage, IsOneBoxThatCameAmongOthers) {
  Frames frames;
  frames.Next({{"a", {{10, 10}, {50, 50}, {90, 10}}}});
  EXPECT_THAT(frames.Next({{"a", {{10, 10}, {120.5f, 20}, {50, 50}, {90, 10}}}}),
              ElementsAre(DamageRect{120, 20, 131, 30}));
  EXPECT_THAT(frames.Next({{"a", {{10, 10}, {50, 50}, {90, 10}}}}),
              ElementsAre(DamageRect{120, 20, 131, 30}));
}

TEST(FrameDamage, SeesAnotherColourAndAnotherPictureInTheSameTexture) {
  Frames frames;
  frames.Next({{"a", {{10, 10, 10, 10, IM_COL32_WHITE, TextureOf(7, 1)}}}});
  EXPECT_THAT(frames.Next({{"a", {{10, 10, 10, 10, IM_COL32_WHITE, TextureOf(7, 2)}}}}),
              ElementsAre(DamageRect{10, 10, 20, 20}));
  EXPECT_THAT(frames.Next({{"a", {{10, 10, 10, 10, IM_COL32_BLACK, TextureOf(7, 2)}}}}),
              ElementsAre(DamageRect{10, 10, 20, 20}));
}

TEST(FrameDamage, StaysWithinTheClipAndTheDisplay) {
  Frames frames;
  frames.Next({{"a", {}}});
  EXPECT_THAT(frames.Next({{"a", {{190, 90, 50, 50}}}}),
              ElementsAre(DamageRect{190, 90, 200, 100}));
  EXPECT_THAT(frames.Next({{"a", {{190, 90, 50, 50}, {300, 300}}}}), IsEmpty());
}

TEST(FrameDamage, IsAWindowThatCameOrWentOnly) {
  Frames frames;
  frames.Next({{"a", {{10, 10}}}, {"b", {{50, 50}}}});
  EXPECT_THAT(frames.Next({{"a", {{10, 10}}}, {"tip", {{80, 20}}}, {"b", {{50, 50}}}}),
              ElementsAre(DamageRect{80, 20, 90, 30}));
  EXPECT_THAT(frames.Next({{"a", {{10, 10}}}, {"b", {{50, 50}}}}),
              ElementsAre(DamageRect{80, 20, 90, 30}));
  EXPECT_THAT(frames.Next({{"b", {{50, 50}}}, {"a", {{10, 10}}}}), ElementsAre(kAll))
      << "another order";
}

// Painting only the damaged rectangles gives the same picture as painting everything.
TEST(FrameDamage, CoversEveryPixelThatDiffers) {
  std::mt19937 random(7);
  const auto pick = [&](int count) { return static_cast<int>(random() % unsigned(count)); };
  const auto paint = [](const std::vector<Frames::Layer>& layers) {
    std::vector<ImU32> pixels(200 * 100, 0);
    for (const Frames::Layer& layer : layers) {
      for (const Frames::Box& box : layer.boxes) {
        for (int y = int(box.y); y < std::min(100, int(box.y + box.height)); ++y) {
          for (int x = int(box.x); x < std::min(200, int(box.x + box.width)); ++x) {
            pixels[size_t(y * 200 + x)] = box.colour;
          }
        }
      }
    }
    return pixels;
  };
  std::vector<Frames::Layer> layers = {{"a", {}}, {"b", {}}, {"c", {}}};
  Frames frames;
  frames.Next(layers);
  for (int round = 0; round < 300; ++round) {
    const std::vector<ImU32> before = paint(layers);
    for (int edits = pick(3); edits >= 0; --edits) {
      std::vector<Frames::Box>& boxes = layers[size_t(pick(3))].boxes;
      const Frames::Box box{float(pick(200)), float(pick(100)), float(1 + pick(40)),
                            float(1 + pick(40)), ImU32(random())};
      if (boxes.empty() || pick(3) == 0) {
        boxes.insert(boxes.begin() + pick(int(boxes.size()) + 1), box);
      } else if (pick(2) == 0) {
        boxes[size_t(pick(int(boxes.size())))] = box;
      } else {
        boxes.erase(boxes.begin() + pick(int(boxes.size())));
      }
    }
    if (pick(20) == 0) {
      std::swap(layers[0], layers[2]);
    }
    const std::vector<DamageRect> rects = frames.Next(layers);
    EXPECT_LE(rects.size(), FrameDamage::kMostRects);
    const std::vector<ImU32> after = paint(layers);
    for (size_t i = 0; i < after.size(); ++i) {
      const float x = float(i % 200) + 0.5f, y = float(i / 200) + 0.5f;
      const bool covered = std::any_of(rects.begin(), rects.end(), [&](const DamageRect& rect) {
        return x > rect.from_x && x < rect.to_x && y > rect.from_y && y < rect.to_y;
      });
      ASSERT_TRUE(covered || before[i] == after[i])
          << "round " << round << " at " << x << ", " << y;
    }
  }
}

}  // namespace
}  // namespace lararium::panels
