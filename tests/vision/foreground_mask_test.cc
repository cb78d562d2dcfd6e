#include "shared/vision/foreground/foreground_mask.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <vector>

#include "shared/core/random.h"
#include "tests/vision/poster.h"

namespace lararium::vision {
namespace {

using test::kPosterCamera;

class ForegroundMaskTest : public testing::Test {
 protected:
  // A photograph of the poster from near the keyframe of its map, tracked with the true pose.
  TrackedFrame Photograph(double x = 0.05, double distance = 1.3) const {
    TrackedFrame tracked;
    tracked.camera = kPosterCamera;
    tracked.camera_from_map = test::PosterPose(x, 0.02, distance);
    tracked.state = TrackState::kTracking;
    tracked.frame = test::PhotographPoster(poster_, *tracked.camera_from_map, 0);
    return tracked;
  }
  // Sets the frame's foreground from the points that are not hidden.
  void Estimate(TrackedFrame& tracked, const cv::Mat& hidden) {
    std::vector<SeenPoint> seen;
    for (uint32_t i = 0; i < map_->points.size(); ++i) {
      const auto pixel =
          kPosterCamera.Project(*tracked.camera_from_map * map_->points[i].cast<double>());
      if (pixel && kPosterCamera.Contains(*pixel) &&
          hidden.at<uint8_t>(static_cast<int>(pixel->y() + 0.5),
                             static_cast<int>(pixel->x() + 0.5)) == 0) {
        seen.push_back({i, pixel->cast<float>()});
      }
    }
    ASSERT_GT(seen.size(), 30u);
    tracked.foreground = mask_.Estimate(tracked, seen);
  }
  static cv::Mat Nothing() {
    return cv::Mat::zeros(kPosterCamera.height, kPosterCamera.width, CV_8UC1);
  }
  // A person of one colour with folds, painted over the photograph. Returns where.
  static cv::Mat PaintPerson(const cv::Scalar& colour, cv::Mat& bgr) {
    cv::Mat where = Nothing();
    cv::ellipse(where, {250, 110}, {34, 45}, 0.0, 0.0, 360.0, 255, cv::FILLED);
    cv::ellipse(where, {250, 300}, {90, 150}, 0.0, 0.0, 360.0, 255, cv::FILLED);
    cv::Mat person(bgr.size(), CV_8UC3, colour);
    for (int x = 0; x < person.cols; x += 14) {
      cv::line(person, {x, 0}, {x + 20, person.rows}, 0.85 * colour, 3);
    }
    cv::GaussianBlur(person, person, {}, 2.0);
    person.copyTo(bgr, where);
    return where;
  }
  static double IntersectionOverUnion(const cv::Mat& opacity, const cv::Mat& truth) {
    const cv::Mat found = opacity > 127;
    return static_cast<double>(cv::countNonZero(found & truth)) / cv::countNonZero(found | truth);
  }

  cv::Mat poster_ = test::MakePoster();
  std::shared_ptr<const SceneDatabase> map_ = test::MapOfPoster(poster_);
  ForegroundMask mask_{map_};
};

TEST_F(ForegroundMaskTest, CoversAPersonWhoStandsBeforeTheMap) {
  for (const cv::Scalar& colour :
       {cv::Scalar(40, 60, 190), cv::Scalar(128, 128, 128), cv::Scalar(220, 215, 210)}) {
    TrackedFrame tracked = Photograph();
    const cv::Mat truth = PaintPerson(colour, tracked.frame.bgr);
    cv::cvtColor(tracked.frame.bgr, tracked.frame.grey, cv::COLOR_BGR2GRAY);
    Estimate(tracked, truth);
    ASSERT_FALSE(tracked.foreground.empty()) << colour;
    EXPECT_GT(IntersectionOverUnion(ForegroundOpacity(tracked), truth), 0.85) << colour;
  }
}

TEST_F(ForegroundMaskTest, FindsNothingBeforeAFreeWall) {
  for (const double x : {-0.1, 0.0, 0.1}) {
    TrackedFrame tracked = Photograph(x);
    Estimate(tracked, Nothing());
    EXPECT_TRUE(ForegroundOpacity(tracked).empty() ||
                cv::mean(ForegroundOpacity(tracked))[0] < 0.01 * 255.0)
        << x;
  }
}

TEST_F(ForegroundMaskTest, IsIndifferentToTheGainOfTheCamera) {
  TrackedFrame tracked = Photograph();
  tracked.frame.bgr.convertTo(tracked.frame.bgr, -1, 0.6);
  const cv::Mat truth = PaintPerson({90, 80, 70}, tracked.frame.bgr);
  cv::cvtColor(tracked.frame.bgr, tracked.frame.grey, cv::COLOR_BGR2GRAY);
  Estimate(tracked, truth);
  ASSERT_FALSE(tracked.foreground.empty());
  EXPECT_GT(IntersectionOverUnion(ForegroundOpacity(tracked), truth), 0.85);
}

// With a wrong pose everything differs, and nothing can be told.
TEST_F(ForegroundMaskTest, StaysEmptyWhereTheKeyframesDoNotExplainTheSeenPoints) {
  TrackedFrame tracked = Photograph();
  tracked.camera_from_map = test::PosterPose(-0.1, -0.08, 1.3);
  Estimate(tracked, Nothing());
  EXPECT_TRUE(tracked.foreground.empty());
}

TEST_F(ForegroundMaskTest, StaysEmptyWithoutAPoseOrSeenPoints) {
  TrackedFrame tracked = Photograph();
  EXPECT_TRUE(mask_.Estimate(tracked, {}).empty());
  tracked.camera_from_map.reset();
  EXPECT_TRUE(mask_.Estimate(tracked, std::vector<SeenPoint>(100)).empty());
  EXPECT_TRUE(ForegroundOpacity(tracked).empty());
}

}  // namespace
}  // namespace lararium::vision
