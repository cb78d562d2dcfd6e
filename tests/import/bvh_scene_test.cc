#include "editor/import/model/bvh_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lararium::import {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr char kHierarchy[] =
    "HIERARCHY\n"
    "ROOT Hips\n{\n OFFSET 0 90 0\n CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation "
    "Yrotation\n"
    " JOINT Left Leg\n {\n  OFFSET 10 -5 0\n  CHANNELS 1 Xrotation\n"
    "  End Site\n  {\n   OFFSET 0 -40 0\n  }\n }\n}\n";

class ReadBvh : public ::testing::Test {
 protected:
  Result<std::unique_ptr<aiScene>> Read(const std::string& text) {
    notes_.clear();
    return ReadBvhScene(text, "walk.bvh", notes_);
  }
  Result<std::unique_ptr<aiScene>> ReadMotion(const std::string& motion) {
    return Read(kHierarchy + ("MOTION\n" + motion));
  }
  std::vector<std::string> notes_;
};

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  for (size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

TEST_F(ReadBvh, GivesANodeForEachJointAndAKeyForEachFrame) {
  const auto scene = ReadMotion(
      "Frames: 2\nFrame Time: 0.5\n"
      "1 91 2 90 0 0 30\n"
      "1 92 3 90 90 0 60\n");
  ASSERT_TRUE(scene.ok()) << scene.message();
  EXPECT_THAT(notes_, IsEmpty());
  const aiNode* leg = (*scene)->mRootNode->mChildren[0];
  EXPECT_STREQ(leg->mName.C_Str(), "Left Leg");
  EXPECT_EQ(leg->mTransformation.a4, 10.0f);
  EXPECT_STREQ(leg->mChildren[0]->mName.C_Str(), "EndSite_Left Leg");
  const aiNodeAnim& hips = *(*scene)->mAnimations[0]->mChannels[0];
  ASSERT_EQ(hips.mNumPositionKeys, 2u);
  EXPECT_EQ(hips.mPositionKeys[1].mTime, 0.5);
  EXPECT_EQ(hips.mPositionKeys[1].mValue, aiVector3D(1, 92, 3));
  // First about Z, then about the X axis that this has turned: Y goes to Z, and then to -X.
  const aiVector3D turned = hips.mRotationKeys[1].mValue.Rotate(aiVector3D(0, 0, 1));
  EXPECT_NEAR(turned.x, 1.0f, 1e-6f) << turned.y << " " << turned.z;
}

TEST_F(ReadBvh, RefusesMotionOfJointsWithoutChannels) {
  const std::string none = Replaced(kHierarchy, "CHANNELS", "CHANNEL5");
  EXPECT_THAT(Read(none + "MOTION\nFrames: 1\nFrame Time: 0.5\nx 1 2\n").message(),
              HasSubstr("no joint has a channel"));
}

TEST_F(ReadBvh, ReadsWhatOtherProgramsWrite) {
  const std::string plain =
      std::string(kHierarchy) +
      "MOTION\nFrames: 2\nFrame Time: 0.5\n1 91 2 30 0 0 30\n1.5 92 3 60 0 0 60\n";
  for (const auto& [what, text] : {
           std::pair{"a byte order mark", "\xef\xbb\xbf" + plain},
           std::pair{"Windows' line ends", Replaced(plain, "\n", "\r\n")},
           std::pair{"old line ends", Replaced(plain, "\n", "\r")},
           std::pair{"tabs", Replaced(plain, " ", "\t")},
           std::pair{"a comment", "# by us\n\n" + plain},
           std::pair{"small letters", Replaced(plain, "HIERARCHY", "Hierarchy")},
           std::pair{"small channels", Replaced(plain, "Xrotation", "xRotation")},
           std::pair{"decimal commas", Replaced(plain, ".5", ",5")},
           std::pair{"exponents", Replaced(plain, "1.5", "+1.5e+0")},
           std::pair{"channels of an end", Replaced(plain, "OFFSET 0 -40 0", "CHANNELS 0")},
           std::pair{"braces behind names", Replaced(plain, "ROOT Hips\n{", "ROOT Hips {")},
           std::pair{"broken rows", Replaced(plain, "92 3", "92\n3")},
       }) {
    const auto scene = Read(text);
    ASSERT_TRUE(scene.ok()) << what << ": " << scene.message();
    EXPECT_THAT(notes_, IsEmpty()) << what;
    const aiNodeAnim& hips = *(*scene)->mAnimations[0]->mChannels[0];
    ASSERT_EQ(hips.mNumPositionKeys, 2u) << what;
    EXPECT_EQ(hips.mPositionKeys[1].mValue, aiVector3D(1.5f, 92, 3)) << what;
    EXPECT_EQ(hips.mPositionKeys[1].mTime, 0.5) << what;
  }
}

TEST_F(ReadBvh, TellsWhatIsUnusualAndReadsTheRest) {
  const std::string rows = "1 91 2 30 0 0 30\n1 92 3 60 0 0 60\n";
  for (const auto& [motion, note] : {
           std::pair{"Frames: 9\nFrame Time: 0.5\n" + rows, "2 frames"},
           std::pair{"Frames: 2\nFrame Time: 0\n" + rows, "no frame time"},
           std::pair{"Frames: 2\nFrame Time: 25\n" + rows, "frames a second"},
           std::pair{"Frames: 2\nFrame Time: 0.5\n" + rows + "1 2", "last frame"},
           std::pair{"Frames: 2\nFrame Time: 0.5\n" + Replaced(rows, "92", "-1.#IND"), "line 20"},
       }) {
    const auto scene = ReadMotion(motion);
    ASSERT_TRUE(scene.ok()) << scene.message();
    ASSERT_EQ(notes_.size(), 1u) << motion;
    EXPECT_THAT(notes_[0], HasSubstr(note));
    EXPECT_EQ((*scene)->mAnimations[0]->mChannels[0]->mNumPositionKeys, 2u);
  }
  EXPECT_EQ((*ReadMotion("Frames: 2\nFrame Time: 0.5\n" + Replaced(rows, "92", "nan")))
                ->mAnimations[0]
                ->mChannels[0]
                ->mPositionKeys[1]
                .mValue.y,
            91.0f);
}

TEST_F(ReadBvh, LeavesOutFurtherRoots) {
  const std::string root = std::string(kHierarchy).substr(std::string("HIERARCHY\n").size());
  const auto scene = Read(kHierarchy + root +
                          "MOTION\nFrames: 1\nFrame Time: 0.5\n1 91 2 30 0 0 30 7 7 7 7 7 7 7\n");
  ASSERT_TRUE(scene.ok()) << scene.message();
  EXPECT_EQ((*scene)->mAnimations[0]->mNumChannels, 2u);
  ASSERT_EQ(notes_.size(), 1u);
  EXPECT_THAT(notes_[0], HasSubstr("root"));
}

TEST_F(ReadBvh, KeepsOffsetsWherePositionsAreNothingButZeros) {
  const std::string six = Replaced(kHierarchy, "CHANNELS 1 Xrotation",
                                   "CHANNELS 4 Xposition Yposition Zposition Xrotation");
  const auto scene = Read(six + "MOTION\nFrames: 1\nFrame Time: 0.5\n1 91 2 30 0 0 0 0 0 30\n");
  ASSERT_TRUE(scene.ok()) << scene.message();
  EXPECT_EQ((*scene)->mAnimations[0]->mChannels[1]->mPositionKeys[0].mValue, aiVector3D(10, -5, 0));
}

TEST_F(ReadBvh, NamesTheLineOfAnError) {
  const std::string plain = std::string(kHierarchy) + "MOTION\nFrames: 0\nFrame Time: 0.5\n";
  for (const auto& [text, part] : {
           std::pair{plain, "walk.bvh:18: there is no whole frame of 7 values"},
           std::pair{Replaced(plain, "OFFSET 10 -5 0", "OFFSET 10 -5"), "walk.bvh:8: OFFSET"},
           std::pair{Replaced(plain, "CHANNELS 1", "CHANNELS 2"), "walk.bvh:9: CHANNELS"},
           std::pair{Replaced(plain, "Xposition", "Wposition"), "walk.bvh:5: 'Wposition'"},
           std::pair{Replaced(plain, " }\n}\n", ""), "brace is missing"},
           std::pair{std::string("HIERARCHY\nMOTION\n"), "no ROOT"},
           std::pair{std::string("HIERARCHY\n}\n"), "walk.bvh:2: a brace closes"},
       }) {
    const auto scene = Read(text);
    ASSERT_FALSE(scene.ok()) << part;
    EXPECT_THAT(scene.message(), HasSubstr(part));
  }
}

}  // namespace
}  // namespace lararium::import
