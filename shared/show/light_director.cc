#include "shared/show/light_director.h"

#include <algorithm>
#include <utility>

#include "shared/geometry/glm_convert.h"
#include "shared/light/probe_weights.h"

namespace lararium::show {
namespace {

// Assumed distance, in metres, from the camera to the real surfaces that receive people's shadows.
constexpr float kViewedDistance = 3.0f;

// PersonLight keeps the data that it needs from the meshes.
void ReleaseMeshes(human::Human& figure) {
  figure.meshes = {};
  figure.light.meshes = {};
}

// Blends the light on the real surfaces in view.
void BlendInView(const PlaceLight& place,
                 const std::optional<geometry::Rigid3>& camera_from_stage,
                 StagedLight& light) {
  const std::span<const light::PlacedProbe> probes = place.probes;
  glm::vec3 viewed(0.0f);
  if (camera_from_stage) {
    const geometry::Rigid3 stage_from_camera = camera_from_stage->Inverse();
    viewed = geometry::ToGlm(stage_from_camera * Eigen::Vector3d(0.0, 0.0, kViewedDistance));
  }
  light.surfaces = place.At(viewed);
  light.picture.reset();
  light.probe_weights.resize(probes.size());
  if (probes.empty()) {
    return;
  }
  if (place.hour) {
    const double hour = place.picture_hour >= 0.0f ? place.picture_hour : probes.front().hour;
    light.picture = light::Blend(probes, viewed, hour).sky;
  }
  light::ComputeProbeWeights(probes, viewed, place.hour.value_or(probes.front().hour),
                             light.probe_weights);
}

}  // namespace

light::ProbeLight PlaceLight::At(const glm::vec3& position) const {
  if (probes.empty()) {
    return {};
  }
  return light::Blend(probes, position, hour.value_or(probes.front().hour));
}

LightDirector::LightDirector(const ShowContent& content) : cast_count_(content.cast.size()) {
  std::vector<std::shared_ptr<const human::Human>> cast;
  std::vector<std::shared_ptr<const UnpackedLight>> light;
  std::vector<std::shared_ptr<human::Human>> figures;
  for (const CastMember& member : content.cast) {
    cast.push_back(member.human);
    light.push_back(member.light);
  }
  for (const StageObject& object : content.objects) {
    const stage::Prop& prop = object.model->prop();
    cast.push_back(figures.emplace_back(FigureOf(prop)));
    light.push_back(object.light);
    things_.emplace_back(prop);
  }
  stage_light_.emplace(cast, light);
  for (const std::shared_ptr<human::Human>& figure : figures) {
    ReleaseMeshes(*figure);
  }
  for (const ShowPlace& place : content.places) {
    shades_.emplace_back(place.stage.occluders);
  }
}

void LightDirector::SetPlace(size_t index, const stage::Place& place) {
  shades_[index] = LampShade(place.occluders);
}

void LightDirector::SetMesh(uint32_t cast,
                            std::shared_ptr<const human::Human> human,
                            std::shared_ptr<const UnpackedLight> light) {
  stage_light_->SetMesh(cast, std::move(human), std::move(light));
}

void LightDirector::SetPerson(uint32_t cast,
                              std::shared_ptr<const human::Human> human,
                              std::shared_ptr<const UnpackedLight> light) {
  stage_light_->SetMember(cast, std::move(human), std::move(light));
}

void LightDirector::SetObject(size_t index, const StageObject& object) {
  const stage::Prop& prop = object.model->prop();
  things_[index] = Thing(prop);
  const std::shared_ptr<human::Human> figure = FigureOf(prop);
  stage_light_->SetMember(static_cast<uint32_t>(cast_count_ + index), figure, object.light);
  ReleaseMeshes(*figure);
}

uint32_t LightDirector::LitVerticesOf(uint32_t object) const {
  const auto member = static_cast<uint32_t>(cast_count_ + object);
  return stage_light_->Lights(member) ? static_cast<uint32_t>(stage_light_->vertex_count(member))
                                      : 0;
}

void LightDirector::CollectLit(const StagedPeople& people,
                               const StagedThings& things,
                               StagedLight& light) {
  const auto resize = [](const auto& members, std::vector<glm::vec3>& irradiance) {
    const size_t vertices =
        members.empty() ? 0 : members.back().light_begin + members.back().light_count;
    irradiance.reserve(vertices);  // Reserve exactly: the arrays have megabytes.
    irradiance.resize(vertices);
  };
  resize(people.actors, light.on_people);
  resize(things.objects, light.on_things);
  lit_.clear();
  for (const StagedActor& actor : people.actors) {
    lit_.push_back(
        {actor.cast, &actor.light.sky,
         std::span(people.skin).subspan(actor.skin_begin, actor.skin_count), actor.stage_from_actor,
         std::span(light.on_people).subspan(actor.light_begin, actor.light_count), actor.detail});
  }
  for (const StagedObject& object : things.objects) {
    Thing& thing = things_[object.object];
    SkinOfFigure(std::span(things.stage_from_part).subspan(object.part_begin, object.part_count),
                 std::span(things.part_shown).subspan(object.part_begin, object.part_count),
                 thing.skin);
    lit_.push_back({static_cast<uint32_t>(cast_count_ + object.object), &object.light.sky,
                    thing.skin, things.stage_from_part[object.part_begin],
                    std::span(light.on_things).subspan(object.light_begin, object.light_count)});
  }
}

void LightDirector::SkipUnchanged(size_t people, const StagedThings& things, StagedLight& light) {
  for (size_t i = 0; i < things.objects.size(); ++i) {
    const StagedObject& object = things.objects[i];
    Thing& thing = things_[object.object];
    if (!thing.memory.Update(object.light.sky, things.lamps,
                             things.stage_from_part[object.part_begin], thing.skin,
                             light.blockers)) {
      std::copy(thing.irradiance.begin(), thing.irradiance.end(),
                light.on_things.begin() + object.light_begin);
      lit_[people + i].irradiance = {};
    }
  }
}

double LightDirector::Light(const PlaceLight& place,
                            const std::optional<geometry::Rigid3>& camera_from_stage,
                            const StagedPeople& people,
                            const StagedThings& things,
                            StagedLight& light) {
  BlendInView(place, camera_from_stage, light);
  CollectLit(people, things, light);
  double helpers_cpu_ms = stage_light_->Pose(lit_);
  light.blockers.assign(stage_light_->blockers().begin(), stage_light_->blockers().end());
  SkipUnchanged(people.actors.size(), things, light);
  helpers_cpu_ms += stage_light_->Light(things.lamps, lit_);
  for (size_t i = 0; i < things.objects.size(); ++i) {
    const std::span<const glm::vec3> lit = lit_[people.actors.size() + i].irradiance;
    if (!lit.empty()) {
      things_[things.objects[i].object].irradiance.assign(lit.begin(), lit.end());
    }
  }
  return helpers_cpu_ms;
}

}  // namespace lararium::show
