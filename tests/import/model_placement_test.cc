#include "editor/import/model/model_placement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "editor/import/model/model_matrix.h"
#include "tests/import/plain_figure.h"

namespace lararium::import {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

// The plain skeleton as the rig of a file that states no unit.
class ModelPlacement : public ::testing::Test {
 protected:
  void Stand(float units_per_metre, const glm::vec3& at = glm::vec3(0.0f)) {
    const human::Skeleton skeleton = PlainSkeleton();
    for (size_t j = 0; j < skeleton.size(); ++j) {
      model_.nodes.parents.push_back(skeleton.parents[j]);
      rig_.node_of_bone.push_back(static_cast<int>(j));
      rig_.bones.names.push_back(skeleton.names[j]);
      rig_.bones.parents.push_back(skeleton.parents[j]);
      rig_.bones.positions.push_back(units_per_metre *
                                     (RestPosition(skeleton, skeleton.names[j]) + at));
    }
    rig_.map = MapBones(rig_.bones);
  }

  // A part with a vertex at each joint.
  Part Body() const {
    Part part;
    part.positions = rig_.bones.positions;
    for (const int node : rig_.node_of_bone) {
      part.influences.push_back({Influence{node, 1.0f}});
    }
    return part;
  }

  int Node(const char* joint) const { return static_cast<int>(*rig_.bones.Find(joint)); }

  glm::mat4 Place(const std::vector<Part>& parts, std::optional<float> metres_per_unit = {}) {
    const auto placed = PlaceFigure(model_, parts, rig_, metres_per_unit, notes_);
    EXPECT_TRUE(placed.ok());
    return placed.ok() ? *placed : glm::mat4(0.0f);
  }

  float LowestJoint(const glm::mat4& actor_from_scene) const {
    float lowest = 1e9f;
    for (const glm::vec3& position : rig_.bones.positions) {
      lowest = std::min(lowest, Apply(actor_from_scene, position).y);
    }
    return lowest;
  }

  ModelScene model_;
  ModelRig rig_;
  std::vector<std::string> notes_;
};

TEST_F(ModelPlacement, TakesMetresWhereTheseMakeAPersonOfPossibleHeight) {
  Stand(1.0f);
  EXPECT_NEAR(ScaleOf(Place({Body()})), 1.0f, 1e-6f);
  EXPECT_THAT(notes_, IsEmpty());
}

TEST_F(ModelPlacement, TakesInchesWhereTheseMakeAPersonOfPossibleHeightAndSaysSo) {
  Stand(1.0f / 0.0254f);
  EXPECT_NEAR(ScaleOf(Place({Body()})), 0.0254f, 1e-6f);
  ASSERT_EQ(notes_.size(), 1u);
  EXPECT_THAT(notes_[0], HasSubstr("0.0254"));
}

TEST_F(ModelPlacement, MakesAMotionOfNoUnitAsTallAsPeopleAre) {
  Stand(17.0f);
  const glm::mat4 actor_from_scene = Place({});
  const auto [low, high] =
      std::minmax_element(rig_.bones.positions.begin(), rig_.bones.positions.end(),
                          [](const glm::vec3& a, const glm::vec3& b) { return a.y < b.y; });
  EXPECT_NEAR(Apply(actor_from_scene, *high).y - Apply(actor_from_scene, *low).y, 1.75f, 1e-4f);
}

TEST_F(ModelPlacement, TakesTheUnitThatItIsTold) {
  Stand(1.0f);
  EXPECT_NEAR(ScaleOf(Place({Body()}, 0.5f)), 0.5f, 1e-6f);
  EXPECT_THAT(notes_, IsEmpty());
}

TEST_F(ModelPlacement, BringsWhoStandsElsewhereOverTheOrigin) {
  Stand(1.0f, {7.0f, 3.0f, -2.0f});
  const glm::vec3 hips =
      Apply(Place({Body()}), rig_.bones.positions[*rig_.bones.Find("humanoid_root")]);
  EXPECT_NEAR(hips.x, 0.0f, 1e-5f);
  EXPECT_NEAR(hips.z, 0.0f, 1e-5f);
}

TEST_F(ModelPlacement, StandsOnFeetWhateverHangsLower) {
  Stand(1.0f, {0.0f, 2.0f, 0.0f});
  Part cloak = Body();
  cloak.positions.push_back(rig_.bones.positions[0] - glm::vec3(0.0f, 1.5f, 0.0f));
  cloak.influences.push_back({Influence{Node("vl5"), 1.0f}});
  EXPECT_NEAR(LowestJoint(Place({cloak})), 0.0f, 1e-5f);
  cloak.influences.back() = {Influence{Node("l_ankle"), 1.0f}};  // Now bound to a foot.
  EXPECT_GT(LowestJoint(Place({cloak})), 0.3f);
}

// Only the head has a surface; the soles are where the joints of the feet are.
TEST_F(ModelPlacement, StandsOnJointsWhereLegsHaveNoSurface) {
  Stand(1.0f, glm::vec3(0.0f, -3.0f, 0.0f));
  Part head;
  head.positions = {rig_.bones.positions[static_cast<size_t>(Node("skullbase"))]};
  head.influences.push_back({Influence{Node("skullbase"), 1.0f}});
  EXPECT_NEAR(LowestJoint(Place({head}, 1.0f)), 0.0f, 1e-4f);
}

TEST_F(ModelPlacement, TellsSizesThatAreHardlyMeant) {
  Part box;
  box.positions = {glm::vec3(0.0f), glm::vec3(0.0f, 1.0f, 80.0f)};
  box.influences.resize(2);
  Place({box});
  EXPECT_THAT(notes_, ::testing::Contains(HasSubstr("longest side is 80 m")));
  notes_.clear();
  box.positions[1] = glm::vec3(0.0f, 1.0f, 8.0f);
  Place({box});
  EXPECT_THAT(notes_, IsEmpty());
}

}  // namespace
}  // namespace lararium::import
