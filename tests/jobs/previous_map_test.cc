#include "editor/jobs/previous_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "editor/jobs/staging.h"
#include "editor/jobs/training.h"
#include "editor/jobs/training_report.h"
#include "shared/core/file.h"
#include "shared/core/random.h"
#include "tests/support/png.h"
#include "tests/support/synthetic_world.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using testing::HasSubstr;

PlaceRecordings Filmed(const std::string& video, int added = 0) {
  PlaceRecordings recordings;
  recordings.training = {SourceDocument::Kind::kVideo, video};
  for (int i = 0; i < added; ++i) {
    recordings.added.push_back({{SourceDocument::Kind::kVideo, "evening.mp4"}, {}});
  }
  return recordings;
}

vision::SceneDatabase MapOf(int points) {
  return test::MakeSceneDatabase(test::MakeSyntheticWorld({.points = points}));
}

class FormerMapTest : public testing::Test {
 protected:
  FormerMapTest() {
    CHECK(CreateProject(paths_, "show").ok());
    place_.name = "site";
  }

  // Takes a map like a training, and sets the place's recordings.
  void Take(const PlaceRecordings& recordings, int points) {
    ASSERT_TRUE(TakeMap(paths_, place_, recordings, MapOf(points)).ok());
    SetRecordings(recordings, place_);
  }
  Status PutBack() {
    const Result<PlaceRecordings> recordings = RestorePreviousMap(paths_, place_);
    if (recordings.ok()) {
      SetRecordings(*recordings, place_);
    }
    return recordings.status();
  }
  size_t Points() { return LoadMap(paths_, "site")->points.size(); }

  test::TemporaryFolder folder_;
  ProjectPaths paths_{folder_ / "show.lararium"};
  PlaceDocument place_;
};

TEST_F(FormerMapTest, IsExchangedWithTheOneAtHandAndBack) {
  Take(Filmed("first.mp4"), 20);
  EXPECT_FALSE(HasPreviousMap(paths_, "site")) << "there was none before the first";
  EXPECT_THAT(PutBack().message(), HasSubstr("has no former map"));
  Take(Filmed("second.mp4", 1), 30);
  ASSERT_TRUE(HasPreviousMap(paths_, "site"));
  ASSERT_TRUE(PutBack().ok());
  EXPECT_EQ(Points(), 20u);
  EXPECT_EQ(place_.training.path, "first.mp4");
  EXPECT_TRUE(place_.added.empty());
  ASSERT_TRUE(PutBack().ok());
  EXPECT_EQ(Points(), 30u);
  EXPECT_EQ(place_.training.path, "second.mp4");
  EXPECT_EQ(place_.added.size(), 1u);
}

TEST_F(FormerMapTest, IsTheOneBeforeTheLastTraining) {
  Take(Filmed("first.mp4"), 20);
  Take(Filmed("second.mp4"), 30);
  Take(Filmed("third.mp4"), 40);
  ASSERT_TRUE(PutBack().ok());
  EXPECT_EQ(Points(), 30u);
  EXPECT_EQ(place_.training.path, "second.mp4");
}

TEST_F(FormerMapTest, OfAVersionWithoutReportsIsOfWhatThePlaceSaid) {
  SetRecordings(Filmed("first.mp4"), place_);
  ASSERT_TRUE(SaveMap(paths_, place_, MapOf(20)).ok());
  Take(Filmed("second.mp4"), 30);
  ASSERT_TRUE(PutBack().ok());
  EXPECT_EQ(Points(), 20u);
  EXPECT_EQ(place_.training.path, "first.mp4");
}

TEST_F(FormerMapTest, DoesNotTakePicksWithIt) {
  Take(Filmed("first.mp4"), 20);
  Take(Filmed("first.mp4", 1), 30);
  place_.picks.floor.picks = {{3, "3", {1, 2}, 0}, {4, "4", {1, 2}, 1}};
  EXPECT_THAT(PutBack().message(), HasSubstr("images that the former map does not have (1)"));
  EXPECT_EQ(Points(), 30u);
  EXPECT_EQ(place_.picks.floor.picks.size(), 2u);
  place_.picks.floor.picks.pop_back();
  EXPECT_TRUE(PutBack().ok());
  EXPECT_EQ(Points(), 20u);
}

TEST_F(FormerMapTest, GoesWithASessionThatIsRemoved) {
  Take(Filmed("first.mp4"), 20);
  vision::SceneDatabase map = MapOf(30);
  for (size_t k = 0; k < map.keyframes.size(); ++k) {
    map.keyframes[k].session = static_cast<uint32_t>(k % 2);
  }
  const std::string first = paths_.Resolve("first.mp4").string() + ": is interlaced";
  const std::string evening = paths_.Resolve("evening.mp4").string() + ": is HLG";
  ASSERT_TRUE(TakeMap(paths_, place_, Filmed("first.mp4", 1), map, {first, evening}).ok());
  SetRecordings(Filmed("first.mp4", 1), place_);
  NoProgress progress;
  ASSERT_TRUE(RemoveFromMap(paths_, place_, 1, progress).ok());
  EXPECT_FALSE(HasPreviousMap(paths_, "site")) << "it has what was picked in that session";
  EXPECT_TRUE(LoadTrainingReport(CurrentMap(paths_, "site").report)->recordings.added.empty());
  EXPECT_EQ(MapWarnings(paths_, "site"), std::vector{first});
}

class Cancels : public Progress {
 public:
  void Report(std::string_view, double) override {}
  bool Cancelled() const override { return true; }
};

TEST_F(FormerMapTest, TrainingThatFailsOrIsCancelledLeavesTheMapAsItWas) {
  Take(Filmed("first.mp4"), 20);
  const Result<std::vector<std::byte>> before = ReadBytes(paths_.Scene("site"));
  const std::filesystem::path images = folder_ / "images";
  std::filesystem::create_directories(images);
  for (const char* name : {"1.png", "2.png", "3.png"}) {
    const auto blank = test::Png(cv::Mat(120, 160, CV_8UC1, cv::Scalar(128)));
    ASSERT_TRUE(WriteFileAtomically(images / name, blank).ok());
  }
  place_.training = {SourceDocument::Kind::kImages, images.string()};
  NoProgress to_the_end;
  Cancels at_once;
  for (Progress* progress :
       {static_cast<Progress*>(&to_the_end), static_cast<Progress*>(&at_once)}) {
    EXPECT_FALSE(TrainPlace(paths_, place_, {}, *progress, *MakeSilentLog()).ok());
    EXPECT_EQ(*ReadBytes(paths_.Scene("site")), *before);
    EXPECT_FALSE(HasPreviousMap(paths_, "site"));
  }
}

// Replaces the map in an endless loop by larger and larger ones, and sometimes restores it.
[[noreturn]] void ReplaceForEver(const ProjectPaths& paths, PlaceDocument place, uint64_t seed) {
  Random random(seed);
  for (int n = 1;; ++n) {
    const PlaceRecordings recordings = Filmed(std::to_string(n) + ".mp4");
    if (!TakeMap(paths, place, recordings, MapOf(10 + n)).ok()) {
      ::_exit(1);
    }
    if (random.Below(2) == 0 && !RestorePreviousMap(paths, place).ok()) {
      ::_exit(1);
    }
  }
}

TEST_F(FormerMapTest, WhoIsKilledWhileReplacingLeavesAWholeMap) {
  constexpr int kKills = 30;
  Take(Filmed("first.mp4"), 10);
  Random random(3);
  for (int kill = 0; kill < kKills; ++kill) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      ReplaceForEver(paths_, place_, static_cast<uint64_t>(kill));
    }
    std::this_thread::sleep_for(std::chrono::microseconds(random.Below(40'000)));
    ::kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the child gave up by itself";
    const Result<vision::SceneDatabase> map = LoadMap(paths_, "site");
    ASSERT_TRUE(map.ok()) << "kill " << kill << ": " << map.message();
    EXPECT_GE(map->points.size(), 10u);
    if (HasPreviousMap(paths_, "site")) {
      const auto former = vision::LoadSceneDatabase(PreviousMap(paths_, "site").scene);
      EXPECT_TRUE(former.ok()) << "kill " << kill << ": " << former.message();
    }
  }
}

}  // namespace
}  // namespace lararium::editor
