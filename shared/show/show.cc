#include "shared/show/show.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shared/core/check.h"
#include "shared/core/memory.h"
#include "shared/core/parallel.h"
#include "shared/geometry/glm_convert.h"
#include "shared/light/probe_weights.h"

namespace lararium::show {
namespace {

constexpr double kTicksPerSecond = drama::Drama::kTicksPerSecond;
// Beyond this distance, seeking is cheaper than playing.
constexpr double kSeekAheadSeconds = 2.0;
// Distance beyond a person's head, feet and sides up to which hands, clothes and held objects may
// reach; metres.
constexpr float kReachBeyondBody = 0.75f;
// Assumed distance, in metres, from the camera to the real surfaces that receive people's shadows.
constexpr float kViewedDistance = 3.0f;

}  // namespace

Result<std::unique_ptr<Show>> Show::Create(ShowContent content,
                                           const drama::DramaOptions& options,
                                           Log& log) {
  CHECK(!content.places.empty());
  std::unique_ptr<Show> show(new Show(std::move(content)));
  LARARIUM_RETURN_IF_ERROR(show->FillStage());
  show->lod_streamer_.emplace(show->content_.finer, show->content_.cast, log);
  LARARIUM_ASSIGN_OR_RETURN(show->sound_, SoundDirector::Create(show->content_, log));
  show->ReleaseSoundData();
  LARARIUM_RETURN_IF_ERROR(show->sound_->Teach(show->stage_.sounds()));
  if (const Status status = show->PrepareFloor(); !status.ok()) {
    log.warn("{}", status.message());
  }
  LARARIUM_ASSIGN_OR_RETURN(show->drama_,
                            drama::Drama::Create(show->content_.drama, show->content_.drama_file,
                                                 show->stage_, options, log));
  show->stage_.Capture(show->current_);
  show->previous_ = show->current_;
  return show;
}

Status Show::FillStage() {
  for (const CastMember& member : content_.cast) {
    LARARIUM_ASSIGN_OR_RETURN(const stage::ActorId id, member.model != nullptr
                                                           ? stage_.Add(member.name, member.model)
                                                           : stage_.Add(member.name, member.human));
    actor_ids_.push_back(id);
    bodies_.emplace_back(stage_.Find(id)->model);
  }
  details_.resize(bodies_.size());
  requests_.resize(bodies_.size());
  std::vector<std::shared_ptr<const human::Human>> cast;
  std::vector<std::shared_ptr<const UnpackedLight>> light;
  std::vector<std::shared_ptr<human::Human>> figures;
  for (const CastMember& member : content_.cast) {
    cast.push_back(member.human);
    light.push_back(member.light);
    levels_.push_back(render::FindDetailLevels(*member.human));
  }
  for (const StageObject& object : content_.objects) {
    LARARIUM_ASSIGN_OR_RETURN(const stage::ObjectId id, stage_.AddObject(object.name, object.model,
                                                                         object.stage_from_object));
    object_ids_.push_back(id);
    cast.push_back(figures.emplace_back(FigureOf(object.model->prop())));
    light.push_back(object.light);
    things_.push_back({std::vector<glm::mat4>(object.model->prop().parts.size()),
                       {},
                       ThingMemory(RadiusOf(object.model->prop()))});
  }
  light_.emplace(cast, light);
  for (const std::shared_ptr<human::Human>& figure : figures) {
    figure->meshes = {};  // PersonLight keeps the data that it needs from them.
    figure->light.meshes = {};
  }
  for (const ShowPlace& place : content_.places) {
    lamp_shades_.emplace_back(place.stage.occluders);
  }
  for (Speech& speech : content_.speech) {
    LARARIUM_RETURN_IF_ERROR(stage_.AddSpeech(speech.name, speech.visemes));
  }
  return Status();
}

// Sounds are decoded into the library; the originals can be released.
void Show::ReleaseSoundData() {
  for (Speech& line : content_.speech) {
    Release(line.sound);
  }
  for (audio::SoundData& sound : content_.sounds) {
    sound = {sound.name, {}, nullptr};
  }
}

// On an error actors cannot walk, but the rest of the show works.
Status Show::PrepareFloor() {
  std::vector<stage::Place> places = content_.elsewhere;
  for (const ShowPlace& place : content_.places) {
    places.push_back(place.stage);
  }
  return stage_.SetFloor({}, places);
}

void Show::TickOnce() {
  std::swap(previous_, current_);
  drama_->Tick();
  stage_.Capture(current_);
  ++tick_;
}

void Show::AdvanceTo(double time) {
  const auto wanted = static_cast<int64_t>(std::ceil(time * kTicksPerSecond - 1e-9));
  const bool behind = wanted < tick_;
  const bool far_ahead = static_cast<double>(wanted - tick_) > kSeekAheadSeconds * kTicksPerSecond;
  if (behind || far_ahead) {
    // Stop one tick early, so that both snapshots lie around this time.
    const int64_t before = std::max<int64_t>(wanted - 1, 0);
    if (drama_->Seek(static_cast<double>(before) / kTicksPerSecond).ok()) {
      tick_ = before;
      stage_.Capture(current_);
      previous_ = current_;
    }
  }
  while (tick_ < wanted) {
    TickOnce();
  }
}

Status Show::Reload(std::string_view script) {
  Status status = drama_->Reload(script);
  ShowTick();
  return status;
}

void Show::PlaceObject(size_t index, const stage::Pose& stage_from_object) {
  if (content_.objects[index].stage_from_object == stage_from_object) {
    return;
  }
  content_.objects[index].stage_from_object = stage_from_object;
  PlaceAtBeginning(index);
  floor_changed_ = true;
  stage_.Capture(current_);
  previous_ = current_;
}

// Moves the object to its initial pose, with the objects that stand on it, unless something has
// moved it since the beginning.
void Show::PlaceAtBeginning(size_t index) {
  stage::Object& object = *stage_.Find(object_ids_[index]);
  const stage::Pose& now = object.state.stage_from_object;
  const stage::Pose moved = content_.objects[index].stage_from_object * now.Inverse();
  const bool unmoved = now == object.initial_pose && stage_.Find(object.state.holder) == nullptr;
  object.initial_pose = content_.objects[index].stage_from_object;
  if (unmoved) {
    object.state.stage_from_object = object.initial_pose;
    MoveRiders(object_ids_[index], moved);
  }
}

void Show::MoveRiders(stage::ObjectId base, const stage::Pose& moved) {
  for (const stage::ObjectId id : object_ids_) {
    stage::ObjectState& rider = stage_.Find(id)->state;
    if (rider.support.object == base) {
      rider.stage_from_object = moved * rider.stage_from_object;
      MoveRiders(id, moved);
    }
  }
}

Status Show::LayFloor() {
  if (!std::exchange(floor_changed_, false)) {
    return Status();
  }
  for (size_t i = 0; i < object_ids_.size(); ++i) {  // Seeking restored the old initial poses.
    PlaceAtBeginning(i);
  }
  Status status = PrepareFloor();
  const Status played = drama_->PlayAgain();
  ShowTick();
  return status.ok() ? played : status;
}

// Captures the stage at the drama's time.
void Show::ShowTick() {
  tick_ = std::llround(drama_->time() * kTicksPerSecond);
  stage_.Capture(current_);
  previous_ = current_;
}

void Show::UpdateVisitor(const std::optional<geometry::Rigid3>& camera_from_stage) {
  drama::Visitor visitor;
  {
    const std::lock_guard lock(input_mutex_);
    visitor.keys = std::exchange(keys_, {});
    visitor.hour = hour_;
  }
  picture_hour_ = visitor.hour;
  if (camera_from_stage) {
    visitor.tracked = true;
    visitor.position = geometry::ToGlm(camera_from_stage->Center());
    const Eigen::Vector3d ahead =
        camera_from_stage->rotation.conjugate() * Eigen::Vector3d::UnitZ();
    visitor.direction = geometry::ToGlm(ahead);
  }
  drama_->SetVisitor(visitor);
}

double Show::DramaTime(double time) {
  const double passed = time - last_time_;
  last_time_ = time;
  if (passed < 0.0) {
    held_seconds_ = 0.0;  // Time was set back.
  } else if (drama_->holds()) {
    held_seconds_ += passed;
  }
  return std::clamp(time - start_ - held_seconds_, 0.0, drama::Drama::kMaxTime);
}

Status Show::ResumeFrom(const Show& before) {
  sound_->ResumeFrom(*before.sound_);
  const double time = before.drama_->time();
  drama_->SetPastVisitor(before.drama_->visitor_log(), time);
  return PrepareAt(time);
}

Status Show::PrepareAt(double seconds) {
  LARARIUM_RETURN_IF_ERROR(drama_->Seek(seconds));
  ShowTick();
  RestartAt(seconds);
  return Status();
}

void Show::RestartAt(double seconds) {
  const std::lock_guard lock(input_mutex_);
  restart_ = std::clamp(seconds, 0.0, drama::Drama::kMaxTime);
}

void Show::ForgetPose() {
  const std::lock_guard lock(input_mutex_);
  forget_pose_ = true;
}

void Show::TakeRestart(double time) {
  std::optional<double> restart;
  bool forget_pose = false;
  {
    const std::lock_guard lock(input_mutex_);
    restart = std::exchange(restart_, std::nullopt);
    forget_pose = std::exchange(forget_pose_, false);
  }
  if (restart) {
    start_ = time - *restart;
    last_time_ = time;
    held_seconds_ = 0.0;
  }
  if (restart || forget_pose) {
    ResetPose();
  }
}

void Show::ResetPose() {
  gain_filter_.Reset();
  camera_motion_.Reset();
  if (fader_) {
    fader_->Reset();
  }
}

void Show::SetHour(float hour) {
  const std::lock_guard lock(input_mutex_);
  hour_ = hour;
}

void Show::SetQuality(const render::Quality& quality) {
  const render::Quality clamped = render::Clamped(quality);
  const std::lock_guard lock(input_mutex_);
  detail_options_.tolerance_px = clamped.detail_px;
  detail_options_.triangle_budget = static_cast<size_t>(clamped.triangles);
}

void Show::PressKey(std::string_view key) {
  const std::lock_guard lock(input_mutex_);
  drama::AddKey(key, keys_);
}

TrackingLossFader::View Show::Update(const vision::TrackedFrame& tracked,
                                     const std::optional<geometry::Rigid3>& camera_from_stage,
                                     uint32_t place) {
  if (fader_) {
    fader_->SetGlides(!reduced_motion_);
    return fader_->Update(tracked.frame.capture_time, camera_from_stage, place, tracked.camera,
                          tracked.reason == vision::TrackReason::kTooDark);
  }
  TrackingLossFader::View view;
  view.state =
      camera_from_stage ? TrackingLossFader::State::kShown : TrackingLossFader::State::kGone;
  view.camera_from_stage = camera_from_stage;
  view.place = place;
  view.opacity = 1.0f;
  return view;
}

void Show::Locate(vision::TrackedFrame tracked, StagedFrame& staged) {
  std::optional<geometry::Rigid3> located;
  uint32_t place = place_;
  if (tracked.camera_from_map) {
    CHECK(tracked.map < content_.places.size());
    place = tracked.map;
    located = stage::CameraFromStage(content_.places[place].stage, *tracked.camera_from_map);
  }
  const TrackingLossFader::View view = Update(tracked, located, place);
  if (view.place != place_) {
    gain_filter_.Reset();
    camera_motion_.Reset();
  }
  place_ = view.place;
  staged.place = place_;
  staged.state = view.state;
  staged.opacity = view.opacity;
  staged.lost_seconds = view.lost_seconds;
  staged.camera_from_stage = view.camera_from_stage ? view.camera_from_stage : located;
  staged.motion.reset();
  if (located && place == place_) {
    staged.motion = camera_motion_.Update(tracked.frame.index, *staged.camera_from_stage);
    gain_ = gain_filter_.Update(tracked.gain, tracked.frame.capture_time);
  } else {
    gain_filter_.Reset();
    camera_motion_.Reset();
  }
  staged.gain = gain_;
  guide_.Update(view.guide, tracked, content_.places[place].map.get(), staged.guide);
  UpdateVisitor(located);
  staged.tracked = std::move(tracked);
}

void Show::ChooseDetails(const StagedFrame& staged) {
  if (!staged.camera_from_stage) {
    return;  // Nothing is drawn; keep the previous choice.
  }
  const geometry::CameraModel& camera = staged.tracked.camera;
  geometry::CameraModel display = camera.DisplayPinhole();
  if (picture_width_ > 0 && picture_height_ > 0) {
    display = PictureCamera(camera, picture_width_, picture_height_, picture_part_)
                  .Resized(picture_width_, picture_height_);
  }
  for (size_t cast = 0; cast < requests_.size(); ++cast) {
    requests_[cast].levels = levels_[cast];
    requests_[cast].pixels_per_metre = 0.0f;
  }
  // With a larger drawing tolerance, people are simulated as if seen from further away.
  render::DetailOptions options;
  {
    const std::lock_guard lock(input_mutex_);
    options = detail_options_;
  }
  const float share = render::Quality().detail_px / options.tolerance_px;
  for (const Visible& visible : visible_) {
    const float height = bodies_[visible.cast].height();
    const glm::vec3 middle = visible.state->position + glm::vec3(0.0f, 0.5f * height, 0.0f);
    const float scale = render::PixelsPerMetre(display, *staged.camera_from_stage, middle);
    const bool seen = seen_around_ || render::MaySee(display, *staged.camera_from_stage, middle,
                                                     0.5f * height + kReachBeyondBody);
    BodyDetail& detail = details_[visible.cast];
    detail = ChooseBodyDetail(height * scale * share, !seen, detail);
    requests_[visible.cast].pixels_per_metre = seen ? scale : 0.0f;
  }
  detail_chooser_.SetOptions(options);
  detail_chooser_.Choose(requests_);
  for (size_t cast = 0; cast < requests_.size(); ++cast) {
    if (requests_[cast].pixels_per_metre > 0.0f) {
      lod_streamer_->Want(cast, requests_[cast].detail);
    }
  }
}

void Show::SwapFinishedLods() {
  std::optional<LodStreamer::Person> person = lod_streamer_->Take();
  if (!person) {
    return;
  }
  const auto cast = static_cast<uint32_t>(person->cast);
  const std::shared_ptr<const human::Human>& human = person->figure.human;
  levels_[cast] = render::FindDetailLevels(*human);
  light_->SetMesh(cast, human, std::move(person->light));
  content_.cast[cast].light = nullptr;  // The old level is no longer lit.
  if (!other_bodies_.empty()) {
    other_bodies_[cast].SetMesh(CharacterMesh(human));
  }
  bodies_[cast].SetMesh(std::move(person->figure));
}

void Show::LayOutActors(StagedFrame& staged) {
  uint32_t vertices = 0;
  for (const Visible& visible : visible_) {
    const CharacterInstance& body = bodies_[visible.cast];
    StagedActor& actor = staged.actors.emplace_back();
    actor.cast = visible.cast;
    actor.figure = body.figure();
    actor.stage_from_actor = stage::StageFromActor(*visible.state);
    actor.detail = requests_[visible.cast].detail;
    actor.skin_begin = static_cast<uint32_t>(staged.skin.size());
    actor.skin_count = static_cast<uint32_t>(body.skin().size());
    staged.skin.insert(staged.skin.end(), body.skin().begin(), body.skin().end());
    actor.mesh_begin = static_cast<uint32_t>(staged.meshes.size());
    actor.mesh_count = static_cast<uint32_t>(body.moving_meshes().size());
    for (const CharacterInstance::MovingMesh& mesh : body.moving_meshes()) {
      const auto count = static_cast<uint32_t>(actor.figure->meshes[mesh.mesh].positions.size());
      staged.meshes.push_back({mesh, vertices, count});
      vertices += count;
    }
  }
  // Reserve exactly: the arrays have megabytes.
  staged.positions.reserve(vertices);
  staged.normals.reserve(vertices);
  staged.positions.resize(vertices);
  staged.normals.resize(vertices);
}

void Show::StageActors(double time, StagedFrame& staged) {
  visible_.clear();
  for (uint32_t cast = 0; cast < actor_ids_.size(); ++cast) {
    for (const stage::StageSnapshot::ActorEntry& entry : drawn_.actors) {
      if (entry.actor == actor_ids_[cast] && entry.state.visible) {
        visible_.push_back({cast, &entry.state});
      }
    }
  }
  ChooseDetails(staged);
  staged.helpers_cpu_ms = ParallelForTimed(visible_.size(), [&](size_t i) {
    const Visible& visible = visible_[i];
    bodies_[visible.cast].Step(*visible.state, time, details_[visible.cast]);
  });
  LayOutActors(staged);
  staged.helpers_cpu_ms += ParallelForTimed(staged.actors.size(), [&](size_t i) {
    const StagedActor& actor = staged.actors[i];
    for (uint32_t m = actor.mesh_begin; m < actor.mesh_begin + actor.mesh_count; ++m) {
      const StagedMesh& mesh = staged.meshes[m];
      bodies_[actor.cast].ComputeVertices(
          mesh.mesh, std::span(staged.positions).subspan(mesh.vertex_begin, mesh.vertex_count),
          std::span(staged.normals).subspan(mesh.vertex_begin, mesh.vertex_count));
    }
  });
}

light::ProbeLight Show::LightAt(const StagedFrame& staged, const glm::vec3& position) const {
  const std::vector<light::PlacedProbe>& probes = content_.places[staged.place].stage.probes;
  if (probes.empty()) {
    return {};
  }
  return light::Blend(probes, position, drawn_.hour.value_or(probes.front().hour));
}

double Show::PictureHour(std::span<const light::PlacedProbe> probes) const {
  return picture_hour_ >= 0.0f ? picture_hour_ : probes.front().hour;
}

void Show::BlendProbes(StagedFrame& staged) const {
  glm::vec3 viewed(0.0f);
  if (staged.camera_from_stage) {
    const geometry::Rigid3 stage_from_camera = staged.camera_from_stage->Inverse();
    viewed = geometry::ToGlm(stage_from_camera * Eigen::Vector3d(0.0, 0.0, kViewedDistance));
  }
  staged.light = LightAt(staged, viewed);
  const std::vector<light::PlacedProbe>& probes = content_.places[staged.place].stage.probes;
  staged.picture_light.reset();
  if (!probes.empty() && drawn_.hour) {
    staged.picture_light = light::Blend(probes, viewed, PictureHour(probes)).sky;
  }
  staged.probe_weights.resize(probes.size());
  if (!probes.empty()) {
    light::ComputeProbeWeights(probes, viewed, drawn_.hour.value_or(probes.front().hour),
                               staged.probe_weights);
  }
  for (StagedActor& actor : staged.actors) {
    const glm::vec4 middle(0.0f, 0.5f * bodies_[actor.cast].height(), 0.0f, 1.0f);
    actor.light = LightAt(staged, actor.stage_from_actor * middle);
  }
  for (StagedObject& object : staged.objects) {
    object.light = LightAt(staged, glm::vec3(staged.stage_from_part[object.part_begin][3]));
  }
}

// People who are not visible still cast shadows.
void Show::LayOutLight(StagedFrame& staged) {
  uint32_t vertices = 0;
  const auto lay_out = [&](auto& lit, size_t cast, bool wanted) {
    lit.light_begin = vertices;
    lit.light_count = wanted && light_->Lights(static_cast<uint32_t>(cast))
                          ? static_cast<uint32_t>(light_->vertex_count(static_cast<uint32_t>(cast)))
                          : 0;
    vertices += lit.light_count;
  };
  for (StagedActor& actor : staged.actors) {
    lay_out(actor, actor.cast, details_[actor.cast].drawn);
  }
  for (StagedObject& object : staged.objects) {
    lay_out(object, content_.cast.size() + object.object, true);
  }
  staged.irradiance.reserve(vertices);  // Reserve exactly, as in LayOutActors().
  staged.irradiance.resize(vertices);
}

// The sun's shadows are drawn separately (render/sun_pass.h).
void Show::LightStage(StagedFrame& staged) {
  LayOutLight(staged);
  lit_.clear();
  for (const StagedActor& actor : staged.actors) {
    lit_.push_back(
        {actor.cast, &actor.light.sky,
         std::span(staged.skin).subspan(actor.skin_begin, actor.skin_count), actor.stage_from_actor,
         std::span(staged.irradiance).subspan(actor.light_begin, actor.light_count), actor.detail});
  }
  for (const StagedObject& object : staged.objects) {
    Thing& thing = things_[object.object];
    SkinOfFigure(std::span(staged.stage_from_part).subspan(object.part_begin, object.part_count),
                 std::span(staged.part_shown).subspan(object.part_begin, object.part_count),
                 thing.skin);
    const auto cast = static_cast<uint32_t>(content_.cast.size() + object.object);
    lit_.push_back({cast, &object.light.sky, thing.skin, staged.stage_from_part[object.part_begin],
                    std::span(staged.irradiance).subspan(object.light_begin, object.light_count)});
  }
  staged.helpers_cpu_ms += light_->Pose(lit_);
  staged.blockers.assign(light_->blockers().begin(), light_->blockers().end());
  for (size_t i = 0; i < staged.objects.size(); ++i) {
    const StagedObject& object = staged.objects[i];
    Thing& thing = things_[object.object];
    if (!thing.memory.Update(object.light.sky, staged.lamps,
                             staged.stage_from_part[object.part_begin], thing.skin,
                             staged.blockers)) {
      std::copy(thing.irradiance.begin(), thing.irradiance.end(),
                staged.irradiance.begin() + object.light_begin);
      lit_[staged.actors.size() + i].irradiance = {};
    }
  }
  staged.helpers_cpu_ms += light_->Light(staged.lamps, lit_);
  KeepLightOfThings(staged);
}

void Show::KeepLightOfThings(const StagedFrame& staged) {
  for (size_t i = 0; i < staged.objects.size(); ++i) {
    const std::span<const glm::vec3> lit = lit_[staged.actors.size() + i].irradiance;
    if (!lit.empty()) {
      things_[staged.objects[i].object].irradiance.assign(lit.begin(), lit.end());
    }
  }
}

// An object in a hand follows the hand as drawn.
stage::Pose Show::DrawnObjectPose(const stage::StageSnapshot::ObjectEntry& entry) const {
  const stage::ObjectState& state = entry.state;
  const auto holder = std::find_if(visible_.begin(), visible_.end(), [&](const Visible& visible) {
    return actor_ids_[visible.cast] == state.holder;
  });
  if (!state.holder || state.hand < 0 || holder == visible_.end()) {
    return state.stage_from_object;
  }
  return stage::DrawnPose(*stage_.Find(entry.object)->model, state,
                          stage::StageFromActor(*holder->state),
                          bodies_[holder->cast].actor_from_palm(state.hand));
}

void Show::StageVisible(uint32_t object,
                        const stage::StageSnapshot::ObjectEntry& entry,
                        StagedFrame& staged) {
  const stage::ObjectModel& model = *content_.objects[object].model;
  const stage::Object& known = *stage_.Find(entry.object);
  const stage::Pose pose = DrawnObjectPose(entry);
  const size_t begin = staged.stage_from_part.size();
  const size_t count = model.prop().parts.size();
  staged.stage_from_part.resize(begin + count);
  staged.part_shown.resize(begin + count);
  stage::ComputeParts(model, entry.state, pose, std::span(staged.stage_from_part).subspan(begin),
                      std::span(staged.part_shown).subspan(begin));
  stage::AddLamps(known, entry.state, pose, staged.time, staged.lamps);
  staged.objects.push_back({object,
                            static_cast<uint32_t>(begin),
                            static_cast<uint32_t>(count),
                            {},
                            stage::GlowOf(known, entry.state, staged.time)});
}

void Show::StageObjects(StagedFrame& staged) {
  for (uint32_t object = 0; object < object_ids_.size(); ++object) {
    const auto entry = std::find_if(
        drawn_.objects.begin(), drawn_.objects.end(),
        [&](const auto& candidate) { return candidate.object == object_ids_[object]; });
    if (entry != drawn_.objects.end() && entry->state.visible) {
      StageVisible(object, *entry, staged);
    }
  }
  // Flicker does not change the choice from frame to frame: intensities of lamps differ by more.
  if (staged.lamps.size() > light::kMaxLamps) {
    std::sort(staged.lamps.begin(), staged.lamps.end(),
              [](const auto& a, const auto& b) { return a.intensity.g > b.intensity.g; });
    staged.lamps.resize(light::kMaxLamps);
  }
  lamp_shades_[staged.place].SetWalls(staged.lamps);
}

void Show::StageLines(double behind, StagedFrame& staged) const {
  for (uint32_t cast = 0; cast < actor_ids_.size(); ++cast) {
    for (const stage::StageSnapshot::ActorEntry& entry : drawn_.actors) {
      const stage::Utterance& utterance = entry.state.utterance;
      if (entry.actor == actor_ids_[cast] && utterance.line >= 0) {
        const double seconds =
            stage::Stage::UtteredSeconds(utterance) - behind * stage::Stage::kTickSeconds;
        staged.lines.push_back({cast, static_cast<uint32_t>(utterance.line), std::max(seconds, 0.0),
                                utterance.speaking});
      }
    }
  }
  for (const stage::StageCaption& caption : drawn_.captions) {
    staged.lines.push_back({StagedLine::kNobody, static_cast<uint32_t>(caption.line),
                            static_cast<double>(caption.ticks) * stage::Stage::kTickSeconds,
                            false});
  }
  if (const stage::Utterance& heard = drawn_.description.heard; describes_ && heard.line >= 0) {
    const double seconds =
        stage::Stage::UtteredSeconds(heard) - behind * stage::Stage::kTickSeconds;
    staged.lines.push_back({StagedLine::kDescription, static_cast<uint32_t>(heard.line),
                            std::max(seconds, 0.0), heard.speaking});
  }
}

// Actors outside the picture, or not drawn, have a mouth too.
Mouth Show::MouthOf(uint32_t cast, const stage::ActorState& state) const {
  Mouth mouth = bodies_[cast].actor_from_mouth();
  const glm::mat4 stage_from_actor = stage::StageFromActor(state);
  mouth.position = glm::vec3(stage_from_actor * glm::vec4(mouth.position, 1.0f));
  mouth.facing = glm::mat3(stage_from_actor) * mouth.facing;
  return mouth;
}

// Position of a sound; nullopt: around the listener.
std::optional<glm::vec3> Show::PlaceOf(const stage::StageSound& sound) const {
  switch (sound.at) {
    case stage::StageSound::At::kListener:
      break;
    case stage::StageSound::At::kPoint:
      return sound.point;
    case stage::StageSound::At::kActor:
      for (const stage::StageSnapshot::ActorEntry& entry : drawn_.actors) {
        if (entry.actor == sound.actor) {
          const auto cast = std::find(actor_ids_.begin(), actor_ids_.end(), entry.actor);
          return MouthOf(static_cast<uint32_t>(cast - actor_ids_.begin()), entry.state).position;
        }
      }
      break;
    case stage::StageSound::At::kObject:
      for (const stage::StageSnapshot::ObjectEntry& entry : drawn_.objects) {
        if (entry.object == sound.object) {
          return DrawnObjectPose(entry).position;
        }
      }
      break;
  }
  return std::nullopt;
}

// Positions are those drawn; times are those of the tick after the frame.
void Show::StageSounds(StagedFrame& staged) {
  const double tick_time = static_cast<double>(tick_) / kTicksPerSecond;
  audio::SoundScene& scene = staged.sound;
  sound_->Begin(staged.time, place_, staged.camera_from_stage, scene);
  sound_->BeginFrame(staged.tracked.frame.capture_time, scene);
  for (const Visible& visible : visible_) {
    const stage::Utterance& utterance = visible.state->utterance;
    if (utterance.line >= 0) {
      sound_->AddLine(visible.cast, static_cast<size_t>(utterance.line),
                      tick_time - stage::Stage::UtteredSeconds(utterance),
                      MouthOf(visible.cast, *visible.state), scene);
    }
  }
  if (const stage::Utterance& heard = drawn_.description.heard; describes_ && heard.line >= 0) {
    sound_->AddDescription(static_cast<size_t>(heard.line),
                           tick_time - stage::Stage::UtteredSeconds(heard), scene);
  }
  for (size_t i = 0; i < drawn_.objects.size(); ++i) {
    const stage::StageSnapshot::ObjectEntry& entry = drawn_.objects[i];
    const auto object = std::find(object_ids_.begin(), object_ids_.end(), entry.object);
    if (entry.state.visible && object != object_ids_.end()) {
      sound_->AddObject(static_cast<size_t>(object - object_ids_.begin()),
                        current_.objects[i].state, DrawnObjectPose(entry), tick_time, scene);
    }
  }
  for (const stage::StageSound& sound : current_.sounds) {
    sound_->AddSound(sound, PlaceOf(sound), tick_time, scene);
  }
  sound_->Finish(place_, scene);
}

void Show::StageFrame(vision::TrackedFrame tracked, double time, StagedFrame& staged) {
  time = std::max(time, 0.0);
  TakeRestart(time);
  SwapFinishedLods();
  Locate(std::move(tracked), staged);
  time = DramaTime(time);
  AdvanceTo(time);
  const double behind = static_cast<double>(tick_) - time * kTicksPerSecond;  // 0..1 ticks
  stage::Interpolate(previous_, current_, static_cast<float>(std::clamp(1.0 - behind, 0.0, 1.0)),
                     drawn_);
  StagePeopleAndThings(time, staged);
  StageLines(behind, staged);
  StageSounds(staged);
}

void Show::StagePeopleAndThings(double time, StagedFrame& staged) {
  staged.time = time;
  staged.actors.clear();
  staged.skin.clear();
  staged.meshes.clear();
  staged.objects.clear();
  staged.lamps.clear();
  staged.lines.clear();
  staged.stage_from_part.clear();
  staged.part_shown.clear();
  StageActors(time, staged);
  StageObjects(staged);
  BlendProbes(staged);
  LightStage(staged);
}

Status Show::StageAtTime(double time, const StagedFrame& now, StagedFrame& other) {
  other.tracked = now.tracked;
  other.place = now.place;
  other.camera_from_stage = now.camera_from_stage;
  other.opacity = now.opacity;
  other.gain = now.gain;
  if (other_bodies_.empty()) {
    for (size_t cast = 0; cast < actor_ids_.size(); ++cast) {
      other_bodies_.emplace_back(stage_.Find(actor_ids_[cast])->model);
      other_bodies_.back().SetMesh(CharacterMesh(bodies_[cast].figure()));
    }
  }
  for (CharacterInstance& body : other_bodies_) {
    body.Settle();
  }
  // State that persists between frames; restored below.
  std::vector<Thing> things = things_;
  const std::vector<BodyDetail> details = details_;
  const std::vector<render::DetailRequest> requests = requests_;
  const render::DetailChooser chooser = detail_chooser_;
  bodies_.swap(other_bodies_);
  const Status status = drama_->Glance(std::max(time, 0.0), [&] {
    stage_.Capture(drawn_);
    StagePeopleAndThings(drama_->time(), other);
  });
  bodies_.swap(other_bodies_);
  things_ = std::move(things);
  details_ = details;
  requests_ = requests;
  detail_chooser_ = chooser;
  return status;
}

}  // namespace lararium::show
