// One person for one frame: an update of all behaviours, and the pose of a body with fingers, toes,
// eyes and jaw. Expected: 0.02 ms of the 0.2 ms budget of a person.

#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "shared/human/animator.h"
#include "shared/human/turns.h"
#include "tests/human/full_body.h"

namespace lararium::human {
namespace {

constexpr float kTick = 1.0f / 120.0f;

// The full body, with additional joints below its head up to this number.
std::shared_ptr<const Human> MakePerson(size_t joints) {
  auto human = std::make_shared<Human>(FullBody(0.7f, 3));
  const auto head = static_cast<int16_t>(*human->skeleton.Find("skullbase"));
  while (human->skeleton.size() < joints) {
    human->skeleton.names.push_back("face" + std::to_string(human->skeleton.size()));
    human->skeleton.parents.push_back(head);
    human->skeleton.rest.push_back({});
    human->skeleton.joint_from_actor.emplace_back(1.0f);
  }
  return human;
}

// Walks in a circle, looks at a target, holds an object in one hand and smiles.
AnimationState Busy() {
  AnimationState animation_state;
  animation_state.seed = 4;
  animation_state.gaze.kind = GazeKind::kPerson;
  animation_state.gaze.target = {0.5f, 1.6f, -2.0f};
  StartReach(animation_state.reaches[kRight], {{0.2f, 1.1f, -0.35f}, kNoTurn}, 0.5f);
  SetHandPose(animation_state.hands[kRight], HandPose::kCylinder, 0.3f);
  SetExpression(animation_state.face, Expression::kJoy, 1.0f, 0.5f);
  return animation_state;
}

void BenchAnimator(benchmark::State& state) {
  const auto model = MakeAnimationRig(MakePerson(static_cast<size_t>(state.range(0))));
  Animator animator(model);
  AnimationState animation_state = Busy(), previous;
  glm::vec3 position(0.0f);
  float heading = 0.0f;
  for (auto _ : state) {
    for (int tick = 0; tick < 2; ++tick) {  // Ticks at 120 Hz for a frame at 60 Hz.
      heading += 0.3f * kTick;
      position += 1.2f * kTick * (TurnY(heading) * glm::vec3(0.0f, 0.0f, -1.0f));
      previous = animation_state;
      UpdateAnimationState(*model, position, heading, kTick, {}, animation_state);
    }
    animator.Pose(Interpolate(previous, animation_state, 0.5f));
    benchmark::DoNotOptimize(animator.skin().data());
  }
}
BENCHMARK(BenchAnimator)->Arg(70)->Arg(163)->Unit(benchmark::kMicrosecond);

// A third of the joints move. Expected: a tenth of the memory, in the time of the plain clip.
void BenchCompressedClip(benchmark::State& state) {
  const std::shared_ptr<const Human> human = MakePerson(static_cast<size_t>(state.range(0)));
  Clip clip{"sway", 1.0f, 30.0f, true, 0.0f, {}};
  for (int key = 0; key <= 30; ++key) {
    std::vector<JointTransform> pose = human->skeleton.rest;
    for (size_t joint = 0; joint < pose.size(); joint += 3) {
      pose[joint].rotation =
          pose[joint].rotation * TurnX(0.1f * std::sin(0.2f * static_cast<float>(key)));
    }
    clip.keys.insert(clip.keys.end(), pose.begin(), pose.end());
  }
  const CompressedClip compressed(clip, human->skeleton.size());
  std::vector<JointTransform> pose(human->skeleton.size());
  double time = 0.0;
  for (auto _ : state) {
    time += 1.0 / 60.0;
    if (state.range(1) != 0) {
      compressed.Sample(time, pose);
    } else {
      SampleClip(clip, time, pose);
    }
    benchmark::DoNotOptimize(pose.data());
  }
  state.counters["bytes"] = static_cast<double>(
      state.range(1) != 0 ? compressed.bytes() : clip.keys.size() * sizeof(JointTransform));
}
BENCHMARK(BenchCompressedClip)->ArgNames({"joints", "compressed"})->Args({163, 0})->Args({163, 1});

}  // namespace
}  // namespace lararium::human
