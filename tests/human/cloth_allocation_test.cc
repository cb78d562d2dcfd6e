// Cloth and hair allocate nothing while they move. This is a separate program because it replaces
// the global allocator.

#include <gtest/gtest.h>

#include "shared/human/cloth.h"
#include "shared/human/spring.h"
#include "tests/human/walker.h"
#include "tests/support/allocation_counter.h"

namespace lararium::human {
namespace {

TEST(ClothAllocation, NoStepNorDrapingAllocates) {
  Human human = SkirtedWalker(20, 10);
  SpringChain chain;
  chain.joints = {6, 7};
  human.springs.push_back(chain);
  const ClothModel model(human);
  ClothState state(model);
  const ClothState snapshot = state;
  const SpringModel springs(human);
  SpringState spring_state(springs);
  const SkinnedMesh& mesh = human.meshes[0];
  std::vector<glm::vec3> x(mesh.positions.size()), n(x.size());
  const std::vector<glm::mat4> skin(human.skeleton.size(), glm::mat4(1.0f));
  WalkerPose walker;
  PoseWalker(human, 0.0, walker);
  int allocations = 0;
  for (int i = 0; i < 200; ++i) {
    PoseWalker(human, i % 90 == 0 ? 20.0 : i / 25.0, walker);  // occasionally a cut
    ClothStep step;
    step.actor_from_joint = walker.actor_from_joint;
    step.stage_from_actor = walker.stage_from_actor;
    step.elapsed = 0.04f;
    step.detail = static_cast<ClothDetail>(i / 50);
    step.wind.velocity = {2.0f, 0.0f, 0.0f};
    ClothState& moving = state;
    if (i == 120) {
      state = snapshot;  // A copy has the same capacity.
    }
    test::AllocationCounter counter;
    StepSprings(springs, {.stage_from_actor = walker.stage_from_actor, .elapsed = 0.04f},
                spring_state, walker.pose, walker.actor_from_joint);
    StepCloth(model, step, moving);
    DrapeMesh(model, moving, 0, mesh, skin, x, n);
    allocations += counter.Stop();
  }
  EXPECT_EQ(allocations, 0);
}

}  // namespace
}  // namespace lararium::human
