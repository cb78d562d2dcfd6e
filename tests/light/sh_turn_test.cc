#include "shared/light/sh_turn.h"

#include <gtest/gtest.h>

#include "tests/light/sh_test_support.h"

namespace lararium::light {
namespace {

// Rotations that include those which keep Z, reverse it, or nearly do.
std::vector<glm::quat> SomeTurns() {
  Random random(47);
  std::vector<glm::quat> turns = {
      glm::quat(1.0f, 0.0f, 0.0f, 0.0f),
      glm::quat(0.0f, 1.0f, 0.0f, 0.0f),
      glm::quat(0.0f, 0.0f, 1.0f, 0.0f),
      glm::quat(0.0f, 0.0f, 0.0f, 1.0f),
      glm::angleAxis(0.7f, glm::vec3(0.0f, 0.0f, 1.0f)),
      glm::angleAxis(1e-4f, glm::normalize(glm::vec3(1.0f, 2.0f, 0.5f))),
      glm::angleAxis(3.1415f, glm::normalize(glm::vec3(3.0f, 1.0f, 1e-4f))),
  };
  std::generate_n(std::back_inserter(turns), 30, [&] { return RandomRotation(random); });
  return turns;
}

class ShTurn : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Counts, ShTurn, testing::Values(9, 16, 25));

TEST_P(ShTurn, AgreesWithTheRotationOfOneAndComesBack) {
  const std::vector<glm::quat> turns = SomeTurns();
  const TurnArrays arrays(turns);
  const auto count = static_cast<size_t>(GetParam());
  Random random(48);
  ShRows source(GetParam(), turns.size()), turned = source, back = source;
  for (size_t i = 0; i < turns.size(); ++i) {
    for (int k = 0; k < GetParam(); ++k) {
      source.at(k, i) = static_cast<float>(random.Normal());
    }
  }
  TurnRows(source, arrays.turns(), TurnDirection::kForth, {0, turns.size()}, turned);
  TurnRows(turned, arrays.turns(), TurnDirection::kBack, {0, turns.size()}, back);
  for (size_t i = 0; i < turns.size(); ++i) {
    std::vector<float> one(count), expected(count);
    for (size_t k = 0; k < count; ++k) {
      one[k] = source.at(static_cast<int>(k), i);
    }
    ShRotation(turns[i]).Apply(one, expected);
    for (size_t k = 0; k < count; ++k) {
      EXPECT_NEAR(turned.at(static_cast<int>(k), i), expected[k], 1e-5) << i << " " << k;
      EXPECT_NEAR(back.at(static_cast<int>(k), i), one[k], 1e-5) << i << " " << k;
    }
  }
}

TEST(ShTurn, ColoursTurnAlike) {
  const TurnArrays turns(SomeTurns());
  const ShRows some(9, turns.w.size());
  ShRowsRgb source = {some, some, some}, turned = source;
  for (size_t channel = 0; channel < 3; ++channel) {
    source[channel].at(3, 5) = static_cast<float>(channel);
  }
  TurnRows(source, turns.turns(), TurnDirection::kForth, {0, turns.w.size()}, turned);
  ShRows alone = some;
  for (size_t channel = 0; channel < 3; ++channel) {
    TurnRows(source[channel], turns.turns(), TurnDirection::kForth, {0, turns.w.size()}, alone);
    EXPECT_EQ(alone.at(1, 5), turned[channel].at(1, 5));
  }
}

TEST(ShTurn, DirectionsComeBackFromWhatTheyTurnInto) {
  const std::vector<glm::quat> turns = SomeTurns();
  const TurnArrays arrays(turns);
  const Turn8 eight(arrays.turns(), 8, kLanes);
  const glm::vec3 direction = glm::normalize(glm::vec3(0.3f, -0.5f, 0.8f));
  Lanes x = {}, y = {}, z = {};
  for (size_t i = 0; i < kLanes; ++i) {
    const glm::vec3 turned = turns[8 + i] * direction;
    x[i] = turned.x;
    y[i] = turned.y;
    z[i] = turned.z;
  }
  eight.Back(x, y, z);
  for (size_t i = 0; i < kLanes; ++i) {
    EXPECT_NEAR(x[i], direction.x, 1e-6);
    EXPECT_NEAR(y[i], direction.y, 1e-6);
    EXPECT_NEAR(z[i], direction.z, 1e-6);
  }
}

}  // namespace
}  // namespace lararium::light
