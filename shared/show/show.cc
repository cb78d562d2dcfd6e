#include "shared/show/show.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shared/core/check.h"
#include "shared/core/release.h"
#include "shared/geometry/glm_convert.h"
#include "shared/stage/state_hash.h"

namespace lararium::show {
namespace {

constexpr double kTicksPerSecond = drama::Drama::kTicksPerSecond;
// Beyond this distance, seeking is cheaper than playing.
constexpr double kSeekAheadSeconds = 2.0;

}  // namespace

Result<std::unique_ptr<Show>> Show::Create(ShowContent content,
                                           const drama::DramaOptions& options,
                                           Log& log) {
  CHECK(!content.places.empty());
  std::unique_ptr<Show> show(new Show(std::move(content)));
  LARARIUM_RETURN_IF_ERROR(show->FillStage(log));
  LARARIUM_ASSIGN_OR_RETURN(show->sound_, SoundDirector::Create(show->content_, log));
  show->ReleaseSoundData();
  LARARIUM_RETURN_IF_ERROR(show->sound_->Teach(show->stage_.sounds()));
  if (const Status status = show->PrepareFloor(); !status.ok()) {
    log.Warn("{}", status.message());
  }
  LARARIUM_ASSIGN_OR_RETURN(show->drama_,
                            drama::Drama::Create(show->content_.drama, show->content_.drama_file,
                                                 show->stage_, options, log));
  show->stage_.Capture(show->current_);
  show->previous_ = show->current_;
  return show;
}

Status Show::FillStage(Log& log) {
  std::vector<stage::ActorId> actors;
  for (const CastMember& member : content_.cast) {
    LARARIUM_ASSIGN_OR_RETURN(actors.emplace_back(), member.model != nullptr
                                                         ? stage_.Add(member.name, member.model)
                                                         : stage_.Add(member.name, member.human));
  }
  for (const StageObject& object : content_.objects) {
    LARARIUM_ASSIGN_OR_RETURN(
        object_ids_.emplace_back(),
        stage_.AddObject(object.name, object.model, object.stage_from_object));
  }
  cast_.emplace(content_, std::move(actors), stage_, log);
  light_.emplace(content_);
  for (Speech& speech : content_.speech) {
    LARARIUM_RETURN_IF_ERROR(stage_.AddSpeech(speech.name, speech.visemes, speech.timing));
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
  if (seat_ && tick_ % GroupSeat::kMarkTicks == 0) {
    seat_->NoteMark(tick_, stage::HashState(current_));
  }
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

void Show::SetPerson(size_t cast, CastMember member) {
  CHECK(member.model != nullptr);
  CastMember& known = content_.cast[cast];
  member.name = std::move(known.name);
  member.title = std::move(known.title);
  known = std::move(member);
  cast_->SetPerson(cast, known.model);
  light_->SetPerson(static_cast<uint32_t>(cast), known.human, known.light);
}

void Show::SetObjects(const std::vector<StageObject>& objects) {
  CHECK(objects.size() == content_.objects.size());
  for (size_t i = 0; i < objects.size(); ++i) {
    content_.objects[i].model = objects[i].model;
    content_.objects[i].light = objects[i].light;
    light_->SetObject(i, objects[i]);
  }
}

Status Show::SetSounds(const ShowContent& content, Log& log) {
  LARARIUM_ASSIGN_OR_RETURN(SoundDirector sound, SoundDirector::Create(content, log));
  sound.ResumeFrom(*sound_);
  sound_ = std::move(sound);
  return Status();
}

Status Show::Reload(std::string_view script) {
  Status status = drama_->Reload(script);
  ShowTick();
  return status;
}

void Show::SetPlace(size_t index, stage::Place place) {
  sound_->SetPlace(index, place);
  light_->SetPlace(index, place);
  floor_changed_ |= !stage::BlockWalkingAlike(content_.places[index].stage, place);
  content_.places[index].stage = std::move(place);
  poses_.ResetMotion();
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

// Without a pose the place stays that of the last pose.
PoseStage::Located Show::Locate(const vision::TrackedFrame& tracked) const {
  if (!tracked.camera_from_map) {
    return {std::nullopt, poses_.place()};
  }
  CHECK(tracked.map < content_.places.size());
  const stage::Place& place = content_.places[tracked.map].stage;
  return {stage::CameraFromStage(place, *tracked.camera_from_map), tracked.map};
}

drama::Visitor Show::VisitorOf(const VisitorInput::Values& input,
                               const std::optional<geometry::Rigid3>& camera_from_stage) {
  drama::Visitor visitor;
  visitor.keys = input.keys;
  visitor.hour = input.hour;
  if (camera_from_stage) {
    visitor.tracked = true;
    visitor.position = geometry::ToGlm(camera_from_stage->Center());
    const Eigen::Vector3d ahead =
        camera_from_stage->rotation.conjugate() * Eigen::Vector3d::UnitZ();
    visitor.direction = geometry::ToGlm(ahead);
  }
  return visitor;
}

void Show::Join(DramaGroup& group) { seat_ = std::make_unique<GroupSeat>(group, *drama_); }

Status Show::CatchUpWithGroup() {
  const Status status = seat_ ? seat_->CatchUp() : Status();
  ShowTick();
  return status;
}

double Show::GroupTime(const VisitorInput::Values& input,
                       const std::optional<geometry::Rigid3>& camera_from_stage,
                       double time) {
  const double wanted =
      seat_->Next(VisitorOf(input, camera_from_stage), input.restart.has_value(), time);
  if (std::llround(drama_->time() * kTicksPerSecond) != tick_) {
    ShowTick();
  }
  return wanted;
}

double Show::DramaTime(double time, bool held) {
  const double passed = time - last_time_;
  last_time_ = time;
  if (passed < 0.0) {
    held_seconds_ = 0.0;  // Time was set back.
  } else if (held || drama_->holds()) {
    held_seconds_ += passed;
  }
  return std::clamp(time - start_ - held_seconds_, 0.0, drama::Drama::kMaxTime);
}

Status Show::ResumeFrom(const Show& before) {
  sound_->ResumeFrom(*before.sound_);
  if (seat_) {
    return CatchUpWithGroup();
  }
  const double time = before.drama_->time();
  drama_->SetPastVisitor(before.drama_->visitor_log(), time);
  return PrepareAt(time);
}

Status Show::PrepareAt(double seconds) {
  LARARIUM_RETURN_IF_ERROR(drama_->Seek(seconds));
  ShowTick();
  input_.RestartAt(seconds);
  return Status();
}

void Show::SwapFinishedLods() {
  std::optional<LodStreamer::Person> person = cast_->detail().TakeFiner();
  if (!person) {
    return;
  }
  light_->SetMesh(static_cast<uint32_t>(person->cast), person->figure.human,
                  std::move(person->light));
  content_.cast[person->cast].light = nullptr;  // The old level is no longer lit.
  cast_->SetMesh(person->cast, std::move(person->figure));
}

// An object in a hand follows the hand as drawn.
stage::Pose Show::DrawnObjectPose(const stage::StageSnapshot::ObjectEntry& entry) const {
  const stage::ObjectState& state = entry.state;
  const std::span<const VisibleActor> visible = cast_->visible();
  const auto holder = std::find_if(visible.begin(), visible.end(), [&](const VisibleActor& actor) {
    return cast_->actors()[actor.cast] == state.holder;
  });
  if (!state.holder || state.hand < 0 || holder == visible.end()) {
    return state.stage_from_object;
  }
  return stage::DrawnPose(*stage_.Find(entry.object)->model, state,
                          stage::StageFromActor(*holder->state),
                          cast_->body(holder->cast).actor_from_palm(state.hand));
}

void Show::StageThings(double time, const PlaceLight& light, StagedThings& things) const {
  things.objects.clear();
  things.stage_from_part.clear();
  things.part_shown.clear();
  things.lamps.clear();
  uint32_t lit_vertices = 0;
  for (uint32_t index = 0; index < object_ids_.size(); ++index) {
    const auto entry =
        std::find_if(drawn_.objects.begin(), drawn_.objects.end(),
                     [&](const auto& drawn) { return drawn.object == object_ids_[index]; });
    if (entry == drawn_.objects.end() || !entry->state.visible) {
      continue;
    }
    const stage::ObjectModel& model = *content_.objects[index].model;
    const stage::Object& known = *stage_.Find(entry->object);
    const stage::Pose pose = DrawnObjectPose(*entry);
    const size_t begin = things.stage_from_part.size();
    const size_t count = model.prop().parts.size();
    things.stage_from_part.resize(begin + count);
    things.part_shown.resize(begin + count);
    stage::ComputeParts(model, entry->state, pose, std::span(things.stage_from_part).subspan(begin),
                        std::span(things.part_shown).subspan(begin));
    stage::AddLamps(known, entry->state, pose, time, things.lamps);
    const uint32_t lit = light_->LitVerticesOf(index);
    things.objects.push_back({.object = index,
                              .part_begin = static_cast<uint32_t>(begin),
                              .part_count = static_cast<uint32_t>(count),
                              .light = light.At(glm::vec3(things.stage_from_part[begin][3])),
                              .glow = stage::GlowOf(known, entry->state, time),
                              .light_begin = lit_vertices,
                              .light_count = lit});
    lit_vertices += lit;
  }
  // Flicker does not change the choice from frame to frame: intensities of lamps differ by more.
  if (things.lamps.size() > light::kMaxLamps) {
    std::sort(things.lamps.begin(), things.lamps.end(),
              [](const auto& a, const auto& b) { return a.intensity.g > b.intensity.g; });
    things.lamps.resize(light::kMaxLamps);
  }
}

void Show::StageLines(double behind, bool describes, std::vector<StagedLine>& lines) const {
  lines.clear();
  for (uint32_t cast = 0; cast < cast_->actors().size(); ++cast) {
    for (const stage::StageSnapshot::ActorEntry& entry : drawn_.actors) {
      const stage::Utterance& utterance = entry.state.utterance;
      if (entry.actor == cast_->actors()[cast] && utterance.line >= 0) {
        const double seconds =
            stage::Stage::UtteredSeconds(utterance) - behind * stage::Stage::kTickSeconds;
        lines.push_back({cast, static_cast<uint32_t>(utterance.line), std::max(seconds, 0.0),
                         utterance.speaking});
      }
    }
  }
  for (const stage::StageCaption& caption : drawn_.captions) {
    lines.push_back({StagedLine::kNobody, static_cast<uint32_t>(caption.line),
                     static_cast<double>(caption.ticks) * stage::Stage::kTickSeconds, false});
  }
  if (const stage::Utterance& heard = drawn_.description.heard; describes && heard.line >= 0) {
    const double seconds =
        stage::Stage::UtteredSeconds(heard) - behind * stage::Stage::kTickSeconds;
    lines.push_back({StagedLine::kDescription, static_cast<uint32_t>(heard.line),
                     std::max(seconds, 0.0), heard.speaking});
  }
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
          const auto cast = std::find(cast_->actors().begin(), cast_->actors().end(), entry.actor);
          const auto index = static_cast<size_t>(cast - cast_->actors().begin());
          return cast_->MouthOf(index, entry.state).position;
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
void Show::StageSounds(double time,
                       double capture_time,
                       const StagedCamera& camera,
                       bool describes,
                       audio::SoundScene& scene) {
  const double tick_time = static_cast<double>(tick_) / kTicksPerSecond;
  sound_->Begin(time, camera.place, camera.camera_from_stage, scene);
  sound_->BeginFrame(capture_time, scene);
  for (const VisibleActor& visible : cast_->visible()) {
    const stage::Utterance& utterance = visible.state->utterance;
    if (utterance.line >= 0) {
      sound_->AddLine(visible.cast, static_cast<size_t>(utterance.line),
                      tick_time - stage::Stage::UtteredSeconds(utterance),
                      cast_->MouthOf(visible.cast, *visible.state), scene);
    }
  }
  if (const stage::Utterance& heard = drawn_.description.heard; describes && heard.line >= 0) {
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
  sound_->Finish(camera.place, scene);
}

void Show::StageFrame(vision::TrackedFrame tracked, double time, StagedFrame& staged) {
  const VisitorInput::Values input = input_.Take();
  time = std::max(time, 0.0);
  if (input.restart && !seat_) {
    start_ = time - *input.restart;
    last_time_ = time;
    held_seconds_ = 0.0;
  }
  if (input.restart || input.forgets_pose) {
    poses_.Reset();
  }
  SwapFinishedLods();
  const PoseStage::Located located = Locate(tracked);
  staged.camera = poses_.Next(tracked, located, content_.places[located.place].map.get(),
                              !input.reduced_motion);
  staged.tracked = std::move(tracked);
  picture_hour_ = input.hour;
  if (seat_) {
    staged.time = GroupTime(input, located.camera_from_stage, time);
    staged.camera.opacity *= seat_->catching_up() ? 0.0f : 1.0f;
  } else {
    drama_->SetVisitor(VisitorOf(input, located.camera_from_stage));
    staged.time = DramaTime(time, input.holds);
  }
  AdvanceTo(staged.time);
  const double behind = static_cast<double>(tick_) - staged.time * kTicksPerSecond;  // 0..1 ticks
  stage::Interpolate(previous_, current_, static_cast<float>(std::clamp(1.0 - behind, 0.0, 1.0)),
                     drawn_);
  StagePeopleAndThings(staged);
  StageLines(behind, input.describes, staged.lines);
  StageSounds(staged.time, staged.tracked.frame.capture_time, staged.camera, input.describes,
              staged.sound);
}

void Show::StagePeopleAndThings(StagedFrame& staged) {
  const StagedCamera& camera = staged.camera;
  const PlaceLight light = {content_.places[camera.place].stage.probes, drawn_.hour, picture_hour_};
  staged.times.helpers_cpu_ms = cast_->Stage(drawn_, staged.time, staged.tracked.camera,
                                             camera.camera_from_stage, light, staged.people);
  StageThings(staged.time, light, staged.things);
  light_->ShadeLamps(camera.place, staged.things.lamps);
  staged.times.helpers_cpu_ms +=
      light_->Light(light, camera.camera_from_stage, staged.people, staged.things, staged.light);
}

Status Show::StageAtTime(double time, const StagedFrame& now, StagedFrame& other) {
  other.tracked = now.tracked;
  other.camera = {.place = now.camera.place,
                  .camera_from_stage = now.camera.camera_from_stage,
                  .opacity = now.camera.opacity,
                  .gain = now.camera.gain};
  other.lines.clear();
  cast_->SetAside();
  light_->SetAside();
  const Status status = drama_->Glance(std::max(time, 0.0), [&] {
    stage_.Capture(drawn_);
    other.time = drama_->time();
    StagePeopleAndThings(other);
  });
  cast_->Restore();
  light_->Restore();
  return status;
}

}  // namespace lararium::show
