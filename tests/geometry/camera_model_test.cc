#include "shared/geometry/camera_model.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>

#include "shared/core/random.h"

namespace lararium::geometry {
namespace {

constexpr CameraModel kFox{540, 960, 687.5, 690.0, 277.0, 482.0, 0.04, -0.06, -0.0007, 0.0012};
constexpr CameraModel kBarrel{640, 480, 420.0, 420.0, 322.0, 236.0, -0.28, 0.07, 0.001, -0.0008};

TEST(CameraModel, UndistortingInvertsDistorting) {
  Random random(1);
  for (const CameraModel& camera : {kFox, kBarrel}) {
    for (int i = 0; i < 1000; ++i) {
      const Eigen::Vector2d pixel{random.Uniform(0, camera.width),
                                  random.Uniform(0, camera.height)};
      EXPECT_LT((camera.PixelFromPlane(camera.PlaneFromPixel(pixel)) - pixel).norm(), 1e-7);
    }
  }
}

TEST(CameraModel, ProjectsThePrincipalRayToThePrincipalPoint) {
  EXPECT_LT((*kFox.Project({0, 0, 2}) - Eigen::Vector2d(kFox.cx, kFox.cy)).norm(), 1e-12);
  EXPECT_FALSE(kFox.Project({0, 0, -2}).has_value());
  EXPECT_FALSE(kFox.Project({0, 0, 0}).has_value());
}

// Beyond the radius at which the distortion folds back, its polynomial returns into the image.
TEST(CameraModel, ShowsNothingFromBeyondTheFoldOfItsDistortion) {
  CameraModel falling = kBarrel;  // The slope falls below zero.
  falling.k2 = 0.0;
  CameraModel wavy = kBarrel;  // The slope falls below zero and rises again.
  wavy.k1 = -0.4;
  wavy.k2 = 0.045;
  CameraModel fox = kFox;
  for (CameraModel camera : {falling, wavy, fox}) {
    camera.p1 = camera.p2 = 0.0;
    double fold = 0.0;  // radius of the fold
    const auto distorted = [&](double r) {
      return r * (1.0 + camera.k1 * r * r + camera.k2 * r * r * r * r);
    };
    while (distorted(fold + 1e-4) > distorted(fold)) {
      fold += 1e-4;
    }
    bool lands_inside = false;
    for (double r = 0.0; r < 6.0; r += 0.01) {
      const auto pixel = camera.Project({0.6 * r, 0.8 * r, 1.0});
      if (std::abs(r - fold) > 0.01) {
        EXPECT_EQ(pixel.has_value(), r < fold) << r;
      }
      lands_inside |= r > fold && camera.Contains(camera.PixelFromPlane({0.6 * r, 0.8 * r}));
    }
    EXPECT_TRUE(lands_inside);  // Makes sure that the case occurs.
  }
}

TEST(CameraModel, ShowsAllThatLiesInTheImage) {
  for (const CameraModel& camera : {kFox, kBarrel}) {
    for (const double x : {-0.5, 0.5 * camera.width, camera.width - 0.5}) {
      for (const double y : {-0.5, 0.5 * camera.height, camera.height - 0.5}) {
        EXPECT_TRUE(camera.Project(camera.PlaneFromPixel({x, y}).homogeneous()).has_value());
      }
    }
  }
}

TEST(CameraModel, ResizingKeepsRays) {
  const CameraModel half = kBarrel.Resized(320, 240);
  const Eigen::Vector2d pixel(100.25, 400.75);
  const Eigen::Vector2d half_pixel =
      0.5 * (pixel + Eigen::Vector2d(0.5, 0.5)) - Eigen::Vector2d(0.5, 0.5);
  EXPECT_LT((half.PlaneFromPixel(half_pixel) - kBarrel.PlaneFromPixel(pixel)).norm(), 1e-9);
}

TEST(CameraModel, ScalesToImagesOfTheSameProportionsOnly) {
  EXPECT_NEAR(kBarrel.ForImages(320, 240)->fx, 0.5 * kBarrel.fx, 1e-12);
  EXPECT_NE(kBarrel.ForImages(1280, 720).message().find("640x480"), std::string::npos);
}

TEST(CameraModel, IsReadFromFourOrEightNumbers) {
  const std::array<double, 8> numbers = {420, 430, 322, 236, -0.28, 0.07, 0.001, -0.0008};
  const CameraModel camera = CameraModel::FromNumbers(numbers, 640, 480).value();
  EXPECT_EQ(camera.fy, 430);
  EXPECT_EQ(camera.p2, -0.0008);
  EXPECT_FALSE(CameraModel::FromNumbers(std::span(numbers).first(4), 640, 480)->HasDistortion());
  EXPECT_FALSE(CameraModel::FromNumbers(std::span(numbers).first(5), 640, 480).ok());
  EXPECT_FALSE(CameraModel::FromNumbers(std::array<double, 4>{}, 640, 480).ok());
}

TEST(CameraModel, DisplayPinholeHasNoBlankCornersAndWastesLittle) {
  for (const CameraModel& camera : {kFox, kBarrel}) {
    const CameraModel display = camera.DisplayPinhole();
    EXPECT_FALSE(display.HasDistortion());
    double margin = std::numeric_limits<double>::max();
    for (int i = 0; i <= 200; ++i) {
      for (const Eigen::Vector2d& border :
           {Eigen::Vector2d(-0.5, -0.5 + display.height * i / 200.0),
            Eigen::Vector2d(display.width - 0.5, -0.5 + display.height * i / 200.0),
            Eigen::Vector2d(-0.5 + display.width * i / 200.0, -0.5),
            Eigen::Vector2d(-0.5 + display.width * i / 200.0, display.height - 0.5)}) {
        const Eigen::Vector2d raw = camera.PixelFromPlane(display.PlaneFromPixel(border));
        margin = std::min({margin, raw.x() + 0.5, raw.y() + 0.5, camera.width - 0.5 - raw.x(),
                           camera.height - 0.5 - raw.y()});
      }
    }
    EXPECT_GT(margin, -0.05);
    EXPECT_LT(margin, 1.0);
  }
}

TEST(CameraModel, ValidateSaysWhatIsImpossible) {
  EXPECT_TRUE(kFox.Validate().ok());
  EXPECT_TRUE(kBarrel.Validate().ok());
  CameraModel camera = kFox;
  camera.fx = 0.0;
  EXPECT_NE(camera.Validate().message().find("focal"), std::string::npos);
  camera = kFox;
  camera.k1 = std::nan("");
  EXPECT_NE(camera.Validate().message().find("finite"), std::string::npos);
  camera = kFox;
  camera.k1 = -5.0;
  EXPECT_NE(camera.Validate().message().find("folds"), std::string::npos);
  EXPECT_FALSE(CameraModel().Validate().ok());
}

}  // namespace
}  // namespace lararium::geometry
