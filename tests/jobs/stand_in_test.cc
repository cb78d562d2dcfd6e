// People who are not built yet: plain figures replace them, so that a place can be shown meanwhile.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "editor/document/project.h"
#include "editor/jobs/baking.h"
#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

float HeightOf(const human::Human& human) {
  const auto highest = [](const human::SkinnedMesh& mesh) {
    return std::ranges::max(mesh.positions, {}, &glm::vec3::y).y;
  };
  return highest(std::ranges::max(human.meshes, {}, highest));
}

class StandInTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(CreateProject(paths_, "test").ok());
    document_ = LoadProject(paths_).value();
    document_.cast.resize(2);
    document_.cast[0].name = "ada";
    document_.cast[0].height = 1.5;
    document_.cast[1].name = "ben";
  }

  test::TemporaryFolder folder_;
  ProjectPaths paths_{folder_ / "test.lararium"};
  ProjectDocument document_;
  NoProgress progress_;
};

TEST_F(StandInTest, WhoWasNeverBakedIsThePlainFigureInTheirSize) {
  EXPECT_FALSE(ShareBakedHuman(paths_, document_.cast[0], 0.0f).ok());
  const auto ada = MakeStandIn(paths_, document_.cast[0]);
  ASSERT_TRUE(ada.ok()) << ada.message();
  EXPECT_NEAR(HeightOf(*ada), 1.5f, 0.05f);
}

TEST_F(StandInTest, WhoWasBakedBeforeStaysAsTheyWere) {
  ASSERT_TRUE(BakeHuman(paths_, document_.cast[0]).ok());
  CastDocument taller = document_.cast[0];
  taller.height = 1.9;
  const auto ada = ShareBakedHuman(paths_, taller, 0.0f);
  ASSERT_TRUE(ada.ok()) << ada.message();
  EXPECT_NEAR(HeightOf(*ada->human), 1.5f, 0.05f);
}

TEST_F(StandInTest, WhoWasCopiedWithTheHashIsNotBakedAgainUntilChanged) {
  const ProjectPaths other{folder_ / "other.lararium"};
  ASSERT_TRUE(CreateProject(other, "other").ok());
  CopyProduct(other.Human("ada"), paths_.Human("ada"));
  EXPECT_FALSE(FileExists(paths_.Human("ada"))) << "a product that is not there";
  ASSERT_TRUE(BakeHuman(other, document_.cast[0]).ok());
  CopyProduct(other.Human("ada"), paths_.Human("ada"));
  EXPECT_EQ(ReadBytes(paths_.Human("ada")).value(), ReadBytes(other.Human("ada")).value());
  document_.cast.resize(1);
  auto report = Bake(paths_, document_, progress_, BakeWhat::kUnlitPeople);
  ASSERT_TRUE(report.ok()) << report.message();
  EXPECT_THAT(report->baked, IsEmpty());
  document_.cast[0].height = 1.9;
  report = Bake(paths_, document_, progress_, BakeWhat::kUnlitPeople);
  ASSERT_TRUE(report.ok()) << report.message();
  EXPECT_THAT(report->baked, ElementsAre("human ada"));
}

TEST_F(StandInTest, BakingAllButPeopleLeavesThemToBeBaked) {
  const auto report = Bake(paths_, document_, progress_, BakeWhat::kAllButPeople);
  ASSERT_TRUE(report.ok()) << report.message();
  EXPECT_THAT(report->baked, Not(Contains(HasSubstr("ada"))));
  EXPECT_THAT(PeopleToBake(paths_, document_), ElementsAre("ada", "ben"));
}

TEST_F(StandInTest, BakingOneAloneLeavesTheLinesOfOthers) {
  ASSERT_TRUE(WriteFileAtomically(paths_.folder / "lines.csv",
                                  std::string_view("id,speaker,notes,en\nhail,ben,,Hail!\n"))
                  .ok());
  document_.cast.resize(1);
  auto report = Bake(paths_, document_, progress_, BakeWhat::kUnlitPeople);
  ASSERT_TRUE(report.ok()) << report.message();
  EXPECT_THAT(report->baked, ElementsAre("human ada"));
  EXPECT_THAT(PeopleToBake(paths_, document_), ElementsAre("ada"));
  report = Bake(paths_, document_, progress_, BakeWhat::kPeople);
  ASSERT_TRUE(report.ok()) << report.message();
  EXPECT_THAT(report->baked, ElementsAre("light transfer of ada"));
  EXPECT_THAT(PeopleToBake(paths_, document_), IsEmpty());
}

TEST_F(StandInTest, PeopleAreToBeBakedUntilTheirLightIs) {
  document_.cast.resize(1);
  ASSERT_TRUE(BakeHuman(paths_, document_.cast[0]).ok());
  EXPECT_THAT(PeopleToBake(paths_, document_), ElementsAre("ada"));
}

}  // namespace
}  // namespace lararium::editor
