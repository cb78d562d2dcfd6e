// libFuzzer harness: parsing any bytes as a human terminates. An accepted human keeps every promise
// of human.h, can be written and read again, and can be shown: posed, skinned, with cloth and hair
// in motion. The same holds for a coarse level read from the same bytes.

#include <cstddef>
#include <cstdint>
#include <span>

#include "shared/core/check.h"
#include "shared/human/animator.h"
#include "shared/human/cloth.h"
#include "shared/human/human.h"
#include "shared/human/skinning.h"
#include "shared/human/spring.h"

namespace lararium::human {
namespace {

constexpr float kTick = 1.0f / 30.0f;

void Show(const std::shared_ptr<const Human>& human) {
  const auto model = MakeAnimationRig(human);
  Animator animator(model);
  Performance performance;
  const ClothModel cloth(*human);
  ClothState cloth_state(cloth);
  const SpringModel springs(*human);
  SpringState spring_state(springs);
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  for (int tick = 0; tick < 2; ++tick) {
    UpdateAnimationState(*model, glm::vec3(0.0f, 0.0f, -0.04f * static_cast<float>(tick)), 0.1f,
                         kTick, {}, performance);
    animator.Pose(performance);
    std::vector<JointTransform> pose(animator.pose().begin(), animator.pose().end());
    std::vector<glm::mat4> actor_from_joint(animator.actor_from_joint().begin(),
                                            animator.actor_from_joint().end());
    StepSprings(springs, {.elapsed = kTick}, spring_state, pose, actor_from_joint);
    StepCloth(cloth, {.actor_from_joint = actor_from_joint, .elapsed = kTick}, cloth_state);
  }
  for (const SkinnedMesh& mesh : human->meshes) {
    positions.resize(mesh.positions.size());
    normals.resize(mesh.positions.size());
    SkinMesh(mesh, animator.skin(), positions, normals, human->skinning);
  }
  for (size_t i = 0; i < cloth.cloth_count(); ++i) {
    const SkinnedMesh& mesh = human->meshes[human->cloths[i].mesh];
    positions.resize(mesh.positions.size());
    normals.resize(mesh.positions.size());
    DrapeMesh(cloth, cloth_state, i, mesh, animator.skin(), positions, normals);
  }
}

}  // namespace
}  // namespace lararium::human

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lararium::human;
  const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(data), size);
  auto parsed = ParseHuman(bytes, "fuzz");
  if (parsed.ok()) {
    CHECK(parsed->Validate("fuzz").ok());
    CHECK(ParseHuman(SerializeHuman(*parsed), "again").ok());
    Show(std::make_shared<const Human>(*std::move(parsed)));
  }
  constexpr float kCoarse = 0.005f;  // metres
  auto coarse = ParseHuman(bytes, "fuzz", kCoarse);
  if (coarse.ok()) {
    CHECK(coarse->Validate("fuzz").ok());
    Show(std::make_shared<const Human>(*std::move(coarse)));
  }
  return 0;
}
