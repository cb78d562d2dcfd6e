#include "shared/geometry/lens_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "shared/core/units.h"
#include "tests/geometry/lens_oracle.h"

namespace lararium::geometry {
namespace {

// A lens with about the field of view of a headset.
LensModel Wide() {
  LensModel lens{960, 1080, 520.0, 520.0, 500.0, 545.0};
  lens.radial = {{{0.20, 0.05, 0.01}, {0.22, 0.06, 0.01}, {0.25, 0.07, 0.01}}};
  return lens;
}

std::string Problem(const LensModel& lens) { return lens.Validate().message(); }

TEST(LensModel, LooksStraightAheadThroughItsMiddle) {
  EXPECT_TRUE(Wide().Validate().ok()) << Problem(Wide());
  EXPECT_LT(Wide().PlaneFromPixel({500.0, 545.0}).norm(), 1e-12);
}

TEST(LensModel, MagnifiesByItsPolynomial) {
  // r = 0.5 to the right: 0.5 (1 + 0.22/4 + 0.06/16 + 0.01/64).
  const Eigen::Vector2d seen = Wide().PlaneFromPixel({760.0, 545.0});
  EXPECT_NEAR(seen.x(), 0.5 * (1.0 + 0.22 / 4 + 0.06 / 16 + 0.01 / 64), 1e-12);
  EXPECT_NEAR(seen.y(), 0.0, 1e-12);
  EXPECT_GT(Wide().PlaneFromPixel({760.0, 545.0}, LensModel::kBlue).x(), seen.x());
  EXPECT_LT(Wide().PlaneFromPixel({760.0, 545.0}, LensModel::kRed).x(), seen.x());
}

TEST(LensModel, IsUndoneByItsInverseAllOverThePart) {
  const LensModel lens = Wide();
  for (double v = 0.0; v < lens.height; v += 53.0) {
    for (double u = 0.0; u < lens.width; u += 47.0) {
      for (const LensModel::Colour colour :
           {LensModel::kRed, LensModel::kGreen, LensModel::kBlue}) {
        const Eigen::Vector2d pixel(u, v);
        const Eigen::Vector2d back =
            test::PixelThrough(lens, lens.PlaneFromPixel(pixel, colour), colour);
        EXPECT_LT((back - pixel).norm(), 1e-8);
      }
    }
  }
}

TEST(LensModel, OfAnglesSpansThem) {
  const LensModel lens =
      LensModel::FromAngles(1000, 800, 50 * kRadiansPerDegree, 40 * kRadiansPerDegree,
                            45 * kRadiansPerDegree, 45 * kRadiansPerDegree);
  ASSERT_TRUE(lens.Validate().ok()) << Problem(lens);
  const Eigen::AlignedBox2d box = lens.SeenBox();
  EXPECT_NEAR(box.min().x(), -std::tan(50 * kRadiansPerDegree), 1e-12);
  EXPECT_NEAR(box.max().x(), std::tan(40 * kRadiansPerDegree), 1e-12);
  EXPECT_NEAR(box.min().y(), -1.0, 1e-12);
  EXPECT_NEAR(box.max().y(), 1.0, 1e-12);
}

TEST(LensModel, SeesNothingOutsideItsBox) {
  LensModel barrel{800, 800, 600.0, 600.0, 400.0, 400.0};
  barrel.radial.fill({-0.2, 0.02, 0.0});
  for (const LensModel& lens : {Wide(), barrel}) {
    Eigen::AlignedBox2d box = lens.SeenBox();
    box.min().array() -= 1e-4;
    box.max().array() += 1e-4;
    for (int v = 0; v < lens.height; v += 9) {
      for (int u = 0; u < lens.width; u += 9) {
        EXPECT_TRUE(box.contains(lens.PlaneFromPixel(Eigen::Vector2d(u, v))));
      }
    }
  }
}

TEST(LensModel, OfTheOtherEyeSeesTheSameMirrored) {
  const LensModel left = Wide();
  const LensModel right = left.Mirrored();
  const Eigen::Vector2d a = left.PlaneFromPixel({10.0, 33.0});
  const Eigen::Vector2d b = right.PlaneFromPixel({left.width - 1.0 - 10.0, 33.0});
  EXPECT_NEAR(a.x(), -b.x(), 1e-12);
  EXPECT_NEAR(a.y(), b.y(), 1e-12);
  EXPECT_EQ(right.Mirrored(), left);
}

TEST(LensModel, SaysWhatIsImpossible) {
  const auto with = [](auto change) {
    LensModel lens = Wide();
    change(lens);
    return Problem(lens);
  };
  EXPECT_NE(with([](LensModel& l) { l.width = 8; }).find("pixels a side"), std::string::npos);
  EXPECT_NE(with([](LensModel& l) { l.fy = 0.0; }).find("focal length"), std::string::npos);
  EXPECT_NE(with([](LensModel& l) { l.cx = 1000.0; }).find("centre"), std::string::npos);
  EXPECT_NE(with([](LensModel& l) {
              l.radial[2] = {-0.5, 0.0, 0.0};
            }).find("folds"),
            std::string::npos);
  EXPECT_NE(with([](LensModel& l) {
              l.radial[0] = {3.0, 1.0, 1.0};
            }).find("outside the eye's field of view"),
            std::string::npos);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(with([&](LensModel& l) { l.radial[1][2] = nan; }).find("finite"), std::string::npos);
}

}  // namespace
}  // namespace lararium::geometry
