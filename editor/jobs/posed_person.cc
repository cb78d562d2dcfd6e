#include "editor/jobs/posed_person.h"

#include <algorithm>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <utility>

#include "shared/human/human.h"
#include "shared/human/morph.h"
#include "shared/human/skinning.h"

namespace lararium::editor {
namespace {

constexpr float kTick = 1.0f / 90.0f;       // seconds
constexpr double kStanding = 2.5;           // Seconds until hair and cloth are at rest.
constexpr float kWalkingHeights = 0.72f;    // Speed of an easy walk, body heights per second.
const glm::vec3 kAhead(0.0f, 0.0f, -3.0f);  // The gaze target relative to the eyes, metres.
constexpr uint64_t kSeed = 7;

float HeightOf(const human::Human& human) {
  float height = 0.0f;
  for (const human::SkinnedMesh& mesh : human.meshes) {
    for (const glm::vec3& position : mesh.positions) {
      height = std::max(height, position.y);
    }
  }
  return height;
}

}  // namespace

PosedPerson::PosedPerson(std::shared_ptr<const human::Human> human, const StudioPose& pose)
    : animator_(human::MakeAnimationRig(std::move(human))),
      cloth_model_(this->human()),
      cloth_(cloth_model_),
      spring_model_(this->human()),
      springs_(spring_model_),
      shapes_(pose.shapes),
      pose_(this->human().skeleton.size()),
      actor_from_joint_(this->human().skeleton.size()),
      skin_(this->human().skeleton.size()) {
  Live(pose);
  Draw();
}

// Runs tick by tick like a show, because hair and cloth depend on their past.
void PosedPerson::Live(const StudioPose& pose) {
  animation_state_.seed = kSeed;
  animation_state_.animation.clip = pose.clip;
  animation_state_.animation.clip_time = pose.time;
  animation_state_.animation.rate = 0.0;
  animation_state_.gaze.kind = human::GazeKind::kObject;
  for (double lived = 0.0; lived < kStanding; lived += double(kTick)) {
    Tick(0.0f);
  }
  const float speed = kWalkingHeights * HeightOf(human());
  for (double walked = 0.0; walked < pose.walk; walked += double(kTick)) {
    Tick(speed);
  }
}

void PosedPerson::Tick(float speed) {
  root_.z -= speed * kTick;
  const human::AnimationRig& model = animator_.model();
  animation_state_.gaze.target = root_ + model.gaze.eyes + kAhead;
  human::UpdateAnimationState(model, root_, 0.0f, kTick, nullptr, animation_state_);
  animation_state_.gaze.lids = 0.0f;  // The picture shows no blink.
  Step(kTick);
}

void PosedPerson::Step(float elapsed) {
  animator_.Pose(animation_state_);
  std::copy(animator_.pose().begin(), animator_.pose().end(), pose_.begin());
  TurnByShapes();
  human::ComputeActorFromJoint(human().skeleton, pose_, actor_from_joint_);
  const glm::mat4 stage_from_actor = glm::translate(glm::mat4(1.0f), root_);
  if (spring_model_.chain_count() > 0) {
    human::StepSprings(spring_model_, {.stage_from_actor = stage_from_actor, .elapsed = elapsed},
                       springs_, pose_, actor_from_joint_);
  }
  human::ComputeSkinMatrices(human().skeleton, actor_from_joint_, skin_);
  if (cloth_model_.cloth_count() > 0) {
    human::ClothStep step;
    step.actor_from_joint = actor_from_joint_;
    step.stage_from_actor = stage_from_actor;
    step.elapsed = elapsed;
    human::StepCloth(cloth_model_, step, cloth_);
  }
}

void PosedPerson::TurnByShapes() {
  for (const StudioPose::Shape& shape : shapes_) {
    for (const human::FaceShape::Turn& turn : human().face[shape.shape].turns) {
      glm::quat& rotation = pose_[turn.joint].rotation;
      const glm::quat none(1.0f, 0.0f, 0.0f, 0.0f);
      rotation = rotation * glm::slerp(none, turn.rotation, shape.weight);
    }
  }
}

void PosedPerson::SetShapes(std::span<const StudioPose::Shape> shapes) {
  shapes_.assign(shapes.begin(), shapes.end());
  Step(0.0f);
  Draw();
}

void PosedPerson::Draw() {
  moved_.assign(human().meshes.size(), {});
  vertices_.clear();
  for (size_t cloth = 0; cloth < human().cloths.size(); ++cloth) {
    const uint32_t mesh = human().cloths[cloth].mesh;
    Vertices& moved = MakeRoom(mesh);
    human::DrapeMesh(cloth_model_, cloth_, cloth, human().meshes[mesh], skin_, moved.positions,
                     moved.normals);
    vertices_.push_back({mesh, moved.positions, moved.normals, true});
  }
  Morph();
}

void PosedPerson::Morph() {
  std::vector<float> weights(human().morphs.size(), 0.0f);
  for (const StudioPose::Shape& shape : shapes_) {
    for (const human::FaceShape::Morph& morph : human().face[shape.shape].morphs) {
      weights[morph.morph] += shape.weight * morph.weight;
    }
  }
  for (const human::MeshMorphs& morphs : human::FindMeshMorphs(human())) {
    if (moved_[morphs.mesh].positions.empty() && morphs.Active(weights)) {
      Vertices& moved = MakeRoom(morphs.mesh);
      human::MorphJob{human().meshes[morphs.mesh], morphs, weights, moved.positions, moved.normals}
          .Run();
      vertices_.push_back({morphs.mesh, moved.positions, moved.normals, false});
    }
  }
}

PosedPerson::Vertices& PosedPerson::MakeRoom(uint32_t mesh) {
  const size_t count = human().meshes[mesh].positions.size();
  moved_[mesh].positions.resize(count);
  moved_[mesh].normals.resize(count);
  return moved_[mesh];
}

std::vector<std::vector<glm::vec3>> PosedPerson::ComputePositions() const {
  std::vector<std::vector<glm::vec3>> positions;
  for (const human::SkinnedMesh& mesh : human().meshes) {
    positions.emplace_back(mesh.positions.size());
    std::vector<glm::vec3> normals(mesh.positions.size());
    human::SkinMesh(mesh, skin_, positions.back(), normals, human().skinning);
  }
  for (const render::SceneVertices& moved : vertices_) {
    if (moved.posed) {
      positions[moved.mesh].assign(moved.positions.begin(), moved.positions.end());
    }
  }
  return positions;
}

}  // namespace lararium::editor
