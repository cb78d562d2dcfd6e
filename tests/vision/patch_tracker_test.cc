// Tests tracking by patches, one image at a time.

#include "shared/vision/patch_tracker.h"

#include <gtest/gtest.h>

#include <span>

#include "tests/vision/poster.h"

namespace lararium::vision {
namespace {

using geometry::Rigid3;
using test::kPosterCamera;
using test::PosterPose;

class FollowerTest : public testing::TestWithParam<int> {
 protected:
  FollowerTest()
      : poster_(test::MakePoster()),
        map_(std::make_shared<const TrackedMap>(test::MapOfPoster(poster_))) {}

  cv::Mat poster_;
  std::shared_ptr<const TrackedMap> map_;
};

// If the prediction is so far off that only the exhaustive search finds the patches, the evidence
// must be that of the search.
TEST_P(FollowerTest, BelievesWhatTheSearchSawWhereNoLevelFollows) {
  const int levels = GetParam();
  const Rigid3 before = PosterPose(0.05, -0.02, 1.5);
  // A shift that is just out of reach of the alignment on the coarsest level.
  const double shift_px = 5.0 * (1 << (levels - 1));
  const Rigid3 now =
      Rigid3{Eigen::Quaterniond::Identity(), {shift_px * 1.5 / kPosterCamera.fx, 0.0, 0.0}} *
      before;
  const cv::Mat grey = test::PhotographPoster(poster_, now, 1).grey;
  ImagePyramid image;
  image.Build(grey, levels);
  PatchTracker patch_tracker(map_);
  patch_tracker.Start(kPosterCamera, before);
  const FollowedPose followed =
      patch_tracker.Follow(image, ExactCamera(kPosterCamera), std::span(&before, 1), nullptr, 1.0);
  ASSERT_TRUE(followed.reliable);
  EXPECT_LT(test::CornerError(followed.camera_from_map, now), 0.3);
  ASSERT_EQ(patch_tracker.seen().size(), static_cast<size_t>(followed.agreeing));
  for (const SeenPoint& seen : patch_tracker.seen()) {
    const Eigen::Vector3d point = map_->database().points[seen.point].cast<double>();
    const Eigen::Vector2d truth = kPosterCamera.Project(now * point).value();
    EXPECT_LT((seen.pixel.cast<double>() - truth).norm(), 2.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, FollowerTest, testing::Values(1, 2));

}  // namespace
}  // namespace lararium::vision
