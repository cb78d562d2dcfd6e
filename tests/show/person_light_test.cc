#include "shared/show/person_light.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "shared/core/random.h"

namespace lararium::show {
namespace {

// One joint, and balls all over a body's height.
std::shared_ptr<const human::Human> BlockedHuman() {
  human::Human human;
  human.skeleton.names = {"humanoid_root"};
  human.skeleton.parents = {human::Skeleton::kNoParent};
  human.skeleton.rest.resize(1);
  human.skeleton.joint_from_actor = {glm::mat4(1.0f)};
  human.light.count = 9;
  human.light.key_poses = {human.skeleton.rest};
  human.light.receivers = {{0, {0.0f, 1.0f, 0.3f}}};
  human.light.meshes.resize(1);
  human.meshes.resize(1);
  Random random(9);
  for (int i = 0; i < 40; ++i) {
    human.light.blockers.push_back({0,
                                    {static_cast<float>(random.Uniform(-0.2, 0.2)),
                                     static_cast<float>(random.Uniform(0.1, 1.7)),
                                     static_cast<float>(random.Uniform(-0.2, 0.2))},
                                    static_cast<float>(random.Uniform(0.04, 0.12))});
  }
  return std::make_shared<const human::Human>(std::move(human));
}

struct Sums {
  double share = 0.0;
  glm::dvec3 centre = glm::dvec3(0.0);
};
// What the balls hide from afar, and about where.
Sums SumsOf(const SphereSet& balls) {
  Sums sums;
  for (size_t i = 0; i < balls.size(); ++i) {
    const double share = static_cast<double>(balls.radius[i]) * balls.radius[i];
    sums.share += share;
    sums.centre += share * glm::dvec3(balls.x[i], balls.y[i], balls.z[i]);
  }
  sums.centre /= sums.share;
  return sums;
}

class PersonLightTest : public ::testing::Test {
 protected:
  // The blockers of one person for another so far away.
  SphereSet SeenFrom(float metres) {
    const glm::mat4 skin(1.0f);
    near_.Pose({&skin, 1}, glm::mat4(1.0f));
    far_.Pose({&skin, 1}, glm::translate(glm::mat4(1.0f), glm::vec3(metres, 0.0f, 0.0f)));
    SphereSet seen;
    near_.AppendBlockers(far_, seen);
    return seen;
  }

  std::shared_ptr<const human::Human> human_ = BlockedHuman();
  PersonLight near_{human_};
  PersonLight far_{human_};
};

TEST_F(PersonLightTest, WhoTouchesSeesEveryBlocker) {
  EXPECT_EQ(SeenFrom(0.3f).size(), human_->light.blockers.size());
}

TEST_F(PersonLightTest, FromAfarFewBallsHideAsMuchInTheSamePlace) {
  const SphereSet few = SeenFrom(4.0f);
  EXPECT_LE(few.size(), human_->light.blockers.size() / 4);
  const Sums merged = SumsOf(few);
  const Sums all = SumsOf(near_.blockers());
  EXPECT_NEAR(merged.share, all.share, 1e-6);
  EXPECT_LT(glm::distance(merged.centre, all.centre), 1e-5);
}

TEST_F(PersonLightTest, InBetweenOnlyWhatLooksSmallIsMerged) {
  const SphereSet some = SeenFrom(1.2f);
  EXPECT_LT(some.size(), human_->light.blockers.size());
  EXPECT_NEAR(SumsOf(some).share, SumsOf(near_.blockers()).share, 1e-6);
}

}  // namespace
}  // namespace lararium::show
