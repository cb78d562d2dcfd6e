#include "shared/capture/camera_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "shared/capture/camera_source.h"
#include "tests/capture/fake_camera.h"

namespace lararium::capture {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Devices = std::map<int, FakeCamera*>;  // key: number; nullptr: no permission

std::vector<ConnectedCamera> List(const Devices& devices) {
  return ListCameras([&](int number) -> std::optional<Result<std::unique_ptr<VideoDevice>>> {
    const auto device = devices.find(number);
    if (device == devices.end()) {
      return std::nullopt;
    }
    if (device->second == nullptr) {
      return Result<std::unique_ptr<VideoDevice>>(Status::Error("camera", "permission denied"));
    }
    return Result<std::unique_ptr<VideoDevice>>(device->second->Open());
  });
}

TEST(CameraList, NamesTheCamerasByTheirNumbers) {
  FakeCamera built_in;
  built_in.card = "Integrated Camera";
  FakeCamera plugged_in;
  plugged_in.card = "HD Webcam C270";
  const auto cameras = List({{10, &plugged_in}, {0, &built_in}});
  ASSERT_EQ(cameras.size(), 2u);
  EXPECT_EQ(cameras[0].number, 0);
  EXPECT_EQ(cameras[0].name, "Integrated Camera");
  EXPECT_EQ(cameras[1].number, 10);
  EXPECT_EQ(cameras[1].name, "HD Webcam C270");
  EXPECT_THAT(cameras[1].problem, IsEmpty());
}

TEST(CameraList, LeavesOutWhatGivesNoImagesOrIsGone) {
  FakeCamera metadata;
  metadata.capabilities = V4L2_CAP_META_CAPTURE | V4L2_CAP_STREAMING;
  FakeCamera gone;
  gone.unplugged = true;
  EXPECT_THAT(List({{1, &metadata}, {2, &gone}}), IsEmpty());
}

TEST(CameraList, KeepsACameraThatMayNotBeOpenedAndSaysSo) {
  const auto cameras = List({{3, nullptr}});
  ASSERT_EQ(cameras.size(), 1u);
  EXPECT_EQ(cameras[0].number, 3);
  EXPECT_THAT(cameras[0].name, IsEmpty());
  EXPECT_THAT(cameras[0].problem, HasSubstr("permission denied"));
}

TEST(CameraList, ANameIsPrintableWhateverTheDriverSays) {
  FakeCamera camera;
  camera.card = std::string("Caf\xc3\xa9\n") + std::string(26, 'x');  // no terminator
  FakeCamera nameless;
  nameless.card = "";
  const auto cameras = List({{4, &camera}, {5, &nameless}});
  ASSERT_EQ(cameras.size(), 2u);
  EXPECT_EQ(cameras[0].name, "Caf???" + std::string(26, 'x'));
  EXPECT_EQ(cameras[1].name, "camera 5");
}

TEST(CameraList, ACameraThatIsListedIsNotInUse) {
  FakeCamera camera;
  EXPECT_EQ(List({{0, &camera}}).size(), 1u);
  EXPECT_FALSE(camera.streams);
  EXPECT_THAT(camera.buffers, IsEmpty());
}

}  // namespace
}  // namespace lararium::capture
