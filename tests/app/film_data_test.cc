// The maquette's recording, filmed as if it were a camera.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "editor/app/filming.h"
#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::app {
namespace {

using testing::HasSubstr;

const std::string kRecording =
    test::SourceDir() / "scenes/maquette/maquette.lararium/places/maquette/training.mp4";

TEST(Film, ARecordingIsFilmedAtItsOwnPaceAndKeepsItsFrames) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "new/film.mp4";
  auto camera = OpenFilmCamera(kRecording);
  ASSERT_TRUE(camera.ok()) << camera.message();
  EXPECT_TRUE((*camera)->live());
  const auto begin = std::chrono::steady_clock::now();
  const auto last = Film(**camera, file, [](const FilmMoment& moment) {
    return moment.frames == 40 ? FilmStep::kFinish : FilmStep::kGoOn;
  });
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  ASSERT_TRUE(last.ok()) << last.message();
  EXPECT_EQ(last->frames, 40);
  EXPECT_GE(took.count(), 0.95 * last->seconds);
  EXPECT_EQ(last->bgr->cols, 640);
  EXPECT_GT(last->coverage.moved.norm(), 0.0);
  const auto filmed = capture::OpenVideo(file);
  ASSERT_TRUE(filmed.ok()) << filmed.message();
  int64_t frames = 0;
  for (auto frame = (*filmed)->Next(); frame.ok() && *frame; frame = (*filmed)->Next()) {
    ++frames;
  }
  EXPECT_EQ(frames, 40);
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
  EXPECT_THAT(last.message(), HasSubstr("cancelled"));
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
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "film.mp4"));
}

TEST(Film, ACameraThatIsNotThereIsOneError) {
  EXPECT_THAT(OpenFilmCamera("0815").status().message(), HasSubstr("815"));
  EXPECT_THAT(OpenFilmCamera("no such file.mp4").status().message(), HasSubstr("no such file"));
}

}  // namespace
}  // namespace lararium::app
