#include "player/openxr/headset.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>

#include "shared/core/json.h"
#include "shared/core/json_fields.h"

namespace lararium::player {
namespace {

Result<Headset> Parse(std::string_view text) {
  const Json json = ParseJson(text, "device.json").value();
  return ParseFields<Headset>(JsonView(json, "device.json", "headset"), UnknownFields::kIgnore);
}

std::string Problem(std::string_view text) { return Parse(text).status().message(); }

// The position of a point (head axes) on the plane z = 1 of an eye.
Eigen::Vector2d SeenBy(const Headset& headset, Eye eye, const Eigen::Vector3d& in_head) {
  const Eigen::Vector3d in_eye = headset.head_from_eye[eye].Inverse() * in_head;
  return in_eye.hnormalized();
}

TEST(Headset, WithoutMoreHasEyesAsPeopleHaveThem) {
  const Headset headset = Parse("{}").value();
  EXPECT_NEAR(headset.head_from_eye[kRight].translation.x(), 0.0315, 1e-12);
  EXPECT_EQ(headset.picture_distance, 3.0);
  EXPECT_FALSE(headset.stereo);
  EXPECT_FALSE(headset.runtime_shows_room);
  EXPECT_FALSE(headset.panel.has_value());
}

TEST(Headset, KnowsHowLateTheCameraIs) {
  EXPECT_EQ(Parse(R"({"camera": {"delay": 0.04}})")->camera_delay, 0.04);
  EXPECT_NE(Problem(R"({"camera": {"delay": 40}})").find("headset.camera.delay"),
            std::string::npos);
}

TEST(Headset, SaysWhoShowsWhatIsReal) {
  EXPECT_TRUE(Parse(R"({"see_through": "runtime"})").value().runtime_shows_room);
  EXPECT_FALSE(Parse(R"({"see_through": "camera"})").value().runtime_shows_room);
  EXPECT_NE(Problem(R"({"see_through": "glass"})").find("headset.see_through"), std::string::npos);
}

TEST(Headset, TheRightLensMirrorsTheLeftUnlessItIsGiven) {
  const Headset headset = Parse(R"({"panel": {"width": 2000, "height": 1000,
                          "left": {"K": [600, 600, 520, 490], "k1_k2_k3": [0.2, 0.05, 0],
                                   "k1_k2_k3_blue": [0.23, 0.05, 0]}}})")
                              .value();
  const Panel& panel = *headset.panel;
  EXPECT_EQ(panel.width(), 2000);
  EXPECT_EQ(panel.lenses[kRight], panel.lenses[kLeft].Mirrored());
  EXPECT_EQ(panel.lenses[kLeft].radial[geometry::LensModel::kRed][0], 0.2);
  EXPECT_EQ(panel.lenses[kLeft].radial[geometry::LensModel::kBlue][0], 0.23);
  const Headset given =
      Parse(R"({"panel": {"width": 2000, "height": 1000, "left": {"K": [600, 600, 520, 490]},
                          "right": {"field_of_view": [45, 45, 45, 45]}}})")
          .value();
  EXPECT_NEAR(given.panel->lenses[kRight].fx, 500.0, 1e-9);
  EXPECT_NEAR(given.panel->lenses[kRight].cx, 499.5, 1e-9);
}

TEST(Headset, EachEyeFindsThePictureWhereItsPlaneIs) {
  const Headset headset =
      Parse(R"({"camera": {"at": [0.01, -0.04, 0.08], "rotation": [0.9961947, 0.0871557, 0, 0]},
                "left_eye": {"rotation": [0.9990482, 0, -0.0436194, 0]},
                "eye_distance": 0.068, "picture_distance": 2})")
          .value();
  for (const Eye eye : {kLeft, kRight}) {
    for (const Eigen::Vector2d& seen : {Eigen::Vector2d(0.0, 0.0), {0.4, -0.3}, {-0.5, 0.2}}) {
      const Eigen::Vector3d on_plane = 2.0 * seen.homogeneous();  // camera axes
      const Eigen::Vector2d before_eye = SeenBy(headset, eye, headset.head_from_camera * on_plane);
      const Eigen::Vector3d found = headset.CameraFromEyePlane(eye) * before_eye.homogeneous();
      EXPECT_LT((found.hnormalized() - seen).norm(), 1e-6);
    }
  }
}

TEST(Headset, APictureAtInfinityHasNoDisparity) {
  const Headset headset =
      Parse(R"({"picture_distance": "infinity", "camera": {"at": [0, 0, 0.1]}})").value();
  EXPECT_TRUE(std::isinf(headset.picture_distance));
  EXPECT_TRUE(headset.CameraFromEyePlane(kLeft).isIdentity());
  EXPECT_TRUE(headset.CameraFromEyePlane(kRight).isIdentity());
}

TEST(Headset, OnlyInStereoPeopleAreSeenFromEachEye) {
  EXPECT_TRUE(Parse("{}").value().PictureEyeOf(kLeft).in_camera.isZero());
  const Headset stereo =
      Parse(R"({"stereo": true, "eye_distance": 0.064, "camera": {"at": [0, -0.05, 0.08]}})")
          .value();
  const show::PictureEye eye = stereo.PictureEyeOf(kRight);
  EXPECT_LT((eye.in_camera - Eigen::Vector3d(0.032, 0.05, -0.08)).norm(), 1e-12);
  EXPECT_EQ(eye.picture_distance, 3.0);
}

TEST(Headset, WhatIsSeenIsWhatEitherEyeSees) {
  const Headset headset = Parse(R"({"eye_distance": 0.06, "picture_distance": 3,
                "panel": {"width": 2000, "height": 1000,
                          "left": {"K": [1000, 1000, 499.5, 499.5]}}})")
                              .value();
  const show::ViewPart part = headset.SeenPart();
  EXPECT_NEAR(part.min().x(), -0.5 - 0.03 / 3.0, 1e-9);
  EXPECT_NEAR(part.max().x(), 0.5 + 0.03 / 3.0, 1e-9);
  EXPECT_NEAR(part.max().y(), 0.5, 1e-9);
}

TEST(Headset, EachMistakeIsOneErrorThatNamesItsField) {
  const auto has = [](const std::string& text, const char* part) {
    return text.rfind("device.json: headset", 0) == 0 && text.find(part) != std::string::npos;
  };
  const auto panel = [](const std::string& left) {
    return Problem(R"({"panel": {"width": 2000, "height": 1000, "left": )" + left + "}}");
  };
  EXPECT_PRED2(has, panel("{}"), "panel.left: needs either \"K\" or \"field_of_view\"");
  EXPECT_PRED2(has, panel(R"({"K": [1, 1, 1, 1]})"), "panel.left: lens: the focal length");
  EXPECT_PRED2(has, panel(R"({"K": [600, 600, 500, 500], "k1_k2_k3": [-2, 0, 0]})"), "folds");
  EXPECT_PRED2(has, panel(R"({"field_of_view": [45, 45, 45, 90]})"), "1 to 80 degrees");
  EXPECT_PRED2(has, Problem(R"({"panel": {"width": 2001, "height": 10, "left": {}}})"), "height");
  EXPECT_PRED2(has, Problem(R"({"panel": {"width": 2001, "height": 100, "left": {}}})"), "even");
  EXPECT_PRED2(has, Problem(R"({"picture_distance": "far"})"), "\"infinity\"");
  EXPECT_PRED2(has, Problem(R"({"picture_distance": 0.1})"), "picture_distance");
  EXPECT_PRED2(has, Problem(R"({"camera": {"at": [0, 0, 80]}})"), "camera: \"at\"");
  EXPECT_PRED2(has, Problem(R"({"camera": {"rotation": [1, 1, 0, 0]}})"), "unit quaternion");
  EXPECT_PRED2(has, Problem(R"({"left_eye": {"rotation": [0, 0, 1, 0]}})"), "60 degrees apart");
  EXPECT_PRED2(has, Problem(R"({"stereo": 1})"), "stereo");
}

}  // namespace
}  // namespace lararium::player
