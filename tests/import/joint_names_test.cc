#include "editor/import/model/joint_names.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace lararium::import {
namespace {

struct Claim {
  const char* name;
  BodySide side;
  BonePart part;
  int segment = 0;
};

void ExpectAll(const std::vector<Claim>& claims) {
  for (const Claim& claim : claims) {
    const BoneName parsed = ParseBoneName(claim.name);
    EXPECT_EQ(parsed.side, claim.side) << claim.name;
    EXPECT_EQ(parsed.part, claim.part) << claim.name;
    EXPECT_EQ(parsed.segment, claim.segment) << claim.name;
  }
}

constexpr BodySide kL = BodySide::kLeft, kR = BodySide::kRight, kM = BodySide::kMiddle;

TEST(ParseBoneName, KnowsMixamoAndCmu) {
  ExpectAll({{"mixamorig:Hips", kM, BonePart::kPelvis},
             {"mixamorig:Spine2", kM, BonePart::kSpine},
             {"mixamorig:LeftUpLeg", kL, BonePart::kThigh},
             {"mixamorig:LeftLeg", kL, BonePart::kLeg},
             {"mixamorig:RightForeArm", kR, BonePart::kForearm},
             {"mixamorig:LeftHandIndex2", kL, BonePart::kIndex, 2},
             {"RightToeBase", kR, BonePart::kToes},
             {"LowerBack", kM, BonePart::kSpine},
             {"LHipJoint", kM, BonePart::kUnknown},
             {"LThumb", kL, BonePart::kThumb, 1}});
}

TEST(ParseBoneName, KnowsBipedAndValve) {
  ExpectAll({{"Bip01 Pelvis", kM, BonePart::kPelvis},
             {"Bip01", kM, BonePart::kUnknown},
             {"Bip01 L UpperArm", kL, BonePart::kUpperArm},
             {"Bip001 R Calf", kR, BonePart::kShin},
             {"Bip01 L Finger0", kL, BonePart::kThumb, 1},
             {"Bip01 L Finger12", kL, BonePart::kIndex, 3},
             {"Bip01 R Toe0", kR, BonePart::kToes},
             {"ValveBiped.Bip01_L_Hand", kL, BonePart::kHand}});
}

TEST(ParseBoneName, KnowsUnrealMakeHumanRigifyAndVroid) {
  ExpectAll({{"upperarm_l", kL, BonePart::kUpperArm},
             {"clavicle_r", kR, BonePart::kClavicle},
             {"spine_03", kM, BonePart::kSpine},
             {"index_metacarpal_l", kL, BonePart::kIndex, 0},
             {"thumb_02_r", kR, BonePart::kThumb, 2},
             {"finger2-3.L", kL, BonePart::kIndex, 3},
             {"upperleg01.R", kR, BonePart::kThigh},
             {"shin.R", kR, BonePart::kShin},
             {"DEF-upper_arm.L", kL, BonePart::kUpperArm},
             {"f_ring.03.R", kR, BonePart::kRing, 3},
             {"J_Bip_L_LowerArm", kL, BonePart::kForearm},
             {"J_Bip_C_Head", kM, BonePart::kHead}});
}

TEST(ParseBoneName, KnowsHAnimItself) {
  ExpectAll({{"humanoid_root", kM, BonePart::kPelvis},
             {"l_shoulder", kL, BonePart::kShoulder},
             {"r_sternoclavicular", kR, BonePart::kClavicle},
             {"vl5", kM, BonePart::kSpine},
             {"l_pinky1", kL, BonePart::kLittle, 1}});
}

TEST(ParseBoneName, TakesHelpersForNothing) {
  for (const char* name :
       {"", "lowerarm_twist_01_l", "ik_hand_r", "HeadTop_End", "J_Sec_Hair1", "tail_03", "Sword",
        "EndSite_LeftToeBase", "Leftovers", ":", "_____", "l", "123"}) {
    EXPECT_EQ(ParseBoneName(name).part, BonePart::kUnknown) << name;
  }
  EXPECT_EQ(ParseBoneName(std::string(100'000, 'a')).part, BonePart::kUnknown);
}

}  // namespace
}  // namespace lararium::import
