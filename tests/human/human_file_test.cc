#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "shared/core/file.h"
#include "shared/core/random.h"
#include "tests/human/two_joint_human.h"
#include "tests/support/test_files.h"

namespace lararium::human {
namespace {

using ::testing::HasSubstr;

TEST(HumanFile, RoundTripKeepsEverything) {
  const Human human = TwoJointHuman();
  const auto parsed = ParseHuman(SerializeHuman(human), "here");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_EQ(parsed->name, human.name);
  EXPECT_EQ(parsed->credits, human.credits);
  EXPECT_EQ(parsed->skeleton.names, human.skeleton.names);
  EXPECT_EQ(parsed->skeleton.parents, human.skeleton.parents);
  EXPECT_EQ(parsed->skeleton.joint_from_actor, human.skeleton.joint_from_actor);
  ASSERT_EQ(parsed->meshes.size(), 1u);
  EXPECT_EQ(parsed->meshes[0].name, human.meshes[0].name);
  EXPECT_EQ(parsed->meshes[0].positions, human.meshes[0].positions);
  EXPECT_EQ(parsed->meshes[0].normals, human.meshes[0].normals);
  EXPECT_EQ(parsed->meshes[0].albedo, human.meshes[0].albedo);
  EXPECT_EQ(parsed->meshes[0].joints, human.meshes[0].joints);
  EXPECT_EQ(parsed->meshes[0].weights, human.meshes[0].weights);
  EXPECT_EQ(parsed->meshes[0].indices, human.meshes[0].indices);
  ASSERT_EQ(parsed->clips.size(), 2u);
  EXPECT_EQ(parsed->clips[1].name, "turn");
  EXPECT_TRUE(parsed->clips[1].loops);
  EXPECT_EQ(parsed->clips[1].stride, 1.25f);
  ASSERT_EQ(parsed->clips[0].keys.size(), human.clips[0].keys.size());
  for (size_t i = 0; i < human.clips[0].keys.size(); ++i) {
    EXPECT_EQ(parsed->clips[0].keys[i].rotation, human.clips[0].keys[i].rotation);
    EXPECT_EQ(parsed->clips[0].keys[i].translation, human.clips[0].keys[i].translation);
  }
}

TEST(HumanFile, TheSameHumanGivesTheSameBytes) {
  EXPECT_EQ(SerializeHuman(TwoJointHuman()), SerializeHuman(TwoJointHuman()));
}

TEST(HumanFile, SavesAndLoads) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(SaveHuman(folder / "a.larhuman", TwoJointHuman()).ok());
  EXPECT_TRUE(LoadHuman(folder / "a.larhuman").ok());
  EXPECT_FALSE(LoadHuman(folder / "b.larhuman").ok());
}

TEST(HumanFile, WillNotSaveWhatItWouldNotLoad) {
  const test::TemporaryFolder folder;
  Human human = TwoJointHuman();
  human.meshes[0].indices[0] = 99;
  EXPECT_FALSE(SaveHuman(folder / "a.larhuman", human).ok());
  EXPECT_FALSE(std::filesystem::exists(folder / "a.larhuman"));
}

TEST(HumanFile, RefusesOtherFilesByName) {
  const std::vector<std::byte> zeros(1000);
  const auto parsed = ParseHuman(zeros, "photo.jpg");
  ASSERT_FALSE(parsed.ok());
  EXPECT_THAT(parsed.message(), HasSubstr("photo.jpg"));
  EXPECT_FALSE(ParseHuman({}, "empty").ok());
}

TEST(HumanFile, RefusesWhatIsInconsistent) {
  const auto refuses = [](auto&& change) {
    Human human = TwoJointHuman();
    change(human);
    return !ParseHuman(SerializeHuman(human), "here").ok();
  };
  EXPECT_TRUE(refuses([](Human& h) { h.meshes[0].joints[2][0] = 7; }));
  EXPECT_TRUE(refuses([](Human& h) { h.meshes[0].indices[1] = 4; }));
  EXPECT_TRUE(refuses([](Human& h) { h.meshes[0].indices.pop_back(); }));
  EXPECT_TRUE(refuses([](Human& h) { h.meshes[0].weights[0].x = 0.5f; }));
  EXPECT_TRUE(refuses([](Human& h) { h.meshes[0].normals[0] = glm::vec3(0.0f); }));
  EXPECT_TRUE(refuses([](Human& h) { h.meshes[0].albedo.pop_back(); }));
  EXPECT_TRUE(refuses([](Human& h) { h.meshes[0].albedo[1].g = 1.5f; }));
  EXPECT_TRUE(refuses([](Human& h) { h.skeleton.parents[1] = 1; }));
  EXPECT_TRUE(refuses([](Human& h) { h.clips[0].keys.pop_back(); }));
}

TEST(HumanFile, RefusesEveryTruncation) {
  const std::vector<std::byte> bytes = SerializeHuman(TwoJointHuman());
  for (size_t length = 0; length < bytes.size(); ++length) {
    // A copy of its own size, so that sanitizers see any read beyond it.
    const std::vector<std::byte> cut(bytes.begin(), bytes.begin() + static_cast<long>(length));
    EXPECT_FALSE(ParseHuman(cut, "cut").ok()) << length;
  }
}

TEST(HumanFile, SurvivesFlippedBits) {
  const std::vector<std::byte> bytes = SerializeHuman(TwoJointHuman());
  Random random(3);
  for (int trial = 0; trial < 20000; ++trial) {
    std::vector<std::byte> damaged = bytes;
    for (uint32_t flips = 1 + random.Below(4); flips > 0; --flips) {
      damaged[random.Below(static_cast<uint32_t>(damaged.size()))] ^=
          static_cast<std::byte>(1u << random.Below(8));
    }
    const auto parsed = ParseHuman(damaged, "damaged");
    if (parsed.ok()) {
      EXPECT_TRUE(parsed->Validate("damaged").ok());
    }
  }
}

TEST(HumanFile, ReadsBytesAtAnyAddress) {
  const std::vector<std::byte> bytes = SerializeHuman(TwoJointHuman());
  std::vector<std::byte> shifted(bytes.size() + 1);
  std::copy(bytes.begin(), bytes.end(), shifted.begin() + 1);
  EXPECT_TRUE(ParseHuman(std::span(shifted).subspan(1), "shifted").ok());
}

}  // namespace
}  // namespace lararium::human
