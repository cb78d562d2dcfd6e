#include "player/app/doctor.h"

#include <gmock/gmock.h>

#include "shared/core/json.h"

namespace lararium::player {
namespace {

using ::testing::HasSubstr;

CameraProbe Good() {
  CameraProbe probe;
  probe.devices = 1;
  probe.width = 640;
  probe.height = 480;
  probe.images = 45;
  probe.seconds = 1.5;
  probe.brightness = 90.0;
  probe.change = 2.0;
  return probe;
}

TEST(Doctor, ACameraThatGivesImagesIsGood) {
  const Finding finding = JudgeCamera(Good());
  EXPECT_EQ(finding.verdict, Verdict::kGood);
  EXPECT_EQ(finding.found, "640x480, 30.0 images a second");
  EXPECT_TRUE(finding.advice.empty());
}

TEST(Doctor, ARuntimeOfAHeadsetIsNamedOrSaysWhatItLacks) {
  const Finding good = JudgeRuntime(std::string("Monado"));
  EXPECT_EQ(good.verdict, Verdict::kGood);
  EXPECT_THAT(good.found, HasSubstr("Monado"));
  const Finding bad =
      JudgeRuntime(Status::Error("OpenXR", "no headset is connected", "connect it"));
  EXPECT_EQ(bad.verdict, Verdict::kBad);
  EXPECT_THAT(bad.found, HasSubstr("connect it"));
  EXPECT_THAT(bad.advice, HasSubstr("not start"));
}

TEST(Doctor, DrawingIsJudgedByTheFinestLevelThatKeepsUp) {
  DrawingProbe probe = {.problem = {}, .size = {1280, 720}, .rates = {0.0, 12.0, 29.0, 40.0, 60.0}};
  const Finding good = JudgeDrawing(probe, 30.0);
  EXPECT_EQ(good.verdict, Verdict::kGood);
  EXPECT_EQ(good.found,
            "29 pictures a second, 1280x720, at level 2 of quality (0 the finest, 4 the coarsest)");
  probe.rates = {0.0, 0.0, 0.0, 0.0, 19.4};
  const Finding slow = JudgeDrawing(probe, 30.0);
  EXPECT_EQ(slow.verdict, Verdict::kWarning);
  EXPECT_THAT(slow.found, HasSubstr("19 pictures a second, 1280x720, at level 4"));
  EXPECT_THAT(slow.found, HasSubstr("the camera gives 30 images"));
  EXPECT_THAT(slow.advice, HasSubstr("--size"));
  probe.problem = Status::Error("graphics", "out of memory");
  const Finding bad = JudgeDrawing(probe, 30.0);
  EXPECT_EQ(bad.verdict, Verdict::kBad);
  EXPECT_THAT(bad.found, HasSubstr("out of memory"));
}

TEST(Doctor, EachFaultOfACameraHasItsAdvice) {
  struct Fault {
    std::function<void(CameraProbe&)> change;
    Verdict verdict;
    std::string advice;
  };
  const Fault faults[] = {
      {[](CameraProbe& p) { p.devices = 0; }, Verdict::kBad, "plug it in"},
      {[](CameraProbe& p) { p.problem = Status::Error("camera 0", "cannot be opened"); },
       Verdict::kBad, "group \"video\""},
      {[](CameraProbe& p) { p.images = 0; }, Verdict::kBad, "unplug it"},
      {[](CameraProbe& p) { p.brightness = 3.0; }, Verdict::kBad, "lens cap"},
      {[](CameraProbe& p) { p.calibration_problem = "no calibration for 640x360"; }, Verdict::kBad,
       "calibrated"},
      {[](CameraProbe& p) { p.change = 0.0; }, Verdict::kWarning, "move it"},
      {[](CameraProbe& p) { p.tracked = 0; }, Verdict::kWarning, "point it at the place"},
      {[](CameraProbe& p) { p.seconds = 4.5; }, Verdict::kWarning, "more light"}};
  for (const Fault& fault : faults) {
    CameraProbe probe = Good();
    fault.change(probe);
    const Finding finding = JudgeCamera(probe);
    EXPECT_EQ(finding.verdict, fault.verdict) << fault.advice;
    EXPECT_THAT(finding.advice, HasSubstr(fault.advice));
  }
}

TEST(Doctor, SaysWhatElseIsWrong) {
  const Status lost = Status::Error("x", "is not there");
  EXPECT_EQ(JudgeGraphics(std::string("AMD Radeon")).verdict, Verdict::kGood);
  EXPECT_EQ(JudgeGraphics(std::string("llvmpipe (LLVM 15)")).verdict, Verdict::kWarning);
  EXPECT_EQ(JudgeGraphics(lost).verdict, Verdict::kBad);
  EXPECT_EQ(JudgeDisplay(lost, true).verdict, Verdict::kBad);
  EXPECT_EQ(JudgeDisplay(DisplayProbe{{1920, 1080}, "AMD"}, true).verdict, Verdict::kGood);
  EXPECT_EQ(JudgeSound(lost).verdict, Verdict::kWarning);
  EXPECT_EQ(JudgeDisk(Status(), uint64_t{1} << 34, "/x").verdict, Verdict::kGood);
  EXPECT_EQ(JudgeDisk(Status(), 1000, "/x").verdict, Verdict::kWarning);
  EXPECT_EQ(JudgeDisk(lost, 1000, "/x").verdict, Verdict::kWarning);
  EXPECT_EQ(JudgePower({90.0, std::nullopt}).verdict, Verdict::kWarning);
  EXPECT_EQ(JudgePower({40.0, 0.05}).verdict, Verdict::kWarning);
  EXPECT_EQ(JudgePower({40.0, 0.9}).verdict, Verdict::kGood);
}

TEST(Doctor, SaysHowTheHeadsetIsSetUpAndWhetherItsMonitorFits) {
  Headset headset;
  headset.head_from_eye[kLeft].translation.x() = -0.032;
  headset.head_from_eye[kRight].translation.x() = 0.032;
  EXPECT_EQ(JudgeHeadset(headset, std::nullopt, std::nullopt).found,
            "eyes 64 mm apart, one picture for both, 3.0 m away, without a panel");
  const geometry::LensModel lens{1000, 1000, 500.0, 500.0, 499.5, 499.5};
  headset.panel = Panel{{lens, lens}};
  headset.stereo = true;
  const geometry::CameraModel camera{640, 480, 320.0, 320.0, 319.5, 239.5};
  const Finding fits = JudgeHeadset(headset, camera, PictureSize{2000, 1000});
  EXPECT_EQ(fits.verdict, Verdict::kGood);
  EXPECT_EQ(fits.found,
            "panel 2000x1000, each eye sees 90 x 90 degrees, eyes 64 mm apart, a picture for each, "
            "3.0 m away; the camera sees 90 x 74 degrees");
  const Finding scaled = JudgeHeadset(headset, camera, PictureSize{1920, 1080});
  EXPECT_EQ(scaled.verdict, Verdict::kWarning);
  EXPECT_THAT(scaled.found, HasSubstr("the monitor has 1920x1080"));
  EXPECT_THAT(scaled.advice, HasSubstr("the panel's own size"));
}

TEST(Doctor, PrintsAdviceBelowWhatItIsFor) {
  const std::string text = FormatFindings(
      {{"camera", Verdict::kGood, "fine"}, {"sound", Verdict::kWarning, "none", "connect it"}});
  EXPECT_EQ(text,
            "good     camera    fine\n"
            "warning  sound     none\n"
            "                    do: connect it\n");
  EXPECT_EQ(
      FindingsToJson({{"disk", Verdict::kBad, "full", "make room"}})["findings"][0]["verdict"],
      "bad");
}

TEST(Doctor, SaysHowTheStaffPageIsAskedFor) {
  const Finding good = JudgeStaffPage({}, {}, {"http://10.0.0.7:8090/", "http://10.1.0.7:8090/"});
  EXPECT_EQ(good.verdict, Verdict::kGood);
  EXPECT_EQ(good.found, "http://10.0.0.7:8090/, http://10.1.0.7:8090/");
  EXPECT_EQ(JudgeStaffPage(Status::Error("port", "taken"), {}, {}).verdict, Verdict::kBad);
  EXPECT_EQ(JudgeStaffPage({}, Status::Error("pin", "short"), {}).verdict, Verdict::kBad);
}

TEST(Doctor, SaysWhetherTheFleetKnowsTheDevice) {
  FleetOptions fleet;
  fleet.address = "mqtts://10.0.0.5/pompeii";
  fleet.name = "tablet-01";
  EXPECT_EQ(JudgeFleet({}, fleet).found, "mqtts://10.0.0.5/pompeii knows \"tablet-01\"");
  EXPECT_EQ(JudgeFleet({}, fleet).verdict, Verdict::kGood);
  EXPECT_EQ(JudgeFleet(Status::Error("broker", "no answer"), fleet).verdict, Verdict::kBad);
}

}  // namespace
}  // namespace lararium::player
