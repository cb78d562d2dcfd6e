#include "editor/train/shutter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shared/core/random.h"
#include "shared/vision/rolling_shutter.h"
#include "tests/train/synthetic_world.h"

namespace lararium::train {
namespace {

using synthetic::MakeWorld;
using synthetic::World;

ImageMotion MotionOf(Random& random) {
  ImageMotion motion;
  for (int i = 0; i < 6; ++i) {
    motion[i] = (i < 3 ? 0.01 : 0.03) * random.Normal();
  }
  return motion;
}

// A world that is filmed by a moving camera with a rolling shutter.
struct Film {
  World world = MakeWorld({.images = 16, .points = 400, .noise_px = 0.2});
  std::vector<ImageMotion> motions;

  Film(const Eigen::Vector2d& readout, uint64_t seed) {
    Random random(seed);
    for (uint32_t image = 0; image < world.pixels.size(); ++image) {
      motions.push_back(MotionOf(random));
      for (size_t i = 0; i < world.pixels[image].size(); ++i) {
        Eigen::Vector2d& pixel = world.pixels[image][i];
        const Eigen::Vector3d& point = world.points[world.point_of[image][i]];
        const Eigen::Vector2d sharp = *world.camera.Project(world.camera_from_world[image] * point);
        const Eigen::Vector2d noise = pixel - sharp;
        Eigen::Vector2d rolled = sharp;
        for (int round = 0; round < 10; ++round) {
          const double time = readout.dot(vision::ReadoutOrder(world.camera, rolled));
          rolled = *world.camera.Project(
              vision::PoseAfter(world.camera_from_world[image], motions[image], time) * point);
        }
        pixel = rolled + noise;
      }
    }
  }

  Reconstruction Located() const {
    Reconstruction reconstruction = world.Unsolved(world.Pairs(11, world.camera), world.camera);
    for (uint32_t image = 0; image < world.pixels.size(); ++image) {
      reconstruction.Locate(image, world.camera_from_world[image]);
    }
    for (uint32_t track = 0; track < reconstruction.tracks().size(); ++track) {
      reconstruction.Triangulate(track, {});
    }
    EXPECT_TRUE(AdjustAll(reconstruction, {0, 8}, {}));
    return reconstruction;
  }
};

TEST(EstimateMotions, FollowsATremblingHand) {
  constexpr double kFrequency = 0.8;  // Radians per frame: 4 Hz at 30 frames a second.
  constexpr double kAmplitude = 0.02;
  std::vector<TimedPose> poses;
  const auto pose_at = [](double time) {
    const double phase = kFrequency * time;
    const Eigen::Vector3d turn(0.0, kAmplitude * std::sin(phase), 0.0);
    return TimedPose{time,
                     {geometry::RotationFromVector(turn),
                      Eigen::Vector3d(kAmplitude * std::cos(phase), 0.0, 0.0)}};
  };
  for (int frame = 0; frame < 40; ++frame) {
    poses.push_back(pose_at(frame));
  }
  const std::vector<ImageMotion> motions = EstimateMotions(poses);
  for (size_t i = 2; i + 2 < poses.size(); ++i) {
    EXPECT_NEAR(motions[i][1], kAmplitude * kFrequency * std::cos(kFrequency * poses[i].time),
                0.03 * kAmplitude * kFrequency);
  }
  // A phone that drops frames and states their times.
  std::vector<TimedPose> uneven;
  for (int frame = 0; frame < 60; ++frame) {
    if (frame % 3 != 1) {
      uneven.push_back(pose_at(frame + 0.1 * std::sin(2.3 * frame)));
    }
  }
  const std::vector<ImageMotion> found = EstimateMotions(uneven);
  for (size_t i = 2; i + 2 < uneven.size(); ++i) {
    EXPECT_NEAR(found[i][1], kAmplitude * kFrequency * std::cos(kFrequency * uneven[i].time),
                0.08 * kAmplitude * kFrequency);
  }
}

class ReadoutOf : public testing::TestWithParam<std::pair<double, double>> {};

TEST_P(ReadoutOf, IsFoundAndStraightensTheMap) {
  const Eigen::Vector2d readout(GetParam().first, GetParam().second);
  const Film film(readout, 3);
  Reconstruction reconstruction = film.Located();
  const double before = film.world.CenterError(reconstruction);
  const auto shutter =
      AdjustToShutter(reconstruction, {0, 8}, film.motions, MapperOptions(), {}, *MakeSilentLog());
  ASSERT_TRUE(shutter);
  EXPECT_LT((shutter->readout - readout).norm(), 0.03) << shutter->readout.transpose();
  EXPECT_EQ(reconstruction.readout(), shutter->readout);
  EXPECT_LT(film.world.CenterError(reconstruction), 0.003);
  EXPECT_LT(film.world.CenterError(reconstruction), 0.5 * before);
}

INSTANTIATE_TEST_SUITE_P(Directions,
                         ReadoutOf,
                         testing::Values(std::pair(0.0, 0.8),     // downwards
                                         std::pair(-0.8, 0.0)));  // upright, from the right

TEST(AdjustToShutter, LeavesTheMapOfAGlobalShutterAlone) {
  const Film film(Eigen::Vector2d::Zero(), 5);
  Reconstruction reconstruction = film.Located();
  const Eigen::Vector3d center = reconstruction.camera_from_map(3).Center();
  EXPECT_FALSE(
      AdjustToShutter(reconstruction, {0, 8}, film.motions, MapperOptions(), {}, *MakeSilentLog()));
  EXPECT_EQ(reconstruction.camera_from_map(3).Center(), center);
  EXPECT_TRUE(reconstruction.readout().isZero(0.0));
}

// A film in which autofocus moves the focal length by a few percent, mapped with a single one.
struct BreathingFilm {
  World world = MakeWorld({.images = 16, .points = 400, .noise_px = 0.2});
  std::vector<double> ratios;
  std::vector<double> times;

  // most: The largest change. mean: What the mean is greater by than the world's focal length.
  explicit BreathingFilm(double most, double mean = 0.0) {
    for (uint32_t image = 0; image < world.pixels.size(); ++image) {
      times.push_back(8.0 * image);
      ratios.push_back(1.0 + mean + most * std::sin(1.3 * image));
      for (Eigen::Vector2d& pixel : world.pixels[image]) {
        const Eigen::Vector2d centre(world.camera.cx, world.camera.cy);
        pixel = centre + ratios[image] * (pixel - centre);
      }
    }
  }

  double MeanRatio() const {
    double sum = 0.0;
    for (const double ratio : ratios) {
      sum += std::log(ratio) / static_cast<double>(ratios.size());
    }
    return std::exp(sum);
  }

  Reconstruction Located(bool refine_intrinsics) const {
    Reconstruction reconstruction = world.Unsolved(world.Pairs(11, world.camera), world.camera);
    for (uint32_t image = 0; image < world.pixels.size(); ++image) {
      reconstruction.Locate(image, world.camera_from_world[image]);
    }
    for (uint32_t track = 0; track < reconstruction.tracks().size(); ++track) {
      reconstruction.Triangulate(track, {.max_error_px = 20.0});
    }
    EXPECT_TRUE(AdjustAll(reconstruction, {0, 8}, {.refine_intrinsics = refine_intrinsics}));
    return reconstruction;
  }
};

TEST(AdjustToBreathing, FindsTheFocalLengthOfEachImageWithAnHonestDeviation) {
  const BreathingFilm film(0.024);
  Reconstruction reconstruction = film.Located(true);
  const double before = film.world.CenterError(reconstruction);
  BundleOptions options{.refine_intrinsics = true};
  ASSERT_TRUE(AdjustToBreathing(reconstruction, {0, 8}, film.times, MapperOptions(), options,
                                *MakeSilentLog()));
  for (uint32_t image = 0; image < film.ratios.size(); ++image) {
    EXPECT_NEAR(reconstruction.camera(image).fx / (film.ratios[image] * film.world.camera.fx), 1.0,
                0.004)
        << image;
  }
  const double mean = film.MeanRatio() * film.world.camera.fx;
  options.refine_breathing = true;
  const double deviation = EstimateDeviation(reconstruction, 0, options).focal_px;
  EXPECT_GT(deviation, 0.0);
  EXPECT_LT(deviation, 0.004 * mean);
  EXPECT_LT(std::abs(reconstruction.camera().fx - mean), 4.0 * deviation);
  EXPECT_LT(film.world.CenterError(reconstruction), 0.3 * before);
}

TEST(AdjustToBreathing, KeepsAGivenCameraWhoseMeanFocalLengthIsAnother) {
  const BreathingFilm film(0.024, 0.03);
  Reconstruction reconstruction = film.Located(false);
  ASSERT_TRUE(
      AdjustToBreathing(reconstruction, {0, 8}, film.times, MapperOptions(), {}, *MakeSilentLog()));
  EXPECT_EQ(reconstruction.camera(), film.world.camera);
  for (uint32_t image = 0; image < film.ratios.size(); ++image) {
    EXPECT_NEAR(reconstruction.camera(image).fx / (film.ratios[image] * film.world.camera.fx), 1.0,
                0.004)
        << image;
  }
}

TEST(AdjustToBreathing, LeavesTheMapOfALensThatStandsStillAlone) {
  const BreathingFilm film(0.0);
  Reconstruction reconstruction = film.Located(true);
  const Eigen::Vector3d center = reconstruction.camera_from_map(3).Center();
  EXPECT_FALSE(AdjustToBreathing(reconstruction, {0, 8}, film.times, MapperOptions(),
                                 {.refine_intrinsics = true}, *MakeSilentLog()));
  EXPECT_EQ(reconstruction.camera_from_map(3).Center(), center);
  EXPECT_EQ(reconstruction.cameras().size(), 1u);
}

TEST(EstimateMotions, AreThoseBetweenTheFramesAround) {
  ImageMotion speed;
  speed << 0.01, -0.02, 0.005, 0.02, 0.01, -0.03;
  std::vector<TimedPose> poses;
  geometry::Rigid3 pose;
  for (int frame = 0; frame < 9; ++frame) {
    if (frame != 6) {  // This one was not located.
      poses.push_back({static_cast<double>(frame), pose});
    }
    pose = vision::PoseAfter(pose, speed, 1.0);
  }
  const std::vector<ImageMotion> motions = EstimateMotions(poses);
  EXPECT_TRUE(motions.front().isZero(0.0));
  EXPECT_LT((motions[3] - speed).norm(), 1e-3);
  EXPECT_LT((motions[5] - speed).norm(), 2e-3);  // Beside the gap.
}

}  // namespace
}  // namespace lararium::train
