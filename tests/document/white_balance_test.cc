#include "editor/document/white_balance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lararium::editor {
namespace {

TEST(WhiteBalance, KeepsTheProductAndTurnsBack) {
  const glm::vec3 balance = BalanceOf({0.6, -0.25});
  EXPECT_NEAR(balance.r * balance.g * balance.b, 1.0f, 1e-6f);
  EXPECT_NEAR(std::log2(balance.r / balance.b), 0.6f, 1e-6f);
  const WhiteBalance back = WhiteBalanceOf(balance);
  EXPECT_NEAR(back.warmth, 0.6, 1e-6);
  EXPECT_NEAR(back.tint, -0.25, 1e-6);
}

}  // namespace
}  // namespace lararium::editor
