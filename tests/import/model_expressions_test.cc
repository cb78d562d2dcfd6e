#include "editor/import/model/model_expressions.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace lararium::import {
namespace {

using human::FaceShape;

std::vector<ForeignShape> Named(const std::vector<std::string>& names) {
  std::vector<ForeignShape> shapes;
  for (const std::string& name : names) {
    shapes.push_back({name, {{static_cast<uint32_t>(shapes.size()), 1.0f}}});
  }
  return shapes;
}

const FaceShape* Find(const std::vector<FaceShape>& face, const std::string& name) {
  const auto found =
      std::find_if(face.begin(), face.end(), [&](const FaceShape& s) { return s.name == name; });
  return found == face.end() ? nullptr : &*found;
}

float Weight(const FaceShape* shape, uint32_t morph) {
  for (const FaceShape::Morph& m : shape == nullptr ? FaceShape().morphs : shape->morphs) {
    if (m.morph == morph) {
      return m.weight;
    }
  }
  return 0.0f;
}

constexpr const char* kAll[] = {"sil",  "PP",      "FF",       "TH",      "DD",      "kk",
                                "CH",   "SS",      "nn",       "RR",      "aa",      "E",
                                "ih",   "oh",      "ou",       "joy",     "sadness", "anger",
                                "fear", "disgust", "surprise", "blink_l", "blink_r"};

TEST(ComposeFace, GetsAllShapesFromArKit) {
  const auto face = ComposeFace(
      Named({"jawOpen",           "mouthFunnel",        "mouthPucker",         "mouthPressLeft",
             "mouthPressRight",   "mouthRollLower",     "mouthRollUpper",      "mouthStretchLeft",
             "mouthStretchRight", "mouthSmileLeft",     "mouthSmileRight",     "mouthFrownLeft",
             "mouthFrownRight",   "mouthLowerDownLeft", "mouthLowerDownRight", "mouthUpperUpLeft",
             "mouthUpperUpRight", "browInnerUp",        "browDownLeft",        "browDownRight",
             "browOuterUpLeft",   "browOuterUpRight",   "eyeWideLeft",         "eyeWideRight",
             "eyeBlinkLeft",      "eyeBlinkRight",      "noseSneerLeft",       "noseSneerRight",
             "cheekSquintLeft",   "cheekSquintRight"}),
      std::nullopt);
  for (const char* name : kAll) {
    EXPECT_NE(Find(face, name), nullptr) << name;
  }
  EXPECT_GT(Weight(Find(face, "aa"), 0), 0.4f);   // the jaw
  EXPECT_GT(Weight(Find(face, "joy"), 9), 0.5f);  // both corners
  EXPECT_FLOAT_EQ(Weight(Find(face, "joy"), 9), Weight(Find(face, "joy"), 10));
  EXPECT_FLOAT_EQ(Weight(Find(face, "blink_l"), 24), 1.0f);  // one lid
  EXPECT_FLOAT_EQ(Weight(Find(face, "blink_l"), 25), 0.0f);
  EXPECT_TRUE(Find(face, "sil")->morphs.empty());
}

TEST(ComposeFace, GetsAllShapesFromVrm) {
  const auto face = ComposeFace(Named({"aa", "ih", "ou", "ee", "oh", "happy", "angry", "sad",
                                       "surprised", "relaxed", "blink", "blinkLeft", "blinkRight"}),
                                std::nullopt);
  for (const char* name : kAll) {
    EXPECT_NE(Find(face, name), nullptr) << name;
  }
  EXPECT_FLOAT_EQ(Weight(Find(face, "E"), 3), 1.0f);
  EXPECT_FLOAT_EQ(Weight(Find(face, "joy"), 5), 1.0f);
  EXPECT_FLOAT_EQ(Weight(Find(face, "blink_r"), 12), 1.0f);
  EXPECT_FLOAT_EQ(Weight(Find(face, "blink_r"), 10), 0.0f);
}

TEST(ComposeFace, GetsExpressionsFromActionUnits) {
  const auto face =
      ComposeFace(Named({"AU1", "AU2", "AU4", "AU5", "AU12_L", "AU12_R", "AU15", "AU26", "AU45"}),
                  std::nullopt);
  EXPECT_GT(Weight(Find(face, "joy"), 4), 0.5f);
  EXPECT_GT(Weight(Find(face, "joy"), 5), 0.5f);
  EXPECT_GT(Weight(Find(face, "sadness"), 6), 0.5f);
  EXPECT_GT(Weight(Find(face, "surprise"), 7), 0.2f);
  EXPECT_FLOAT_EQ(Weight(Find(face, "blink_l"), 8) + Weight(Find(face, "blink_r"), 8), 1.0f);
}

TEST(ComposeFace, KnowsMpeg4sVisemesAndParameters) {
  const auto face = ComposeFace(Named({"viseme_1", "viseme_10", "close_t_l_eyelid",
                                       "raise_l_cornerlip", "raise_r_cornerlip", "open_jaw"}),
                                std::nullopt);
  EXPECT_FLOAT_EQ(Weight(Find(face, "PP"), 0), 1.0f);
  EXPECT_FLOAT_EQ(Weight(Find(face, "aa"), 1), 1.0f);
  EXPECT_FLOAT_EQ(Weight(Find(face, "blink_l"), 2), 1.0f);
  EXPECT_GT(Weight(Find(face, "joy"), 3), 0.5f);
  EXPECT_GT(Weight(Find(face, "oh"), 5), 0.1f);
}

TEST(ComposeFace, OpensTheMouthByTheJawWhereNothingElseDoes) {
  const auto face = ComposeFace({}, 7u);
  const FaceShape* aa = Find(face, "aa");
  ASSERT_NE(aa, nullptr);
  ASSERT_EQ(aa->turns.size(), 1u);
  EXPECT_EQ(aa->turns[0].joint, 7u);
  // Vertices in front of the joint move down.
  EXPECT_LT((aa->turns[0].rotation * glm::vec3(0, 0, -1)).y, -0.1f);
}

TEST(ComposeFace, GivesNothingForTargetsThatAreNoFace) {
  EXPECT_TRUE(ComposeFace(Named({"fat", "tall", "target 3", ""}), std::nullopt).empty());
  EXPECT_TRUE(ComposeFace({}, std::nullopt).empty());
}

}  // namespace
}  // namespace lararium::import
