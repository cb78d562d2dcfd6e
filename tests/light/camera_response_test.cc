#include "shared/light/camera_response.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "shared/core/json.h"

namespace lararium::light {
namespace {

TEST(CameraResponse, SrgbIsTheStandard) {
  const CameraResponse srgb = SrgbResponse();
  EXPECT_TRUE(srgb.Validate("camera").ok());
  EXPECT_EQ(srgb.linear[0][0], 0.0f);
  EXPECT_NEAR(srgb.linear[1][128], 0.2158605f, 1e-6f);
  EXPECT_NEAR(srgb.linear[2][255], 1.0f, 1e-6f);
}

TEST(CameraResponse, AShoulderIsFittedAgain) {
  for (const float knee : {0.4f, 0.6f, 0.8f, 1.0f}) {
    const FittedKnee fitted = FitKnee(ShoulderResponse(knee));
    // Nearly linear responses are the hardest to distinguish.
    EXPECT_NEAR(fitted.knee, knee, knee == 1.0f ? 0.05f : 0.011f);
    EXPECT_LT(fitted.residual, 2e-3f);
  }
}

TEST(CameraResponse, SurvivesBeingWritten) {
  const CameraResponse response = ShoulderResponse(0.5f);
  const Json json = Json::parse(FormatFields(response).dump());
  const auto parsed = ParseFields<CameraResponse>(JsonView(json, "camera"));
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_EQ(parsed->linear, response.linear);
}

TEST(CameraResponse, RefusesCurvesThatFallAndWrongSizes) {
  CameraResponse response = SrgbResponse();
  response.linear[1][100] = 2.0f;
  EXPECT_FALSE(response.Validate("camera").ok());
  Json json = FormatFields(response);
  EXPECT_FALSE(ParseFields<CameraResponse>(JsonView(json, "camera")).ok());
  json = FormatFields(SrgbResponse());
  json["g"].erase(0);
  EXPECT_FALSE(ParseFields<CameraResponse>(JsonView(json, "camera")).ok());
  EXPECT_FALSE(CameraResponse().Validate("camera").ok());
}

TEST(CameraResponse, WhatFollowsTheStandardIsSeenAsItIs) {
  const CameraResponse srgb = SrgbResponse();
  for (const float x : {0.0f, 0.001f, 0.02f, 0.18f, 0.5f, 0.97f, 1.0f, 7.0f}) {
    // Between two bytes the curve is assumed to be linear.
    EXPECT_NEAR(srgb.Seen(glm::vec3(x)).g, std::min(x, 1.0f), 2e-5f) << x;
  }
}

TEST(CameraResponse, EachChannelIsSeenByItsOwnCurve) {
  CameraResponse response = SrgbResponse();
  for (float& value : response.linear[2]) {
    value *= 2.0f;  // half the sensitivity
  }
  const glm::vec3 seen = response.Seen(glm::vec3(0.3f));
  EXPECT_NEAR(seen.r, 0.3f, 2e-5f);
  EXPECT_NEAR(seen.b, 0.15f, 2e-5f);
}

TEST(CameraResponse, ShouldersAreSeenAsTheirFormula) {
  const CameraResponse response = ShoulderResponse(0.5f);
  for (const float x : {0.1f, 0.5f, 0.8f, 1.5f, 2.2f}) {
    const float formula = x <= 0.5f ? x : 1.0f - 0.5f * std::exp(-(x - 0.5f) / 0.5f);
    EXPECT_NEAR(response.Seen(glm::vec3(x)).r, formula, 1e-3f) << x;
  }
}

TEST(CameraResponse, ExposuresThatGiveOneByteAreSeenAlike) {
  CameraResponse response = SrgbResponse();
  // A black level: the first thirty bytes mean no light.
  std::fill_n(response.linear[0].begin(), 30, 0.0f);
  EXPECT_TRUE(response.Validate("camera").ok());
  EXPECT_NEAR(response.Seen(glm::vec3(0.0f)).r, SrgbResponse().linear[0][29], 1e-6f);
}

TEST(SeenTable, HasTheCurveAtItsStepsAndNeverFalls) {
  const CameraResponse response = ShoulderResponse(0.6f);
  const std::array table = SeenTable(response);
  EXPECT_EQ(table.front(), glm::vec3(0.0f));
  EXPECT_EQ(table.back(), glm::vec3(1.0f));
  const float u = 100.0f / static_cast<float>(kSeenSteps - 1);
  EXPECT_EQ(table[100], response.Seen(glm::vec3(u / (1.0f - u))));
  for (size_t i = 1; i < kSeenSteps; ++i) {
    EXPECT_GE(table[i].r, table[i - 1].r) << i;
  }
}

TEST(Monotone, PoolsWhatFallsAndKeepsTheRest) {
  CameraResponse::Curve curve = SrgbResponse().linear[0];
  std::swap(curve[40], curve[41]);
  const CameraResponse::Curve rising = Monotone(curve);
  for (size_t i = 1; i < rising.size(); ++i) {
    EXPECT_GE(rising[i], rising[i - 1]) << i;
  }
  EXPECT_FLOAT_EQ(rising[40], rising[41]);
  EXPECT_NEAR(rising[40], 0.5f * (curve[40] + curve[41]), 1e-6f);
  EXPECT_NEAR(rising[200], curve[200], 1e-6f);
}

}  // namespace
}  // namespace lararium::light
