#include "shared/light/camera_response.h"

#include <gtest/gtest.h>

#include <cmath>

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
    // Nearly linear ones are told apart least.
    EXPECT_NEAR(fitted.knee, knee, knee == 1.0f ? 0.05f : 0.011f);
    EXPECT_LT(fitted.residual, 2e-3f);
  }
}

TEST(CameraResponse, SurvivesBeingWritten) {
  const CameraResponse response = ShoulderResponse(0.5f);
  const Json json = Json::parse(FormatCameraResponse(response).dump());
  const auto parsed = ParseCameraResponse(JsonView(json, "camera"));
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_EQ(parsed->linear, response.linear);
}

TEST(CameraResponse, RefusesCurvesThatFallAndWrongSizes) {
  CameraResponse response = SrgbResponse();
  response.linear[1][100] = 2.0f;
  EXPECT_FALSE(response.Validate("camera").ok());
  Json json = FormatCameraResponse(response);
  EXPECT_FALSE(ParseCameraResponse(JsonView(json, "camera")).ok());
  json = FormatCameraResponse(SrgbResponse());
  json["g"].erase(0);
  EXPECT_FALSE(ParseCameraResponse(JsonView(json, "camera")).ok());
  EXPECT_FALSE(CameraResponse().Validate("camera").ok());
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
