#include "shared/show/show_renderer.h"

#include <span>
#include <utility>

#include "shared/geometry/glm_convert.h"

namespace lararium::show {

Result<std::unique_ptr<ShowRenderer>> ShowRenderer::Create(const ShowContent& content,
                                                           const render::RendererOptions& options) {
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<render::Renderer> renderer,
                            render::Renderer::Create(options));
  std::unique_ptr<ShowRenderer> show(new ShowRenderer(std::move(renderer)));
  for (const CastMember& member : content.cast) {
    LARARIUM_ASSIGN_OR_RETURN(show->cast_.emplace_back(), show->renderer_->AddHuman(*member.human));
  }
  show->places_.resize(content.places.size());
  for (size_t i = 0; i < content.places.size(); ++i) {
    show->SetPlace(i, content.places[i].stage);
  }
  return show;
}

void ShowRenderer::SetPlace(size_t index, const stage::Place& place) {
  PlaceScene& scene = places_[index];
  for (const render::SceneOccluder& occluder : scene.occluders) {
    renderer_->RemoveMesh(occluder.mesh);
  }
  scene.occluders.clear();
  for (const stage::Occluder& occluder : place.occluders) {
    scene.occluders.push_back(
        {renderer_->AddMesh(occluder.mesh), geometry::ToGlm(occluder.stage_from_mesh)});
  }
  scene.light = place.light;
}

Status ShowRenderer::Draw(const StagedFrame& staged, const render::RenderTarget& target) {
  humans_.clear();
  for (const StagedActor& actor : staged.actors) {
    humans_.push_back({cast_[actor.cast], actor.stage_from_actor,
                       std::span(staged.skin).subspan(actor.skin_begin, actor.skin_count)});
  }
  const vision::TrackedFrame& tracked = staged.tracked;
  const PlaceScene& place = places_[staged.place];
  render::RenderScene scene;
  scene.background = tracked.frame.bgr;
  scene.camera = tracked.camera;
  scene.display = tracked.camera.DisplayPinhole();
  scene.camera_from_stage = staged.camera_from_stage;
  scene.occluders = place.occluders;
  scene.humans = humans_;
  scene.light = place.light;
  scene.gain = {staged.gain[0], staged.gain[1], staged.gain[2]};
  return renderer_->Draw(scene, target);
}

}  // namespace lararium::show
