#include "editor/jobs/shared_people.h"

#include <gtest/gtest.h>

#include "editor/document/project.h"
#include "editor/jobs/baking.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
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
  const Result<show::CastMember> one = SharePerson(File(), 0.0f);
  ASSERT_TRUE(one.ok()) << one.message();
  const Result<show::CastMember> other = SharePerson(File(), 0.0f);
  ASSERT_TRUE(other.ok()) << other.message();
  EXPECT_EQ(one->human, other->human);
  EXPECT_EQ(one->light, other->light);
}

TEST_F(SharedPeopleTest, AreReadAnewOnceTheirFileHasChanged) {
  const Result<show::CastMember> before = SharePerson(File(), 0.0f);
  ASSERT_TRUE(before.ok()) << before.message();
  ada_.height = 1.8;
  ASSERT_TRUE(BakeHuman(paths_, ada_).ok());
  const Result<show::CastMember> after = SharePerson(File(), 0.0f);
  ASSERT_TRUE(after.ok()) << after.message();
  EXPECT_NE(before->human, after->human);
  EXPECT_NE(before->human->meshes.front().positions, after->human->meshes.front().positions);
}

TEST_F(SharedPeopleTest, WhoeverIsContentWithLessDetailGetsWhoIsThere) {
  const Result<show::CastMember> whole = SharePerson(File(), 0.0f);
  ASSERT_TRUE(whole.ok()) << whole.message();
  const Result<show::CastMember> any = SharePerson(File(), kAnyDetail);
  ASSERT_TRUE(any.ok()) << any.message();
  EXPECT_EQ(any->human, whole->human);
  EXPECT_EQ(any->model, whole->model);
}

TEST_F(SharedPeopleTest, WhoeverWantsMoreDetailReadsTheFile) {
  const Result<show::CastMember> any = SharePerson(File(), kAnyDetail);
  ASSERT_TRUE(any.ok()) << any.message();
  const Result<show::CastMember> whole = SharePerson(File(), 0.0f);
  ASSERT_TRUE(whole.ok()) << whole.message();
  EXPECT_NE(any->human, whole->human);
  EXPECT_EQ(whole->finest, 0.0f);
}

TEST_F(SharedPeopleTest, AreReadAgainAsLongAsTheirFileIsWhatItWas) {
  const show::ReadPerson read = ReadsAgain({File()});
  const Result<show::DrawnPerson> again = read(0, 0.0f);
  ASSERT_TRUE(again.ok()) << again.message();
  EXPECT_FALSE(again->human->meshes.empty());
  EXPECT_TRUE(again->human->clips.empty());
  ada_.height = 1.8;
  ASSERT_TRUE(BakeHuman(paths_, ada_).ok());
  const Result<show::DrawnPerson> changed = read(0, 0.0f);
  ASSERT_FALSE(changed.ok());
  EXPECT_NE(changed.message().find("ada"), std::string::npos);
  EXPECT_NE(changed.message().find("has changed"), std::string::npos);
}

TEST_F(SharedPeopleTest, AreNotKeptWhenNobodyHoldsThem) {
  Result<show::CastMember> held = SharePerson(File(), 0.0f);
  ASSERT_TRUE(held.ok()) << held.message();
  const std::weak_ptr<const human::Human> human = held->human;
  *held = {};
  EXPECT_TRUE(human.expired());
  EXPECT_TRUE(SharePerson(File(), 0.0f).ok());
}

TEST_F(SharedPeopleTest, WhoIsNotThereIsAnErrorThatNamesTheFile) {
  const Result<show::CastMember> nobody = SharePerson(paths_.Human("ben"), 0.0f);
  ASSERT_FALSE(nobody.ok());
  EXPECT_NE(nobody.message().find("ben"), std::string::npos);
  EXPECT_TRUE(SharePerson(File(), 0.0f).ok());
}

}  // namespace
}  // namespace lararium::editor
