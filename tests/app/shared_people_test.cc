#include "editor/app/shared_people.h"

#include <gtest/gtest.h>

#include "editor/app/baking.h"
#include "editor/app/project.h"
#include "tests/support/test_files.h"

namespace lararium::app {
namespace {

class SharedPeopleTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(CreateProject(paths_, "test").ok());
    ada_.name = "ada";
    ada_.height = 1.5;
    ASSERT_TRUE(BakeHuman(paths_, ada_).ok());
  }

  std::filesystem::path File() const { return paths_.Human("ada"); }

  test::TemporaryFolder folder_;
  ProjectPaths paths_{folder_ / "test.lararium"};
  CastDocument ada_;
};

TEST_F(SharedPeopleTest, AreReadOnceForAllWhoHoldThem) {
  const Result<SharedPerson> one = SharePerson(File());
  ASSERT_TRUE(one.ok()) << one.message();
  const Result<SharedPerson> other = SharePerson(File());
  ASSERT_TRUE(other.ok()) << other.message();
  EXPECT_EQ(one->human, other->human);
  EXPECT_EQ(one->light, other->light);
}

TEST_F(SharedPeopleTest, AreReadAnewOnceTheirFileHasChanged) {
  const Result<SharedPerson> before = SharePerson(File());
  ASSERT_TRUE(before.ok()) << before.message();
  ada_.height = 1.8;
  ASSERT_TRUE(BakeHuman(paths_, ada_).ok());
  const Result<SharedPerson> after = SharePerson(File());
  ASSERT_TRUE(after.ok()) << after.message();
  EXPECT_NE(before->human, after->human);
  EXPECT_NE(before->human->meshes.front().positions, after->human->meshes.front().positions);
}

TEST_F(SharedPeopleTest, AreNotKeptWhenNobodyHoldsThem) {
  Result<SharedPerson> held = SharePerson(File());
  ASSERT_TRUE(held.ok()) << held.message();
  const std::weak_ptr<const human::Human> human = held->human;
  *held = {};
  EXPECT_TRUE(human.expired());
  EXPECT_TRUE(SharePerson(File()).ok());
}

TEST_F(SharedPeopleTest, WhoIsNotThereIsAnErrorThatNamesTheFile) {
  const Result<SharedPerson> nobody = SharePerson(paths_.Human("ben"));
  ASSERT_FALSE(nobody.ok());
  EXPECT_NE(nobody.message().find("ben"), std::string::npos);
  EXPECT_TRUE(SharePerson(File()).ok());
}

}  // namespace
}  // namespace lararium::app
