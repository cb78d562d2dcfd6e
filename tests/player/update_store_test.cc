#include "player/updates/update_store.h"

#include <gmock/gmock.h>

#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::player {
namespace {

namespace fs = std::filesystem;
using ::testing::UnorderedElementsAre;

class UpdateStoreTest : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(store_.folder()); }

  void Fetch(uint64_t serial) const {
    ASSERT_TRUE(WriteFileAtomically(store_.part(serial), std::string_view("show")).ok());
    ASSERT_TRUE(store_.Complete(serial).ok());
  }
  uint64_t Chosen(int failed_starts) const { return store_.Choose(failed_starts, *log_).serial; }
  std::vector<std::string> Files() const {
    std::vector<std::string> files;
    for (const auto& entry : fs::directory_iterator(store_.folder())) {
      files.push_back(entry.path().filename().string());
    }
    return files;
  }

  test::TemporaryFolder around_;
  std::shared_ptr<Log> log_ = MakeSilentLog();
  UpdateStore store_{around_ / "updates", around_ / "shipped.larshow"};
};

TEST_F(UpdateStoreTest, PlaysTheShippedShowUntilAnotherIsWhole) {
  EXPECT_EQ(store_.Choose(0, *log_).file, around_ / "shipped.larshow");
  ASSERT_TRUE(WriteFileAtomically(store_.part(5), std::string_view("sh")).ok());
  EXPECT_EQ(Chosen(0), 0u);
  Fetch(5);
  EXPECT_EQ(Chosen(0), 5u);
  EXPECT_EQ(*ReadText(store_.Choose(0, *log_).file), "show");
}

TEST_F(UpdateStoreTest, WhatFailsThreeStartsGivesWayToTheOneBefore) {
  Fetch(5);
  Fetch(6);
  EXPECT_EQ(Chosen(2), 6u);
  EXPECT_EQ(Chosen(3), 5u);
  EXPECT_EQ(Chosen(0), 5u);
  EXPECT_EQ(store_.HighestSerial(), 6u);
  EXPECT_EQ(Chosen(3), 0u);
}

TEST_F(UpdateStoreTest, WhatHasPlayedStaysHoweverOftenItFails) {
  Fetch(5);
  ASSERT_TRUE(store_.MarkGood(5).ok());
  EXPECT_EQ(Chosen(12), 5u);
}

TEST_F(UpdateStoreTest, TheShippedShowIsNeverPutAside) {
  EXPECT_EQ(Chosen(7), 0u);
  EXPECT_TRUE(store_.MarkGood(0).ok());
  EXPECT_THAT(Files(), UnorderedElementsAre());
}

TEST_F(UpdateStoreTest, KeepsTheNewestShowAndTheOneBefore) {
  for (const uint64_t serial : {5, 6, 7}) {
    Fetch(serial);
    ASSERT_TRUE(store_.MarkGood(serial).ok());
  }
  EXPECT_THAT(Files(), UnorderedElementsAre("6.larshow", "6.good", "7.larshow", "7.good"));
}

TEST_F(UpdateStoreTest, KeepsOnePart) {
  for (const uint64_t serial : {5, 6}) {
    ASSERT_TRUE(WriteFileAtomically(store_.part(serial), std::string_view("s")).ok());
  }
  store_.RemoveOtherParts(6);
  EXPECT_THAT(Files(), UnorderedElementsAre("6.part"));
}

TEST_F(UpdateStoreTest, FilesOfOthersAreLeftAlone) {
  for (const char* name :
       {"notes.txt", "x.larshow", "-3.larshow", "99999999999999999999.larshow"}) {
    ASSERT_TRUE(WriteFileAtomically(store_.folder() / name, std::string_view("s")).ok());
  }
  Fetch(5);
  Fetch(6);
  Fetch(7);
  EXPECT_EQ(Chosen(0), 7u);
  EXPECT_EQ(Files().size(), 6u);
}

}  // namespace
}  // namespace lararium::player
