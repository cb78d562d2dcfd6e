#include "editor/import/joint_names.h"

#include <gtest/gtest.h>

namespace lararium::import {
namespace {

TEST(HAnimName, KnowsTheCommonRigs) {
  EXPECT_EQ(HAnimName("mixamorig:LeftUpLeg"), "l_hip");
  EXPECT_EQ(HAnimName("mixamorig:RightForeArm"), "r_elbow");
  EXPECT_EQ(HAnimName("mixamorig:Hips"), "humanoid_root");
  EXPECT_EQ(HAnimName("upperarm_l"), "l_shoulder");
  EXPECT_EQ(HAnimName("clavicle_r"), "r_sternoclavicular");
  EXPECT_EQ(HAnimName("shin.R"), "r_knee");
  EXPECT_EQ(HAnimName("upper_arm.L"), "l_shoulder");
  EXPECT_EQ(HAnimName("Head"), "skullbase");
}

TEST(HAnimName, KeepsWhatItDoesNotKnow) {
  EXPECT_EQ(HAnimName("l_shoulder"), "l_shoulder");
  EXPECT_EQ(HAnimName("vl5"), "vl5");
  EXPECT_EQ(HAnimName("tail_03"), "tail_03");
  EXPECT_EQ(HAnimName(""), "");
}

}  // namespace
}  // namespace lararium::import
