#include "shared/stage/stage.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shared/human/animation.h"
#include "shared/stage/attention.h"
#include "shared/stage/hands.h"
#include "shared/stage/walking.h"
#include "shared/stage/world.h"

namespace lararium::stage {
namespace {

constexpr auto kTick = static_cast<float>(Stage::kTickSeconds);
constexpr float kMovingPace = 0.1f;  // m/s

// The seed differs between names and is the same whenever an actor or object of that name is added.
uint64_t SeedOf(std::string_view name) {
  uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a
  for (const char c : name) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  }
  return hash | 1u;
}

// Resets everything about an actor that a drama changes.
void ResetActor(Actor& actor) {
  const std::string name = std::move(actor.name);
  const auto model = std::move(actor.model);
  actor = Actor();
  actor.name = name;
  actor.model = model;
  actor.state.animation_state.seed = SeedOf(name);
  actor.attention.random = Random(SeedOf(name), 7);
  const int walk = FindClip(actor.human(), "walk");
  if (walk >= 0 && actor.human().clips[static_cast<size_t>(walk)].stride > 0.0f &&
      actor.human().clips[static_cast<size_t>(walk)].duration > 0.0f) {
    actor.walk_clip = walk;
  }
  actor.idle_clip = FindClip(actor.human(), "idle");
}

void ResetObject(Object& object) {
  object.state = InitialState(object);
  object.held = {};
  object.dimming = {};
}

float PaceOf(const World& world, const Actor& actor) {
  switch (actor.walk.phase) {
    case Walk::Phase::kGo:
      return glm::length(world.navigation->velocity(actor.walker));
    case Walk::Phase::kLeave:
    case Walk::Phase::kDock:
      return actor.walk.pace;
    default:
      return 0.0f;
  }
}

// Signed hours from one time of day to another, the shorter way round the clock.
double HoursBetween(double from, double to) { return std::remainder(to - from, 24.0); }

double OnTheClock(double hour) {
  const double rest = std::fmod(hour, 24.0);
  return rest < 0.0 ? rest + 24.0 : rest;
}

}  // namespace

Stage::Stage() : world_(std::make_unique<World>()), tasks_(*world_) {}
Stage::~Stage() = default;

// ---- contents of the stage ----

bool Stage::IsNameTaken(std::string_view name) const {
  return Find(name).has_value() || FindObject(name).has_value();
}

Result<ActorId> Stage::Add(std::string name, std::shared_ptr<const human::Human> human) {
  CHECK(human != nullptr);
  return Add(std::move(name), human::MakeAnimationRig(std::move(human)));
}

Result<ActorId> Stage::Add(std::string name, std::shared_ptr<const human::AnimationRig> model) {
  CHECK(model != nullptr);
  if (IsNameTaken(name)) {
    return Status::Error("stage", "two actors or objects are called '" + name + "'",
                         "rename one of them");
  }
  Actor actor;
  actor.name = std::move(name);
  actor.model = std::move(model);
  ResetActor(actor);
  const ActorId id = world_->actors.Add(std::move(actor));
  world_->actor_ids = world_->actors.ids();
  return id;
}

Result<ObjectId> Stage::AddObject(std::string name,
                                  std::shared_ptr<const ObjectModel> model,
                                  const Pose& stage_from_object) {
  CHECK(model != nullptr);
  if (IsNameTaken(name)) {
    return Status::Error("stage", "two actors or objects are called '" + name + "'",
                         "rename one of them");
  }
  Object object;
  object.name = std::move(name);
  object.model = std::move(model);
  object.initial_pose = stage_from_object;
  object.seed = SeedOf(object.name);
  ResetObject(object);
  const ObjectId id = world_->objects.Add(std::move(object));
  world_->object_ids = world_->objects.ids();
  floor_changed_ = true;
  return id;
}

Status Stage::AddSpeech(std::string name,
                        human::VisemeTrack track,
                        std::optional<human::VisemeTrack> timing) {
  LARARIUM_RETURN_IF_ERROR(track.Validate(name));
  LARARIUM_RETURN_IF_ERROR(timing ? timing->Validate(name) : Status());
  if (FindSpeech(name)) {
    return Status::Error("stage", "two lines are called '" + name + "'", "rename one of them");
  }
  world_->speeches.push_back({std::move(name), std::move(track), std::move(timing)});
  return Status();
}

Status Stage::SetFloor(const NavigationOptions& options, std::span<const stage::Place> places) {
  LARARIUM_RETURN_IF_ERROR(options.Validate());
  floor_ = options;
  solids_.clear();
  for (const stage::Place& place : places) {
    for (const Occluder& occluder : place.occluders) {
      if (occluder.blocks_walking) {
        solids_.emplace_back(occluder.mesh, occluder.stage_from_mesh);
      }
    }
  }
  floor_changed_ = true;
  return BuildNavigation();
}

std::optional<ActorId> Stage::Find(std::string_view name) const {
  for (const ActorId id : world_->actor_ids) {
    if (world_->actors.Find(id)->name == name) {
      return id;
    }
  }
  return std::nullopt;
}

std::optional<ObjectId> Stage::FindObject(std::string_view name) const {
  for (const ObjectId id : world_->object_ids) {
    if (world_->objects.Find(id)->name == name) {
      return id;
    }
  }
  return std::nullopt;
}

std::optional<int> Stage::FindSpeech(std::string_view name) const {
  const auto& speeches = world_->speeches;
  const auto found = std::find_if(speeches.begin(), speeches.end(),
                                  [name](const World::Speech& s) { return s.name == name; });
  return found == speeches.end() ? std::nullopt
                                 : std::optional(static_cast<int>(found - speeches.begin()));
}

double Stage::SpeechSeconds(int speech) const { return SpeechTrack(speech).duration; }

const human::VisemeTrack& Stage::SpeechTrack(int speech) const {
  const World::Speech& line = world_->speeches[static_cast<size_t>(speech)];
  return line.timing ? *line.timing : line.track;
}

Actor* Stage::Find(ActorId id) { return world_->actors.Find(id); }
const Actor* Stage::Find(ActorId id) const { return world_->actors.Find(id); }
Object* Stage::Find(ObjectId id) { return world_->objects.Find(id); }
const Object* Stage::Find(ObjectId id) const { return world_->objects.Find(id); }
void Stage::SetVisitors(std::span<const glm::vec3> positions, size_t turn) {
  world_->visitors.assign(positions.begin(), positions.end());
  world_->turn = turn;
}
std::optional<glm::vec3> Stage::VisitorFor(ActorId actor) const {
  return world_->VisitorFor(actor);
}
std::span<const ActorId> Stage::actors() const { return world_->actor_ids; }
std::span<const ObjectId> Stage::objects() const { return world_->object_ids; }

// ---- the floor ----

Status Stage::BuildNavigation() {
  std::vector<NavigationSolid> solids;
  solids.reserve(solids_.size());
  for (const auto& [mesh, stage_from_mesh] : solids_) {
    solids.push_back({&mesh, stage_from_mesh});
  }
  std::vector<BlockedArea> areas;
  gates_.clear();
  for (const ObjectId id : world_->object_ids) {
    const Object& object = world_->object(id);
    const Footprint& footprint = object.use().footprint;
    if (footprint.outline.empty() || object.use().carry) {
      continue;
    }
    BlockedArea area;
    for (const glm::vec2& corner : footprint.outline) {
      const glm::vec3 point = object.state.stage_from_object * glm::vec3(corner.x, 0.0f, corner.y);
      area.outline.emplace_back(point.x, point.z);
    }
    const uint32_t all =
        object.use().states.size() == 32 ? ~0u : (1u << object.use().states.size()) - 1u;
    area.gate = (footprint.states & all) != all;
    if (area.gate) {
      gates_.push_back({id, false});
    }
    areas.push_back(std::move(area));
  }
  floor_changed_ = false;
  for (const ActorId id : world_->actor_ids) {
    world_->actor(id).walker = -1;
  }
  world_->navigation.reset();
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<Navigation> navigation,
                            Navigation::Create(floor_, solids, areas));
  world_->navigation = std::move(navigation);
  UpdateGates();
  RestartWalks();
  return Status();
}

// Starts the current walks again on a new floor.
void Stage::RestartWalks() {
  for (const ActorId id : world_->actor_ids) {
    Actor& actor = world_->actor(id);
    if (actor.walk.phase != Walk::Phase::kNone) {
      const Walk walk = actor.walk;
      actor.walk = {};
      if (!BeginWalk(*world_, actor, walk.goal, walk.heading, walk.speed).ok()) {
        actor.walk = {};
      }
    }
  }
}

void Stage::UpdateGates() {
  for (size_t i = 0; i < gates_.size(); ++i) {
    const Object& object = world_->object(gates_[i].object);
    const bool open = (object.use().footprint.states >> object.state.state & 1u) == 0;
    if (open != gates_[i].open) {
      world_->navigation->OpenGate(i, open);
      gates_[i].open = open;
    }
  }
}

// ---- commands of the drama ----

void Stage::Place(ActorId id, const glm::vec3& position, float heading) {
  Actor* actor = Find(id);
  if (actor == nullptr) {
    return;
  }
  tasks_.StopAll(id, "'" + actor->name + "' was placed elsewhere");
  if (actor->walk.phase != Walk::Phase::kNone) {
    EndWalk(*world_, *actor);
  }
  actor->state.position = position;
  actor->state.heading = heading;
  actor->state.animation_state.sitting = {};
}

void Stage::Show(ActorId id, bool visible) {
  Actor* actor = Find(id);
  if (actor == nullptr || actor->state.visible == visible) {
    return;
  }
  if (!visible) {
    tasks_.StopAll(id, "'" + actor->name + "' has left the stage");
    if (actor->walk.phase != Walk::Phase::kNone) {
      EndWalk(*world_, *actor);
    }
  }
  actor->state.visible = visible;
  actor->state.animation_state.locomotion.placed = false;
  actor->state.animation_state.sitting = {};
}

void Stage::Place(ObjectId id, const Pose& stage_from_object) {
  Object* object = Find(id);
  if (object == nullptr) {
    return;
  }
  if (Actor* holder = Find(object->state.holder)) {
    tasks_.StopAll(object->state.holder, "'" + object->name + "' was placed elsewhere");
    LetGo(*holder, object->state.hands);
    PutAway(*object);
  }
  object->state.support = {};
  object->state.stage_from_object = stage_from_object;
  floor_changed_ =
      floor_changed_ || (!object->use().footprint.outline.empty() && !object->use().carry);
}

Status Stage::PlaceOn(ObjectId id, const Support& support) {
  Object* object = Find(id);
  const Object* base = Find(support.object);
  if (object == nullptr || base == nullptr) {
    return Status::Error("stage", "the object has left the stage");
  }
  const std::string what = "'" + object->name + "' cannot stand on '" + base->name + "'";
  if (RestsOn(*world_, support.object, id)) {
    return Status::Error(what, "that stands on it");
  }
  if (IsOccupied(*world_, support.object, support.surface, support.spot)) {
    return Status::Error(what, "the spot is taken", "choose another one");
  }
  Support turned = support;
  const Pose spot = ObjectFromSpot(*base->model, base->state.joints, support.surface, support.spot);
  const int place = base->use()
                        .surfaces[static_cast<size_t>(support.surface)]
                        .spots[static_cast<size_t>(support.spot)]
                        .place;
  if (place >= 0 && object->use().carry) {
    // Turn the object as if an actor had put it there.
    const float heading = base->use().places[static_cast<size_t>(place)].heading;
    turned.turn = TurnBetween(HeadingOf(spot.rotation), heading + CarriedTurn(object->use()));
  }
  Place(id,
        base->state.stage_from_object * ObjectFromSpot(*base->model, base->state.joints,
                                                       support.surface, support.spot, turned.turn));
  object->state.support = turned;
  return Status();
}

void Stage::SetState(ObjectId id, int state) {
  if (Object* object = Find(id)) {
    CHECK(state >= 0 && static_cast<size_t>(state) < object->use().states.size());
    object->state.state = state;
  }
}

void Stage::Say(ActorId id, int speech) {
  Actor* actor = Find(id);
  if (actor == nullptr) {
    return;
  }
  Utterance& utterance = actor->state.utterance;
  if (speech >= 0) {
    utterance = {speech, 0, true};
    return;
  }
  actor->state.animation_state.face.visemes = {};
  // A script that waited for the end may be a tick early: that still counts as the end. The
  // captions of a line that was broken off disappear at once.
  constexpr double kEarly = 1.5 * kTickSeconds;
  if (utterance.speaking && UtteredSeconds(utterance) < SpeechSeconds(utterance.line) - kEarly) {
    utterance = {};
  }
  utterance.speaking = false;
}

void Stage::AdvanceUtterance(ActorId id) {
  Utterance& utterance = world_->actor(id).state.utterance;
  if (utterance.line < 0) {
    return;
  }
  ++utterance.ticks;
  const double over = UtteredSeconds(utterance) - SpeechSeconds(utterance.line);
  if (utterance.speaking && over >= 0.0) {
    Say(id, -1);
  } else if (over > kReadOnSeconds) {
    utterance = {};
  }
}

void Stage::Gesture(ActorId id, int clip, human::BodyPart part) {
  Actor* actor = Find(id);
  if (actor == nullptr) {
    return;
  }
  human::Animation& animation = actor->state.animation_state.animation;
  if (actor->clip_ends < 0.0 && !actor->in_gait) {
    actor->clip_after = animation.clip;
  }
  human::StartClip(animation, clip, 1.0, kClipFade, part);
  const double length = actor->human().clips[static_cast<size_t>(clip)].duration;
  actor->clip_ends = std::max(0.0, length - static_cast<double>(kClipFade));
}

std::optional<glm::vec2> Stage::FindAway(ActorId id, glm::vec2 from, float metres) {
  if ((floor_changed_ || world_->navigation == nullptr) && !BuildNavigation().ok()) {
    return std::nullopt;
  }
  constexpr float kFurther = 1.0f;  // metres
  return Find(id) == nullptr
             ? std::nullopt
             : FindStand(*world_, id,
                         {.point = from, .nearest = metres, .furthest = metres + kFurther});
}

// ---- time ----

// An actor with a walking clip plays it at the rate of its pace. For one without, locomotion moves
// the legs, so no other clip may move them.
void Stage::AnimateWalk(Actor& actor) const {
  human::Animation& animation = actor.state.animation_state.animation;
  if (actor.clip_ends >= 0.0) {
    return;  // A gesture plays.
  }
  const float pace = PaceOf(*world_, actor);
  const bool moves = pace > kMovingPace;
  if (moves && !actor.in_gait) {
    if (animation.clip != actor.walk_clip) {
      actor.clip_after = animation.clip;
      human::StartClip(animation, actor.walk_clip, 1.0, kClipFade);
    }
    actor.in_gait = true;
  } else if (actor.in_gait && actor.walk.phase == Walk::Phase::kNone) {
    actor.in_gait = false;
    const int after =
        actor.clip_after == human::Animation::kNoClip ? actor.idle_clip : actor.clip_after;
    if (animation.clip == actor.walk_clip && after != actor.walk_clip) {
      human::StartClip(animation, after, 1.0, kClipFade);
    }
  }
  if (actor.in_gait && actor.walk_clip >= 0 && animation.clip == actor.walk_clip) {
    const human::Clip& clip = actor.human().clips[static_cast<size_t>(actor.walk_clip)];
    animation.rate = pace / (clip.stride / clip.duration);
  }
}

void Stage::SetHour(double hour, double seconds) {
  if (!daylight_.hour || !(seconds > 0.0)) {
    daylight_ = {OnTheClock(hour), 0.0, 0.0};
  } else {
    daylight_.hours_left = HoursBetween(*daylight_.hour, hour);
    daylight_.seconds_left = seconds;
  }
}

void Stage::SetLightLevel(ObjectId id, float level, float seconds, Ease ease) {
  if (Object* object = Find(id)) {
    seconds = std::max(seconds, 0.0f);
    object->dimming = {level, seconds, object->state.light.level, seconds, ease};
    if (!(seconds > 0.0f)) {
      object->state.light.level = level;
    }
  }
}

void Stage::SetLightColour(ObjectId id, const glm::vec3& colour) {
  if (Object* object = Find(id)) {
    object->state.light.colour = colour;
  }
}

void Stage::AdvanceLights() {
  for (const ObjectId id : world_->object_ids) {
    Object& object = world_->object(id);
    Object::Dimming& dimming = object.dimming;
    if (dimming.seconds_left > 0.0f) {
      dimming.seconds_left = std::max(dimming.seconds_left - kTick, 0.0f);
      const double time = 1.0 - static_cast<double>(dimming.seconds_left / dimming.seconds);
      const auto way = static_cast<float>(Eased(dimming.ease, time));
      object.state.light.level = glm::mix(dimming.from, dimming.to, way);
    }
  }
}

void Stage::AdvanceDaylight() {
  if (daylight_.seconds_left <= 0.0) {
    return;
  }
  const double share = std::min(kTickSeconds / daylight_.seconds_left, 1.0);
  const double step = share * daylight_.hours_left;
  daylight_.hour = OnTheClock(*daylight_.hour + step);
  daylight_.hours_left -= step;
  daylight_.seconds_left -= kTickSeconds;
}

void Stage::Caption(int speech, double seconds) {
  if (captions_.size() >= kMaxCaptions) {
    captions_.erase(captions_.begin());
  }
  captions_.push_back({speech, 0, std::llround(seconds / kTickSeconds)});
}

void Stage::AdvanceCaptions() {
  for (StageCaption& caption : captions_) {
    ++caption.ticks;
    --caption.ticks_left;
  }
  std::erase_if(captions_, [](const StageCaption& caption) { return caption.ticks_left <= 0; });
}

void Stage::Describe(int speech, double patience) {
  description_.waiting = speech;
  description_.ticks_left = std::llround(patience / kTickSeconds);
}

// Must run after all utterances have advanced.
void Stage::AdvanceDescription() {
  Utterance& heard = description_.heard;
  if (heard.line >= 0) {
    ++heard.ticks;
    const double over = UtteredSeconds(heard) - SpeechSeconds(heard.line);
    heard.speaking = over < 0.0;
    heard = over > kReadOnSeconds ? Utterance() : heard;
  }
  if (description_.waiting < 0) {
    return;
  }
  const bool pause =
      !heard.speaking &&
      std::none_of(world_->actor_ids.begin(), world_->actor_ids.end(),
                   [&](ActorId id) { return world_->actor(id).state.utterance.speaking; });
  if (pause) {
    description_ = {{description_.waiting, 0, true}, -1, 0};
  } else if (--description_.ticks_left <= 0) {
    description_.waiting = -1;
  }
}

void Stage::Advance() {
  AdvanceCaptions();
  AdvanceDaylight();
  AdvanceLights();
  if (tasks_.any()) {
    if (floor_changed_ || world_->navigation == nullptr) {
      if (const Status status = BuildNavigation(); !status.ok()) {
        tasks_.FailAll(status.message());
      }
    }
  }
  if (world_->navigation != nullptr) {
    UpdateGates();
    SyncWalkers(*world_);
    world_->navigation->Tick();
    tasks_.Advance(kTick);
  }
  AdvanceObjects(*world_, kTick);
  sounds_.Advance();
  for (const ActorId id : world_->actor_ids) {
    Actor& actor = world_->actor(id);
    AnimateWalk(actor);
    human::UpdateAnimation(actor.state.animation_state.animation, kTickSeconds);
    if (actor.clip_ends >= 0.0) {
      actor.clip_ends -= kTickSeconds;
      if (actor.clip_ends < 0.0) {
        human::StartClip(actor.state.animation_state.animation,
                         actor.in_gait ? actor.walk_clip : actor.clip_after, 1.0, kClipFade);
      }
    }
    AdvanceUtterance(id);
  }
  AdvanceDescription();
}

void Stage::Perform() {
  DirectAttention(*world_, tasks_, kTick);
  for (const ActorId id : world_->actor_ids) {
    Actor& actor = world_->actor(id);
    if (!actor.state.visible) {
      continue;
    }
    human::AnimationState& animation_state = actor.state.animation_state;
    if (const Utterance& utterance = actor.state.utterance; utterance.speaking) {
      animation_state.face.visemes = human::SampleVisemes(
          world_->speeches[static_cast<size_t>(utterance.line)].track, UtteredSeconds(utterance));
    }
    // Clips advance in Advance(): a clip that the drama started in this tick stays at its start.
    const human::Animation animation = animation_state.animation;
    human::UpdateAnimationState(*actor.model, actor.state.position, actor.state.heading, kTick, {},
                                animation_state);
    animation_state.animation = animation;
  }
}

void Stage::Reset() {
  tasks_.Reset();
  daylight_ = {};
  sounds_.Reset();
  captions_.clear();
  description_ = {};
  for (const ActorId id : world_->actor_ids) {
    ResetActor(world_->actor(id));
  }
  for (const ObjectId id : world_->object_ids) {
    Object& object = world_->object(id);
    floor_changed_ = floor_changed_ || object.state.stage_from_object != object.initial_pose;
    ResetObject(object);
  }
  for (Gate& gate : gates_) {
    gate.open = false;
  }
  if (world_->navigation != nullptr) {
    world_->navigation->Reset();
  }
}

void Stage::Capture(StageSnapshot& snapshot) const {
  snapshot.hour = daylight_.hour;
  snapshot.actors.clear();
  for (const ActorId id : world_->actor_ids) {
    snapshot.actors.push_back({id, Find(id)->state});
  }
  snapshot.objects.clear();
  for (const ObjectId id : world_->object_ids) {
    snapshot.objects.push_back({id, Find(id)->state});
    // A carried object is shown and hidden with its holder.
    if (const Actor* holder = Find(snapshot.objects.back().state.holder)) {
      snapshot.objects.back().state.visible &= holder->state.visible;
    }
  }
  snapshot.sounds.assign(sounds_.playing().begin(), sounds_.playing().end());
  snapshot.captions.assign(captions_.begin(), captions_.end());
  snapshot.description = description_;
}

void Stage::Settle() {
  if (world_->navigation != nullptr) {
    world_->navigation->Settle();
  }
}

Stage::Checkpoint Stage::Save() const {
  Checkpoint checkpoint;
  for (const ActorId id : world_->actor_ids) {
    checkpoint.actors.push_back(*Find(id));
  }
  for (const ObjectId id : world_->object_ids) {
    checkpoint.objects.push_back(*Find(id));
  }
  checkpoint.daylight = daylight_;
  checkpoint.sounds = sounds_.Save();
  checkpoint.captions = captions_;
  checkpoint.description = description_;
  checkpoint.tasks = tasks_.Save();
  checkpoint.navigation = world_->navigation;
  if (world_->navigation != nullptr) {
    checkpoint.walkers = world_->navigation->Save();
  }
  checkpoint.gates = gates_;
  checkpoint.floor_changed = floor_changed_;
  return checkpoint;
}

void Stage::Restore(const Checkpoint& checkpoint) {
  daylight_ = checkpoint.daylight;
  tasks_.Restore(*checkpoint.tasks);
  world_->navigation = checkpoint.navigation;
  if (world_->navigation != nullptr) {
    world_->navigation->Restore(*checkpoint.walkers);
  }
  gates_ = checkpoint.gates;
  floor_changed_ = checkpoint.floor_changed;
  CHECK(checkpoint.actors.size() == world_->actor_ids.size() &&
        checkpoint.objects.size() == world_->object_ids.size());
  for (size_t i = 0; i < checkpoint.actors.size(); ++i) {
    world_->actor(world_->actor_ids[i]) = checkpoint.actors[i];
  }
  for (size_t i = 0; i < checkpoint.objects.size(); ++i) {
    world_->object(world_->object_ids[i]) = checkpoint.objects[i];
  }
  sounds_.Restore(checkpoint.sounds);
  captions_ = checkpoint.captions;
  description_ = checkpoint.description;
}

namespace {

// Interpolates entries that are sorted by slot; `id` is the member that identifies them.
template <typename Entry, typename Id>
void InterpolateEntries(const std::vector<Entry>& previous,
                        const std::vector<Entry>& current,
                        Id Entry::*id,
                        float alpha,
                        std::vector<Entry>& result) {
  result.clear();
  auto before = previous.begin();
  for (const Entry& now : current) {
    while (before != previous.end() && ((*before).*id).index < (now.*id).index) {
      ++before;
    }
    const bool known = before != previous.end() && (*before).*id == now.*id;
    result.push_back(now);
    if (known) {
      result.back().state = Interpolate(before->state, now.state, alpha);
    }
  }
}

}  // namespace

void Interpolate(const StageSnapshot& previous,
                 const StageSnapshot& current,
                 float alpha,
                 StageSnapshot& result) {
  InterpolateEntries(previous.actors, current.actors, &StageSnapshot::ActorEntry::actor, alpha,
                     result.actors);
  InterpolateEntries(previous.objects, current.objects, &StageSnapshot::ObjectEntry::object, alpha,
                     result.objects);
  result.hour = current.hour;
  if (previous.hour && current.hour) {
    const double moved = HoursBetween(*previous.hour, *current.hour);
    // A larger change in one tick is a jump.
    constexpr double kJump = 0.1;  // hours
    if (std::abs(moved) < kJump) {
      result.hour = OnTheClock(*current.hour - (1.0 - static_cast<double>(alpha)) * moved);
    }
  }
  result.sounds = current.sounds;
  result.captions = current.captions;
  result.description = current.description;
}

}  // namespace lararium::stage
