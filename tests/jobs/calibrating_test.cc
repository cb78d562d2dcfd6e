#include "editor/jobs/calibrating.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Kind = train::CalibrationAdvice::Kind;

const geometry::CameraModel kCamera{640,   480,   560.25, 562.0, 325.0,
                                    236.0, -0.28, 0.09,   8e-4,  -5e-4};

TEST(SaveDeviceCamera, WritesAFileOfItsOwn) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "device.json";
  ASSERT_TRUE(SaveDeviceCamera(file, kCamera).ok());
  const Json device = *LoadJson(file);
  EXPECT_EQ(device["schema"], 1);
  EXPECT_EQ(device["camera"]["width"], 640);
  EXPECT_EQ(device["camera"]["K"], Json({560.25, 562.0, 325.0, 236.0}));
  EXPECT_EQ(device["camera"]["k1_k2_p1_p2"], Json({-0.28, 0.09, 8e-4, -5e-4}));
}

TEST(SaveDeviceCamera, KeepsWhatElseTheFileSays) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "device.json";
  ASSERT_TRUE(
      SaveJson(file, {{"schema", 1}, {"camera", {{"width", 1}}}, {"lost", {{"hold", 0.5}}}}).ok());
  ASSERT_TRUE(SaveDeviceCamera(file, kCamera).ok());
  const Json device = *LoadJson(file);
  EXPECT_EQ(device["lost"]["hold"], 0.5);
  EXPECT_EQ(device["camera"]["width"], 640);
}

TEST(SaveDeviceCamera, LeavesAFileAloneThatIsNone) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "device.json";
  for (const char* text : {"[1]", "{", "{\"schema\": 2}", "{}"}) {
    ASSERT_TRUE(WriteFileAtomically(file, text).ok());
    const Status status = SaveDeviceCamera(file, kCamera);
    ASSERT_FALSE(status.ok()) << text;
    EXPECT_THAT(status.message(), HasSubstr("device.json"));
    EXPECT_EQ(*ReadText(file), text);
  }
}

TEST(BoardSvg, FillsA4WithSquaresOfWholeMillimetres) {
  const auto svg = BoardSvg({9, 6});
  ASSERT_TRUE(svg.ok()) << svg.message();
  EXPECT_THAT(*svg, HasSubstr("width=\"297mm\" height=\"210mm\""));
  EXPECT_THAT(*svg, HasSubstr("squares of 24 mm"));
  // 10 x 7 squares, half of them black.
  size_t black = 0;
  for (size_t at = svg->find("h24v24h-24z"); at != std::string::npos;
       at = svg->find("h24v24h-24z", at + 1)) {
    ++black;
  }
  EXPECT_EQ(black, 35u);
}

TEST(BoardSvg, IsUprightWhereTheBoardIsAndRefusesWhatDoesNotFit) {
  EXPECT_THAT(*BoardSvg({6, 9, 0.02}), HasSubstr("width=\"210mm\" height=\"297mm\""));
  EXPECT_THAT(BoardSvg({9, 6, 0.05}).message(), HasSubstr("take squares of 5 to 24 mm"));
  EXPECT_THAT(BoardSvg({40, 40}).message(), HasSubstr("take a smaller board"));
  EXPECT_FALSE(BoardSvg({1, 6}).ok());
}

TEST(AdviceTexts, NameAllPartsWithoutCornersAtOnce) {
  train::Calibration calibration;
  calibration.advice = {{Kind::kTilt, 0.03}, {Kind::kPart, 0}, {Kind::kPart, 7}, {Kind::kBlur, 12}};
  EXPECT_THAT(AdviceTexts(calibration, false),
              ElementsAre(HasSubstr("known to 3.0 % only"),
                          HasSubstr("hardly a corner was seen: the upper left corner, the lower "
                                    "edge."),
                          HasSubstr("12 blurred views")));
}

TEST(CalibrationText, EndsWithWhatTrainTakes) {
  train::Calibration calibration;
  calibration.camera = kCamera;
  EXPECT_THAT(CalibrationText(calibration),
              ::testing::EndsWith("--intrinsics 560.25,562,325,236,-0.28,0.09,0.0008,-0.0005\n"));
  EXPECT_EQ(CalibrationJson(calibration)["intrinsics"][0], 560.25);
}

TEST(RunCalibrate, SaysWhichFileIsNoVideo) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "none.mp4";
  ASSERT_TRUE(WriteFileAtomically(file, "no video").ok());
  CalibrateOptions options;
  options.video = file;
  NoProgress progress;
  const auto result = RunCalibrate(options, progress);
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(result.message(), HasSubstr("none.mp4"));
}

}  // namespace
}  // namespace lararium::editor
