#include "player/app/camera_choice.h"

#include <gtest/gtest.h>

#include <vector>

#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::player {
namespace {

const std::vector<TrainedCamera> kTrained = {{"bar", {640, 480, 560, 560, 319.5, 239.5}},
                                             {"yard", {540, 960, 700, 700, 269.5, 479.5}}};

class CameraChoiceTest : public ::testing::Test {
 protected:
  void WriteDevice(std::string_view text) {
    options_.device = folder_ / "device.json";
    ASSERT_TRUE(WriteFileAtomically(options_.device, text).ok());
  }
  std::string Error(int width = 640, int height = 480) {
    return ChooseCamera(options_, kTrained, width, height).message();
  }

  test::TemporaryFolder folder_;
  CameraOptions options_;
};

TEST_F(CameraChoiceTest, OtherwiseTheCameraOfTheBundleIsAGuess) {
  const CameraChoice choice = ChooseCamera(options_, kTrained, 640, 480).value();
  EXPECT_EQ(choice.camera, kTrained[0].camera);
  EXPECT_FALSE(choice.known);
  EXPECT_NE(choice.origin.find("the bundle's place \"bar\""), std::string::npos);
}

TEST_F(CameraChoiceTest, OfTheBundleTheFirstPlaceThatFitsIsTaken) {
  const CameraChoice choice = ChooseCamera(options_, kTrained, 270, 480).value();
  EXPECT_NEAR(choice.camera.fx, 350.0, 1e-9);
  EXPECT_NE(choice.origin.find("\"yard\""), std::string::npos);
}

TEST_F(CameraChoiceTest, ImagesOfAnotherShapeGetAGuessAsWideAlongTheLongerSide) {
  const CameraChoice choice = ChooseCamera(options_, kTrained, 720, 1280).value();
  EXPECT_EQ(choice.camera.width, 720);
  EXPECT_FALSE(choice.known);
  const CameraChoice wide = ChooseCamera(options_, kTrained, 1280, 720).value();
  EXPECT_NEAR(wide.camera.fx, 1120.0, 1e-9);
  EXPECT_NEAR(wide.camera.cx, 639.5, 1e-9);
}

TEST_F(CameraChoiceTest, TheDeviceFileGoesBeforeTheBundleAndTheOptionBeforeBoth) {
  WriteDevice(
      R"({"schema": 1, "camera": {"width": 640, "height": 480, "K": [500, 500, 320, 240],
          "k1_k2_p1_p2": [-0.1, 0.01, 0, 0]}})");
  CameraChoice choice = ChooseCamera(options_, kTrained, 640, 480).value();
  EXPECT_TRUE(choice.known);
  EXPECT_EQ(choice.camera.fx, 500);
  EXPECT_EQ(choice.camera.k1, -0.1);
  options_.intrinsics = {400, 410, 320, 240};
  choice = ChooseCamera(options_, kTrained, 640, 480).value();
  EXPECT_EQ(choice.camera.fy, 410);
  EXPECT_EQ(choice.origin, "--intrinsics");
}

TEST_F(CameraChoiceTest, ScalesWhatIsGivenToAnotherSizeOfTheSameAspectOnly) {
  WriteDevice(
      R"({"schema": 1, "camera": {"width": 640, "height": 480, "K": [500, 500, 320, 240]}})");
  EXPECT_NEAR(ChooseCamera(options_, kTrained, 320, 240)->camera.fx, 250.0, 1e-9);
  EXPECT_NE(Error(1280, 720).find("device.json"), std::string::npos) << Error(1280, 720);
  EXPECT_NE(Error(1280, 720).find("640x480"), std::string::npos);
}

TEST_F(CameraChoiceTest, ErrorsNameTheFileAndTheField) {
  WriteDevice(R"({"schema": 1, "camera": {"width": 640, "height": 480, "K": [500, 500]}})");
  EXPECT_NE(Error().find("device.json: camera.K: must be a list of 4"), std::string::npos)
      << Error();
  WriteDevice(R"({"schema": 2})");
  EXPECT_NE(Error().find("newer"), std::string::npos);
  WriteDevice("");
  EXPECT_NE(Error().find("not valid JSON"), std::string::npos);
  options_.intrinsics = {0, 0, 0, 0};
  EXPECT_NE(Error().find("--intrinsics: camera intrinsics: the focal length"), std::string::npos)
      << Error();
}

}  // namespace
}  // namespace lararium::player
