#include "shared/light/glossy_map.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <numbers>

#include "shared/light/octahedral.h"
#include "tests/light/sh_test_support.h"

namespace lararium::light {
namespace {

using ::testing::HasSubstr;

TEST(GlossyMap, PositionsAndDirectionsAreInverse) {
  for (int row = 0; row < GlossyMap::kSize; ++row) {
    for (int column = 0; column < GlossyMap::kSize; ++column) {
      const glm::vec3 direction = GlossyDirection(column, row);
      EXPECT_LT(glm::distance(OctahedralDirection(OctahedralPosition(direction)), direction), 1e-5f)
          << column << " " << row;
    }
  }
}

TEST(GlossyMap, TheBorderFoldsOntoItself) {
  const int last = GlossyMap::kSize - 1;
  for (int i = 0; i <= last; ++i) {
    EXPECT_LT(glm::distance(GlossyDirection(i, 0), GlossyDirection(last - i, 0)), 1e-5f);
    EXPECT_LT(glm::distance(GlossyDirection(last, i), GlossyDirection(last, last - i)), 1e-5f);
  }
}

TEST(GlossyMap, TexelsKeepRadianceWithinTheirBits) {
  for (const float value : {0.0f, 0.001f, 0.37f, 1.0f, 250.0f}) {
    const glm::vec3 kept = UnpackRadiance(PackRadiance(glm::vec3(value)));
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(kept[channel], value, value / 30.0f);
    }
  }
  EXPECT_EQ(UnpackRadiance(PackRadiance(glm::vec3(-1.0f))), glm::vec3(0.0f));
  EXPECT_TRUE(std::isfinite(UnpackRadiance(PackRadiance(glm::vec3(1e9f))).b));
}

TEST(GlossyMap, TheWeightIsTheLobeOfItsHalfWayDirection) {
  for (const double roughness : {0.2, 0.5, 1.0}) {
    const double alpha = roughness * roughness;
    for (const double angle : {0.0, 0.1, 0.5, 1.2}) {
      const double n_h = std::cos(0.5 * angle);
      const double spread = n_h * n_h * (alpha * alpha - 1.0) + 1.0;
      const double lobe = alpha * alpha / (std::numbers::pi * spread * spread);
      const double top = 1.0 / (std::numbers::pi * alpha * alpha);
      EXPECT_NEAR(GlossyWeight(std::cos(angle), roughness), lobe / top * std::cos(angle), 1e-9);
    }
    EXPECT_EQ(GlossyWeight(-0.5, roughness), 0.0);
  }
}

GlossyMap Even(float radiance) {
  return {std::vector<uint32_t>(GlossyMap::kTexels, PackRadiance(glm::vec3(radiance)))};
}

TEST(GlossyMap, BlendsByWeightAndPassesOverWhatIsNotThere) {
  const GlossyMap one = Even(1.0f), three = Even(3.0f), none;
  const GlossyMap* maps[] = {&one, &three, &none, nullptr};
  const float weights[] = {0.25f, 0.25f, 0.25f, 0.25f};
  std::vector<uint32_t> blended(GlossyMap::kTexels);
  BlendGlossyMaps(maps, weights, blended);
  EXPECT_NEAR(UnpackRadiance(blended[100]).r, 1.0f, 0.02f);
}

TEST(GlossyMap, SurvivesItsFile) {
  GlossyMap map = Even(0.5f);
  map.texels[17] = PackRadiance({1.0f, 2.0f, 3.0f});
  const auto read = ParseGlossyMap(SerializeGlossyMap(map), "probe.gloss");
  ASSERT_TRUE(read.ok()) << read.message();
  EXPECT_EQ(read->texels, map.texels);
}

TEST(GlossyMap, RefusesFilesThatAreNone) {
  const std::vector<std::byte> good = SerializeGlossyMap(Even(0.5f));
  const auto problem = [](const std::vector<std::byte>& bytes) {
    return ParseGlossyMap(bytes, "probe.gloss").message();
  };
  EXPECT_THAT(problem({}), HasSubstr("not a reflection map"));
  std::vector<std::byte> bytes = good;
  bytes[0] = std::byte{'X'};
  EXPECT_THAT(problem(bytes), HasSubstr("not a reflection map"));
  bytes = good;
  bytes[4] = std::byte{9};
  EXPECT_THAT(problem(bytes), HasSubstr("version 9"));
  bytes = good;
  bytes.pop_back();
  EXPECT_THAT(problem(bytes), HasSubstr("size"));
  bytes = good;
  const uint32_t infinite = 31u << 6;
  std::memcpy(&bytes[16 + 4 * 50], &infinite, 4);
  EXPECT_THAT(problem(bytes), HasSubstr("not finite"));
}

}  // namespace
}  // namespace lararium::light
