#include "editor/jobs/background_task.h"

#include <gtest/gtest.h>

#include <future>
#include <thread>

namespace lararium::editor {
namespace {

void PollUntilEmpty(TaskList& tasks) {
  while (!tasks.entries().empty()) {
    tasks.Poll();
    std::this_thread::yield();
  }
}

TEST(StepCount, TellsHowFarAllOfTheWorkIs) {
  StepCount steps({{"read", 1.0}, {"think", 2.0}, {"write", 1.0}});
  EXPECT_EQ(steps.count(), 3);
  EXPECT_EQ(steps.number(), 1);
  EXPECT_EQ(steps.fraction(), 0.0);
  steps.Report("read", 0.5);
  EXPECT_DOUBLE_EQ(steps.fraction(), 0.125);
  steps.Report("think", 0.5);
  EXPECT_EQ(steps.number(), 2);
  EXPECT_DOUBLE_EQ(steps.fraction(), 0.5);
}

TEST(StepCount, NeverGoesBack) {
  StepCount steps({{"read"}, {"merge"}, {"read"}, {"merge"}});
  steps.Report("merge", 0.5);
  steps.Report("aside", 0.0);  // An unknown step is part of the current one.
  EXPECT_EQ(steps.number(), 2);
  EXPECT_DOUBLE_EQ(steps.fraction(), 0.375);
  steps.Report("read", 0.0);  // The step of the next round.
  EXPECT_EQ(steps.number(), 3);
  EXPECT_DOUBLE_EQ(steps.fraction(), 0.5);
  steps.Report("merge", 1.0);
  EXPECT_DOUBLE_EQ(steps.fraction(), 1.0);
}

TEST(StepCount, KnowsNothingOfWorkWithoutSteps) {
  StepCount steps;
  steps.Report("read", 0.5);
  EXPECT_EQ(steps.count(), 0);
  EXPECT_EQ(steps.fraction(), 0.0);
}

TEST(TaskList, HandsTheStatusToTheCallerOfPoll) {
  TaskList tasks;
  std::string message;
  tasks.Start(
      TaskKind::kBaking, [](Progress&) { return Status::Error("here", "went wrong"); },
      [&](const Status& status, bool) { message = status.message(); });
  PollUntilEmpty(tasks);
  EXPECT_EQ(message, "here: went wrong");
}

TEST(TaskList, RunsOneTaskOfAKindAtATime) {
  TaskList tasks;
  std::promise<void> release;
  const auto work = [gate = release.get_future().share()](Progress&) {
    gate.wait();
    return Status();
  };
  const auto ignore = [](const Status&, bool) {};
  EXPECT_TRUE(tasks.Start(TaskKind::kBaking, work, ignore));
  EXPECT_TRUE(tasks.Running(TaskKind::kBaking));
  EXPECT_FALSE(tasks.Start(TaskKind::kBaking, work, ignore));
  EXPECT_TRUE(tasks.Start(TaskKind::kTraining, work, ignore));
  release.set_value();
  PollUntilEmpty(tasks);
  EXPECT_FALSE(tasks.Running(TaskKind::kBaking));
}

TEST(TaskList, WorkThatAsksLearnsThatItIsCancelled) {
  TaskList tasks;
  bool was_cancelled = false;
  tasks.Start(
      TaskKind::kBaking,
      [](Progress& progress) {
        while (!progress.Cancelled()) {
          std::this_thread::yield();
        }
        return Status::Error("work", "cancelled");
      },
      [&](const Status&, bool cancelled) { was_cancelled = cancelled; });
  tasks.Cancel(TaskKind::kBaking);
  PollUntilEmpty(tasks);
  EXPECT_TRUE(was_cancelled);
}

TEST(TaskList, DoneMayStartTheNextTask) {
  TaskList tasks;
  bool second_done = false;
  tasks.Start(
      TaskKind::kBaking, [](Progress&) { return Status(); },
      [&](const Status&, bool) {
        tasks.Start(
            TaskKind::kTraining, [](Progress&) { return Status(); },
            [&](const Status&, bool) { second_done = true; });
      });
  PollUntilEmpty(tasks);
  EXPECT_TRUE(second_done);
}

TEST(BackgroundTask, ReportsItsStepAndFraction) {
  std::promise<void> reported;
  std::promise<void> release;
  BackgroundTask task(TaskKind::kBaking, [&](Progress& progress) {
    progress.Report("matching", 0.25);
    reported.set_value();
    release.get_future().wait();
    return Status();
  });
  reported.get_future().wait();
  EXPECT_EQ(task.state().step, "matching");
  EXPECT_DOUBLE_EQ(task.state().fraction, 0.25);
  EXPECT_FALSE(task.outcome().has_value());
  release.set_value();
}

TEST(TimeLeft, FollowsTheFractionDone) {
  EXPECT_FALSE(EstimateSecondsLeft(0.001, 10.0).has_value());
  EXPECT_FALSE(EstimateSecondsLeft(0.5, 0.1).has_value());
  EXPECT_DOUBLE_EQ(*EstimateSecondsLeft(0.25, 10.0), 30.0);
  EXPECT_DOUBLE_EQ(*EstimateSecondsLeft(1.0, 10.0), 0.0);
}

TEST(FormatDuration, UsesTheTwoLargestUnits) {
  EXPECT_EQ(FormatDuration(0.2), "0 s");
  EXPECT_EQ(FormatDuration(59.4), "59 s");
  EXPECT_EQ(FormatDuration(200.0), "3 min 20 s");
  EXPECT_EQ(FormatDuration(3900.0), "1 h 5 min");
}

}  // namespace
}  // namespace lararium::editor
