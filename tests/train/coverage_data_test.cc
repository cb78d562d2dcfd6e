// Tests the guide with recordings of the sample data, as if they were being filmed.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "editor/train/corner_tracker.h"
#include "editor/train/coverage_guide.h"
#include "shared/capture/frame_source.h"
#include "shared/core/check.h"
#include "shared/core/json.h"
#include "tests/support/test_files.h"

namespace lararium::train {
namespace {

// The state after each frame.
std::vector<CoverageState> FilmAll(capture::FrameSource& source) {
  const geometry::CameraModel camera = TypicalCamera(source.width(), source.height());
  CornerTracker tracker(camera);
  CoverageGuide guide(HalfView(camera));
  std::vector<CoverageState> states;
  while (true) {
    const auto frame = source.Next();
    CHECK(frame.ok());
    if (!*frame) {
      return states;
    }
    states.push_back(guide.Add(tracker.Measure((*frame)->grey, (*frame)->capture_time)));
  }
}

CoverageState Film(capture::FrameSource& source) { return FilmAll(source).back(); }

// True heading of each image, radians to the right of the first one.
std::vector<double> TrueHeadings(const std::filesystem::path& ground_truth) {
  const Result<Json> json = LoadJson(ground_truth);
  CHECK(json.ok());
  std::vector<double> headings;
  Eigen::Matrix3d first;
  for (const Json& image : (*json)["images"]) {
    const std::vector<double> r = image["world_to_camera"]["R"];
    const Eigen::Matrix3d camera_from_world =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(r.data());
    if (headings.empty()) {
      first = camera_from_world;
    }
    const Eigen::Vector3d ahead = first * camera_from_world.transpose().col(2);
    headings.push_back(std::atan2(ahead.x(), ahead.z()));
  }
  return headings;
}

TEST(CoverageOfRecordings, AWalkAcrossTheMaquetteIsSteppedSideways) {
  const auto source = capture::OpenVideo(test::SourceDir() /
                                         "scenes/maquette/maquette.lararium/places/maquette/"
                                         "training.mp4");
  ASSERT_TRUE(source.ok()) << source.message();
  const CoverageState state = Film(**source);
  EXPECT_GT(state.shares.sideways, 0.5);
  EXPECT_GT(state.shares.ahead, 0.3);
  EXPECT_LT(state.shares.all(), 1.0);
}

TEST(CoverageOfRecordings, DirectionsStayThoseOfTheBeginning) {
  LARARIUM_REQUIRE_DATA(folder, "maquette");
  constexpr double kColumn = 2.0 * std::numbers::pi / CoverageGuide::kColumns;
  for (const char* recording : {"training", "handheld"}) {
    const auto source = capture::OpenVideo(folder / recording / "video.mp4");
    ASSERT_TRUE(source.ok()) << source.message();
    const std::vector<CoverageState> states = FilmAll(**source);
    const std::vector<double> truth = TrueHeadings(folder / recording / "ground_truth.json");
    ASSERT_EQ(states.size(), truth.size());
    double worst = 0.0;
    for (size_t i = 0; i < states.size(); ++i) {
      worst = std::max(worst, std::abs(states[i].heading - truth[i]));
    }
    EXPECT_LT(worst, 0.6 * kColumn) << recording;
    EXPECT_LT(std::abs(states.back().heading - truth.back()), 0.4 * kColumn) << recording;
  }
}

TEST(CoverageOfRecordings, OneImageAgainAndAgainCoversNothing) {
  const auto source = capture::OpenVideo(test::SourceDir() /
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
