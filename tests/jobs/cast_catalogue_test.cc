#include "editor/jobs/cast_catalogue.h"

#include <gtest/gtest.h>

namespace lararium::editor {
namespace {

TEST(DescribeModifier, SaysInWordsWhatASliderDoes) {
  const auto hump = DescribeModifier("nose", "nose-hump-lesshump|morehump", true);
  ASSERT_TRUE(hump);
  EXPECT_EQ(hump->title, "Nose");
  EXPECT_EQ(hump->slider.label, "hump");
  EXPECT_EQ(hump->slider.less, "less");
  EXPECT_EQ(hump->slider.more, "more");
  EXPECT_EQ(hump->slider.min, -1.0f);
  const auto width = DescribeModifier("mouth", "mouth-scale-horiz-decr|incr", true);
  EXPECT_EQ(width->slider.label, "width");
}

TEST(DescribeModifier, MovesBothSidesTogether) {
  const auto left = DescribeModifier("ears", "l-ear-size-small|big", true);
  const auto right = DescribeModifier("ears", "r-ear-size-small|big", true);
  ASSERT_TRUE(left && right);
  EXPECT_EQ(left->slider, right->slider);
  EXPECT_EQ(left->slider.modifier, "ear-size-small|big");
}

TEST(DescribeModifier, TellsArmsFromLegs) {
  EXPECT_EQ(DescribeModifier("armslegs", "l-hand-scale-decr|incr", true)->title, "Arms and hands");
  EXPECT_EQ(DescribeModifier("armslegs", "l-upperleg-skinny|fat", true)->title, "Legs and feet");
}

TEST(DescribeModifier, WithoutATargetBelowBeginsAtZero) {
  const auto round = DescribeModifier("head", "head-round", false);
  ASSERT_TRUE(round);
  EXPECT_EQ(round->slider.min, 0.0f);
  EXPECT_EQ(round->slider.label, "round");
}

TEST(DescribeModifier, LeavesOutWhatClothesHide) {
  EXPECT_FALSE(DescribeModifier("genitals", "penis-length-min|max", true));
  EXPECT_FALSE(DescribeModifier("breast", "nipple-size-min|max", true));
}

TEST(Matches, FindsAllWordsInTitleLabelOrName) {
  const CastSliderGroup group{"Nose", {}};
  const CastSlider hump{"nose-hump-lesshump|morehump", "hump", "less", "more"};
  EXPECT_TRUE(Matches(group, hump, ""));
  EXPECT_TRUE(Matches(group, hump, "NOSE hu"));
  EXPECT_FALSE(Matches(group, hump, "nose width"));
}

}  // namespace
}  // namespace lararium::editor
