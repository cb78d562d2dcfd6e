// Animation allocates nothing. This is a separate program because it replaces the global allocator.

#include <gtest/gtest.h>

#include <memory>

#include "shared/human/animator.h"
#include "shared/human/turns.h"
#include "tests/human/full_body.h"
#include "tests/support/allocation_counter.h"

namespace lararium::human {
namespace {

TEST(AnimationState, AllocatesNothingOnceItIsBuilt) {
  auto human = std::make_shared<Human>(FullBody(0.7f, 3));
  Clip clip{"still", 0.0f, 30.0f, false, 0.0f, human->skeleton.rest};
  human->clips.push_back(clip);
  const auto model = MakeAnimationRig(human);
  Animator animator(model);
  AnimationState animation_state, previous;
  VisemeTrack track;
  track.keys = {{0.0f, Viseme::kAa, 1.0f}, {0.2f, Viseme::kPP, 1.0f}};
  track.duration = 0.4f;
  const FloorHeight floor = [](float x, float) { return 0.02f * x; };
  glm::vec3 position(0.0f);
  constexpr float kTick = 1.0f / 120.0f;
  test::AllocationCounter counter;
  for (int tick = 0; tick < 600; ++tick) {
    position.z -= 1.2f * kTick;
    if (tick == 100) {
      StartClip(animation_state.animation, 0, 1.0, 0.3f, BodyPart::kUpper);
      StartReach(animation_state.reaches[kRight], {{0.2f, 0.2f, -0.4f}, kNoTurn}, 0.5f);
      SetHandPose(animation_state.hands[kRight], HandPose::kPinch, 0.3f);
      SetExpression(animation_state.face, Expression::kJoy, 1.0f, 0.3f);
    }
    animation_state.gaze.kind = GazeKind::kPerson;
    animation_state.gaze.target = position + glm::vec3(0.5f, 1.6f, -1.5f);
    animation_state.face.visemes = SampleVisemes(track, 0.001 * tick);
    previous = animation_state;
    UpdateAnimationState(*model, position, 0.0f, kTick, floor, animation_state);
    animator.Pose(Interpolate(previous, animation_state, 0.3f));
  }
  EXPECT_EQ(counter.Stop(), 0);
}

}  // namespace
}  // namespace lararium::human
