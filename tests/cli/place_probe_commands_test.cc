#include "editor/cli/place_probe_commands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>

#include "editor/bake/exr_image.h"
#include "editor/document/white_balance.h"
#include "shared/geometry/glm_convert.h"
#include "tests/bake/probe_images.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using testing::HasSubstr;
using Work = ProbeOptions::Work;

class PlaceProbes : public testing::Test {
 protected:
  // A bar, and a sky with a bright spot straight ahead, 30 degrees high.
  PlaceProbes() {
    EXPECT_TRUE(CreateProject(paths_, "Tavern").ok());
    ProjectDocument document = *LoadProject(paths_);
    document.places.emplace_back().name = "bar";
    EXPECT_TRUE(SaveProject(paths_, document).ok());
    const glm::vec3 sun = glm::normalize(glm::vec3(0.0f, 0.5f, -std::sqrt(0.75f)));
    const bake::ProbeImage image = test::MakeProbe(128, [&](const glm::vec3& direction) {
      return glm::dot(direction, sun) > 0.998f ? glm::vec3(500.0f) : glm::vec3(1.0f);
    });
    std::vector<glm::vec4> pixels;
    for (const glm::vec3& pixel : image.pixels) {
      pixels.emplace_back(pixel, 1.0f);
    }
    EXPECT_TRUE(bake::WriteExr(sky_, image.width, image.height, pixels).ok());
  }

  Result<CommandResult> Run(ProbeOptions options) {
    options.project = paths_.folder;
    return RunPlaceProbe(options);
  }
  ProbeDocument Saved() { return LoadProject(paths_)->places[0].probes.at(0); }

  const test::TemporaryFolder folder_;
  const ProjectPaths paths_{folder_ / "tavern.lararium"};
  const std::filesystem::path sky_ = folder_ / "tavern.lararium" / "sky.exr";
};

TEST_F(PlaceProbes, OneIsAddedChangedAndRemoved) {
  EXPECT_THAT(Run({.work = Work::kList})->text, HasSubstr("bar: even light"));
  const auto added =
      Run({.work = Work::kAdd, .files = {sky_}, .name = "noon", .at = {0, 1.5, -1}, .hour = 12.0});
  ASSERT_TRUE(added.ok()) << added.message();
  EXPECT_EQ(Saved().file, "sky.exr");
  ASSERT_TRUE(Run({.work = Work::kSet, .name = "noon", .exposure = 1.0, .warmth = 0.5}).ok());
  EXPECT_NEAR(Saved().scale, 2.0, 1e-9);
  EXPECT_NEAR(WhiteBalanceOf(geometry::ToGlm(Saved().balance)).warmth, 0.5, 1e-5);
  ASSERT_TRUE(Run({.work = Work::kSet, .name = "noon", .tint = 0.25}).ok());
  EXPECT_NEAR(WhiteBalanceOf(geometry::ToGlm(Saved().balance)).warmth, 0.5, 1e-5) << "as it was";
  EXPECT_EQ(Saved().position, Eigen::Vector3d(0, 1.5, -1));
  EXPECT_THAT(Run({.work = Work::kList})->text, HasSubstr("exposure +1.00 stops, warmth +0.50"));
  ASSERT_TRUE(Run({.work = Work::kRemove, .name = "noon"}).ok());
  EXPECT_TRUE(LoadProject(paths_)->places[0].probes.empty());
}

TEST_F(PlaceProbes, OneIsTurnedAndItsSunIsMatched) {
  ASSERT_TRUE(Run({.work = Work::kAdd, .files = {sky_}, .name = "noon", .rotation = {90}}).ok());
  ASSERT_TRUE(Run({.work = Work::kSet, .turn = -45.0, .name = "noon"}).ok());
  const Eigen::Quaterniond eighth(
      Eigen::AngleAxisd(std::numbers::pi / 4.0, Eigen::Vector3d::UnitY()));
  EXPECT_LT(Saved().stage_from_probe.angularDistance(eighth), 1e-6);

  // The sun is on the right of the stage, as high as in the picture.
  ASSERT_TRUE(Run({.work = Work::kSet, .pairs = {90, 30}, .level = true, .name = "noon"}).ok());
  const Eigen::Vector3d sun =
      Saved().stage_from_probe * Eigen::Vector3d(0.0, 0.5, -std::sqrt(0.75));
  EXPECT_LT((sun - Eigen::Vector3d(std::sqrt(0.75), 0.5, 0.0)).norm(), 0.03);
}

TEST_F(PlaceProbes, AGreySurfaceSaysHowBrightItIs) {
  ASSERT_TRUE(Run({.work = Work::kAdd, .files = {sky_}, .name = "noon"}).ok());
  ASSERT_TRUE(Run({.work = Work::kSet, .pixel = {120, 120, 120}, .name = "noon"}).ok());
  const double dark = Saved().scale;
  EXPECT_NE(dark, 1.0);
  ASSERT_TRUE(Run({.work = Work::kSet, .pixel = {200, 200, 200}, .name = "noon"}).ok());
  EXPECT_GT(Saved().scale, 2.0 * dark);
}

TEST_F(PlaceProbes, WhatCannotBeIsRefusedAndNothingIsSaved) {
  ASSERT_TRUE(Run({.work = Work::kAdd, .files = {sky_}, .name = "noon"}).ok());
  const Json before = FormatProject(*LoadProject(paths_));
  const auto problem = [&](ProbeOptions options) {
    return Run(std::move(options)).status().message();
  };
  EXPECT_THAT(problem({.work = Work::kAdd, .files = {sky_}, .name = "noon"}), HasSubstr("already"));
  EXPECT_THAT(problem({.work = Work::kSet, .name = "moon", .exposure = 1.0}),
              HasSubstr("bar has no probe \"moon\"; it has noon"));
  EXPECT_THAT(problem({.work = Work::kRemove, .name = "moon"}), HasSubstr("no probe"));
  EXPECT_THAT(problem({.work = Work::kSet, .files = {folder_ / "none.exr"}, .name = "noon"}),
              HasSubstr("none.exr"));
  EXPECT_THAT(problem({.work = Work::kSet, .pairs = {1, 2, 3}, .name = "noon"}),
              HasSubstr("2, 4 or 8 numbers"));
  EXPECT_THAT(problem({.work = Work::kList, .place = "moon"}), HasSubstr("no place \"moon\""));
  EXPECT_EQ(FormatProject(*LoadProject(paths_)), before);
}

}  // namespace
}  // namespace lararium::editor
