#include "editor/train/photometric_reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shared/core/random.h"
#include "tests/support/synthetic_world.h"

namespace lararium::train {
namespace {

constexpr size_t kPoints = 600;
constexpr size_t kKeyframes = 60;
constexpr size_t kOverlap = 8;  // Number of keyframes that observe a point; they form a long chain.

struct PhotoWorld {
  std::vector<Eigen::Vector3f> colours;
  std::vector<std::array<float, 3>> gains;
  std::vector<ColourObservation> observations;

  std::vector<Eigen::Vector3f> Unknown() const {
    return std::vector<Eigen::Vector3f>(colours.size(), Eigen::Vector3f::Constant(-1.0f));
  }
};

struct PhotoOptions {
  double noise = 0.0;          // Standard deviation of the logarithms.
  double outlier_share = 0.0;  // Share of observations with a random value.
  double falloff = 0.0;        // Largest share of light lost at random positions in the image.
};

void Scale(std::array<float, 3>& gain, const std::array<float, 3>& by) {
  for (size_t c = 0; c < 3; ++c) {
    gain[c] *= by[c];
  }
}

// Fixes the scale of the reference: the median of the gains becomes 1.
void Normalise(std::vector<std::array<float, 3>>& gains) {
  std::array<float, 3> inverse;
  for (size_t c = 0; c < 3; ++c) {
    std::vector<float> values;
    for (const auto& gain : gains) {
      values.push_back(gain[c]);
    }
    std::sort(values.begin(), values.end());
    inverse[c] = 1.0f / values[values.size() / 2];
  }
  for (auto& gain : gains) {
    Scale(gain, inverse);
  }
}

PhotoWorld MakePhotoWorld(const PhotoOptions& options) {
  Random random(11);
  PhotoWorld world;
  for (size_t k = 0; k < kKeyframes; ++k) {
    const double t = static_cast<double>(k) / (kKeyframes - 1) - 0.5;
    const double exposure = std::sin(12.0 * t);
    world.gains.push_back({static_cast<float>(std::exp(0.5 * exposure + 0.2 * t)),
                           static_cast<float>(std::exp(0.5 * exposure)),
                           static_cast<float>(std::exp(0.5 * exposure - 0.3 * t))});
  }
  Normalise(world.gains);
  for (size_t p = 0; p < kPoints; ++p) {
    const auto dark_to_bright = [&] { return static_cast<float>(random.Uniform(0.05, 0.3)); };
    world.colours.emplace_back(dark_to_bright(), dark_to_bright(), dark_to_bright());
    const size_t first = p * (kKeyframes - kOverlap) / (kPoints - 1);
    for (size_t k = first; k < first + kOverlap; ++k) {
      ColourObservation observation{static_cast<uint32_t>(p), static_cast<uint32_t>(k), {}};
      const bool outlier = random.Uniform() < options.outlier_share;
      const double light = 1.0 - options.falloff * random.Uniform();
      for (int c = 0; c < 3; ++c) {
        const double clean = world.colours[p][c] * world.gains[k][static_cast<size_t>(c)] * light;
        observation.colour.rgb[c] =
            static_cast<float>(outlier ? random.Uniform(0.01, 1.0)
                                       : clean * std::exp(options.noise * random.Normal()));
      }
      observation.colour.weight = Eigen::Vector3f::Ones();
      world.observations.push_back(observation);
    }
  }
  return world;
}

// Root mean square of logarithmic differences of gains, over all channels.
double GainError(const PhotometricReference& found, const PhotoWorld& world) {
  double sum = 0.0;
  for (size_t k = 0; k < kKeyframes; ++k) {
    for (size_t c = 0; c < 3; ++c) {
      sum += std::pow(std::log(found.gains[k][c] / world.gains[k][c]), 2);
    }
  }
  return std::sqrt(sum / (3.0 * kKeyframes));
}

// Median absolute logarithmic difference of the colours.
double ColourError(const PhotometricReference& found, const PhotoWorld& world) {
  std::vector<double> sizes;
  for (size_t p = 0; p < kPoints; ++p) {
    for (int c = 0; c < 3; ++c) {
      sizes.push_back(std::abs(std::log(found.colours[p][c] / world.colours[p][c])));
    }
  }
  std::nth_element(sizes.begin(), sizes.begin() + sizes.size() / 2, sizes.end());
  return sizes[sizes.size() / 2];
}

TEST(PhotometricReference, IsExactWithoutNoise) {
  const PhotoWorld world = MakePhotoWorld({});
  const auto found = SolvePhotometry(world.observations, kKeyframes, world.Unknown());
  EXPECT_LT(GainError(found, world), 1e-3);
  EXPECT_LT(ColourError(found, world), 1e-3);
}

TEST(PhotometricReference, WithstandsOutliersNoiseAndFalloff) {
  const PhotoWorld world = MakePhotoWorld({.noise = 0.03, .outlier_share = 0.15, .falloff = 0.16});
  const auto found = SolvePhotometry(world.observations, kKeyframes, world.Unknown());
  EXPECT_LT(GainError(found, world), 0.03);
  // The mean falloff of 8 % becomes part of the colours.
  EXPECT_LT(ColourError(found, world), 0.08 + 0.03);
}

TEST(PhotometricReference, FixesTheMedianGain) {
  const PhotoWorld world = MakePhotoWorld({.noise = 0.03});
  const auto found = SolvePhotometry(world.observations, kKeyframes, world.Unknown());
  for (size_t c = 0; c < 3; ++c) {
    size_t above = 0;
    for (const auto& gain : found.gains) {
      above += gain[c] > 1.0f;
    }
    EXPECT_NEAR(above, kKeyframes / 2, 1);
  }
}

TEST(PhotometricReference, KeepsKnownColours) {
  PhotoWorld world = MakePhotoWorld({.noise = 0.01, .outlier_share = 0.1});
  std::vector<Eigen::Vector3f> known = world.Unknown();
  for (size_t p = 0; p < kPoints; p += 3) {
    known[p] = 2.0f * world.colours[p];  // A reference with twice the light.
  }
  const auto found = SolvePhotometry(world.observations, kKeyframes, known);
  for (size_t p = 0; p < kPoints; p += 3) {
    EXPECT_EQ(found.colours[p], known[p]);
  }
  for (auto& gain : world.gains) {
    Scale(gain, {0.5f, 0.5f, 0.5f});
  }
  for (auto& colour : world.colours) {
    colour *= 2.0f;
  }
  EXPECT_LT(GainError(found, world), 0.01);
  EXPECT_LT(ColourError(found, world), 0.01);
}

TEST(PhotometricReference, SaysWhatNoImageShowsWell) {
  PhotoWorld world = MakePhotoWorld({});
  for (ColourObservation& observation : world.observations) {
    if (observation.point == 5) {
      observation.colour.weight[1] = 0.0f;
    }
    if (observation.keyframe == 30) {
      observation.colour.weight.setZero();
    }
  }
  const auto found = SolvePhotometry(world.observations, kKeyframes, world.Unknown());
  EXPECT_GT(found.colours[5][0], 0.0f);
  EXPECT_LT(found.colours[5][1], 0.0f);
  EXPECT_EQ(found.gains[30], (std::array<float, 3>{1.0f, 1.0f, 1.0f}));
}

TEST(PhotometricReference, ReadsTheKeyframesImages) {
  test::SyntheticWorld points = test::MakeSyntheticWorld({.points = 80, .cameras = 4});
  vision::SceneDatabase database = test::MakeSceneDatabase(points);
  std::vector<cv::Mat> images;  // A plain wall under four exposures; the last image is missing.
  for (const uint8_t grey : {100, 120, 140}) {
    images.emplace_back(480, 640, CV_8UC3, cv::Scalar(grey, grey, grey));
  }
  images.emplace_back();
  database.keyframes[3].gain = {3.0f, 3.0f, 3.0f};
  FillPhotometry(database, images);
  ASSERT_TRUE(database.Validate().ok());
  ASSERT_EQ(database.colours.size(), 80u);
  EXPECT_NEAR(database.colours[0][1], vision::LinearFromSrgb(120), 1e-3);
  EXPECT_NEAR(database.keyframes[0].gain[0],
              vision::LinearFromSrgb(100) / vision::LinearFromSrgb(120), 1e-3);
  EXPECT_NEAR(database.keyframes[2].gain[2],
              vision::LinearFromSrgb(140) / vision::LinearFromSrgb(120), 1e-3);
  EXPECT_EQ(database.keyframes[3].gain[0], 3.0f);
}

}  // namespace
}  // namespace lararium::train
