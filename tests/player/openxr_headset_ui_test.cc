// Uses a runtime without a headset: tests/player/null_openxr_runtime.cc.

#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "player/kiosk/visitor_actions.h"
#include "player/openxr/openxr_headset.h"
#include "shared/render/gl/window.h"
#include "tests/support/test_files.h"

namespace lararium::player {
namespace {

using SteadyClock = std::chrono::steady_clock;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr geometry::CameraModel kPinhole{64, 48, 50.0, 50.0, 31.5, 23.5};

// A quad layer as the runtime has logged it.
struct Quad {
  std::string eye;
  std::string space;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double yaw = 0.0;  // radians, positive to the left
  double width = 0.0;
  double height = 0.0;
  std::string upper;
  std::string lower;
};

std::optional<Quad> ParseQuad(const std::string& line) {
  Quad quad;
  double w = 0.0, x = 0.0, y = 0.0, z = 0.0;
  std::string word;
  int columns = 0, rows = 0;
  std::istringstream in(line);
  in >> word >> word >> quad.eye >> word >> quad.space >> word >> quad.position.x() >>
      quad.position.y() >> quad.position.z() >> word >> w >> x >> y >> z >> word >> quad.width >>
      quad.height >> word >> columns >> rows >> word >> quad.upper >> word >> quad.lower;
  quad.yaw = 2.0 * std::atan2(y, w);
  return line.rfind("quad ", 0) == 0 && in ? std::optional(quad) : std::nullopt;
}

class OpenXrTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::getenv("DISPLAY") == nullptr) {
      GTEST_SKIP() << "needs a display (xvfb-run)";
    }
    auto window = render::Window::Create({.vsync = false, .visible = false});
    ASSERT_TRUE(window.ok()) << window.message();
    window_.emplace(std::move(window).value());
    headset_.picture_distance = 2.0;
    log_ = MakeLog("").value();
  }
  void TearDown() override {
    xr_.reset();
    ::unsetenv("XR_RUNTIME_JSON");
    ::unsetenv("LARARIUM_NULL_XR");
  }

  Status Open(const std::string& script, const char* runtime = LARARIUM_NULL_RUNTIME) {
    ::setenv("XR_RUNTIME_JSON", runtime, 1);
    ::setenv("LARARIUM_NULL_XR", ("log=" + file_.string() + " " + script).c_str(), 1);
    Result<std::unique_ptr<OpenXrHeadset>> opened = OpenXrHeadset::Open(headset_, "test", *log_);
    if (opened.ok()) {
      xr_ = std::move(opened).value();
    }
    return opened.status();
  }

  // Runs a number of frames, or until the session ends. Returns false if it has ended.
  bool Run(int frames) {
    bool more = true;
    for (int i = 0; more && i < frames; ++i) {
      const Result<bool> frame = xr_->Frame();
      EXPECT_TRUE(frame.ok()) << frame.message();
      more = frame.ok() && *frame;
    }
    return more;
  }

  // A picture whose upper half is opaque red and whose lower half has the given red, green, blue
  // and alpha.
  static render::RenderTarget TwoHalves(const std::array<float, 4>& lower) {
    auto target = render::RenderTarget::Create(kPinhole.width, kPinhole.height);
    EXPECT_TRUE(target.ok()) << target.message();
    glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer());
    glDisable(GL_SCISSOR_TEST);
    glClearColor(1.0f, 0.0f, 0.0f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, kPinhole.height / 2, kPinhole.width, kPinhole.height / 2);
    glClearColor(lower[0], lower[1], lower[2], lower[3]);
    glClear(GL_COLOR_BUFFER_BIT);
    return std::move(target).value();
  }

  void Show(SteadyClock::time_point taken) {
    const render::RenderTarget target = TwoHalves({0.0f, 0.0f, 0.5f, 1.0f});
    for (const Eye eye : {kLeft, kRight}) {
      if (eye == kLeft || headset_.stereo) {
        const Status set = xr_->SetPicture(eye, target);
        ASSERT_TRUE(set.ok()) << set.message();
      }
    }
    xr_->Place(kPinhole, taken);
  }

  std::vector<std::string> Lines(const std::string& beginning = "") const {
    std::vector<std::string> lines;
    std::ifstream in(file_);
    for (std::string line; std::getline(in, line);) {
      if (line.rfind(beginning, 0) == 0) {
        lines.push_back(line);
      }
    }
    return lines;
  }
  Quad LastQuad() const {
    const std::vector<std::string> lines = Lines("quad ");
    const std::optional<Quad> quad = lines.empty() ? std::nullopt : ParseQuad(lines.back());
    EXPECT_TRUE(quad.has_value());
    return quad.value_or(Quad());
  }

  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "calls.txt";
  std::optional<render::Window> window_;
  Headset headset_;
  std::shared_ptr<Log> log_;
  std::unique_ptr<OpenXrHeadset> xr_;  // declared last, so destroyed before its context
};

TEST_F(OpenXrTest, FollowsTheSessionThroughItsStates) {
  ASSERT_TRUE(Open("exit=6").ok());
  EXPECT_FALSE(Run(100)) << "the runtime ends the session";
  EXPECT_EQ(Lines("frame ").size(), 6u);
  // The states IDLE, READY, ..., STOPPING, IDLE, EXITING, and the calls of the program in between.
  std::vector<std::string> calls;
  for (const std::string& line : Lines()) {
    if (line.rfind("state", 0) == 0 || line.rfind("begin", 0) == 0 || line.rfind("end", 0) == 0) {
      calls.push_back(line);
    }
  }
  EXPECT_THAT(calls, ElementsAre("state 1", "state 2", "begin session", "state 3", "state 4",
                                 "state 5", "state 6", "end session", "state 1", "state 8"));
}

TEST_F(OpenXrTest, SaysWhichRuntimeDrivesIt) {
  ASSERT_TRUE(Open("").ok());
  EXPECT_EQ(xr_->runtime(), "null");
}

TEST_F(OpenXrTest, EndsASessionByAskingForIt) {
  ASSERT_TRUE(Open("").ok());
  EXPECT_TRUE(Run(3));
  EXPECT_TRUE(xr_->End().ok());
  const Result<bool> after = xr_->Frame();
  ASSERT_TRUE(after.ok());
  EXPECT_FALSE(*after);
  EXPECT_EQ(Lines("exit requested").size(), 1u);
  EXPECT_EQ(Lines("end session").size(), 1u);
  xr_.reset();
  EXPECT_EQ(Lines("instance destroyed").size(), 1u);
}

TEST_F(OpenXrTest, ShowsNothingBeforeThereIsAPicture) {
  ASSERT_TRUE(Open("").ok());
  Run(4);
  for (const std::string& frame : Lines("frame ")) {
    EXPECT_THAT(frame, HasSubstr("layers 0"));
  }
  EXPECT_FALSE(Lines("frame ").empty());
}

TEST_F(OpenXrTest, HangsThePictureBeforeTheHeadWhereTheRuntimeKnowsNoTime) {
  ASSERT_TRUE(Open("turn=1 timeless=4").ok());
  Run(3);
  EXPECT_TRUE(xr_->RoomFromCamera(SteadyClock::now()).has_value());
  Run(3);
  EXPECT_FALSE(xr_->RoomFromCamera(SteadyClock::now()).has_value());
  Show(SteadyClock::now());
  Run(2);
  EXPECT_EQ(LastQuad().space, "head");
}

TEST_F(OpenXrTest, HangsThePictureAsFarAwayAndAsLargeAsTheCameraSawIt) {
  headset_.head_from_camera.translation = Eigen::Vector3d(0.0, -0.05, 0.1);
  ASSERT_TRUE(Open("").ok());
  Run(3);
  Show(SteadyClock::now());
  Run(2);
  const Quad quad = LastQuad();
  EXPECT_EQ(quad.eye, "both");
  EXPECT_EQ(quad.space, "room");
  // The head is at a height of 1.6 m, the camera 0.05 m above and 0.1 m in front of it. OpenXR's
  // axes point up and backward.
  EXPECT_LT((quad.position - Eigen::Vector3d(0.0, 1.65, -2.1)).norm(), 1e-4);
  EXPECT_NEAR(quad.width, 2.0 * 64 / 50, 1e-4);
  EXPECT_NEAR(quad.height, 2.0 * 48 / 50, 1e-4);
}

TEST_F(OpenXrTest, ThePictureIsUprightAndItsColoursAreKept) {
  ASSERT_TRUE(Open("").ok());
  Run(3);
  Show(SteadyClock::now());
  Run(2);
  EXPECT_EQ(LastQuad().upper, "255,0,0,255");
  EXPECT_THAT(LastQuad().lower, ::testing::AnyOf("0,0,127,255", "0,0,128,255"));
}

TEST_F(OpenXrTest, ThePictureStaysInTheRoomWhileTheHeadTurns) {
  ASSERT_TRUE(Open("turn=1").ok());
  Run(12);
  const SteadyClock::time_point first = SteadyClock::now() - std::chrono::milliseconds(60);
  Show(first);
  Run(2);
  const Quad before = LastQuad();
  EXPECT_NEAR(before.position.x(), -2.0 * std::sin(before.yaw), 1e-3);
  EXPECT_NEAR(before.position.z(), -2.0 * std::cos(before.yaw), 1e-3);
  Run(12);
  EXPECT_EQ(LastQuad().yaw, before.yaw) << "no newer picture came";
  const SteadyClock::time_point second = SteadyClock::now() - std::chrono::milliseconds(60);
  Show(second);
  Run(2);
  // The layer is at the pose of the head when the image was taken, not at the current pose.
  const double passed = std::chrono::duration<double>(second - first).count();
  EXPECT_NEAR(LastQuad().yaw - before.yaw, passed, 2e-3);
}

TEST_F(OpenXrTest, InStereoEachEyeHasItsPictureAndTheRuntimesEyes) {
  headset_.stereo = true;
  ASSERT_TRUE(Open("").ok());
  Run(3);
  EXPECT_NEAR(xr_->PictureEyeOf(kRight).in_camera.x(), 0.032, 1e-6);
  EXPECT_NEAR(xr_->PictureEyeOf(kLeft).in_camera.x(), -0.032, 1e-6);
  Show(SteadyClock::now());
  Run(1);
  const std::vector<std::string> quads = Lines("quad ");
  ASSERT_EQ(quads.size(), 2u);
  EXPECT_EQ(ParseQuad(quads[0])->eye, "left");
  EXPECT_EQ(ParseQuad(quads[1])->eye, "right");
}

// The projection layer of an eye over the real world, as the runtime has logged it.
struct Projected {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double yaw = 0.0;                                      // radians, positive to the left
  double left = 0.0, right = 0.0, up = 0.0, down = 0.0;  // angles of the field of view, radians
  std::string upper;
  std::string lower;
};

// Parses the layers of both eyes from a line of the log.
std::vector<Projected> ParseProjection(const std::string& line) {
  std::vector<Projected> eyes;
  for (size_t at = line.find('|'); at != std::string::npos; at = line.find('|', at + 1)) {
    Projected eye;
    double w = 0.0, x = 0.0, y = 0.0, z = 0.0;
    std::string word;
    std::istringstream in(line.substr(at + 1));
    in >> word >> eye.position.x() >> eye.position.y() >> eye.position.z() >> word >> w >> x >> y >>
        z >> word >> eye.left >> eye.right >> eye.up >> eye.down >> word >> eye.upper >> word >>
        eye.lower;
    eye.yaw = 2.0 * std::atan2(y, w);
    eyes.push_back(eye);
  }
  return eyes;
}

// A headset whose runtime shows the real world.
class OpenXrSeeThroughTest : public OpenXrTest {
 protected:
  void SetUp() override {
    OpenXrTest::SetUp();
    headset_.runtime_shows_room = true;
  }

  void ShowToBoth() {
    const render::RenderTarget target = TwoHalves({0.0f, 0.0f, 0.0f, 0.0f});
    for (const Eye eye : {kLeft, kRight}) {
      views_[eye] = xr_->ViewOf(eye, kPinhole.width, kPinhole.height);
      ASSERT_TRUE(views_[eye].has_value());
      const Status set = xr_->SetPicture(eye, target);
      ASSERT_TRUE(set.ok()) << set.message();
    }
  }

  std::array<std::optional<EyeView>, 2> views_;
};

TEST_F(OpenXrSeeThroughTest, PeopleAreBlendedOverWhatIsRealWhereTheRuntimeCan) {
  ASSERT_TRUE(Open("blends=o+a passes").ok());
  Run(3);
  ShowToBoth();
  Run(1);
  EXPECT_THAT(Lines("frame ").back(), HasSubstr("layers 1 blend a"));
  const std::vector<Projected> eyes =
      ParseProjection(Lines("projection space room flags 2").back());
  ASSERT_EQ(eyes.size(), 2u);
  for (const Projected& eye : eyes) {
    EXPECT_EQ(eye.upper, "255,0,0,255");
    EXPECT_EQ(eye.lower, "0,0,0,0");
  }
  EXPECT_TRUE(Lines("passthrough").empty());
}

TEST_F(OpenXrSeeThroughTest, OtherwiseWhatIsRealIsALayerBelowPeople) {
  ASSERT_TRUE(Open("blends=o passes").ok());
  Run(3);
  ShowToBoth();
  Run(1);
  const std::vector<std::string> lines = Lines();
  ASSERT_GE(lines.size(), 3u);
  EXPECT_THAT(lines[lines.size() - 3], HasSubstr("layers 2 blend o"));
  EXPECT_EQ(lines[lines.size() - 2], "what is real");
  EXPECT_THAT(lines.back(), HasSubstr("projection"));
  EXPECT_EQ(Lines("passthrough flags 1").size(), 1u);
}

TEST_F(OpenXrSeeThroughTest, WhatIsRealIsSeenBeforeThereAreAnyPeople) {
  ASSERT_TRUE(Open("blends=o passes").ok());
  Run(3);
  EXPECT_THAT(Lines("frame ").back(), HasSubstr("layers 1"));
  EXPECT_FALSE(Lines("what is real").empty());
}

TEST_F(OpenXrSeeThroughTest, AHeadsetOfGlassOnlyAddsLight) {
  ASSERT_TRUE(Open("blends=+").ok());
  Run(3);
  ShowToBoth();
  Run(1);
  EXPECT_THAT(Lines("frame ").back(), HasSubstr("layers 1 blend +"));
}

TEST_F(OpenXrSeeThroughTest, AHeadsetThatShowsNothingRealIsOneErrorThatSaysWhatToDo) {
  EXPECT_EQ(Open("blends=o").message(),
            "OpenXR: the headset cannot show the real world itself; set \"see_through\" of the "
            "device file's \"headset\" to \"camera\"");
}

TEST_F(OpenXrSeeThroughTest, EachEyesPictureIsHandedOverForTheViewItWasDrawnFor) {
  ASSERT_TRUE(Open("blends=a turn=1").ok());
  Run(12);
  ShowToBoth();
  Run(4);  // the head turns further without a newer picture
  const std::vector<Projected> eyes = ParseProjection(Lines("projection").back());
  ASSERT_EQ(eyes.size(), 2u);
  for (const Eye eye : {kLeft, kRight}) {
    const EyeView& view = *views_[eye];
    const geometry::Rigid3& pose = view.room_from_eye;
    // Our axes are those of OpenXR, turned by 180 degrees about x.
    EXPECT_NEAR(eyes[eye].position.x(), pose.translation.x(), 1e-4);
    EXPECT_NEAR(eyes[eye].position.y(), -pose.translation.y(), 1e-4);
    EXPECT_NEAR(eyes[eye].position.z(), -pose.translation.z(), 1e-4);
    EXPECT_NEAR(eyes[eye].yaw, -2.0 * std::atan2(pose.rotation.y(), pose.rotation.w()), 1e-4);
    EXPECT_NEAR(eyes[eye].right, std::atan(0.5 * kPinhole.width / view.camera.fx), 1e-4);
    EXPECT_NEAR(eyes[eye].up, std::atan(0.5 * kPinhole.height / view.camera.fy), 1e-4);
    EXPECT_NEAR(eyes[eye].left, -eyes[eye].right, 1e-6);
    // The picture covers the whole field of view of the eye.
    EXPECT_GE(eyes[eye].right, 0.8 - 1e-4);
    EXPECT_GE(eyes[eye].up, 0.8 - 1e-4);
  }
  EXPECT_NEAR((eyes[kRight].position - eyes[kLeft].position).norm(), 0.064, 1e-4);
}

TEST_F(OpenXrSeeThroughTest, EyesAreForeseenAndTheCameraIsKnownBackInTime) {
  headset_.head_from_camera.translation = Eigen::Vector3d(0.0, -0.05, 0.1);
  ASSERT_TRUE(Open("blends=a turn=1").ok());
  Run(12);
  const SteadyClock::time_point taken = SteadyClock::now() - std::chrono::milliseconds(50);
  ShowToBoth();
  const std::optional<geometry::Rigid3> camera = xr_->RoomFromCamera(taken);
  ASSERT_TRUE(camera.has_value());
  const auto yaw = [](const geometry::Rigid3& pose) {
    return -2.0 * std::atan2(pose.rotation.y(), pose.rotation.w());
  };
  // The prediction is two to three periods of the display ahead, plus the time of drawing.
  const double ahead = yaw(views_[kLeft]->room_from_eye) - yaw(*camera);
  EXPECT_GT(ahead, 0.05);
  EXPECT_LT(ahead, 0.05 + 0.05);
  EXPECT_NEAR(camera->translation.y(), -1.65, 1e-4);
}

TEST_F(OpenXrTest, ControllersButtonsArePressedOnceHoweverLongTheyAreHeld) {
  ASSERT_TRUE(Open("press=/user/hand/right/input/select/click@8 "
                   "press=/user/hand/left/input/menu/click@14")
                  .ok());
  std::vector<std::pair<int, std::string>> pressed;
  for (int frame = 0; frame < 24; ++frame) {
    ASSERT_TRUE(Run(1));
    for (const std::string& button : xr_->TakeButtons()) {
      pressed.emplace_back(frame, button);
    }
  }
  ASSERT_EQ(pressed.size(), 2u);
  EXPECT_EQ(pressed[0].second, kHandSelect);
  EXPECT_EQ(pressed[1].second, kHandMenu);
  EXPECT_EQ(pressed[1].first - pressed[0].first, 6);
}

TEST_F(OpenXrTest, AHandThatHoldsAButtonHidesTheOtherHands) {
  ASSERT_TRUE(Open("press=/user/hand/right/input/select/click@8 "
                   "press=/user/hand/left/input/select/click@9")
                  .ok());
  ASSERT_TRUE(Run(24));
  EXPECT_EQ(xr_->TakeButtons(), std::vector<std::string>{std::string(kHandSelect)});
  EXPECT_TRUE(xr_->TakeButtons().empty());
}

TEST_F(OpenXrTest, WithoutTheFocusNothingIsPressed) {
  ASSERT_TRUE(Open("aside press=/user/hand/right/input/select/click@4").ok());
  ASSERT_TRUE(Run(12));
  EXPECT_TRUE(xr_->TakeButtons().empty());
}

TEST_F(OpenXrTest, ALostRuntimeIsOneErrorThatSaysWhatToDo) {
  ASSERT_TRUE(Open("lose=3").ok());
  Status status;
  for (int i = 0; i < 20 && status.ok(); ++i) {
    status = xr_->Frame().status();
  }
  EXPECT_EQ(status.message(),
            "OpenXR: the runtime was lost (XR_ERROR_SESSION_LOST); start the headset's runtime "
            "again, then the player");
}

TEST_F(OpenXrTest, SaysThatThereIsNoRuntime) {
  const Status status = Open("", "/nowhere/runtime.json");
  EXPECT_THAT(status.message(), HasSubstr("OpenXR: there is no usable runtime; install"));
}

TEST_F(OpenXrTest, SaysThatNoHeadsetIsConnected) {
  EXPECT_THAT(Open("away").message(), HasSubstr("no headset is connected; connect it"));
}

}  // namespace
}  // namespace lararium::player
