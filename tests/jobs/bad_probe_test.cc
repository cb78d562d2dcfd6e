// Unusable light probes: a warning names each with its file and a remedy, and people are still lit.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/vec4.hpp>
#include <limits>

#include "editor/bake/exr_image.h"
#include "editor/cli/subcommands.h"
#include "editor/document/project.h"
#include "editor/jobs/baking.h"
#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using testing::Contains;
using testing::HasSubstr;

constexpr int kWidth = 64;
constexpr int kHeight = 32;

class BadProbeTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(CreateProject(paths_, "test").ok());
    document_ = LoadProject(paths_).value();
    document_.places.resize(1);
    document_.places[0].name = "bar";
  }
  // Grey light with a bright spot.
  static std::vector<glm::vec4> Good() {
    std::vector<glm::vec4> pixels(kWidth * kHeight, glm::vec4(0.5f, 0.5f, 0.5f, 1.0f));
    pixels[5 * kWidth + 7] = glm::vec4(60.0f, 50.0f, 40.0f, 1.0f);
    return pixels;
  }
  void Use(const std::string& file) {
    ProbeDocument probe;
    probe.name = "noon";
    probe.file = file;
    document_.places[0].probes = {probe};
    ASSERT_TRUE(SaveProject(paths_, document_).ok());
  }
  void UsePixels(const std::vector<glm::vec4>& pixels, int width = kWidth, int height = kHeight) {
    ASSERT_TRUE(bake::WriteExr(paths_.folder / "probe.exr", width, height, pixels).ok());
    Use("probe.exr");
  }
  // Expects one warning that names the file and the uniform light, whose radiance comes from the
  // map.
  void ExpectEvenLight(const std::string& why) {
    NoProgress progress;
    const auto report = Bake(paths_, document_, progress);
    ASSERT_TRUE(report.ok()) << report.message();
    ASSERT_EQ(report->warnings.size(), 1u);
    EXPECT_THAT(report->warnings[0], HasSubstr(why));
    EXPECT_THAT(report->warnings[0], HasSubstr("lit evenly"));
    const auto probes = LoadBakedProbes(paths_, document_.places[0], 0.75f);
    ASSERT_TRUE(probes.ok()) << probes.message();
    ASSERT_EQ(probes->size(), 1u);
    const glm::vec3 up = probes->at(0).light.Irradiance({0.0f, 1.0f, 0.0f});
    EXPECT_NEAR(up.g, 0.75f * static_cast<float>(M_PI), 1e-4f);
    EXPECT_FALSE(probes->at(0).light.sun.has_value());
  }
  CommandResult Check() {
    CheckOptions options;
    options.project = paths_.folder;
    options.seconds = 0.0;
    NoProgress progress;
    return RunCheck(options, progress).value();
  }

  test::TemporaryFolder folder_;
  ProjectPaths paths_{folder_ / "test.lararium"};
  ProjectDocument document_;
};

TEST_F(BadProbeTest, AMissingFile) {
  Use("nowhere.exr");
  ExpectEvenLight("nowhere.exr");
  EXPECT_THAT(Check().text,
              HasSubstr("nowhere.exr: was not found (the light probe \"noon\"); put it back"));
}

TEST_F(BadProbeTest, NotTwiceAsWideAsHigh) {
  UsePixels(std::vector<glm::vec4>(64 * 64, glm::vec4(1.0f)), 64, 64);
  ExpectEvenLight("64 x 64");
  EXPECT_THAT(Check().text, HasSubstr("probe.exr: the probe is 64 x 64, not twice as wide"));
  EXPECT_THAT(Check().text, HasSubstr("probe ball"));
}

TEST_F(BadProbeTest, NegativeRadiance) {
  std::vector<glm::vec4> pixels = Good();
  pixels[100] = glm::vec4(-3.0f, 0.0f, 0.0f, 1.0f);
  UsePixels(pixels);
  ExpectEvenLight("negative");
  EXPECT_THAT(Check().text, HasSubstr("probe.exr: pixel (36, 1) is negative"));
}

TEST_F(BadProbeTest, ManyPixelsThatAreNoNumbers) {
  std::vector<glm::vec4> pixels = Good();
  std::fill_n(pixels.begin(), 100, glm::vec4(std::nanf("")));
  UsePixels(pixels);
  ExpectEvenLight("not a number");
  EXPECT_THAT(Check().text, HasSubstr("repair the image"));
}

TEST_F(BadProbeTest, APhotographByMistake) {
  ASSERT_TRUE(WriteFileAtomically(paths_.folder / "probe.jpg", std::string_view("x")).ok());
  Use("probe.jpg");
  ExpectEvenLight("too small a range of brightness");
  EXPECT_THAT(Check().text, HasSubstr("probe merge"));
}

TEST_F(BadProbeTest, WhatCanBeMendedIsUsedWithAWarning) {
  std::vector<glm::vec4> pixels = Good();
  pixels[50].r = std::numeric_limits<float>::infinity();
  UsePixels(pixels);
  NoProgress progress;
  const auto report = Bake(paths_, document_, progress);
  ASSERT_TRUE(report.ok()) << report.message();
  EXPECT_THAT(report->baked, Contains(HasSubstr("noon")));
  EXPECT_THAT(report->warnings, Contains(HasSubstr("infinite")));
  EXPECT_THAT(Check().text, HasSubstr("warning: " + (paths_.folder / "probe.exr").string()));
}

TEST_F(BadProbeTest, LowRangeIsWarnedOf) {
  UsePixels(std::vector<glm::vec4>(kWidth * kHeight, glm::vec4(0.4f, 0.4f, 0.4f, 1.0f)));
  EXPECT_THAT(Check().text, HasSubstr("less than four times the mean"));
}

TEST_F(BadProbeTest, NothingIsLeftOfAProbeThatWasGood) {
  UsePixels(Good());
  NoProgress progress;
  ASSERT_TRUE(Bake(paths_, document_, progress).ok());
  UsePixels(std::vector<glm::vec4>(64 * 64, glm::vec4(1.0f)), 64, 64);
  ExpectEvenLight("64 x 64");
}

TEST(EvenRadiance, LightsUsualSurfacesAsBrightAsTheMapIs) {
  vision::SceneDatabase map;
  const float without = EvenRadiance(map);
  EXPECT_GT(without, 0.0f);
  map.colours = {Eigen::Vector3f::Constant(0.1f), Eigen::Vector3f::Constant(0.2f)};
  EXPECT_NEAR(0.3f * EvenRadiance(map), 0.15f, 1e-6f);
}

}  // namespace
}  // namespace lararium::editor
