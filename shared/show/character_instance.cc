#include "shared/show/character_instance.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace lararium::show {
namespace {

// Heights of a person in pixels from which a part is simulated.
constexpr float kFullCloth = 240.0f;
constexpr float kReducedCloth = 120.0f;
constexpr float kCoarseCloth = 50.0f;
constexpr float kHair = 100.0f;
constexpr float kFace = 60.0f;
// A part that is simulated stays down to this share of its threshold.
constexpr float kStay = 0.85f;
// Position of the lips relative to the eyes of an upright person, in units of the eyes' height.
constexpr glm::vec3 kMouthFromEyes = {0.0f, -0.043f, -0.015f};

bool IsWorth(float height_px, float threshold, bool has_it) {
  return height_px >= (has_it ? kStay * threshold : threshold);
}

human::ClothDetail ChooseCloth(float height_px, human::ClothDetail before) {
  using human::ClothDetail;
  if (IsWorth(height_px, kFullCloth, before <= ClothDetail::kFull)) {
    return ClothDetail::kFull;
  }
  if (IsWorth(height_px, kReducedCloth, before <= ClothDetail::kReduced)) {
    return ClothDetail::kReduced;
  }
  return IsWorth(height_px, kCoarseCloth, before <= ClothDetail::kCoarse) ? ClothDetail::kCoarse
                                                                          : ClothDetail::kSkinned;
}

}  // namespace

BodyDetail ChooseBodyDetail(float height_px, bool not_seen, const BodyDetail& before) {
  if (not_seen) {
    return {human::ClothDetail::kSkinned, false, false, false};
  }
  return {ChooseCloth(height_px, before.cloth), IsWorth(height_px, kHair, before.hair),
          IsWorth(height_px, kFace, before.face), true};
}

CharacterInstance::CharacterInstance(std::shared_ptr<const human::AnimationRig> model)
    : model_(std::move(model)),
      animator_(model_),
      figure_(animator_.model().human),
      cloth_(figure_.cloth),
      spring_model_(human()),
      springs_(spring_model_),
      is_cloth_(human().meshes.size(), false),
      pose_(human().skeleton.size()),
      actor_from_joint_(human().skeleton.size()),
      skin_(human().skeleton.size()) {
  for (const human::Cloth& cloth : human().cloths) {
    is_cloth_[cloth.mesh] = true;
  }
  height_ = animator_.model().gaze.eyes.y;
  for (const human::SkinnedMesh& mesh : human().meshes) {
    for (const glm::vec3& position : mesh.positions) {
      height_ = std::max(height_, position.y);
    }
  }
  moving_.reserve(human().meshes.size());
  const std::vector<std::string>& names = human().skeleton.names;
  const auto head = std::find(names.begin(), names.end(), "skullbase");
  head_ = head == names.end() ? -1 : static_cast<int>(head - names.begin());
}

void CharacterInstance::Step(const stage::ActorState& state,
                             double time,
                             const BodyDetail& detail) {
  animator_.Pose(state.animation_state);
  std::copy(animator_.pose().begin(), animator_.pose().end(), pose_.begin());
  std::copy(animator_.actor_from_joint().begin(), animator_.actor_from_joint().end(),
            actor_from_joint_.begin());
  const glm::mat4 stage_from_actor = stage::StageFromActor(state);
  const float passed = time_ ? static_cast<float>(time - *time_) : 0.0f;
  const float elapsed = std::exchange(settles_, false) ? -1.0f : passed;
  time_ = time;
  if (spring_model_.chain_count() > 0) {
    StepSprings(
        spring_model_,
        {.stage_from_actor = stage_from_actor, .elapsed = elapsed, .simulated = detail.hair},
        springs_, pose_, actor_from_joint_);
  }
  human::ComputeSkinMatrices(human().skeleton, actor_from_joint_, skin_);
  if (figure_.cloth.cloth_count() > 0) {
    human::ClothStep step;
    step.actor_from_joint = actor_from_joint_;
    step.stage_from_actor = stage_from_actor;
    step.elapsed = elapsed;
    step.floor_height = state.position.y;
    step.detail = detail.cloth;
    StepCloth(figure_.cloth, step, cloth_);
  }
  FindMovingMeshes(detail);
}

void CharacterInstance::FindMovingMeshes(const BodyDetail& detail) {
  moving_.clear();
  if (!detail.drawn) {
    return;
  }
  for (uint32_t cloth = 0; cloth < human().cloths.size(); ++cloth) {
    moving_.push_back({human().cloths[cloth].mesh, true, cloth});
  }
  for (uint32_t i = 0; detail.face && i < figure_.morphs.size(); ++i) {
    if (!is_cloth_[figure_.morphs[i].mesh] && figure_.morphs[i].Active(animator_.morph_weights())) {
      moving_.push_back({figure_.morphs[i].mesh, false, i});
    }
  }
}

human::GripFrame CharacterInstance::actor_from_palm(int side) const {
  return human::ActorFromPalm(animator_.model().reach, human().skeleton, pose_, side);
}

Mouth CharacterInstance::actor_from_mouth() const {
  const human::GazeModel& gaze = animator_.model().gaze;
  const glm::vec3 at_rest = gaze.eyes + gaze.eyes.y * kMouthFromEyes;
  if (head_ < 0) {
    return {at_rest};
  }
  const glm::mat4& posed = skin_[static_cast<size_t>(head_)];
  return {glm::vec3(posed * glm::vec4(at_rest, 1.0f)),
          glm::normalize(glm::mat3(posed) * glm::vec3(0.0f, 0.0f, -1.0f))};
}

void CharacterInstance::ComputeVertices(const MovingMesh& moving,
                                        std::span<glm::vec3> positions,
                                        std::span<glm::vec3> normals) const {
  const human::SkinnedMesh& mesh = figure_.human->meshes[moving.mesh];
  if (moving.posed) {
    human::DrapeMesh(figure_.cloth, cloth_, moving.source, mesh, skin_, positions, normals);
  } else {
    human::MorphJob{mesh, figure_.morphs[moving.source], animator_.morph_weights(), positions,
                    normals}
        .Run();
  }
}

}  // namespace lararium::show
