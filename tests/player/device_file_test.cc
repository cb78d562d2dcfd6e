#include "player/app/device_file.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::player {
namespace {

class DeviceFileTest : public ::testing::Test {
 protected:
  Result<Device> Load(std::string_view text) {
    const std::filesystem::path file = folder_ / "device.json";
    EXPECT_TRUE(WriteFileAtomically(file, text).ok());
    return LoadDevice(file);
  }

  test::TemporaryFolder folder_;
};

TEST_F(DeviceFileTest, HoldsCalibrationOrLookOrBoth) {
  const Device look =
      Load(R"({"schema": 1, "look": {"width": 640, "noise": [0.01, 0.001], "blur_px": 0.5,
                                     "knee": 0.7}})")
          .value();
  EXPECT_FALSE(look.camera.has_value());
  EXPECT_EQ(look.look, (light::CameraTraits{640, 0.01f, 0.001f, 0.5f, 0.7f}));
  const Device camera =
      Load(R"({"schema": 1, "camera": {"width": 640, "height": 480, "K": [500, 500, 320, 240]}})")
          .value();
  EXPECT_EQ(camera.camera->fx, 500.0);
  EXPECT_FALSE(camera.look.has_value());
}

TEST_F(DeviceFileTest, HoldsAHeadset) {
  const Device device = Load(R"({"schema": 1, "headset": {"eye_distance": 0.06}})").value();
  EXPECT_EQ(device.headset->head_from_eye[kRight].translation.x(), 0.03);
  const std::string wrong =
      Load(R"({"schema": 1, "headset": {"eye_distance": 60}})").status().message();
  EXPECT_NE(wrong.find("device.json: headset.eye_distance"), std::string::npos) << wrong;
}

TEST_F(DeviceFileTest, ErrorsNameTheFileAndTheField) {
  const std::string empty = Load(R"({"schema": 1})").status().message();
  EXPECT_NE(empty.find("device.json: has none of"), std::string::npos) << empty;
  const std::string noisy =
      Load(R"({"schema": 1, "look": {"width": 640, "noise": [-1, 0], "blur_px": 0, "knee": 1}})")
          .status()
          .message();
  EXPECT_NE(noisy.find("device.json: look: \"noise\""), std::string::npos) << noisy;
}

}  // namespace
}  // namespace lararium::player
