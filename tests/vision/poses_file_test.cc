#include "shared/vision/poses_file.h"

#include <gtest/gtest.h>

#include "shared/core/file.h"
#include "shared/core/json.h"
#include "tests/support/test_files.h"

namespace lararium::vision {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;

const CameraModel kFileCamera = {.width = 640,
                                 .height = 480,
                                 .fx = 560.0,
                                 .fy = 561.0,
                                 .cx = 319.5,
                                 .cy = 239.5,
                                 .k1 = -0.1,
                                 .k2 = 0.01,
                                 .p1 = 0.001,
                                 .p2 = -0.002};

std::vector<PoseRecord> Records() {
  const Rigid3 pose{Eigen::Quaterniond(0.5, -0.1, 0.7, 0.2).normalized(), {0.1, -2.0, 3.5}};
  RollingShutter rolling{{0.0, 0.8}};
  rolling.motion << 0.01, -0.02, 0.03, 0.1, 0.2, -0.3;
  return {{"000000.png", kFileCamera, pose, true, rolling},
          {"000001.png", kFileCamera, std::nullopt, false},
          {"000002.png", kFileCamera, pose, false}};
}

TEST(PosesFile, KeepsPosesAndCameras) {
  const test::TemporaryFolder folder;
  const auto records = Records();
  ASSERT_TRUE(SavePoses(folder / "poses.json", records).ok());
  const auto loaded = LoadPoses(folder / "poses.json");
  ASSERT_TRUE(loaded.ok());
  ASSERT_EQ(loaded->size(), records.size());
  for (size_t i = 0; i < records.size(); ++i) {
    const PoseRecord& a = records[i];
    const PoseRecord& b = (*loaded)[i];
    EXPECT_EQ(b.file, a.file);
    EXPECT_EQ(b.camera, a.camera);
    EXPECT_EQ(b.tracked, a.tracked);
    ASSERT_EQ(b.shutter.has_value(), a.shutter.has_value());
    if (a.shutter) {
      EXPECT_EQ(b.shutter->readout, a.shutter->readout);
      EXPECT_EQ(b.shutter->motion, a.shutter->motion);
    }
    ASSERT_EQ(b.camera_from_world.has_value(), a.camera_from_world.has_value());
    if (a.camera_from_world) {
      EXPECT_LT((a.camera_from_world->Matrix3x4() - b.camera_from_world->Matrix3x4()).norm(),
                1e-12);
    }
  }
}

TEST(PosesFile, HasTheFieldsThatOtherToolsRead) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(SavePoses(folder / "poses.json", Records()).ok());
  const auto json = LoadJson(folder / "poses.json");
  ASSERT_TRUE(json.ok());
  const Json& first = (*json)["images"][0];
  EXPECT_EQ(first["file"], "000000.png");
  EXPECT_EQ(first["width"], 640);
  EXPECT_EQ(first["height"], 480);
  EXPECT_EQ(first["K"].size(), 4u);
  EXPECT_EQ(first["distortion"]["model"], "opencv");
  EXPECT_EQ(first["distortion"]["k1_k2_p1_p2"].size(), 4u);
  EXPECT_EQ(first["world_to_camera"]["R"].size(), 9u);
  EXPECT_EQ(first["world_to_camera"]["t"].size(), 3u);
  EXPECT_EQ(first["tracked"], true);
  EXPECT_EQ(first["rolling_shutter"]["readout"].size(), 2u);
  EXPECT_EQ(first["rolling_shutter"]["rotation"].size(), 3u);
  EXPECT_EQ(first["rolling_shutter"]["translation"].size(), 3u);
  EXPECT_TRUE((*json)["images"][1]["world_to_camera"].is_null());
}

TEST(PosesFile, KeepsWhatTheTrackerSays) {
  const test::TemporaryFolder folder;
  TrackedFrame tracked;
  tracked.camera = kFileCamera;
  tracked.state = TrackState::kTracking;
  tracked.camera_from_map = Rigid3();
  tracked.map = 2;
  tracked.followed = true;
  tracked.confidence = 0.75f;
  tracked.gain = {0.5f, 1.0f, 2.0f};
  TrackedFrame lost;
  lost.camera = kFileCamera;
  lost.state = TrackState::kLost;
  lost.reason = TrackReason::kTooDark;
  const std::vector<PoseRecord> records = {MakePoseRecord("0.png", tracked),
                                           MakePoseRecord("1.png", lost)};
  ASSERT_TRUE(SavePoses(folder / "poses.json", records).ok());
  const Json images = (*LoadJson(folder / "poses.json"))["images"];
  EXPECT_EQ(images[0]["state"], "tracking");
  EXPECT_EQ(images[1]["state"], "lost");
  EXPECT_EQ(images[1]["reason"], "too dark");

  const auto loaded = LoadPoses(folder / "poses.json");
  ASSERT_TRUE(loaded.ok()) << loaded.message();
  const TrackingDetails& details = (*loaded)[0].details.value();
  EXPECT_EQ(details.map, 2u);
  EXPECT_TRUE(details.followed);
  EXPECT_EQ(details.confidence, 0.75f);
  EXPECT_EQ(details.gain, tracked.gain);
  EXPECT_FALSE((*loaded)[1].tracked);
}

TEST(PosesFile, RefusesWhatItCannotUse) {
  const test::TemporaryFolder folder;
  std::vector<PoseRecord> records = Records();
  records[0].details = TrackingDetails{.state = TrackState::kTracking};
  ASSERT_TRUE(SavePoses(folder / "good.json", records).ok());
  const Json good = *LoadJson(folder / "good.json");
  const auto refuses = [&](const char* what, const auto& edit) {
    Json bad = good;
    edit(bad["images"][0]);
    EXPECT_TRUE(SaveJson(folder / "bad.json", bad).ok());
    const auto loaded = LoadPoses(folder / "bad.json");
    EXPECT_FALSE(loaded.ok()) << what;
    if (!loaded.ok()) {
      EXPECT_NE(loaded.message().find("bad.json"), std::string::npos) << what;
    }
  };
  refuses("no file", [](Json& image) { image.erase("file"); });
  refuses("no K", [](Json& image) { image.erase("K"); });
  refuses("three numbers of K", [](Json& image) { image["K"].erase(3); });
  refuses("no width", [](Json& image) { image["width"] = 0; });
  refuses("huge height", [](Json& image) { image["height"] = 1 << 30; });
  refuses("other distortion", [](Json& image) { image["distortion"]["model"] = "fisheye"; });
  refuses("no rotation", [](Json& image) { image["world_to_camera"]["R"][4] = 3.0; });
  refuses("reflection",
          [](Json& image) { image["world_to_camera"]["R"] = {1, 0, 0, 0, 1, 0, 0, 0, -1}; });
  refuses("text for t", [](Json& image) { image["world_to_camera"]["t"] = "here"; });
  refuses("negative map", [](Json& image) { image["map"] = -1; });
  refuses("a map beyond all bundles", [](Json& image) { image["map"] = 1 << 20; });
  refuses("a number for followed", [](Json& image) { image["followed"] = 1; });
  refuses("confidence above 1", [](Json& image) { image["confidence"] = 1.5; });
  refuses("no gain", [](Json& image) { image.erase("gain"); });
  refuses("gain of zero", [](Json& image) { image["gain"][1] = 0.0; });
  refuses("image is a number", [](Json& image) { image = 7; });
  EXPECT_FALSE(LoadPoses(folder / "none.json").ok());
  ASSERT_TRUE(WriteFileAtomically(folder / "list.json", std::string_view("[]")).ok());
  EXPECT_FALSE(LoadPoses(folder / "list.json").ok());
}

}  // namespace
}  // namespace lararium::vision
