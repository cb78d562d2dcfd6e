#include "shared/vision/features.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "shared/core/parallel.h"
#include "shared/core/random.h"
#include "shared/vision/descriptor_forest.h"

namespace lararium::vision {
namespace {

// Blobs of many sizes and grey levels at random positions.
cv::Mat Picture(int width, int height, uint64_t seed) {
  Random random(seed);
  cv::Mat picture(height, width, CV_32F, cv::Scalar(0.5));
  const int blobs = width * height / 400;
  for (int i = 0; i < blobs; ++i) {
    // One number is drawn in a statement, because compilers order the arguments of a call
    // differently.
    const int y = static_cast<int>(random.Below(height));
    const int x = static_cast<int>(random.Below(width));
    const int half_height = 1 + static_cast<int>(random.Below(10));
    const int half_width = 1 + static_cast<int>(random.Below(10));
    const double grey_level = random.Uniform(0.1, 0.9);
    const double turn_deg = random.Uniform(0.0, 180.0);
    cv::ellipse(picture, cv::Point(x, y), cv::Size(half_width, half_height), turn_deg, 0.0, 360.0,
                cv::Scalar(grey_level), cv::FILLED);
  }
  cv::GaussianBlur(picture, picture, cv::Size(), 0.8);
  cv::Mat grey;
  picture.convertTo(grey, CV_8U, 255.0);
  return grey;
}

Features Extract(const cv::Mat& grey, const FeatureOptions& options = {}) {
  auto features = ExtractFeatures(grey, options);
  EXPECT_TRUE(features.ok());
  return *features;
}

// A Gaussian blob whose centre may lie between pixels.
cv::Mat Blob(double x, double y, double sigma) {
  cv::Mat grey(96, 128, CV_8UC1);
  for (int row = 0; row < grey.rows; ++row) {
    for (int column = 0; column < grey.cols; ++column) {
      const double square = (column - x) * (column - x) + (row - y) * (row - y);
      const double value = 60.0 + 150.0 * std::exp(-0.5 * square / (sigma * sigma));
      grey.at<uint8_t>(row, column) = static_cast<uint8_t>(value + 0.5);
    }
  }
  return grey;
}

TEST(ExtractFeatures, FindsABlobWhereItIsWhateverTheFirstOctave) {
  for (const int first_octave : {-1, 0, 1}) {
    for (const double shift : {0.0, 0.3, 0.5, 0.8}) {
      const double x = 60.0 + shift;
      const double y = 47.0 - shift;
      const double sigma = 6.0;
      FeatureOptions options;
      options.first_octave = first_octave;
      options.max_features = 1;
      const Features features = Extract(Blob(x, y, sigma), options);
      ASSERT_GE(features.size(), 1u);
      EXPECT_NEAR(features.keypoints[0].x, x, 0.05) << "first octave " << first_octave;
      EXPECT_NEAR(features.keypoints[0].y, y, 0.05) << "first octave " << first_octave;
      EXPECT_NEAR(features.keypoints[0].scale, sigma, 0.15 * sigma);
    }
  }
}

struct Agreement {
  int found = 0;
  double median_distance = 0.0;
};

// Counts how many of OpenCV's keypoints are among ours. OpenCV 4.6 puts them a quarter of a pixel
// too far right and down, because it doubles the image about the corner of the top-left pixel and
// not about its centre.
Agreement AgreementWithOpenCv(const std::vector<cv::KeyPoint>& theirs, const Features& ours) {
  Agreement agreement;
  std::vector<double> distances;
  for (const cv::KeyPoint& k : theirs) {
    double nearest = 0.5;
    for (const Keypoint& o : ours.keypoints) {
      const double scale = 0.5 * k.size;
      const double turn = o.angle - k.angle * std::numbers::pi / 180.0;
      if (std::abs(std::log(o.scale / scale)) < 0.1 && std::cos(turn) > 0.99) {
        nearest = std::min(nearest, std::hypot(o.x - (k.pt.x - 0.25), o.y - (k.pt.y - 0.25)));
      }
    }
    if (nearest < 0.5) {
      ++agreement.found;
      distances.push_back(nearest);
    }
  }
  std::sort(distances.begin(), distances.end());
  agreement.median_distance = distances.empty() ? 1.0 : distances[distances.size() / 2];
  return agreement;
}

TEST(ExtractFeatures, FindsWhatOpenCvFinds) {
  const cv::Mat picture = Picture(320, 240, 1);
  std::vector<cv::KeyPoint> theirs;
  cv::SIFT::create(0, 3, 0.04, 10.0, 1.6)->detect(picture, theirs);
  const Features ours = Extract(picture);
  ASSERT_GT(theirs.size(), 200u);
  const Agreement agreement = AgreementWithOpenCv(theirs, ours);
  EXPECT_GT(agreement.found, 0.93 * theirs.size());
  EXPECT_LT(agreement.median_distance, 0.01);
  EXPECT_LT(ours.size(), 1.25 * theirs.size());
}

// The picture transformed by x' = A x + t; where it shrinks it is blurred first, as a lens would.
cv::Mat Warped(const cv::Mat& picture, const Eigen::Matrix2d& a, const Eigen::Vector2d& t) {
  cv::Mat blurred = picture;
  const double scale = std::sqrt(a.determinant());
  if (scale < 1.0) {
    cv::GaussianBlur(picture, blurred, cv::Size(), 0.7 * std::sqrt(1.0 / (scale * scale) - 1.0));
  }
  const cv::Mat matrix =
      (cv::Mat_<double>(2, 3) << a(0, 0), a(0, 1), t.x(), a(1, 0), a(1, 1), t.y());
  cv::Mat warped;
  cv::warpAffine(blurred, warped, matrix, picture.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
  return warped;
}

TEST(ExtractFeatures, MatchesItselfUnderRotationAndScale) {
  const cv::Mat picture = Picture(480, 360, 2);
  const Eigen::Vector2d centre(239.5, 179.5);
  const Features reference = Extract(picture);
  for (const auto& [degrees, scale] :
       {std::pair(10.0, 1.0), std::pair(45.0, 0.8), std::pair(170.0, 1.25), std::pair(0.0, 0.6)}) {
    const Eigen::Matrix2d a =
        scale * Eigen::Rotation2Dd(degrees * std::numbers::pi / 180.0).toRotationMatrix();
    const Eigen::Vector2d t = centre - a * centre;
    const Features features = Extract(Warped(picture, a, t));
    const DescriptorForest forest = BuildForest(reference.descriptors, {});
    ForestSearcher searcher(forest, reference.descriptors);
    int matches = 0;
    int right = 0;
    std::vector<double> errors;
    for (size_t f = 0; f < features.size(); ++f) {
      std::array<Neighbour, 2> found;
      ASSERT_EQ(searcher.Search(features.descriptors[f], 500, found), 2u);
      const Eigen::Vector2d origin =
          a.inverse() * (Eigen::Vector2d(features.keypoints[f].x, features.keypoints[f].y) - t);
      const bool shown =
          cv::Rect(20, 20, picture.cols - 40, picture.rows - 40)
              .contains(cv::Point(static_cast<int>(origin.x()), static_cast<int>(origin.y())));
      if (shown && found[0].squared_distance < 0.64 * found[1].squared_distance) {
        const Keypoint& from = reference.keypoints[found[0].descriptor];
        const Keypoint& to = features.keypoints[f];
        const double error =
            (a * Eigen::Vector2d(from.x, from.y) + t - Eigen::Vector2d(to.x, to.y)).norm();
        ++matches;
        if (error < 1.5) {
          ++right;
          errors.push_back(error);
        }
      }
    }
    std::sort(errors.begin(), errors.end());
    ASSERT_GT(matches, 80) << degrees << " degrees, scale " << scale;
    EXPECT_GT(right, 0.93 * matches) << degrees << " degrees, scale " << scale;
    EXPECT_LT(errors[errors.size() / 2], 0.15) << degrees << " degrees, scale " << scale;
  }
}

bool Same(const Features& a, const Features& b) {
  if (a.size() != b.size() || a.descriptors != b.descriptors) {
    return false;
  }
  for (size_t i = 0; i < a.size(); ++i) {
    const Keypoint& p = a.keypoints[i];
    const Keypoint& q = b.keypoints[i];
    if (p.x != q.x || p.y != q.y || p.scale != q.scale || p.angle != q.angle ||
        p.response != q.response) {
      return false;
    }
  }
  return true;
}

TEST(ExtractFeatures, IsTheSameForAnyNumberOfThreads) {
  const cv::Mat picture = Picture(320, 240, 3);
  const Features many = Extract(picture);
  const ThreadLimit limit(1);
  EXPECT_TRUE(Same(many, Extract(picture)));
}

TEST(ExtractFeatures, KeepsTheStrongest) {
  const cv::Mat picture = Picture(320, 240, 4);
  const Features all = Extract(picture);
  FeatureOptions options;
  options.max_features = 100;
  const Features some = Extract(picture, options);
  ASSERT_EQ(some.size(), 100u);
  std::vector<float> responses;
  for (const Keypoint& k : all.keypoints) {
    responses.push_back(k.response);
  }
  std::sort(responses.begin(), responses.end(), std::greater<>());
  for (const Keypoint& k : some.keypoints) {
    EXPECT_GE(k.response, responses[99]);
  }
}

TEST(ExtractFeatures, AHigherThresholdKeepsASubset) {
  const cv::Mat picture = Picture(320, 240, 5);
  FeatureOptions options;
  options.contrast_threshold = 0.1f;
  const Features some = Extract(picture, options);
  EXPECT_GT(some.size(), 0u);
  EXPECT_LT(some.size(), Extract(picture).size());
  for (const Keypoint& k : some.keypoints) {
    EXPECT_GE(3.0f * k.response, 0.1f);
  }
}

TEST(ExtractFeatures, GivesDescriptorsOfOneLength) {
  for (const Descriptor& d : Extract(Picture(320, 240, 6)).descriptors) {
    const double length = std::sqrt(static_cast<double>(SquaredDistance(d, Descriptor{})));
    EXPECT_NEAR(length, 512.0, 8.0);
  }
}

TEST(ExtractFeatures, FindsNothingInEmptyOrTinyImages) {
  EXPECT_EQ(Extract(cv::Mat(240, 320, CV_8UC1, cv::Scalar(77))).size(), 0u);
  EXPECT_EQ(Extract(cv::Mat(1, 1, CV_8UC1, cv::Scalar(77))).size(), 0u);
  EXPECT_EQ(Extract(cv::Mat(3, 200, CV_8UC1, cv::Scalar(77))).size(), 0u);
}

TEST(ExtractFeatures, RefusesWhatIsNoGreyImage) {
  EXPECT_FALSE(ExtractFeatures(cv::Mat(), {}).ok());
  EXPECT_FALSE(ExtractFeatures(cv::Mat(10, 10, CV_8UC3, cv::Scalar::all(0)), {}).ok());
  EXPECT_FALSE(ExtractFeatures(cv::Mat(10, 10, CV_32F, cv::Scalar::all(0)), {}).ok());
}

TEST(FeatureOptions, SayWhichFieldIsWrong) {
  EXPECT_TRUE(FeatureOptions().Validate().ok());
  FeatureOptions options;
  options.first_octave = -2;
  EXPECT_NE(options.Validate().message().find("first_octave"), std::string::npos);
  options = {};
  options.scales_per_octave = 0;
  EXPECT_NE(options.Validate().message().find("scales_per_octave"), std::string::npos);
  options = {};
  options.contrast_threshold = std::nanf("");
  EXPECT_NE(options.Validate().message().find("contrast_threshold"), std::string::npos);
  options = {};
  options.edge_threshold = 0.5f;
  EXPECT_NE(options.Validate().message().find("edge_threshold"), std::string::npos);
  options = {};
  options.max_features = -1;
  EXPECT_NE(options.Validate().message().find("max_features"), std::string::npos);
}

}  // namespace
}  // namespace lararium::vision
