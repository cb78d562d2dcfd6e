// Filming with the maquette's recording as a camera, and with a camera that fails, simulated by a
// fake driver.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "editor/jobs/filming.h"
#include "shared/capture/camera_source.h"
#include "shared/core/file.h"
#include "tests/capture/fake_camera.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using testing::HasSubstr;

const std::string kRecording =
    test::SourceDir() / "scenes/maquette/maquette.lararium/places/maquette/training.mp4";

// The number of frames of a film; -1 where it cannot be read to its end.
int64_t FramesOf(const std::filesystem::path& file) {
  const auto film = capture::OpenVideo(file);
  if (!film.ok()) {
    return -1;
  }
  int64_t frames = 0;
  auto frame = (*film)->Next();
  for (; frame.ok() && *frame; frame = (*film)->Next()) {
    ++frames;
  }
  return frame.ok() ? frames : -1;
}

// A camera that is unplugged after a given number of images.
class FailingCamera {
 public:
  explicit FailingCamera(int images) {
    camera_.when_waited = [this, images] {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      camera_.unplugged = ++sent_ > images;
      capture::FakeCamera::Sent sent;
      for (uint32_t i = 0; i < camera_.format.sizeimage; ++i) {
        sent.bytes.push_back(static_cast<uint8_t>(i % 2 == 1 ? 128 : 60 + (i / 64) % 90));
      }
      return sent;
    };
  }

  std::unique_ptr<capture::FrameSource> Open() {
    auto source = capture::OpenCamera("camera 3", camera_.Open(), {});
    EXPECT_TRUE(source.ok()) << source.message();
    return *std::move(source);
  }

 private:
  capture::FakeCamera camera_;
  int sent_ = 0;
};

FilmStep GoOn(const FilmMoment&) { return FilmStep::kGoOn; }

TEST(Film, ACameraThatIsUnpluggedLeavesTheFilmUntilThen) {
  const test::TemporaryFolder folder;
  FailingCamera camera(12);
  const auto filmed = Film(*camera.Open(), folder / "film.mp4", GoOn);
  ASSERT_TRUE(filmed.ok()) << filmed.message();
  EXPECT_EQ(filmed->last.frames, 12);
  EXPECT_THAT(filmed->stopped.message(), HasSubstr("camera 3: gives no image"));
  EXPECT_EQ(FramesOf(folder / "film.mp4"), 12);
}

TEST(Film, ACameraThatFailsBeforeItsFirstImageIsAnErrorAndLeavesNoFile) {
  const test::TemporaryFolder folder;
  FailingCamera camera(0);
  const auto filmed = Film(*camera.Open(), folder / "film.mp4", GoOn);
  EXPECT_THAT(filmed.status().message(), HasSubstr("camera 3: gives no image"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Film, ADiskThatFillsUpEndsTheFilmWhileItCanStillBeCompleted) {
  const test::TemporaryFolder folder;
  FailingCamera camera(1000);
  int asked = 0;
  const auto filmed =
      Film(*camera.Open(), folder / "film.mp4", GoOn, [&](const std::filesystem::path& asked_of) {
        EXPECT_EQ(asked_of, folder.path());
        return std::optional<uint64_t>(++asked <= 7 ? 1'000'000'000 : 1'000'000);
      });
  ASSERT_TRUE(filmed.ok()) << filmed.message();
  EXPECT_THAT(filmed->stopped.message(), HasSubstr("the disk is full: 1 MB are free and 64 MB"));
  EXPECT_EQ(FramesOf(folder / "film.mp4"), 7);
}

TEST(Film, AFullDiskIsAnErrorBeforeAnythingIsFilmed) {
  const test::TemporaryFolder folder;
  FailingCamera camera(1000);
  const auto filmed = Film(*camera.Open(), folder / "film.mp4", GoOn,
                           [](const auto&) { return std::optional<uint64_t>(0); });
  EXPECT_THAT(filmed.status().message(), HasSubstr("make room"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Film, ATaskWhoseCameraFailsHasAFilmAndSaysWhy) {
  const test::TemporaryFolder folder;
  FailingCamera camera(9);
  FilmTask task(camera.Open(), folder / "film.mp4");
  while (!task.outcome()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ASSERT_TRUE(task.outcome()->ok()) << task.outcome()->message();
  EXPECT_FALSE((*task.outcome())->stopped.ok());
  EXPECT_EQ((*task.outcome())->last.frames, 9);
  EXPECT_EQ(FramesOf(task.file()), 9);
}

TEST(Film, ATaskThatNobodyDiscardedKeepsWhatWasFilmed) {
  const test::TemporaryFolder folder;
  FailingCamera camera(1000);
  int64_t seen = 0;
  {
    FilmTask task(camera.Open(), folder / "film.mp4");
    while ((seen = task.moment().frames) < 5 && !task.outcome()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }
  EXPECT_GE(FramesOf(folder / "film.mp4"), seen);
}

TEST(Film, ATaskThatIsDiscardedWhileItFilmsLeavesNoFile) {
  const test::TemporaryFolder folder;
  FailingCamera camera(1000);
  {
    FilmTask task(camera.Open(), folder / "film.mp4");
    while (task.moment().frames < 5 && !task.outcome()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    task.Discard();
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Film, ARecordingIsFilmedAtItsOwnPaceAndKeepsItsFrames) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "new/film.mp4";
  auto camera = OpenFilmCamera(kRecording);
  ASSERT_TRUE(camera.ok()) << camera.message();
  EXPECT_TRUE((*camera)->live());
  const auto begin = std::chrono::steady_clock::now();
  const auto filmed = Film(**camera, file, [](const FilmMoment& moment) {
    return moment.frames == 40 ? FilmStep::kFinish : FilmStep::kGoOn;
  });
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  ASSERT_TRUE(filmed.ok()) << filmed.message();
  EXPECT_TRUE(filmed->stopped.ok()) << filmed->stopped.message();
  const FilmMoment& last = filmed->last;
  EXPECT_EQ(last.frames, 40);
  EXPECT_GE(took.count(), 0.95 * last.seconds);
  EXPECT_EQ(last.bgr->cols, 640);
  EXPECT_GT(last.coverage.moved.norm(), 0.0);
  EXPECT_EQ(FramesOf(file), 40);
}

TEST(Film, WhatIsDiscardedLeavesWhatWasThereBefore) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "film-1.mp4", std::string_view("older")).ok());
  EXPECT_EQ(NewFilmFile(folder.path()), folder / "film-2.mp4");
  auto camera = OpenFilmCamera(kRecording);
  ASSERT_TRUE(camera.ok()) << camera.message();
  const auto last = Film(**camera, folder / "film-1.mp4", [](const FilmMoment& moment) {
    return moment.frames == 3 ? FilmStep::kDiscard : FilmStep::kGoOn;
  });
  EXPECT_THAT(last.status().message(), HasSubstr("cancelled"));
  EXPECT_EQ(*ReadText(folder / "film-1.mp4"), "older");
}

TEST(Film, ATaskTellsItsMomentsAndFinishesWhenAsked) {
  const test::TemporaryFolder folder;
  auto camera = OpenFilmCamera(kRecording);
  ASSERT_TRUE(camera.ok()) << camera.message();
  FilmTask task(*std::move(camera), folder / "film.mp4");
  while (task.moment().frames < 5 && !task.outcome()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_FALSE(task.outcome().has_value());
  task.Finish();
  while (!task.outcome()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_TRUE(task.outcome()->ok()) << task.outcome()->message();
  EXPECT_TRUE(std::filesystem::exists(folder / "film.mp4"));
}

TEST(Film, ATaskThatIsDiscardedAfterItsRecordingHasEndedLeavesNoFile) {
  const test::TemporaryFolder folder;
  auto camera = OpenFilmCamera(kRecording);
  ASSERT_TRUE(camera.ok()) << camera.message();
  {
    FilmTask task(*std::move(camera), folder / "film.mp4");
    while (!task.outcome()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_TRUE(std::filesystem::exists(folder / "film.mp4"));
    task.Discard();
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "film.mp4"));
}

TEST(Film, ACameraThatIsNotThereIsOneError) {
  EXPECT_THAT(OpenFilmCamera("0815").status().message(), HasSubstr("815"));
  EXPECT_THAT(OpenFilmCamera("no such file.mp4").status().message(), HasSubstr("no such file"));
}

}  // namespace
}  // namespace lararium::editor
