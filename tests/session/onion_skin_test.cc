#include "editor/session/onion_skin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/ext/matrix_transform.hpp>

namespace lararium::editor {
namespace {

TEST(OnionMoments, AreFartherFirstFainterAndNotBeforeTheBeginning) {
  OnionSkin skin;
  skin.before = 2;
  skin.after = 3;
  skin.spacing = 0.5;
  const std::vector<OnionMoment> moments = OnionMoments(skin, 4.0);
  ASSERT_EQ(moments.size(), 5u);
  double farthest = 10.0;
  float opacity = 0.0f;
  for (const OnionMoment& moment : moments) {
    EXPECT_LE(std::abs(moment.offset), farthest);
    EXPECT_GE(moment.opacity, opacity);
    EXPECT_EQ(moment.colour, moment.offset < 0.0 ? skin.colour_before : skin.colour_after);
    farthest = std::abs(moment.offset);
    opacity = moment.opacity;
  }
  EXPECT_EQ(moments.front().offset, 1.5);
  EXPECT_LT(moments.front().opacity, moments.back().opacity);
  EXPECT_EQ(OnionMoments(skin, 0.7).size(), 4u);
  skin.before = skin.after = 0;
  EXPECT_TRUE(OnionMoments(skin, 4.0).empty());
}

show::StagedFrame Frame(float x, float turn) {
  show::StagedFrame frame;
  frame.people.actors.resize(1);
  frame.people.actors[0].cast = 2;
  frame.people.actors[0].skin_count = 2;
  frame.people.actors[0].stage_from_actor[3].x = x;
  frame.people.skin = {glm::mat4(1.0f),
                       glm::rotate(glm::mat4(1.0f), turn, glm::vec3(0.0f, 0.0f, 1.0f))};
  frame.things.objects.push_back({1, 0, 1, {}, 1.0f});
  frame.things.stage_from_part = {glm::mat4(1.0f)};
  frame.things.part_shown = {1};
  return frame;
}

TEST(RemoveUnmoved, LeavesWhoIsElsewhereOrPosedOtherwise) {
  const show::StagedFrame now = Frame(1.0f, 0.0f);
  const auto left = [&](show::StagedFrame other) {
    RemoveUnmoved(now, other);
    return std::pair(other.people.actors.size(), other.things.objects.size());
  };
  EXPECT_EQ(left(Frame(1.0f, 0.0f)), std::pair(size_t{0}, size_t{0}));
  EXPECT_EQ(left(Frame(1.005f, 0.001f)), std::pair(size_t{0}, size_t{0})) << "breath";
  EXPECT_EQ(left(Frame(1.1f, 0.0f)), std::pair(size_t{1}, size_t{0}));
  EXPECT_EQ(left(Frame(1.0f, 0.1f)), std::pair(size_t{1}, size_t{0})) << "an arm";
  show::StagedFrame carried = Frame(1.0f, 0.0f);
  carried.things.stage_from_part[0][3].y = 0.2f;
  EXPECT_EQ(left(carried), std::pair(size_t{0}, size_t{1}));
  show::StagedFrame gone = Frame(1.0f, 0.0f);
  gone.things.part_shown[0] = 0;
  EXPECT_EQ(left(gone), std::pair(size_t{0}, size_t{1}));
  show::StagedFrame somebody_else = Frame(1.0f, 0.0f);
  somebody_else.people.actors[0].cast = 3;
  EXPECT_EQ(left(somebody_else).first, 1u);
}

TEST(BlendOverlay, ShowsWhereTheGhostIsAndNobodyIsNow) {
  const cv::Scalar place(40, 80, 120);
  cv::Mat picture(1, 4, CV_8UC3, place);
  const cv::Mat before = picture.clone();
  cv::Mat overlay(1, 4, CV_8UC3, cv::Scalar(0, 0, 0));
  cv::Mat covers = (cv::Mat_<uint8_t>(1, 4) << 0, 255, 255, 128);
  overlay.at<cv::Vec3b>(0, 1) = overlay.at<cv::Vec3b>(0, 2) = {200, 100, 0};
  overlay.at<cv::Vec3b>(0, 3) = {100, 50, 0};  // Multiplied by its coverage.
  const cv::Mat now = (cv::Mat_<uint8_t>(1, 4) << 0, 0, 255, 0);
  BlendOverlay(overlay, covers, now, 0.5f, picture);
  EXPECT_EQ(picture.at<cv::Vec3b>(0, 0), before.at<cv::Vec3b>(0, 0));
  EXPECT_EQ(picture.at<cv::Vec3b>(0, 2), before.at<cv::Vec3b>(0, 2));
  EXPECT_EQ(picture.at<cv::Vec3b>(0, 1), cv::Vec3b(120, 90, 60));
  EXPECT_NEAR(picture.at<cv::Vec3b>(0, 3)[0], 80, 1);
}

}  // namespace
}  // namespace lararium::editor
