// Tests that tracking allocates nothing in steady state. This is a program of its own, because it
// replaces the global allocator.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "shared/vision/foreground/foreground_mask.h"
#include "shared/vision/tracker.h"
#include "tests/support/allocation_counter.h"
#include "tests/vision/poster.h"

namespace lararium::vision {
namespace {

constexpr int kSettledMasks = 3;  // Number of frames until a mask's images have their sizes.

using test::Allocations;

class Following : public testing::Test {
 protected:
  static constexpr int kSettled = 5;  // Number of frames until patches are chosen.
  // Frames at which the result of background work is joined, 6 frames after it began.
  static constexpr std::array<int, 2> kJoined = {66, 126};

  Following() : poster_(test::MakePoster()), map_(test::MapOfPoster(poster_)) {
    for (int i = 0; i <= kSwing; ++i) {
      swing_.push_back(
          test::PhotographPoster(poster_, test::PosterPose(0.005 * i, 0.002 * i, 1.5), i));
    }
  }

  // The allocations of each frame in the caller's thread. The camera moves to and fro, so that the
  // images located in the background are similar.
  std::vector<Allocations> Walk(const TrackerOptions& options) const {
    auto tracker = *CreateTracker({map_}, test::kPosterCamera, options);
    // Half of the points lie behind an occluder that does not exist.
    tracker->SetOccluders(
        0, std::vector<OccluderMesh>{{{{-5, -5, 0.3f}, {0, -5, 0.3f}, {0, 5, 0.3f}}, {0, 1, 2}}});
    std::vector<Allocations> all;
    for (int i = 0; i <= kJoined[1]; ++i) {
      const int phase = i % (2 * kSwing);
      geometry::Frame frame = swing_[static_cast<size_t>(std::min(phase, 2 * kSwing - phase))];
      frame.index = i;
      test::CountInThread();
      const TrackedFrame tracked = tracker->Track(frame);
      all.push_back(test::CountedInThread());
      EXPECT_EQ(tracked.followed, i > 0);
    }
    return all;
  }

 private:
  static constexpr int kSwing = 10;  // frames

  cv::Mat poster_;
  std::shared_ptr<const SceneDatabase> map_;
  std::vector<geometry::Frame> swing_;
};

TEST_F(Following, AllocatesNothingInSteadyState) {
  const std::vector<Allocations> all = Walk({});
  EXPECT_GT(all[0].by_new, 0);  // The counter works.
  for (size_t i = kSettled; i < all.size(); ++i) {
    EXPECT_EQ(all[i].by_new, 0) << "frame " << i;
    EXPECT_EQ(all[i].by_malloc, 0) << "frame " << i;
  }
}

// If the background has no thread of its own, the frame that joins it does the work. In steady
// state that allocates the kernels, rows and taps of the Gaussian levels, the lists of extrema and
// orientations of the parallel jobs, and the buffer of std::stable_sort. OpenCV allocates nothing.
TEST_F(Following, AllocatesLittleWhereItDoesTheBackgroundsWork) {
  const std::vector<Allocations> all = Walk({.threads = 1});
  for (size_t i = kSettled; i < all.size(); ++i) {
    const bool joins = i == size_t{kJoined[0]} || i == size_t{kJoined[1]};
    EXPECT_EQ(all[i].by_new > 0, joins) << "frame " << i;
    if (!joins) {
      EXPECT_EQ(all[i].by_malloc, 0) << "frame " << i;
    }
  }
  EXPECT_LE(all[kJoined[1]].by_new, 60);  // measured: 29
  EXPECT_EQ(all[kJoined[1]].by_malloc, 0);
}

// OpenCV allocates tables in cv::resize() and cv::remap(), and images in cv::distanceTransform()
// and cv::connectedComponentsWithStats().
TEST(Foreground, AllocatesLittle) {
  const cv::Mat poster = test::MakePoster();
  const auto map = test::MapOfPoster(poster);
  ForegroundMask mask(map);
  TrackedFrame tracked;
  tracked.camera = test::kPosterCamera;
  tracked.camera_from_map = test::PosterPose(0.05, 0.02, 1.3);
  tracked.frame = test::PhotographPoster(poster, *tracked.camera_from_map, 0);
  const cv::Rect person(200, 60, 100, 240);
  tracked.frame.bgr(person).setTo(cv::Scalar(40, 60, 190));
  cv::cvtColor(tracked.frame.bgr, tracked.frame.grey, cv::COLOR_BGR2GRAY);
  std::vector<SeenPoint> seen;
  for (uint32_t i = 0; i < map->points.size(); ++i) {
    const auto pixel =
        test::kPosterCamera.Project(*tracked.camera_from_map * map->points[i].cast<double>());
    if (pixel && test::kPosterCamera.Contains(*pixel) &&
        !person.contains({static_cast<int>(pixel->x()), static_cast<int>(pixel->y())})) {
      seen.push_back({i, pixel->cast<float>()});
    }
  }
  Allocations frame;
  for (int i = 0; i < kSettledMasks; ++i) {
    test::CountInThread();
    const cv::Mat guide = mask.Estimate(tracked, seen);
    frame = test::CountedInThread();
    ASSERT_FALSE(guide.empty());
  }
  EXPECT_LE(frame.by_new, 90);     // measured: 57
  EXPECT_LE(frame.by_malloc, 40);  // measured: 21
}

}  // namespace
}  // namespace lararium::vision
