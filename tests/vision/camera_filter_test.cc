#include "shared/vision/camera_filter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lararium::vision {
namespace {

using geometry::CameraModel;

const CameraModel kSimilar{1280, 720, 1000.0, 1000.0, 650.0, 350.0, 0.1, -0.05, 0.001, 0.0};

CameraMatrix Certain(double share) {
  CameraVector deviations;
  deviations << 0.01, 0.01, 0.0, 0.0, 0.0, 0.002, 2.0, 2.0, 0.005, 0.005;
  deviations *= share;
  return deviations.cwiseAbs2().asDiagonal();
}

CameraEstimate LensOf(double focal, double centre, double k1) {
  CameraEstimate lens = ExactCamera({1280, 720, focal, focal, centre, 360.0, k1, 0.0});
  lens.covariance = Certain(1.0);
  return lens;
}

TEST(CameraFilter, OfAKnownCameraOnlyTheShutterIsNotKnown) {
  const CameraFilter filter(kSimilar, true);
  EXPECT_EQ(filter.now().model, kSimilar);
  EXPECT_EQ(filter.Predict(1.0).Unknown(), kTurnX);
  EXPECT_TRUE(filter.Guess().candidates.empty());
}

TEST(CameraFilter, AnUnknownCameraTakesOnlyASizeFromASimilarOne) {
  CameraFilter filter(kSimilar, false);
  EXPECT_EQ(filter.Guess().prior.Unknown(), kCameraParameters);
  EXPECT_EQ(filter.Guess().prior.model.cx, 639.5);
  EXPECT_EQ(filter.Guess().prior.model.k1, 0.0);
  ASSERT_EQ(filter.Guess().candidates.size(), 1u);
  EXPECT_EQ(filter.Guess().candidates[0], kSimilar);
  filter.SetSize(720, 1280);  // The phone is turned.
  EXPECT_EQ(filter.now().model.width, 720);
  EXPECT_EQ(filter.now().model.cy, 639.5);
  EXPECT_NEAR(filter.now().model.fx, 1000.0, 1e-9);
}

TEST(CameraFilter, WhatIsKnownFadesButNeverBeyondWhatNobodyKnows) {
  CameraFilter filter(kSimilar, false);
  filter.Found(LensOf(900.0, 640.0, 0.05));
  const CameraMatrix least = filter.Guess().prior.covariance;
  double before = 0.0;
  for (const double frames : {1.0, 10.0, 1e3, 1e9}) {
    const double focal = filter.Predict(frames).covariance(kFocal, kFocal);
    EXPECT_GT(focal, before);
    EXPECT_LE(focal, least(kFocal, kFocal) * 1.000001);
    before = focal;
  }
}

TEST(CameraFilter, RecognisesALensThatWasInUse) {
  CameraFilter filter(kSimilar, false);
  filter.Found(LensOf(900.0, 642.0, 0.05));
  CameraEstimate settled = LensOf(902.0, 644.0, 0.06);
  settled.covariance = Certain(0.1);
  filter.Update(settled);
  filter.Found(LensOf(560.0, 636.0, -0.02));
  EXPECT_NEAR(filter.now().model.fx, 560.0, 1e-9);
  EXPECT_EQ(filter.Guess().candidates.size(), 3u);  // The two lenses and the similar camera.
  // One image tells the first lens badly, but well enough to recognise it.
  CameraEstimate poor = LensOf(915.0, 630.0, 0.10);
  poor.covariance = Certain(6.0);
  filter.Found(poor);
  EXPECT_NEAR(filter.now().model.k1, 0.06, 0.01);
  EXPECT_NEAR(filter.now().model.cx, 644.0, 3.0);
  EXPECT_EQ(filter.Guess().candidates.size(), 3u);
}

TEST(CameraFilter, HoldsTheSimilarCameraOnceAnImageLooksLikeIt) {
  CameraFilter filter(kSimilar, false);
  CameraEstimate found = ExactCamera(kSimilar);
  found.model.fx = found.model.fy = 1003.0;
  found.model.k1 += 0.01;
  found.covariance = Certain(3.0);
  filter.Found(found);
  EXPECT_TRUE(filter.held());
  EXPECT_EQ(filter.now().model, kSimilar);
  EXPECT_EQ(filter.Predict(1.0).Unknown(), kTurnX);
  // An image may still come from another lens.
  EXPECT_EQ(filter.Guess().prior.Unknown(), kCameraParameters);
  filter.Found(LensOf(560.0, 636.0, -0.02));
  EXPECT_FALSE(filter.held());
  EXPECT_NEAR(filter.now().model.fx, 560.0, 1e-9);
}

TEST(CameraFilter, KnownIntrinsicsThatImagesGoOnContradictAreGivenUp) {
  CameraFilter filter(kSimilar, true);
  CameraEstimate breathed = filter.Doubted();
  breathed.model.fx = breathed.model.fy = 1015.0;
  breathed.covariance = Certain(1.0);
  EXPECT_FALSE(filter.contradicted());
  filter.Contradict(breathed);
  EXPECT_TRUE(filter.contradicted());
  filter.Contradict(breathed);
  filter.Contradict(filter.Doubted());  // No contradiction: the two before were chance.
  EXPECT_FALSE(filter.contradicted());
  filter.Contradict(breathed);
  filter.Contradict(breathed);
  EXPECT_TRUE(filter.held());
  filter.Contradict(breathed);
  EXPECT_FALSE(filter.held());
  EXPECT_NEAR(filter.now().model.fx, 1015.0, 1e-9);
  EXPECT_EQ(filter.Predict(1.0).Unknown(), kCameraParameters);
}

TEST(CameraFilter, AShutterThatIsKnownNotToRollIsNotEstimatedAnyMore) {
  CameraFilter filter(kSimilar, true);
  CameraEstimate estimate = filter.now();
  estimate.readout = {0.002, -0.004};
  estimate.covariance = Certain(0.0);
  estimate.covariance(kReadoutX, kReadoutX) = estimate.covariance(kReadoutY, kReadoutY) = 1e-4;
  filter.Update(estimate);
  EXPECT_TRUE(filter.now().readout.isZero(0.0));
  EXPECT_EQ(filter.Predict(1.0).Unknown(), 0);
}

TEST(CameraFilter, AReadoutTimeThatJumpsIsLeftOut) {
  CameraFilter filter(kSimilar, true);
  CameraEstimate estimate = filter.now();
  estimate.readout.y() = 0.7;
  estimate.covariance(kReadoutX, kReadoutX) = estimate.covariance(kReadoutY, kReadoutY) =
      0.02 * 0.02;
  filter.Update(estimate);
  estimate.readout.y() = 0.2;
  filter.Update(estimate);
  EXPECT_EQ(filter.now().readout.y(), 0.7);
}

}  // namespace
}  // namespace lararium::vision
