#include "shared/stage/task_queue.h"

#include <gtest/gtest.h>

namespace lararium::stage {
namespace {

class TaskQueueTest : public ::testing::Test {
 protected:
  const ActorId actor_ = {0, 1};
  TaskQueue queue_{8};
};

TEST_F(TaskQueueTest, OnlyATaskThatHasEndedIsForgottenAndItsTicketIsNotReused) {
  const TaskId first = queue_.Add({.actor = actor_});
  queue_.Forget(first);
  ASSERT_NE(queue_.Find(first), nullptr);
  queue_.Find(first)->Fail("was stopped");
  queue_.Forget(first);
  EXPECT_EQ(queue_.Find(first), nullptr);
  EXPECT_NE(queue_.Add({.actor = actor_}), first);
}

TEST_F(TaskQueueTest, AnActorThatSitsIsNotBusy) {
  Task& task = *queue_.Find(queue_.Add({.kind = TaskKind::kUse, .actor = actor_}));
  EXPECT_FALSE(queue_.IsBusy(actor_));
  task.stage = TaskStage::kRunning;
  EXPECT_TRUE(queue_.IsBusy(actor_));
  EXPECT_FALSE(queue_.Sits(actor_));
  task.Finish();
  task.stage = TaskStage::kLingering;
  EXPECT_FALSE(queue_.IsBusy(actor_));
  EXPECT_EQ(queue_.SeatOf(actor_), &task);
}

TEST_F(TaskQueueTest, OldReportsAreDroppedAndOpenTasksStay) {
  const TaskId open = queue_.Add({.actor = actor_});
  const TaskId old = queue_.Add({.actor = actor_});
  queue_.Find(old)->Finish();
  for (int i = 0; i < 1100; ++i) {
    queue_.Find(queue_.Add({.actor = actor_}))->Finish();
  }
  EXPECT_NE(queue_.Find(open), nullptr);
  EXPECT_EQ(queue_.Find(old), nullptr);
}

}  // namespace
}  // namespace lararium::stage
