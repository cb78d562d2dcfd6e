#include "editor/session/player_trial.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using testing::ElementsAre;

TEST(TrialArguments, TheRecordingOfTheCameraViewStandsInForTheCamera) {
  const test::TemporaryFolder folder;
  const ProjectPaths paths{folder / "show.lararium"};
  std::filesystem::create_directories(paths.folder);
  PlaceDocument place;
  place.name = "yard";
  place.training = {SourceDocument::Kind::kVideo, "training.mp4"};
  EXPECT_THAT(TrialArguments(paths, place, "a.larshow"),
              ElementsAre("a.larshow", "--place", "yard"))
      << "a recording that is not there";
  std::ofstream(paths.folder / "training.mp4") << "x";
  EXPECT_THAT(TrialArguments(paths, place, "a.larshow"),
              ElementsAre("a.larshow", "--place", "yard", "--video",
                          (paths.folder / "training.mp4").string(), "--loop"));
  std::filesystem::create_directories(paths.folder / "walk");
  place.preview = {SourceDocument::Kind::kImages, "walk"};
  EXPECT_THAT(TrialArguments(paths, place, "a.larshow"),
              ElementsAre("a.larshow", "--place", "yard", "--images",
                          (paths.folder / "walk").string(), "--loop"));
}

}  // namespace
}  // namespace lararium::editor
