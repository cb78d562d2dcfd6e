#include "shared/show/stage_light.h"

#include <algorithm>
#include <utility>

#include "shared/core/parallel.h"

namespace lararium::show {
namespace {

size_t CountVertices(const human::Human& human) {
  size_t vertices = 0;
  for (const human::SkinnedMesh& mesh : human.meshes) {
    vertices += mesh.positions.size();
  }
  return vertices;
}

}  // namespace

size_t LitVertices(const human::Human& human) {
  return human.light.empty() ? 0 : CountVertices(human);
}

StageLight::StageLight(std::span<const std::shared_ptr<const human::Human>> cast,
                       std::span<const std::shared_ptr<const UnpackedLight>> light)
    : people_(cast.size()),
      matrices_(cast.size()),
      lights_(cast.size()),
      vertex_counts_(cast.size()),
      others_(cast.size()) {
  for (uint32_t i = 0; i < cast.size(); ++i) {
    SetMember(i, cast[i], light.empty() ? nullptr : light[i]);
  }
}

void StageLight::SetMember(uint32_t cast,
                           std::shared_ptr<const human::Human> human,
                           std::shared_ptr<const UnpackedLight> light) {
  vertex_counts_[cast] = CountVertices(*human);
  lights_[cast] = !human->light.empty();
  matrices_[cast] = {};
  const bool shades = !human->light.blockers.empty();
  people_[cast] = lights_[cast] || shades
                      ? std::make_unique<PersonLight>(std::move(human), std::move(light))
                      : nullptr;
}

void StageLight::SetMesh(uint32_t cast,
                         std::shared_ptr<const human::Human> human,
                         std::shared_ptr<const UnpackedLight> light) {
  vertex_counts_[cast] = CountVertices(*human);
  if (people_[cast] != nullptr) {
    people_[cast]->SetMesh(std::move(human), std::move(light));
  }
}

const light::LightMatrix& StageLight::MatrixFor(const LitActor& actor) {
  PersonMatrix& of = matrices_[actor.cast];
  if (!of.matrix || of.light != *actor.light) {
    of.light = *actor.light;
    of.matrix.emplace(of.light, people_[actor.cast]->light_count());
  }
  return *of.matrix;
}

double StageLight::Pose(std::span<const LitActor> actors) {
  const double helpers = ParallelForTimed(actors.size(), [&](size_t i) {
    if (people_[actors[i].cast] != nullptr) {
      people_[actors[i].cast]->Pose(actors[i].skin, actors[i].stage_from_actor);
    }
  });
  CollectBlockers(actors);
  return helpers;
}

// Collects the blockers of all actors, without hidden parts.
void StageLight::CollectBlockers(std::span<const LitActor> actors) {
  all_blockers_.clear();
  for (const LitActor& actor : actors) {
    if (people_[actor.cast] == nullptr) {
      continue;
    }
    const SphereSet& set = people_[actor.cast]->blockers().spheres();
    for (size_t k = 0; k < set.size(); ++k) {
      if (set.y[k] > 0.5f * kNowhere) {
        continue;
      }
      all_blockers_.emplace_back(set.x[k], set.y[k], set.z[k], set.radius[k]);
    }
  }
}

void StageLight::CollectOthers(std::span<const LitActor> actors, size_t index) {
  SphereSet& others = others_[index];
  others.Clear();
  for (size_t k = 0; k < actors.size(); ++k) {
    if (k != index && people_[actors[k].cast] != nullptr) {
      people_[actors[k].cast]->blockers().AppendTo(others, people_[actors[index].cast]->blockers());
    }
  }
}

double StageLight::Light(std::span<const light::Lamp> lamps, std::span<const LitActor> actors) {
  return ParallelForTimed(actors.size(), [&](size_t i) {
    if (Lights(actors[i].cast) && !actors[i].irradiance.empty()) {
      CollectOthers(actors, i);
      LightActor(actors[i], lamps, i);
    }
  });
}

void StageLight::LightActor(const LitActor& actor,
                            std::span<const light::Lamp> lamps,
                            size_t index) {
  PersonLight& person = *people_[actor.cast];
  person.Update(MatrixFor(actor), others_[index].spheres(), lamps);
  person.LightVertices(actor.detail, actor.irradiance);
}

}  // namespace lararium::show
