#include "shared/show/stage_light.h"

#include <algorithm>
#include <utility>

#include "shared/core/parallel.h"

namespace lararium::show {
StageLight::StageLight(std::span<const std::shared_ptr<const human::Human>> cast) {
  for (const std::shared_ptr<const human::Human>& human : cast) {
    size_t vertices = 0;
    for (const human::SkinnedMesh& mesh : human->meshes) {
      vertices += mesh.positions.size();
    }
    vertex_counts_.push_back(vertices);
    people_.push_back(human->light.empty() ? nullptr : std::make_unique<PersonLight>(human));
  }
  matrices_.resize(people_.size());
  others_.resize(people_.size());
}

const light::LightMatrix& StageLight::MatrixFor(const LitActor& actor) {
  PersonMatrix& of = matrices_[actor.cast];
  if (!of.matrix || of.light != *actor.light) {
    of.light = *actor.light;
    of.matrix.emplace(of.light, people_[actor.cast]->light_count());
  }
  return *of.matrix;
}

void StageLight::PoseActor(const LitActor& actor) {
  if (Lights(actor.cast)) {
    people_[actor.cast]->Pose(actor.skin, actor.stage_from_actor);
  }
}

// What is not the actor's own, for each; and all there is.
void StageLight::CollectBlockers(const SphereSet& things, std::span<const LitActor> actors) {
  all_blockers_.clear();
  const auto add = [this](const SphereSet& set) {
    for (size_t k = 0; k < set.size(); ++k) {
      all_blockers_.emplace_back(set.x[k], set.y[k], set.z[k], set.radius[k]);
    }
  };
  add(things);
  for (size_t i = 0; i < actors.size(); ++i) {
    others_[i].Clear();
    others_[i].Append(things);
    if (Lights(actors[i].cast)) {
      add(people_[actors[i].cast]->blockers());
    }
    for (size_t k = 0; k < actors.size(); ++k) {
      if (k != i && Lights(actors[i].cast) && Lights(actors[k].cast)) {
        people_[actors[k].cast]->AppendBlockers(*people_[actors[i].cast], others_[i]);
      }
    }
  }
}

double StageLight::Light(const SphereSet& things,
                         std::span<const light::Lamp> lamps,
                         std::span<const LitActor> actors) {
  double helpers = ParallelForTimed(actors.size(), [&](size_t i) { PoseActor(actors[i]); });
  CollectBlockers(things, actors);
  helpers += ParallelForTimed(actors.size(), [&](size_t i) { LightActor(actors[i], lamps, i); });
  return helpers;
}

void StageLight::LightActor(const LitActor& actor,
                            std::span<const light::Lamp> lamps,
                            size_t index) {
  if (!Lights(actor.cast) || actor.irradiance.empty()) {
    return;
  }
  PersonLight& person = *people_[actor.cast];
  person.Update(MatrixFor(actor), others_[index].spheres(), lamps);
  person.LightVertices(actor.detail, actor.irradiance);
}

}  // namespace lararium::show
