#include "shared/core/srgb.h"

#include <gtest/gtest.h>

namespace lararium {
namespace {

TEST(Srgb, GivesTheValuesOfTheStandard) {
  EXPECT_EQ(LinearFromSrgb(0.0), 0.0);
  EXPECT_NEAR(LinearFromSrgb(1.0), 1.0, 1e-12);
  EXPECT_NEAR(LinearFromSrgb(0.5), 0.2140411, 1e-7);
  EXPECT_NEAR(SrgbFromLinear(0.5), 0.7353570, 1e-7);
  EXPECT_NEAR(SrgbFromLinear(0.001), 0.01292, 1e-9);
}

TEST(Srgb, EncodingIsTheInverseOfDecoding) {
  for (int byte = 0; byte <= 255; ++byte) {
    const double encoded = byte / 255.0;
    EXPECT_NEAR(SrgbFromLinear(LinearFromSrgb(encoded)), encoded, 1e-6) << byte;
    EXPECT_NEAR(LinearFromSrgb(static_cast<float>(encoded)), LinearFromSrgb(encoded), 1e-6) << byte;
  }
}

}  // namespace
}  // namespace lararium
