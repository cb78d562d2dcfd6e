#include "editor/session/cached.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>

namespace lararium::editor {
namespace {

class CachedTest : public testing::Test {
 protected:
  // Refreshes the value of a key and waits for the task. Returns whether a task was started.
  bool Refresh(int key, const Result<std::string>& result) {
    cached_.Refresh(
        key, TaskKind::kProbe, tasks_, [result](Progress&) { return result; },
        [this](const Status& status, bool) { failure_ = status.message(); });
    const bool started = tasks_.Running(TaskKind::kProbe);
    while (tasks_.Running(TaskKind::kProbe)) {
      tasks_.Poll();
      std::this_thread::yield();
    }
    return started;
  }

  Cached<int, std::string> cached_;
  TaskList tasks_;
  std::string failure_;
};

TEST_F(CachedTest, MakesTheValueOnceForEachKey) {
  EXPECT_TRUE(cached_.Stale(1));
  EXPECT_EQ(cached_.newest(), nullptr);
  EXPECT_TRUE(Refresh(1, std::string("one")));
  EXPECT_FALSE(cached_.Stale(1));
  EXPECT_FALSE(Refresh(1, std::string("again")));
  ASSERT_NE(cached_.Find(1), nullptr);
  EXPECT_EQ(*cached_.Find(1), "one");
  EXPECT_EQ(cached_.Find(2), nullptr);
  const int64_t number = cached_.number();
  EXPECT_TRUE(Refresh(2, std::string("two")));
  EXPECT_EQ(*cached_.newest(), "two");
  EXPECT_NE(cached_.number(), number);
}

TEST_F(CachedTest, AFailureKeepsTheFormerValueAndIsNotAttemptedAgain) {
  Refresh(1, std::string("one"));
  EXPECT_TRUE(Refresh(2, Status::Error("here", "went wrong")));
  EXPECT_EQ(failure_, "here: went wrong");
  EXPECT_EQ(cached_.problem().message(), "here: went wrong");
  EXPECT_EQ(*cached_.newest(), "one");
  EXPECT_EQ(cached_.Find(2), nullptr);
  EXPECT_FALSE(Refresh(2, std::string("two")));
  EXPECT_TRUE(Refresh(3, std::string("three")));
  EXPECT_TRUE(cached_.problem().ok());
}

TEST_F(CachedTest, MakesAForgottenValueAgainAndShowsItUntilThen) {
  Refresh(1, std::string("one"));
  cached_.Forget();
  EXPECT_TRUE(cached_.Stale(1));
  EXPECT_EQ(*cached_.Find(1), "one");
  EXPECT_TRUE(Refresh(1, std::string("new")));
  EXPECT_EQ(*cached_.Find(1), "new");
}

}  // namespace
}  // namespace lararium::editor
