#include "shared/show/frame_pipeline.h"

#include <gtest/gtest.h>

#include <semaphore>
#include <thread>

#include "tests/show/small_show.h"

namespace lararium::show {
namespace {

// Signals every frame that it is asked for.
class TellingPoses : public vision::PoseSource {
 public:
  vision::TrackedFrame Track(const geometry::Frame& frame) override {
    asked_.release();
    return fake_.Track(frame);
  }
  // Waits for the next frame that is asked for.
  bool WasAsked() { return asked_.try_acquire_for(std::chrono::seconds(20)); }

 private:
  test::FakePoses fake_;
  std::counting_semaphore<> asked_{0};
};

// Holds every frame until it is released.
class StuckPoses : public vision::PoseSource {
 public:
  vision::TrackedFrame Track(const geometry::Frame& frame) override {
    go_on_.acquire();
    return fake_.Track(frame);
  }
  void LetGo() { go_on_.release(1000); }

 private:
  test::FakePoses fake_;
  std::counting_semaphore<> go_on_{0};
};

class FramePipelineTest : public ::testing::Test {
 protected:
  FrameStages Stages(test::FakeSource& source) { return {source, poses_, *show_, statistics_}; }

  std::shared_ptr<Log> log_ = MakeSilentLog();
  std::unique_ptr<Show> show_ = Show::Create(test::SmallContent(), {}, *log_).value();
  test::FakePoses poses_;
  ShowStatistics statistics_;
};

TEST_F(FramePipelineTest, LockStepPassesEveryFrameOnceInOrder) {
  test::FakeSource source(20);
  LockStep lock_step(Stages(source));
  StagedFrame staged;
  int64_t count = 0;
  while (lock_step.Next(staged).value()) {
    EXPECT_EQ(staged.tracked.frame.index, count);
    EXPECT_NEAR(staged.time, static_cast<double>(count) / 30.0, 1e-9);
    ++count;
  }
  EXPECT_EQ(count, 20);
  EXPECT_EQ(statistics_.ToJson()["track"]["count"], 20);
}

TEST_F(FramePipelineTest, LockStepReportsWhatTheSourceSays) {
  test::FakeSource source(20, 3);
  LockStep lock_step(Stages(source));
  StagedFrame staged;
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(lock_step.Next(staged).value());
  }
  EXPECT_EQ(lock_step.Next(staged).message(), "fake: broken");
  EXPECT_EQ(lock_step.Next(staged).message(), "fake: broken");
}

TEST_F(FramePipelineTest, LockStepHasEndedForGood) {
  test::FakeSource source(1);
  LockStep lock_step(Stages(source));
  StagedFrame staged;
  EXPECT_TRUE(lock_step.Next(staged).value());
  EXPECT_FALSE(lock_step.Next(staged).value());
  EXPECT_FALSE(lock_step.Next(staged).value());
}

TEST_F(FramePipelineTest, LockStepPreparesTheNextFrameWhileOneIsDrawn) {
  test::FakeSource source(20);
  TellingPoses poses;
  LockStep lock_step({source, poses, *show_, statistics_});
  StagedFrame staged;
  EXPECT_TRUE(poses.WasAsked());
  EXPECT_TRUE(lock_step.Next(staged).value());
  EXPECT_TRUE(poses.WasAsked()) << "only one was taken";
  EXPECT_EQ(staged.tracked.frame.index, 0);
  EXPECT_EQ(statistics_.tracking.frames(), 1) << "counts what was not shown yet";
}

TEST_F(FramePipelineTest, LockStepCanBeAbandonedAtAnyMoment) {
  test::FakeSource source(20);
  StagedFrame staged;
  { const LockStep unused(Stages(source)); }
  LockStep lock_step(Stages(source));
  EXPECT_TRUE(lock_step.Next(staged).value());
}

TEST_F(FramePipelineTest, RealtimeDeliversTheLastFrameAndNeverGoesBack) {
  test::FakeSource source(15);
  RealtimePipeline pipeline(Stages(source));
  int64_t last = -1;
  int64_t shown = 0;
  while (!pipeline.Finished()) {
    std::unique_ptr<StagedFrame> staged = pipeline.Take(std::chrono::milliseconds(20));
    if (staged != nullptr) {
      EXPECT_GT(staged->tracked.frame.index, last);
      last = staged->tracked.frame.index;
      ++shown;
      pipeline.Recycle(std::move(staged));
    }
  }
  pipeline.Stop();
  EXPECT_EQ(last, 14);
  EXPECT_EQ(shown + static_cast<int64_t>(statistics_.dropped_frames), 15);
  EXPECT_TRUE(pipeline.status().ok());
}

TEST_F(FramePipelineTest, RealtimeCountsWhatItDroppedOnTopOfWhatOthersDid) {
  int64_t shown = 0;
  for (const int milliseconds : {100, 0}) {  // Duration of drawing; the first one drops frames.
    test::FakeSource source(15);
    RealtimePipeline pipeline(Stages(source));
    while (!pipeline.Finished()) {
      if (std::unique_ptr<StagedFrame> staged = pipeline.Take(std::chrono::milliseconds(20))) {
        ++shown;
        std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
        pipeline.Recycle(std::move(staged));
      }
    }
    pipeline.Stop();
    pipeline.Stop();
  }
  EXPECT_GT(statistics_.dropped_frames, 0u);
  EXPECT_EQ(shown + static_cast<int64_t>(statistics_.dropped_frames), 30);
}

TEST_F(FramePipelineTest, RealtimeStagesIntoThreeFramesHoweverSlowTheyAreDrawn) {
  constexpr size_t kServed = 1000;  // More than there are actors.
  test::FakeSource source(30);
  RealtimePipeline pipeline(Stages(source));
  int fresh = 0;
  while (!pipeline.Finished()) {
    std::unique_ptr<StagedFrame> staged = pipeline.Take(std::chrono::milliseconds(20));
    if (staged != nullptr) {
      fresh += staged->people.actors.capacity() < kServed ? 1 : 0;
      staged->people.actors.reserve(kServed);
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      pipeline.Recycle(std::move(staged));
    }
  }
  pipeline.Stop();
  EXPECT_GT(statistics_.dropped_frames, 0u);
  EXPECT_LE(fresh, 3);
}

TEST_F(FramePipelineTest, RealtimeEndsWithTheFailureOfItsSource) {
  test::FakeSource source(15, 2);
  RealtimePipeline pipeline(Stages(source));
  while (!pipeline.Finished()) {
    (void)pipeline.Take(std::chrono::milliseconds(20));
  }
  EXPECT_EQ(pipeline.status().message(), "fake: broken");
}

TEST_F(FramePipelineTest, RealtimeTellsForHowLongAFrameIsWorkedOn) {
  test::FakeSource source(2);
  StuckPoses poses;
  RealtimePipeline pipeline({source, poses, *show_, statistics_});
  while (pipeline.LongestWork() < 0.05) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  const double before = pipeline.LongestWork();
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_GE(pipeline.LongestWork(), before + 0.02);
  poses.LetGo();
  while (!pipeline.Finished()) {
    (void)pipeline.Take(std::chrono::milliseconds(20));
  }
  EXPECT_EQ(pipeline.LongestWork(), 0.0) << "nothing is left to work on";
}

TEST_F(FramePipelineTest, RealtimeCanBeAbandonedAtAnyMoment) {
  test::FakeSource source(1'000'000);
  RealtimePipeline pipeline(Stages(source));
  EXPECT_NE(pipeline.Take(std::chrono::milliseconds(5000)), nullptr);
}

}  // namespace
}  // namespace lararium::show
