// Recordings of the sample data, as if they were filmed now.

#include <gtest/gtest.h>

#include "editor/train/corner_tracker.h"
#include "editor/train/coverage_guide.h"
#include "shared/capture/frame_source.h"
#include "shared/core/check.h"
#include "tests/support/test_files.h"

namespace lararium::train {
namespace {

CoverageState Film(capture::FrameSource& source) {
  const geometry::CameraModel camera = TypicalCamera(source.width(), source.height());
  CornerTracker tracker(camera);
  CoverageGuide guide(HalfView(camera));
  CoverageState state;
  while (true) {
    const auto frame = source.Next();
    CHECK(frame.ok());
    if (!*frame) {
      return state;
    }
    state = guide.Add(tracker.Measure((*frame)->grey, (*frame)->capture_time));
  }
}

TEST(CoverageOfRecordings, AWalkAcrossTheMaquetteIsSteppedSideways) {
  const auto source = capture::OpenVideo(std::filesystem::path(LARARIUM_SOURCE_DIR) /
                                         "scenes/maquette/maquette.lararium/places/maquette/"
                                         "training.mp4");
  ASSERT_TRUE(source.ok()) << source.message();
  const CoverageState state = Film(**source);
  EXPECT_GT(state.shares.sideways, 0.5);
  EXPECT_GT(state.shares.ahead, 0.3);
  EXPECT_LT(state.shares.all(), 1.0);
}

TEST(CoverageOfRecordings, OneImageAgainAndAgainCoversNothing) {
  const auto source = capture::OpenVideo(std::filesystem::path(LARARIUM_SOURCE_DIR) /
                                         "scenes/maquette/maquette.lararium/places/maquette/"
                                         "training.mp4");
  ASSERT_TRUE(source.ok()) << source.message();
  const auto first = (*source)->Next();
  ASSERT_TRUE(first.ok() && *first);
  const geometry::CameraModel camera = TypicalCamera((*source)->width(), (*source)->height());
  CornerTracker tracker(camera);
  CoverageGuide guide(HalfView(camera));
  CoverageState state;
  for (int i = 0; i < 60; ++i) {
    state = guide.Add(tracker.Measure((*first)->grey, i / 20.0));
  }
  EXPECT_EQ(state.fault, CoverageFault::kStanding);
  EXPECT_EQ(state.shares.all(), 0.0);
}

}  // namespace
}  // namespace lararium::train
