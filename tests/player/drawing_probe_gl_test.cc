#include <gmock/gmock.h>

#include <memory>

#include "player/app/drawing_probe.h"
#include "shared/render/quality.h"
#include "tests/render/gl_fixture.h"
#include "tests/render/test_people.h"
#include "tests/show/small_show.h"

namespace lararium::player {
namespace {

// A ball in a place with two keyframes. Only the second one has an image.
show::ShowContent SmallContent() {
  show::ShowContent content = test::SmallContent();
  content.drama = "";
  content.cast = {{"ball", std::make_shared<const human::Human>(
                               render::MakeHuman(render::Sphere(glm::vec3(1.0f)), 1))}};
  vision::SceneDatabase map;
  map.camera = {64, 48, 60.0, 60.0, 31.5, 23.5};
  map.keyframes.resize(2);
  map.keyframes[1].grey = cv::Mat(48, 64, CV_8UC1, cv::Scalar(90));
  for (vision::Keyframe& keyframe : map.keyframes) {
    keyframe.camera_from_map.translation.z() = 4.0;
  }
  content.places.front().map = std::make_shared<const vision::SceneDatabase>(map);
  return content;
}

TEST(DrawingProbe, DrawsASmallShowAtEveryLevelThatIsQuickEnough) {
  const show::ShowContent content = SmallContent();
  const auto log = MakeSilentLog();
  const DrawingProbe probe =
      ProbeDrawing(content, std::nullopt, render::TestedGraphics(), 0.001, *log);
  ASSERT_TRUE(probe.problem.ok()) << probe.problem.message();
  EXPECT_EQ(probe.size.width, 64);
  EXPECT_EQ(probe.size.height, 48);
  ASSERT_EQ(probe.rates.size(), render::QualityLadder().size());
  for (const double rate : probe.rates) {
    EXPECT_GT(rate, 0.0);
  }
}

TEST(DrawingProbe, TriesNoFinerLevelThanOneThatIsTooSlow) {
  const show::ShowContent content = SmallContent();
  const auto log = MakeSilentLog();
  const DrawingProbe probe =
      ProbeDrawing(content, PictureSize{32, 24}, render::TestedGraphics(), 1e9, *log);
  ASSERT_TRUE(probe.problem.ok()) << probe.problem.message();
  EXPECT_EQ(probe.size.width, 32);
  EXPECT_GT(probe.rates.back(), 0.0);
  EXPECT_EQ(probe.rates[probe.rates.size() - 2], 0.0);
}

TEST(DrawingProbe, SaysThatAPlaceHasNoKeyframes) {
  show::ShowContent content = SmallContent();
  content.places.front().map = std::make_shared<const vision::SceneDatabase>();
  const auto log = MakeSilentLog();
  EXPECT_THAT(
      ProbeDrawing(content, std::nullopt, render::TestedGraphics(), 30.0, *log).problem.message(),
      ::testing::HasSubstr("bar: has no keyframes"));
}

TEST(DrawingProbe, SaysWhyADramaDoesNotBegin) {
  show::ShowContent content = SmallContent();
  content.drama = "this is no Lua";
  const auto log = MakeSilentLog();
  const DrawingProbe probe =
      ProbeDrawing(content, std::nullopt, render::TestedGraphics(), 30.0, *log);
  EXPECT_FALSE(probe.problem.ok());
}

}  // namespace
}  // namespace lararium::player
