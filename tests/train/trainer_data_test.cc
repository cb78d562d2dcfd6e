#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "editor/train/camera_transfer.h"
#include "editor/train/matching.h"
#include "editor/train/trainer.h"
#include "shared/core/median.h"
#include "shared/vision/poses_file.h"
#include "tests/support/test_files.h"
#include "tests/train/part_of_video.h"

namespace lararium::train {
namespace {

// The camera of the images and the true poses by file name.
struct GroundTruth {
  geometry::CameraModel camera;
  std::map<std::string, geometry::Rigid3> camera_from_world;
};

GroundTruth LoadGroundTruth(const std::filesystem::path& file) {
  const auto poses = vision::LoadPoses(file);
  EXPECT_TRUE(poses.ok()) << poses.message();
  GroundTruth truth;
  for (const vision::PoseRecord& pose : *poses) {
    truth.camera = pose.camera;
    truth.camera_from_world[std::filesystem::path(pose.file).filename()] = *pose.camera_from_world;
  }
  return truth;
}

// Position errors of all located frames after alignment by the best similarity, metres.
std::map<std::string, double> CenterErrors(const TrainReport& report, const GroundTruth& truth) {
  std::vector<Eigen::Vector3d> found;
  std::vector<Eigen::Vector3d> expected;
  for (const LocatedFrame& frame : report.located) {
    found.push_back(frame.camera_from_map.Center());
    expected.push_back(truth.camera_from_world.at(frame.name).Center());
  }
  const auto world_from_map = geometry::EstimateSimilarity(expected, found);
  EXPECT_TRUE(world_from_map.ok());
  std::map<std::string, double> errors;
  for (size_t i = 0; i < found.size(); ++i) {
    errors[report.located[i].name] = (*world_from_map * found[i] - expected[i]).norm();
  }
  return errors;
}

double MeanCenterError(const TrainReport& report, const GroundTruth& truth) {
  double sum = 0.0;
  for (const auto& [name, error] : CenterErrors(report, truth)) {
    sum += error;
  }
  return sum / static_cast<double>(report.located.size());
}

Result<TrainResult> TrainFountain(const std::filesystem::path& folder,
                                  const TrainOptions& options) {
  LARARIUM_ASSIGN_OR_RETURN(auto source, capture::OpenImageFolder(folder / "images"));
  NoProgress progress;
  return Train(*source, options, progress, *MakeSilentLog());
}

TEST(TrainerOnFountain, LocatesAllImagesWithinFiveMillimetres) {
  LARARIUM_REQUIRE_DATA(folder, "fountain-P11");
  const GroundTruth truth = LoadGroundTruth(folder / "ground_truth.json");
  TrainOptions options;
  options.intrinsics = truth.camera;
  const Result<TrainResult> result = TrainFountain(folder, options);
  ASSERT_TRUE(result.ok()) << result.message();
  EXPECT_EQ(result->report.located.size(), 11u);
  EXPECT_LT(MeanCenterError(result->report, truth), 0.005);
  EXPECT_LT(result->report.mean_reprojection_error_px, 0.4);
}

TEST(TrainerOnFountain, EstimatesTheFocalLength) {
  LARARIUM_REQUIRE_DATA(folder, "fountain-P11");
  const GroundTruth truth = LoadGroundTruth(folder / "ground_truth.json");
  const Result<TrainResult> result = TrainFountain(folder, TrainOptions());
  ASSERT_TRUE(result.ok()) << result.message();
  EXPECT_EQ(result->report.located.size(), 11u);
  EXPECT_TRUE(result->report.intrinsics_estimated);
  EXPECT_NEAR(result->report.camera.fx, truth.camera.fx, 0.02 * truth.camera.fx);
  EXPECT_LT(MeanCenterError(result->report, truth), 0.02);
}

// The photographs as other cameras would have taken them from the same places: photograph i by
// cameras[camera_of[i]].
void PhotographWith(const std::vector<geometry::CameraModel>& cameras,
                    const std::vector<size_t>& camera_of,
                    const geometry::CameraModel& taken_by,
                    const std::filesystem::path& photographs,
                    const std::filesystem::path& out) {
  auto source = capture::OpenImageFolder(photographs);
  ASSERT_TRUE(source.ok()) << source.message();
  for (const size_t camera : camera_of) {
    const auto frame = (*source)->Next();
    ASSERT_TRUE(frame.ok() && frame->has_value());
    const std::string name = (*source)->FrameName((*frame)->index);
    cv::Mat image = (*frame)->bgr;
    Resample(taken_by, cameras[camera], std::array{&image});
    ASSERT_TRUE(cv::imwrite((out / name).string(), image));
  }
}

geometry::CameraModel CameraOfSize(int width, int height, double focal, double k1) {
  return {width, height, focal, focal, 0.5 * (width - 1), 0.5 * (height - 1), k1};
}

TEST(TrainerOnPhotographs, MakesOneMapOfDifferentCamerasThatNothingTellsApart) {
  LARARIUM_REQUIRE_DATA(folder, "fountain-P11");
  const GroundTruth truth = LoadGroundTruth(folder / "ground_truth.json");
  // The last camera zooms, and its images have the size of the first one.
  const std::vector<geometry::CameraModel> cameras = {
      CameraOfSize(1280, 850, 1180.0, 0.0), CameraOfSize(800, 1100, 1520.0, -0.04),
      CameraOfSize(1024, 768, 1200.0, 0.06), CameraOfSize(1280, 850, 1600.0, 0.0)};
  const std::vector<size_t> camera_of = {0, 1, 2, 0, 3, 1, 0, 2, 3, 0, 1};
  test::TemporaryFolder photographs;
  PhotographWith(cameras, camera_of, truth.camera, folder / "images", photographs.path());
  auto source = capture::OpenImageFolder(photographs.path());
  ASSERT_TRUE(source.ok()) << source.message();
  NoProgress progress;
  const auto result = Train(**source, {}, progress, *MakeSilentLog());
  ASSERT_TRUE(result.ok()) << result.message();
  ASSERT_EQ(result->report.located.size(), 11u);
  EXPECT_LT(MeanCenterError(result->report, truth), 0.05);
  EXPECT_EQ(result->report.cameras.size(), 4u);
  for (size_t i = 0; i < camera_of.size(); ++i) {
    const geometry::CameraModel& expected = cameras[camera_of[i]];
    const geometry::CameraModel& found = result->report.located[i].camera;
    EXPECT_EQ(found.width, expected.width);
    EXPECT_EQ(found.height, expected.height);
    EXPECT_NEAR(found.fx, expected.fx, 0.03 * expected.fx) << i;
  }
  // The map has the observations and images of one camera.
  const vision::SceneDatabase& map = result->database;
  EXPECT_EQ(map.keyframes.size(), 11u);
  std::vector<double> errors;
  for (const vision::Observation& o : map.observations) {
    const auto pixel = map.PixelIn(o.keyframe, map.points[o.point].cast<double>());
    ASSERT_TRUE(pixel.has_value());
    errors.push_back((*pixel - Eigen::Vector2d(o.x, o.y)).norm());
  }
  EXPECT_LT(Median(std::move(errors)), 0.6);
}

TrainOptions MaquetteOptions(const GroundTruth& truth) {
  TrainOptions options;
  options.intrinsics = truth.camera;
  options.max_features = 1500;
  return options;
}

TEST(TrainerOnMaquette, LocatesTheFramesBetweenKeyframesAsWellAsThese) {
  LARARIUM_REQUIRE_DATA(folder, "maquette/training");
  const GroundTruth truth = LoadGroundTruth(folder / "ground_truth.json");
  const auto source = Part{folder / "video.mp4", 0, 119, 1}.Open();
  TrainOptions options = MaquetteOptions(truth);
  options.max_keyframes = 40;
  NoProgress progress;
  const auto result = Train(*source, options, progress, *MakeSilentLog());
  ASSERT_TRUE(result.ok()) << result.message();
  EXPECT_EQ(result->report.located.size(), 120u);
  const auto errors = CenterErrors(result->report, truth);
  double sum[2] = {0.0, 0.0};
  int count[2] = {0, 0};
  for (const LocatedFrame& frame : result->report.located) {
    sum[frame.keyframe] += errors.at(frame.name);
    ++count[frame.keyframe];
  }
  EXPECT_GE(count[false], 80);
  EXPECT_LT(sum[false] / count[false], 0.003);
  EXPECT_LT(sum[false] / count[false], 2.0 * sum[true] / count[true]);
  for (const FrameReport& frame : result->report.frame_reports) {
    EXPECT_GT(frame.observations, 100) << frame.name;
    EXPECT_LT(frame.median_error_px, 1.0) << frame.name;
  }
}

// A textured figure that walks through the picture near the camera.
class PasserBy {
 public:
  static constexpr int64_t kFirst = 40;
  static constexpr int64_t kLast = 78;

  PasserBy() : texture_(kHeight, kWidth, CV_8UC3), shape_(kHeight, kWidth, CV_8UC1, cv::Scalar(0)) {
    cv::RNG random(7);
    cv::Mat fine(texture_.size(), CV_32FC3);
    cv::Mat coarse(texture_.size(), CV_32FC3);
    random.fill(fine, cv::RNG::NORMAL, 0.0, 250.0);
    random.fill(coarse, cv::RNG::NORMAL, 0.0, 700.0);
    cv::GaussianBlur(fine, fine, cv::Size(), 1.6);
    cv::GaussianBlur(coarse, coarse, cv::Size(), 5.0);
    cv::Mat(fine + coarse + cv::Scalar::all(110.0)).convertTo(texture_, CV_8UC3);
    cv::circle(shape_, {kWidth / 2, 56}, 55, 255, cv::FILLED);
    cv::ellipse(shape_, {kWidth / 2, 245}, {145, 175}, 0.0, 0.0, 360.0, 255, cv::FILLED);
    cv::rectangle(shape_, {50, 340}, {140, kHeight}, 255, cv::FILLED);
    cv::rectangle(shape_, {160, 340}, {250, kHeight}, 255, cv::FILLED);
  }

  // The position in a frame, as a transform from the figure's pixels to those of the image.
  static cv::Matx23d PlaceIn(int64_t frame) {
    const double way = static_cast<double>(frame - kFirst) / (kLast - kFirst);
    const auto swing = [&](double frames) {
      return std::sin(2.0 * std::numbers::pi * static_cast<double>(frame) / frames);
    };
    const double angle = 0.035 * swing(17.0);
    const double scale = 1.0 + 0.08 * way;
    const cv::Vec2d centre(-150.0 + 940.0 * way, 240.0 + 8.0 * swing(14.0));
    const double c = scale * std::cos(angle);
    const double s = scale * std::sin(angle);
    return {c, -s, centre[0] - c * kWidth / 2 + s * kHeight / 2,
            s, c,  centre[1] - s * kWidth / 2 - c * kHeight / 2};
  }

  // A mask that is 255 where the figure hides the background.
  cv::Mat MaskIn(int64_t frame, const cv::Size& size) const {
    cv::Mat mask(size, CV_8UC1, cv::Scalar(0));
    if (frame >= kFirst && frame <= kLast) {
      cv::warpAffine(shape_, mask, PlaceIn(frame), size, cv::INTER_LINEAR);
    }
    return mask;
  }

  void Paint(geometry::Frame& frame) const {
    cv::Mat figure;
    cv::warpAffine(texture_, figure, PlaceIn(frame.index), frame.bgr.size(), cv::INTER_LINEAR);
    cv::Mat bgr = frame.bgr.clone();
    figure.copyTo(bgr, MaskIn(frame.index, bgr.size()) > 127);
    frame.bgr = bgr;
    frame.grey = cv::Mat();
    cv::cvtColor(bgr, frame.grey, cv::COLOR_BGR2GRAY);
  }

 private:
  static constexpr int kWidth = 300;
  static constexpr int kHeight = 470;
  cv::Mat texture_;
  cv::Mat shape_;
};

class WithPasserBy : public capture::FrameSource {
 public:
  WithPasserBy(std::unique_ptr<FrameSource> place, const PasserBy& passer_by)
      : place_(std::move(place)), passer_by_(passer_by) {}

  Result<std::optional<geometry::Frame>> Next() override {
    auto frame = place_->Next();
    if (frame.ok() && *frame) {
      passer_by_.Paint(**frame);
    }
    return frame;
  }
  Status Seek(int64_t index) override { return place_->Seek(index); }
  std::optional<int64_t> frame_count() const override { return place_->frame_count(); }
  int width() const override { return place_->width(); }
  int height() const override { return place_->height(); }
  double frames_per_second() const override { return place_->frames_per_second(); }
  bool live() const override { return false; }
  std::string FrameName(int64_t index) const override { return place_->FrameName(index); }

 private:
  std::unique_ptr<FrameSource> place_;
  const PasserBy& passer_by_;
};

// Number of matches between two frames that move with the passer-by.
int MatchesOn(const PasserBy& passer_by, const geometry::Frame& a, const geometry::Frame& b) {
  vision::FeatureOptions options;
  options.max_features = 1500;
  const auto in_a = vision::ExtractFeatures(a.grey, options);
  const auto in_b = vision::ExtractFeatures(b.grey, options);
  const cv::Mat mask = passer_by.MaskIn(a.index, a.grey.size());
  cv::Matx23d home;
  cv::invertAffineTransform(PasserBy::PlaceIn(a.index), home);
  int count = 0;
  for (const FeatureMatch& match : MatchDescriptors(in_a->descriptors, in_b->descriptors, 0.8f)) {
    const vision::Keypoint& p = in_a->keypoints[match.a];
    const vision::Keypoint& q = in_b->keypoints[match.b];
    const cv::Vec2d own = home * cv::Vec3d(p.x, p.y, 1.0);
    const cv::Vec2d moved = PasserBy::PlaceIn(b.index) * cv::Vec3d(own[0], own[1], 1.0);
    const bool on_it = mask.at<uint8_t>(static_cast<int>(p.y), static_cast<int>(p.x)) > 127;
    count += on_it && cv::norm(moved - cv::Vec2d(q.x, q.y)) < 1.5 ? 1 : 0;
  }
  return count;
}

TEST(TrainerOnMaquette, PaysNoHeedToAPasserBy) {
  LARARIUM_REQUIRE_DATA(folder, "maquette/training");
  const GroundTruth truth = LoadGroundTruth(folder / "ground_truth.json");
  const PasserBy passer_by;
  const Part part{folder / "video.mp4", 0, 119, 2};
  WithPasserBy source(part.Open(), passer_by);
  // In the middle of its way it hides a third of the image and gives matches of its own.
  const int64_t middle = (PasserBy::kFirst + PasserBy::kLast) / 2 / 2 * 2;
  WithPasserBy crossing(Part{part.video, middle, middle + 2, 2}.Open(), passer_by);
  const auto before = crossing.Next();
  const auto after = crossing.Next();
  ASSERT_TRUE(before.ok() && *before && after.ok() && *after);
  EXPECT_GT(cv::countNonZero(passer_by.MaskIn(middle, {640, 480})), 640 * 480 / 3);
  EXPECT_GT(MatchesOn(passer_by, **before, **after), 300);

  NoProgress progress;
  const auto result = Train(source, MaquetteOptions(truth), progress, *MakeSilentLog());
  ASSERT_TRUE(result.ok()) << result.message();
  EXPECT_EQ(result->report.located.size(), 60u);
  EXPECT_LT(MeanCenterError(result->report, truth), 0.001);
  const vision::SceneDatabase& database = result->database;
  std::vector<cv::Mat> masks;
  for (const vision::Keyframe& keyframe : database.keyframes) {
    masks.push_back(passer_by.MaskIn(keyframe.frame_index, {640, 480}));
  }
  const auto on_it =
      std::count_if(database.observations.begin(), database.observations.end(), [&](const auto& o) {
        return masks[o.keyframe].template at<uint8_t>(static_cast<int>(o.y),
                                                      static_cast<int>(o.x)) > 127;
      });
  EXPECT_LT(static_cast<double>(on_it), 0.005 * static_cast<double>(database.observations.size()));
}

}  // namespace
}  // namespace lararium::train
