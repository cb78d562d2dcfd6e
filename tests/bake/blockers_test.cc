#include "editor/bake/blockers.h"

#include <gtest/gtest.h>

#include "editor/bake/receivers.h"
#include "tests/bake/test_surfaces.h"

namespace lararium::bake {
namespace {

using human::LightTransfer;

float Volume(std::span<const LightTransfer::Blocker> blockers) {
  float sum = 0.0f;
  for (const LightTransfer::Blocker& blocker : blockers) {
    sum += 4.0f / 3.0f * kPiF * blocker.radius * blocker.radius * blocker.radius;
  }
  return sum;
}

std::vector<LightTransfer::Blocker> Fit(const human::Human& human,
                                        std::span<const SurfaceMesh> surfaces,
                                        size_t count) {
  auto blockers = FitBlockers(surfaces, StrongestJoints(human), count);
  EXPECT_TRUE(blockers.ok()) << blockers.message();
  return blockers.ok() ? *std::move(blockers) : std::vector<LightTransfer::Blocker>{};
}

TEST(Blockers, HaveTheVolumeOfTheModelAndLieInIt) {
  const SurfaceMesh sphere = MakeCap({0, 1, 0}, 0.5f, kPiF, false, glm::vec3(0.5f), 12, 24);
  const human::Human human = MakeRigidHuman({glm::vec3(0.0f)}, {{sphere, 0}});
  for (const size_t count : {size_t{1}, size_t{20}}) {
    const auto blockers = Fit(human, {&sphere, 1}, count);
    ASSERT_EQ(blockers.size(), count);
    // The ball, without the volume that its flat triangles cut off.
    EXPECT_NEAR(Volume(blockers), 0.97f * 4.0f / 3.0f * kPiF * 0.125f, 0.03f * 0.52f);
    for (const LightTransfer::Blocker& blocker : blockers) {
      EXPECT_LT(glm::distance(blocker.centre, glm::vec3(0, 1, 0)), 0.5f);
      EXPECT_EQ(blocker.joint, 0u);
    }
  }
  const auto one = Fit(human, {&sphere, 1}, 1);
  EXPECT_LT(glm::distance(one[0].centre, glm::vec3(0, 1, 0)), 0.01f);
}

TEST(Blockers, FollowTheJointOfWhatIsAroundThem) {
  const SurfaceMesh parts[] = {MakeBox({-0.5f, 0, -0.1f}, {-0.1f, 0.3f, 0.1f}, glm::vec3(0.5f)),
                               MakeBox({0.1f, 0, -0.1f}, {0.5f, 0.3f, 0.1f}, glm::vec3(0.5f))};
  const human::Human human =
      MakeRigidHuman({glm::vec3(0.0f), glm::vec3(0.3f, 0, 0)}, {{parts[0], 0}, {parts[1], 1}});
  const auto blockers = Fit(human, parts, 12);
  ASSERT_EQ(blockers.size(), 12u);
  EXPECT_NEAR(Volume(blockers), 2.0f * 0.4f * 0.3f * 0.2f, 0.05f * 0.048f);
  for (const LightTransfer::Blocker& blocker : blockers) {
    EXPECT_EQ(blocker.joint, blocker.centre.x > 0.0f ? 1u : 0u);
    EXPECT_GT(std::abs(blocker.centre.x), 0.1f);
  }
}

TEST(Blockers, WhatShutsNothingInHasNone) {
  const SurfaceMesh disc = MakeDisc({0, 1, 0}, {0, 1, 0}, 1.0f, glm::vec3(0.5f));
  const human::Human human = MakeRigidHuman({glm::vec3(0.0f)}, {{disc, 0}});
  EXPECT_TRUE(Fit(human, {&disc, 1}, 8).empty());
  SurfaceMesh nothing;
  EXPECT_FALSE(FitBlockers({&nothing, 1}, {{}}, 8).ok());
}

LightTransfer Place(const human::Human& human, std::span<const SurfaceMesh> rest, size_t count) {
  LightTransfer transfer;
  PlaceReceivers(rest, human, count, transfer);
  return transfer;
}

TEST(Receivers, EveryVertexIsBoundInSharesThatSumToOne) {
  const SurfaceMesh parts[] = {MakeSphere({0, 1, 0}, 0.5f, glm::vec3(0.5f)),
                               MakeBox({-0.1f, 0, -0.1f}, {0.1f, 0.5f, 0.1f}, glm::vec3(0.5f))};
  const human::Human human =
      MakeRigidHuman({glm::vec3(0.0f), glm::vec3(0, 1, 0)}, {{parts[0], 1}, {parts[1], 0}});
  for (const size_t count : {size_t{1}, size_t{3}, size_t{60}, size_t{1000}}) {
    const LightTransfer transfer = Place(human, parts, count);
    EXPECT_EQ(transfer.receivers.size(), count);
    ASSERT_EQ(transfer.meshes.size(), 2u);
    for (size_t m = 0; m < 2; ++m) {
      ASSERT_EQ(transfer.meshes[m].weights.size(), parts[m].positions.size());
      ASSERT_EQ(transfer.meshes[m].receivers.size(), parts[m].positions.size());
      for (size_t v = 0; v < parts[m].positions.size(); ++v) {
        const auto& weights = transfer.meshes[m].weights[v];
        EXPECT_EQ(weights[0] + weights[1] + weights[2] + weights[3], 255);
        EXPECT_TRUE(std::is_sorted(weights.rbegin(), weights.rend()));
        for (const uint16_t receiver : transfer.meshes[m].receivers[v]) {
          EXPECT_LT(receiver, transfer.receivers.size());
        }
      }
    }
  }
}

TEST(Receivers, LieJustOffTheSurfaceAndFollowItsJoint) {
  const SurfaceMesh parts[] = {MakeSphere({0, 1, 0}, 0.5f, glm::vec3(0.5f)),
                               MakeSphere({3, 1, 0}, 0.5f, glm::vec3(0.5f))};
  const human::Human human =
      MakeRigidHuman({glm::vec3(0.0f), glm::vec3(3, 1, 0)}, {{parts[0], 0}, {parts[1], 1}});
  const LightTransfer transfer = Place(human, parts, 100);
  size_t of_second = 0;
  for (const LightTransfer::Receiver& receiver : transfer.receivers) {
    const bool second = receiver.position.x > 1.5f;
    of_second += second;
    EXPECT_EQ(receiver.joint, second ? 1u : 0u);
    const glm::vec3 centre(second ? 3.0f : 0.0f, 1.0f, 0.0f);
    EXPECT_NEAR(glm::distance(receiver.position, centre), 0.52f, 1e-4f);
  }
  EXPECT_NEAR(static_cast<double>(of_second), 50.0, 10.0);
  for (size_t m = 0; m < 2; ++m) {
    for (size_t v = 0; v < parts[m].positions.size(); ++v) {
      EXPECT_EQ(transfer.receivers[transfer.meshes[m].receivers[v][0]].joint, m);
    }
  }
}

TEST(Receivers, BothSidesOfASheetHaveTheirOwn) {
  const SurfaceMesh parts[] = {MakeDisc({0, 1.001f, 0}, {0, 1, 0}, 0.3f, glm::vec3(0.5f)),
                               MakeDisc({0, 1, 0}, {0, -1, 0}, 0.3f, glm::vec3(0.5f))};
  const human::Human human = MakeRigidHuman({glm::vec3(0.0f)}, {{parts[0], 0}, {parts[1], 0}});
  const LightTransfer transfer = Place(human, parts, 120);
  for (size_t m = 0; m < 2; ++m) {
    for (size_t v = 0; v < parts[m].positions.size(); ++v) {
      const auto is_own = [&](size_t i) {
        const float y = transfer.receivers[transfer.meshes[m].receivers[v][i]].position.y;
        return (y > 1.0005f) == (m == 0);
      };
      EXPECT_TRUE(is_own(0)) << m << " " << v;
      int own = 0;
      for (size_t i = 0; i < 4; ++i) {
        own += is_own(i) ? transfer.meshes[m].weights[v][i] : 0;
      }
      EXPECT_GE(own, 192) << m << " " << v;
    }
  }
}

}  // namespace
}  // namespace lararium::bake
