#include "shared/show/show_renderer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "shared/geometry/glm_convert.h"
#include "shared/show/camera_look.h"

namespace lararium::show {
namespace {

// Quantisation steps of the probe weights that blend reflections.
constexpr float kWeightSteps = 32.0f;
// A layer drawn in halves is shown in the next picture and the one after it.
constexpr double kPicturesUntilSeen = 1.5;

bool CatchesShadows(const ShowPlace& place) {
  return std::any_of(place.stage.occluders.begin(), place.stage.occluders.end(),
                     [](const stage::Occluder& occluder) { return occluder.receives_shadow; });
}

// Moves the camera to its predicted pose after a number of frames.
void LookAhead(double frames, StagedFrame& staged) {
  if (staged.camera.motion && staged.camera.camera_from_stage) {
    const geometry::Rigid3 now = *staged.camera.camera_from_stage;
    staged.camera.camera_from_stage = Predict(*staged.camera.motion, now, frames);
    staged.camera.motion->before_from_stage =
        staged.camera.motion->before_from_stage * now.Inverse() * *staged.camera.camera_from_stage;
  }
}

}  // namespace

Result<std::unique_ptr<ShowRenderer>> ShowRenderer::Create(const ShowContent& content,
                                                           const render::Quality& quality) {
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<render::Renderer> renderer,
                            render::Renderer::Create(quality));
  std::unique_ptr<ShowRenderer> show(new ShowRenderer(std::move(renderer)));
  for (const CastMember& member : content.cast) {
    LARARIUM_ASSIGN_OR_RETURN(const render::ModelHandle model,
                              show->renderer_->AddHuman(member.human));
    show->cast_.push_back({member.human, model});
  }
  LARARIUM_RETURN_IF_ERROR(show->AddObjects(content));
  LARARIUM_ASSIGN_OR_RETURN(show->captions_, ShowCaptions::Create(content));
  show->evidence_.emplace(content);
  show->places_.resize(content.places.size());
  for (size_t i = 0; i < content.places.size(); ++i) {
    show->places_[i].glossy = content.places[i].glossy;
    show->SetPlace(i, content.places[i].stage);
  }
  if (std::any_of(content.places.begin(), content.places.end(), CatchesShadows)) {
    LARARIUM_RETURN_IF_ERROR(show->renderer_->PrepareCaughtShadows());
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
    scene.occluders.push_back({renderer_->AddMesh(occluder.mesh),
                               geometry::ToGlm(occluder.stage_from_mesh),
                               occluder.receives_shadow});
  }
  scene.camera = place.camera;
}

Status ShowRenderer::SetTexts(const ShowContent& content) {
  LARARIUM_ASSIGN_OR_RETURN(captions_, ShowCaptions::Create(content));
  captions_->SetStyle(caption_style_);
  evidence_.emplace(content);
  return Status();
}

Status ShowRenderer::SetObjects(const ShowContent& content) {
  for (size_t i = 0; i < objects_.size(); ++i) {
    if (std::find(objects_.begin(), objects_.begin() + static_cast<ptrdiff_t>(i), objects_[i]) ==
        objects_.begin() + static_cast<ptrdiff_t>(i)) {
      renderer_->RemoveModel(objects_[i]);
    }
  }
  objects_.clear();
  return AddObjects(content);
}

// Objects of one model share its GPU data.
Status ShowRenderer::AddObjects(const ShowContent& content) {
  for (size_t i = 0; i < content.objects.size(); ++i) {
    const auto same = std::find_if(
        content.objects.begin(), content.objects.begin() + static_cast<ptrdiff_t>(i),
        [&](const StageObject& other) { return other.model == content.objects[i].model; });
    const auto index = static_cast<size_t>(same - content.objects.begin());
    if (index < i) {
      objects_.push_back(objects_[index]);
    } else {
      const std::shared_ptr<const stage::ObjectModel>& model = content.objects[i].model;
      LARARIUM_ASSIGN_OR_RETURN(
          objects_.emplace_back(),
          renderer_->AddProp(std::shared_ptr<const stage::Prop>(model, &model->prop())));
    }
  }
  return Status();
}

// The new level of detail shares the textures of the old one, which are already uploaded.
Status ShowRenderer::UploadFigures(const StagedFrame& staged) {
  for (const StagedActor& actor : staged.people.actors) {
    CastModel& known = cast_[actor.cast];
    if (known.figure != actor.figure) {
      LARARIUM_ASSIGN_OR_RETURN(const render::ModelHandle model, renderer_->AddHuman(actor.figure));
      renderer_->RemoveModel(known.model);
      known = {actor.figure, model};
    }
  }
  return Status();
}

void ShowRenderer::CollectHumans(const StagedPeople& people, const StagedLight& light) {
  humans_.clear();
  vertices_.clear();
  for (const StagedMesh& mesh : people.meshes) {
    vertices_.push_back(
        {mesh.mesh.mesh, std::span(people.positions).subspan(mesh.vertex_begin, mesh.vertex_count),
         std::span(people.normals).subspan(mesh.vertex_begin, mesh.vertex_count), mesh.mesh.posed});
  }
  for (const StagedActor& actor : people.actors) {
    humans_.push_back({cast_[actor.cast].model, actor.stage_from_actor,
                       std::span(people.skin).subspan(actor.skin_begin, actor.skin_count),
                       std::span(vertices_).subspan(actor.mesh_begin, actor.mesh_count),
                       std::span(light.on_people).subspan(actor.light_begin, actor.light_count),
                       actor.detail, &actor.light});
  }
}

void ShowRenderer::CollectProps(const StagedThings& things, const StagedLight& light) {
  props_.clear();
  for (const StagedObject& object : things.objects) {
    props_.push_back(
        {objects_[object.object],
         std::span(things.stage_from_part).subspan(object.part_begin, object.part_count),
         std::span(things.part_shown).subspan(object.part_begin, object.part_count), &object.light,
         std::span(light.on_things).subspan(object.light_begin, object.light_count), object.glow});
  }
}

void ShowRenderer::MarkByEvidence(const StagedFrame& staged, int height) {
  for (size_t i = 0; i < humans_.size(); ++i) {
    humans_[i].mark = evidence_->MarkOfActor(staged.people.actors[i].cast, height);
  }
  for (size_t i = 0; i < props_.size(); ++i) {
    props_[i].mark = evidence_->MarkOfObject(staged.things.objects[i].object, height);
  }
}

void ShowRenderer::BlendReflections(const StagedFrame& staged) {
  const PlaceScene& place = places_[staged.camera.place];
  const size_t count = std::min(place.glossy.size(), staged.light.probe_weights.size());
  new_weights_.clear();
  glossy_maps_.clear();
  bool any = false;
  for (size_t i = 0; i < count; ++i) {
    new_weights_.push_back(std::round(kWeightSteps * staged.light.probe_weights[i]) / kWeightSteps);
    glossy_maps_.push_back(&place.glossy[i]);
    any = any || !place.glossy[i].empty();
  }
  if (!any) {
    glossy_.clear();
    glossy_weights_.clear();
    return;
  }
  if (glossy_.empty() || staged.camera.place != glossy_place_ || new_weights_ != glossy_weights_) {
    glossy_.resize(light::GlossyMap::kTexels);
    light::BlendGlossyMaps(glossy_maps_, new_weights_, glossy_);
    glossy_place_ = staged.camera.place;
    glossy_weights_ = new_weights_;
    ++glossy_number_;
  }
}

Result<render::RenderScene> ShowRenderer::SceneOf(const StagedFrame& staged, int height) {
  LARARIUM_RETURN_IF_ERROR(UploadFigures(staged));
  const PlaceScene& place = places_[staged.camera.place];
  render::RenderScene scene;
  CollectHumans(staged.people, staged.light);
  CollectProps(staged.things, staged.light);
  if (shows_evidence_) {
    MarkByEvidence(staged, height);
  }
  scene.occluders = place.occluders;
  scene.humans = humans_;
  scene.props = props_;
  scene.light = staged.light.surfaces.sky;
  scene.sun = staged.light.surfaces.sun;
  scene.picture_light = staged.light.picture;
  scene.blockers = staged.light.blockers;
  scene.lamps = staged.things.lamps;
  BlendReflections(staged);
  scene.glossy = glossy_;
  scene.glossy_number = glossy_number_;
  scene.gain = {staged.camera.gain[0], staged.camera.gain[1], staged.camera.gain[2]};
  scene.matte = matte_;
  if (place.camera && !matte_) {
    scene.knee = place.camera->knee;
    scene.response = place.camera->response ? &*place.camera->response : nullptr;
  }
  return scene;
}

void ShowRenderer::SetQuality(const render::Quality& quality) {
  renderer_->SetQuality(quality);
  half_rate_ = quality.half_rate;
  shadows_are_drawn_ = false;
}

void ShowRenderer::SetCamera(const StagedFrame& staged,
                             const render::RenderTarget& target,
                             const PictureEye& eye,
                             render::RenderScene& scene) const {
  const vision::TrackedFrame& tracked = staged.tracked;
  const PlaceScene& place = places_[staged.camera.place];
  scene.background = tracked.frame.bgr;
  scene.camera = tracked.camera;
  scene.foreground = tracked.foreground;
  scene.background_display = PictureOf(tracked.camera, target.width(), target.height());
  scene.display = ForEye(*scene.background_display, eye);
  const geometry::Rigid3 eye_from_camera{.translation = -eye.in_camera};
  if (staged.camera.camera_from_stage) {
    scene.camera_from_stage = eye_from_camera * *staged.camera.camera_from_stage;
  }
  scene.people_opacity = staged.camera.opacity;
  scene.shutter = ShutterOf(staged);
  if (scene.shutter) {
    scene.shutter->previous_camera_from_stage =
        eye_from_camera * scene.shutter->previous_camera_from_stage;
  }
  if (place.camera && !matte_) {
    const geometry::CameraModel picture = scene.display.Resized(target.width(), target.height());
    scene.look = LookOf(*place.camera, staged, picture);
    if (scene.look.previous_camera_from_stage) {
      scene.look.previous_camera_from_stage =
          eye_from_camera * *scene.look.previous_camera_from_stage;
    }
  }
}

Status ShowRenderer::DrawWhole(const StagedFrame& staged,
                               const render::RenderTarget& target,
                               const PictureEye& eye) {
  LARARIUM_ASSIGN_OR_RETURN(render::RenderScene scene, SceneOf(staged, target.height()));
  SetCamera(staged, target, eye, scene);
  shadows_are_drawn_ = false;
  layer_place_ = staged.camera.place;
  return renderer_->Draw(scene, target);
}

Status ShowRenderer::DrawHalf(const StagedFrame& staged,
                              const render::RenderScene& picture,
                              const render::RenderTarget& target) {
  if (!shadows_are_drawn_) {
    drawn_by_halves_ = staged;
    const int64_t frames = staged.tracked.frame.index - last_frame_;
    LookAhead(kPicturesUntilSeen * static_cast<double>(std::clamp(frames, int64_t{1},
                                                                  CameraMotionTracker::kLongest)),
              drawn_by_halves_);
  }
  LARARIUM_ASSIGN_OR_RETURN(render::RenderScene people, SceneOf(drawn_by_halves_, target.height()));
  SetCamera(drawn_by_halves_, target, {}, people);
  const auto half =
      shadows_are_drawn_ ? render::Renderer::Half::kPeople : render::Renderer::Half::kShadows;
  shadows_are_drawn_ = !shadows_are_drawn_;
  return renderer_->DrawHalf(half, people, picture, target);
}

Status ShowRenderer::Draw(const StagedFrame& staged,
                          const render::RenderTarget& target,
                          const PictureEye& eye) {
  render::RenderScene picture;
  SetCamera(staged, target, eye, picture);
  const bool halves = half_rate_ && eye == PictureEye() && layer_place_ == staged.camera.place &&
                      renderer_->CanCarryLayer(picture, target);
  LARARIUM_RETURN_IF_ERROR(halves ? DrawHalf(staged, picture, target)
                                  : DrawWhole(staged, target, eye));
  last_frame_ = staged.tracked.frame.index;
  captions_->Draw(staged, shows_evidence_ ? &*evidence_ : nullptr, target);
  return Status();
}

Status ShowRenderer::DrawSeeThrough(const StagedFrame& staged,
                                    const FreeEye& eye,
                                    const render::RenderTarget& target) {
  LARARIUM_ASSIGN_OR_RETURN(render::RenderScene scene, SceneOf(staged, target.height()));
  scene.see_through = true;
  scene.display = eye.camera;
  scene.camera_from_stage = eye.eye_from_stage;
  scene.people_opacity = eye.opacity;
  layer_place_.reset();
  LARARIUM_RETURN_IF_ERROR(renderer_->Draw(scene, target));
  captions_->Draw(staged, shows_evidence_ ? &*evidence_ : nullptr, target);
  return Status();
}

Status ShowRenderer::DrawOverlays(const StagedFrame& staged,
                                  const render::SceneMark& mark,
                                  const render::RenderTarget& target) {
  if (!staged.camera.camera_from_stage) {
    return Status::Error("overlays", "cannot be drawn without a camera pose");
  }
  LARARIUM_ASSIGN_OR_RETURN(render::RenderScene scene, SceneOf(staged, target.height()));
  for (render::SceneHuman& human : humans_) {
    human.mark = mark;
  }
  for (render::SceneProp& prop : props_) {
    prop.mark = mark;
  }
  std::vector<render::SceneOccluder> occluders(scene.occluders.begin(), scene.occluders.end());
  for (render::SceneOccluder& occluder : occluders) {
    occluder.receives_shadow = false;
  }
  scene.occluders = occluders;
  scene.see_through = true;
  scene.display = PictureOf(staged.tracked.camera, target.width(), target.height());
  scene.camera_from_stage = staged.camera.camera_from_stage;
  layer_place_.reset();
  return renderer_->Draw(scene, target);
}

}  // namespace lararium::show
