#include "shared/show/cast_stage.h"

#include <utility>

#include "shared/core/parallel.h"

namespace lararium::show {

CastStage::CastStage(const ShowContent& content,
                     std::vector<stage::ActorId> actors,
                     const stage::Stage& stage,
                     Log& log)
    : actors_(std::move(actors)), detail_(content, log) {
  for (const stage::ActorId actor : actors_) {
    bodies_.emplace_back(stage.Find(actor)->model);
  }
}

void CastStage::SetMesh(size_t cast, CharacterMesh figure) {
  if (!other_bodies_.empty()) {
    other_bodies_[cast].SetMesh(CharacterMesh(figure.human));
  }
  bodies_[cast].SetMesh(std::move(figure));
}

void CastStage::SetPerson(size_t cast, const std::shared_ptr<const human::AnimationRig>& model) {
  if (!other_bodies_.empty()) {
    other_bodies_[cast] = CharacterInstance(model);
  }
  bodies_[cast] = CharacterInstance(model);
  detail_.SetLevels(cast, *model->human);
}

double CastStage::Stage(const stage::StageSnapshot& drawn,
                        double time,
                        const geometry::CameraModel& image_camera,
                        const std::optional<geometry::Rigid3>& camera_from_stage,
                        const PlaceLight& light,
                        StagedPeople& people) {
  visible_.clear();
  for (uint32_t cast = 0; cast < actors_.size(); ++cast) {
    for (const stage::StageSnapshot::ActorEntry& entry : drawn.actors) {
      if (entry.actor == actors_[cast] && entry.state.visible) {
        visible_.push_back({cast, &entry.state, bodies_[cast].height()});
      }
    }
  }
  if (camera_from_stage) {
    detail_.Choose(visible_, image_camera, *camera_from_stage);
  }
  double helpers_cpu_ms = ParallelForTimed(visible_.size(), [&](size_t i) {
    const VisibleActor& visible = visible_[i];
    bodies_[visible.cast].Step(*visible.state, time, detail_.body(visible.cast));
  });
  LayOut(light, people);
  helpers_cpu_ms += ParallelForTimed(people.actors.size(), [&](size_t i) {
    const StagedActor& actor = people.actors[i];
    for (uint32_t m = actor.mesh_begin; m < actor.mesh_begin + actor.mesh_count; ++m) {
      const StagedMesh& mesh = people.meshes[m];
      bodies_[actor.cast].ComputeVertices(
          mesh.mesh, std::span(people.positions).subspan(mesh.vertex_begin, mesh.vertex_count),
          std::span(people.normals).subspan(mesh.vertex_begin, mesh.vertex_count));
    }
  });
  return helpers_cpu_ms;
}

void CastStage::LayOut(const PlaceLight& light, StagedPeople& people) const {
  people.actors.clear();
  people.skin.clear();
  people.meshes.clear();
  uint32_t vertices = 0;
  uint32_t lit_vertices = 0;
  for (const VisibleActor& visible : visible_) {
    const CharacterInstance& body = bodies_[visible.cast];
    StagedActor& actor = people.actors.emplace_back();
    actor.cast = visible.cast;
    actor.figure = body.figure();
    actor.stage_from_actor = stage::StageFromActor(*visible.state);
    actor.detail = detail_.error(visible.cast);
    actor.skin_begin = static_cast<uint32_t>(people.skin.size());
    actor.skin_count = static_cast<uint32_t>(body.skin().size());
    people.skin.insert(people.skin.end(), body.skin().begin(), body.skin().end());
    actor.mesh_begin = static_cast<uint32_t>(people.meshes.size());
    actor.mesh_count = static_cast<uint32_t>(body.moving_meshes().size());
    for (const CharacterInstance::MovingMesh& mesh : body.moving_meshes()) {
      const auto count = static_cast<uint32_t>(actor.figure->meshes[mesh.mesh].positions.size());
      people.meshes.push_back({mesh, vertices, count});
      vertices += count;
    }
    actor.light_begin = lit_vertices;
    actor.light_count =
        detail_.body(visible.cast).drawn ? static_cast<uint32_t>(LitVertices(*actor.figure)) : 0;
    lit_vertices += actor.light_count;
    const glm::vec4 middle(0.0f, 0.5f * visible.height, 0.0f, 1.0f);
    actor.light = light.At(actor.stage_from_actor * middle);
  }
  // Reserve exactly: the arrays have megabytes.
  people.positions.reserve(vertices);
  people.normals.reserve(vertices);
  people.positions.resize(vertices);
  people.normals.resize(vertices);
}

Mouth CastStage::MouthOf(size_t cast, const stage::ActorState& state) const {
  Mouth mouth = bodies_[cast].actor_from_mouth();
  const glm::mat4 stage_from_actor = stage::StageFromActor(state);
  mouth.position = glm::vec3(stage_from_actor * glm::vec4(mouth.position, 1.0f));
  mouth.facing = glm::mat3(stage_from_actor) * mouth.facing;
  return mouth;
}

void CastStage::SetAside() {
  if (other_bodies_.empty()) {
    for (const CharacterInstance& body : bodies_) {
      other_bodies_.emplace_back(body.model());
      other_bodies_.back().SetMesh(CharacterMesh(body.figure()));
    }
  }
  for (CharacterInstance& body : other_bodies_) {
    body.Settle();
  }
  bodies_.swap(other_bodies_);
  choice_before_ = detail_.choice();
}

void CastStage::Restore() {
  bodies_.swap(other_bodies_);
  detail_.SetChoice(choice_before_);
}

}  // namespace lararium::show
