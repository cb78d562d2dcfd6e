#include "shared/show/person_blockers.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "shared/core/random.h"

namespace lararium::show {
namespace {

// Spheres of one joint, distributed over a body's height.
std::vector<human::LightTransfer::Blocker> SpheresOfBody() {
  std::vector<human::LightTransfer::Blocker> blockers;
  Random random(9);
  for (int i = 0; i < 40; ++i) {
    blockers.push_back({0,
                        {static_cast<float>(random.Uniform(-0.2, 0.2)),
                         static_cast<float>(random.Uniform(0.1, 1.7)),
                         static_cast<float>(random.Uniform(-0.2, 0.2))},
                        static_cast<float>(random.Uniform(0.04, 0.12))});
  }
  return blockers;
}

struct Sums {
  double share = 0.0;
  glm::dvec3 centre = glm::dvec3(0.0);
};
// Sums that describe what the spheres hide from a distance, and where.
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

class PersonBlockersTest : public ::testing::Test {
 protected:
  // The blockers of one person as seen by another one at a distance.
  SphereSet SeenFrom(float metres) {
    const glm::mat4 skin(1.0f);
    near_.Pose({&skin, 1}, glm::mat4(1.0f));
    far_.Pose({&skin, 1}, glm::translate(glm::mat4(1.0f), glm::vec3(metres, 0.0f, 0.0f)));
    SphereSet seen;
    near_.AppendTo(seen, far_);
    return seen;
  }

  std::vector<human::LightTransfer::Blocker> blockers_ = SpheresOfBody();
  PersonBlockers near_{blockers_};
  PersonBlockers far_{blockers_};
};

TEST_F(PersonBlockersTest, WhoTouchesSeesEveryBlocker) {
  EXPECT_EQ(SeenFrom(0.3f).size(), blockers_.size());
}

TEST_F(PersonBlockersTest, FromAfarFewBallsHideAsMuchInTheSamePlace) {
  const SphereSet few = SeenFrom(4.0f);
  EXPECT_LE(few.size(), blockers_.size() / 4);
  const Sums merged = SumsOf(few);
  const Sums all = SumsOf(near_.spheres());
  EXPECT_NEAR(merged.share, all.share, 1e-6);
  EXPECT_LT(glm::distance(merged.centre, all.centre), 1e-5);
}

TEST_F(PersonBlockersTest, InBetweenOnlyWhatLooksSmallIsMerged) {
  const SphereSet some = SeenFrom(1.2f);
  EXPECT_LT(some.size(), blockers_.size());
  EXPECT_NEAR(SumsOf(some).share, SumsOf(near_.spheres()).share, 1e-6);
}

TEST_F(PersonBlockersTest, TellsAJumpFromAStep) {
  const glm::mat4 skin(1.0f);
  const auto jumps_to = [&](float x) {
    return near_.Pose({&skin, 1}, glm::translate(glm::mat4(1.0f), glm::vec3(x, 0.0f, 0.0f)));
  };
  EXPECT_TRUE(jumps_to(5.0f)) << "it came from nowhere";
  EXPECT_FALSE(jumps_to(5.1f));
  EXPECT_TRUE(jumps_to(5.4f));
}

}  // namespace
}  // namespace lararium::show
