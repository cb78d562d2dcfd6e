#include "editor/import/model/bone_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "editor/import/model/bone_structure.h"
#include "shared/core/file.h"
#include "tests/import/plain_figure.h"
#include "tests/support/test_files.h"

namespace lararium::import {
namespace {

using ::testing::HasSubstr;

// The bones of the plain figure under other names, without the skirt.
Rig PlainRig(const std::map<std::string, std::string>& names, bool scramble) {
  const human::Skeleton& skeleton = PlainSkeleton();
  Rig rig;
  std::vector<int16_t> bones(skeleton.size());  // The bone of each joint of the skeleton.
  for (size_t j = 0; j < skeleton.size(); ++j) {
    if (skeleton.names[j].starts_with("tunic")) {
      continue;
    }
    const auto found = names.find(skeleton.names[j]);
    const int16_t parent = skeleton.parents[j];
    bones[j] = static_cast<int16_t>(rig.names.size());
    rig.names.push_back(scramble               ? "bone" + std::to_string(j)
                        : found != names.end() ? found->second
                                               : skeleton.names[j]);
    rig.parents.push_back(parent < 0 ? parent : bones[static_cast<size_t>(parent)]);
    rig.positions.push_back(RestPosition(skeleton, skeleton.names[j]));
  }
  return rig;
}

void ExpectLimbs(const Rig& rig, const BoneMap& map, FoundBy found_by) {
  const Rig truth = PlainRig({}, false);
  EXPECT_TRUE(map.IsHuman());
  for (const std::string joint : {"shoulder", "elbow", "wrist", "hip", "knee", "ankle"}) {
    for (const std::string side : {"r_", "l_"}) {
      const MappedBone* mapped = map.Find(side + joint);
      ASSERT_NE(mapped, nullptr) << side << joint << "\n" << Preview(rig, map);
      EXPECT_EQ(truth.names[mapped->bone], side + joint);
      EXPECT_EQ(mapped->found_by, found_by) << side << joint;
    }
  }
  for (const char* joint :
       {"skullbase", "humanoid_root", "vl5", "vt4", "vc4", "l_sternoclavicular"}) {
    const MappedBone* mapped = map.Find(joint);
    ASSERT_NE(mapped, nullptr) << joint << "\n" << Preview(rig, map);
    EXPECT_EQ(truth.names[mapped->bone], joint);
  }
}

std::map<std::string, std::string> Sided(const std::map<std::string, std::string>& names,
                                         const std::string& right,
                                         const std::string& left) {
  std::map<std::string, std::string> sided;
  for (const auto& [joint, name] : names) {
    for (const auto& [prefix, side] : {std::pair<std::string, std::string>{"r_", right},
                                       std::pair<std::string, std::string>{"l_", left}}) {
      std::string replaced = name;
      if (const size_t at = replaced.find('*'); at != std::string::npos) {
        replaced.replace(at, 1, side);
        sided[prefix + joint] = replaced;
      } else {
        sided[joint] = name;
      }
    }
  }
  return sided;
}

TEST(MapBones, FindsHAnimByItself) {
  const Rig rig = PlainRig({}, false);
  ExpectLimbs(rig, MapBones(rig), FoundBy::kName);
}

TEST(MapBones, FindsMixamoWhereTheShoulderIsTheClavicle) {
  const Rig rig = PlainRig(Sided({{"humanoid_root", "mixamorig:Hips"},
                                  {"vl5", "mixamorig:Spine"},
                                  {"vt10", "mixamorig:Spine1"},
                                  {"vt4", "mixamorig:Spine2"},
                                  {"vc4", "mixamorig:Neck"},
                                  {"skullbase", "mixamorig:Head"},
                                  {"hip", "mixamorig:*UpLeg"},
                                  {"knee", "mixamorig:*Leg"},
                                  {"ankle", "mixamorig:*Foot"},
                                  {"sternoclavicular", "mixamorig:*Shoulder"},
                                  {"shoulder", "mixamorig:*Arm"},
                                  {"elbow", "mixamorig:*ForeArm"},
                                  {"wrist", "mixamorig:*Hand"}},
                                 "Right", "Left"),
                           false);
  ExpectLimbs(rig, MapBones(rig), FoundBy::kName);
}

TEST(MapBones, FindsRigsWhereTheShoulderIsTheUpperArmAndTheHipTheThigh) {
  const Rig rig = PlainRig(Sided({{"humanoid_root", "Hips"},
                                  {"vl5", "Ab"},
                                  {"vt4", "Chest"},
                                  {"skullbase", "Head"},
                                  {"hip", "*Hip"},
                                  {"knee", "*Knee"},
                                  {"ankle", "*Ankle"},
                                  {"sternoclavicular", "*Collar"},
                                  {"shoulder", "*Shoulder"},
                                  {"elbow", "*Elbow"},
                                  {"wrist", "*Wrist"}},
                                 "Right", "Left"),
                           false);
  ExpectLimbs(rig, MapBones(rig), FoundBy::kName);
}

TEST(MapBones, FindsABodyByItsShapeWhereNamesSayNothing) {
  const Rig rig = PlainRig({}, true);
  ExpectLimbs(rig, MapBones(rig), FoundBy::kStructure);
}

TEST(MapBones, FindsItLyingAndInOtherUnits) {
  Rig rig = PlainRig({}, true);
  for (glm::vec3& p : rig.positions) {
    p = 100.0f * glm::vec3(p.z, p.x, p.y);  // Z up.
  }
  ExpectLimbs(rig, MapBones(rig), FoundBy::kStructure);
}

TEST(MapBones, TakesASavedMapBeforeNames) {
  const Rig rig = PlainRig({}, false);
  const BoneMap map =
      MapBones(rig, {FindGiven(rig, {{"skullbase", "vc4"}, {"l_thumb1", ""}, {"vl5", "absent"}})});
  EXPECT_EQ(rig.names[map.Find("skullbase")->bone], "vc4");
  EXPECT_EQ(map.Find("skullbase")->found_by, FoundBy::kSavedMap);
  EXPECT_EQ(map.Find("l_thumb1"), nullptr);
}

TEST(MapBones, FindsNoBodyInATableOrASpider) {
  Rig table;
  for (int leg = -1; leg < 4; ++leg) {
    table.names.push_back("part" + std::to_string(leg));
    table.parents.push_back(leg < 0 ? Rig::kNoParent : 0);
    table.positions.emplace_back(leg % 2, -leg / 2, 0.3f * static_cast<float>(leg));
  }
  EXPECT_FALSE(MapBones(table).IsHuman());
  EXPECT_TRUE(MapByStructure(table).empty());
  EXPECT_FALSE(MapBones(Rig()).IsHuman());
}

TEST(MapBones, GivesEachBoneAndEachJointOnce) {
  Rig rig = PlainRig({}, false);
  rig.names.assign(rig.size(), "LeftArm");
  std::set<std::string> joints;
  std::set<size_t> bones;
  for (const MappedBone& mapped : MapBones(rig).bones) {
    EXPECT_TRUE(joints.insert(mapped.joint).second);
    EXPECT_TRUE(bones.insert(mapped.bone).second);
  }
}

TEST(Preview, TellsJointBoneHowAndHowSure) {
  const Rig rig = PlainRig({{"l_elbow", "LeftForeArm"}}, false);
  const std::string text = Preview(rig, MapBones(rig));
  EXPECT_THAT(text, HasSubstr("l_elbow             LeftForeArm"));
  EXPECT_THAT(text, HasSubstr("name"));
  EXPECT_THAT(text, HasSubstr("100%"));
}

TEST(BoneNames, AreReadBackAsTheyWereSaved) {
  const test::TemporaryFolder folder;
  const Rig rig = PlainRig({}, false);
  const BoneNames names = NamesOf(rig, MapBones(rig));
  ASSERT_TRUE(SaveBoneNames(folder / "bones.json", names).ok());
  const auto loaded = LoadBoneNames(folder / "bones.json");
  ASSERT_TRUE(loaded.ok()) << loaded.message();
  EXPECT_EQ(*loaded, names);
}

TEST(BoneNames, RefuseWhatMakesNoSense) {
  for (const char* text :
       {"", "[]", "{}", R"({"schema": 2, "bones": {}})", R"({"schema": 1, "bones": []})",
        R"({"schema": 1, "bones": {"tail": "x"}})", R"({"schema": 1, "bones": {"vl5": 3}})",
        R"({"schema": 1, "bones": {"vl5": "a", "vt4": "a"}})"}) {
    const auto names = ParseBoneNames(text, "map.json");
    ASSERT_FALSE(names.ok()) << text;
    EXPECT_THAT(names.message(), HasSubstr("map.json"));
  }
}

}  // namespace
}  // namespace lararium::import
