#include "shared/light/camera_traits.h"

#include <gtest/gtest.h>

#include <string>

#include "shared/core/json.h"

namespace lararium::light {
namespace {

const CameraTraits kTraits = {640, 0.01f, 0.0005f, 0.75f, 0.625f, 0.5f};

std::string Error(const Json& json) {
  return ParseFields<CameraTraits>(JsonView(json, "device.json", "look")).status().message();
}

TEST(CameraTraits, SurviveWritingAndReading) {
  const Json json = FormatFields(kTraits);
  EXPECT_EQ(ParseFields<CameraTraits>(JsonView(json, "test")).value(), kTraits);
  CameraTraits learns = kTraits;
  learns.shutter.reset();
  const Json shorter = FormatFields(learns);
  EXPECT_EQ(ParseFields<CameraTraits>(JsonView(shorter, "test")).value(), learns);
  CameraTraits measured = kTraits;
  measured.response = ShoulderResponse(0.7f);
  const Json longer = Json::parse(FormatFields(measured).dump());
  EXPECT_EQ(ParseFields<CameraTraits>(JsonView(longer, "test")).value(), measured);
}

TEST(CameraTraits, WhatIsImpossibleIsNamed) {
  const auto with = [](const char* key, const Json& value) {
    Json json = FormatFields(kTraits);
    json[key] = value;
    return json;
  };
  EXPECT_NE(Error(with("noise", {0.5, 0.0})).find("noise"), std::string::npos);
  EXPECT_NE(Error(with("noise", {0.1})).find("noise"), std::string::npos);
  EXPECT_NE(Error(with("blur_px", -1.0)).find("blur_px"), std::string::npos);
  EXPECT_NE(Error(with("blur_px", 1e9)).find("blur_px"), std::string::npos);
  EXPECT_NE(Error(with("knee", 0.0)).find("knee"), std::string::npos);
  EXPECT_NE(Error(with("shutter", 2.0)).find("shutter"), std::string::npos);
  Json falls = FormatFields(SrgbResponse());
  falls["g"][100] = 2.0;
  EXPECT_NE(Error(with("response", falls)).find("falls"), std::string::npos);
  EXPECT_NE(Error(with("response", falls)).find("device.json: look.response"), std::string::npos);
  EXPECT_NE(Error(with("width", 0)).find("width"), std::string::npos);
  EXPECT_NE(Error(with("width", "wide")).find("device.json: look"), std::string::npos);
}

}  // namespace
}  // namespace lararium::light
