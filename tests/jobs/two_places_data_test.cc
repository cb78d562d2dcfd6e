// One drama at the maquette and at the site.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "editor/jobs/baking.h"
#include "editor/jobs/staging.h"
#include "shared/show/show.h"
#include "tests/jobs/two_places.h"

namespace lararium::editor {
namespace {

class TwoPlaces : public testing::Test, protected test::TwoPlacesProject {
 protected:
  // The state of the show at one place at every tenth of a second.
  struct Played {
    std::vector<glm::mat4> stage_from_keeper;
    std::vector<std::vector<glm::mat4>> skin;
    std::vector<drama::TaskRecord> tasks;
  };
  Played PlayAt(const std::string& place) {
    Result<show::ShowContent> content = LoadShowContent(paths_, *LoadProject(paths_), place);
    CHECK(content.ok());
    vision::TrackedFrame tracked;
    tracked.state = vision::TrackState::kTracking;
    tracked.camera_from_map = content->places.front().map->keyframes[5].camera_from_map;
    const std::shared_ptr<Log> log = MakeSilentLog();
    const auto show = show::Show::Create(*std::move(content), {}, *log);
    CHECK(show.ok());
    Played played;
    show::StagedFrame staged;
    for (int moment = 0; moment < 80; ++moment) {
      (*show)->StageFrame(tracked, 0.1 * moment, staged);
      played.stage_from_keeper.push_back(staged.people.actors.at(0).stage_from_actor);
      played.skin.push_back(staged.people.skin);
    }
    const auto tasks = (*show)->drama().tasks();
    played.tasks.assign(tasks.begin(), tasks.end());
    return played;
  }
};

TEST_F(TwoPlaces, TheWholeDramaIsTheSameOnTheStageOfEither) {
  NoProgress progress;
  const auto baked = Bake(paths_, *LoadProject(paths_), progress);
  ASSERT_TRUE(baked.ok()) << baked.message();
  const Played maquette = PlayAt("maquette");
  const Played site = PlayAt("site");
  ASSERT_EQ(maquette.tasks.size(), 2u);
  ASSERT_EQ(site.tasks.size(), 2u);
  const drama::TaskRecord& walk = maquette.tasks[1];
  EXPECT_FALSE(walk.failed) << walk.message;
  EXPECT_EQ(walk.ended, site.tasks[1].ended);
  EXPECT_EQ(maquette.stage_from_keeper, site.stage_from_keeper);
  EXPECT_EQ(maquette.skin, site.skin);
  // The keeper walked around both obstacles, although each place has only one of them.
  float widest = 0.0f;
  for (const glm::mat4& stage_from_keeper : maquette.stage_from_keeper) {
    const glm::vec4 at = stage_from_keeper[3];
    EXPECT_FALSE(std::abs(at.x) < 1.0f && at.z < -1.0f && at.z > -1.2f) << "in the wall";
    EXPECT_FALSE(std::abs(at.x) < 0.4f && at.z < 0.6f && at.z > 0.2f) << "in the bench";
    widest = std::max(widest, std::abs(at.x));
  }
  EXPECT_GT(widest, 1.0f);
  EXPECT_LT(maquette.stage_from_keeper.back()[3].z, -2.4f);
}

}  // namespace
}  // namespace lararium::editor
