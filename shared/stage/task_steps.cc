#include "shared/stage/task_steps.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vector_relational.hpp>

#include "shared/human/animation.h"
#include "shared/stage/hands.h"
#include "shared/stage/walking.h"
#include "shared/stage/world.h"

namespace lararium::stage {
namespace {

constexpr float kCarrySeconds = 0.9f;  // Duration of kCarry.
constexpr float kOverSeconds = 0.8f;   // Duration of kOver.
constexpr float kLowerSeconds = 0.5f;
constexpr float kAbove = 0.10f;  // Metres above the spot.
constexpr float kOfferSeconds = 0.9f;
constexpr float kBothSeconds = 0.35f;  // Duration of kBoth.
constexpr float kBackUpPace = 0.35f;   // m/s, backwards to a seat.
constexpr float kFeetStand = 1.5f;     // Maximum seconds until the feet come to rest.
constexpr float kWaitForRoom = 12.0f;  // Seconds after which an action blocked by an actor fails.
constexpr float kClipFade = 0.3f;
constexpr float kOfferHeight = 1.12f;  // Metres, for people 1.7 m tall.
constexpr float kGreet = 2.5f;         // Metres at which the receiver turns to the giver.

float MinimumJerk(float t) {
  t = std::clamp(t, 0.0f, 1.0f);
  return t * t * t * (10.0f + t * (6.0f * t - 15.0f));
}

Pose InHolderFrame(const Actor& holder, const Pose& stage_from_object) {
  return StageFromUpperBody(holder).Inverse() * stage_from_object;
}

void PlayClip(Actor& actor, int clip) {
  human::StartClip(actor.state.animation_state.animation, clip, 1.0, kClipFade);
}

// If both hands use the same grip, the receiver takes the object below the other hand and moves to
// the grip when that hand has left. Returns the offset in the object frame.
Pose BelowTheOther(const HandGrips& giving, const HandGrips& receiving) {
  constexpr float kBelow = 0.10f;  // Width of a hand around an object, metres.
  for (const int grip : receiving) {
    if (grip >= 0 && (grip == giving[0] || grip == giving[1])) {
      return {{0.0f, -kBelow, 0.0f}};
    }
  }
  return {};
}

bool Holds(const PartBounds& box, const glm::vec3& point, float around) {
  return glm::all(glm::greaterThan(point, box.lower - around)) &&
         glm::all(glm::lessThan(point, box.upper + around));
}

// Whether the part of a move would pass through the actor.
bool SweepsThrough(const Object& object, const ObjectAction::Move& move, const Actor& actor) {
  constexpr int kSamples = 12;                      // Joint values that are tested.
  constexpr float kBody = 0.2f;                     // Radius of a body, metres.
  constexpr float kHeights[] = {0.3f, 0.8f, 1.3f};  // Metres, for a person 1.7 m tall.
  const auto joint = static_cast<size_t>(move.joint);
  const int part = object.use().joints[joint].part;
  const PartBounds& box = object.model->bounds(part);
  std::array<float, ObjectUse::kMaxJoints> joints = object.state.joints;
  for (int i = 0; i <= kSamples; ++i) {
    joints[joint] = glm::mix(object.state.joints[joint], move.to,
                             static_cast<float>(i) / static_cast<float>(kSamples));
    const Pose part_from_stage =
        (object.state.stage_from_object * ObjectFromPart(*object.model, joints, part)).Inverse();
    for (const float height : kHeights) {
      const glm::vec3 at(0.0f, height * actor.eye_height() / 1.58f, 0.0f);
      if (Holds(box, part_from_stage * (actor.state.position + at), kBody)) {
        return true;
      }
    }
  }
  return false;
}

// Pose of an object that is handed over: between the actors, upright, with the giver's heading.
Pose Between(const Actor& giver, const Actor& receiver) {
  const Pose offer = {{0.0f, kOfferHeight, 0.0f}};
  const glm::vec3 middle =
      0.5f * ((StageFromUpperBody(giver) * ScaledTo(giver, offer)).position +
              (StageFromUpperBody(receiver) * ScaledTo(receiver, offer)).position);
  return {middle, StageFromActorPose(giver.state).rotation};
}

// The pose of a path at a time. The path starts at `rest` and returns to it in the time that is
// left after the last key.
Pose SamplePath(const std::vector<ObjectAction::Key>& path,
                const Pose& rest,
                float duration,
                float time) {
  ObjectAction::Key before = {0.0f, rest};
  for (const ObjectAction::Key& key : path) {
    if (time < key.time) {
      return Mix(before.pose, key.pose,
                 MinimumJerk((time - before.time) / (key.time - before.time)));
    }
    before = key;
  }
  if (time >= duration || duration <= before.time) {
    return rest;
  }
  return Mix(before.pose, rest, MinimumJerk((time - before.time) / (duration - before.time)));
}

void MoveJoints(const Task& task, Object& object) {
  const ObjectAction& action = object.use().actions[static_cast<size_t>(task.action)];
  for (const ObjectAction::Move& move : action.moves) {
    const auto joint = static_cast<size_t>(move.joint);
    const float span = move.end - move.begin;
    const float done =
        span > 0.0f ? (task.time - move.begin) / span : (task.time >= move.begin ? 1.0f : 0.0f);
    if (task.time >= move.begin) {
      object.state.joints[joint] = glm::mix(task.joints[joint], move.to, MinimumJerk(done));
    }
  }
}

}  // namespace

void TaskSteps::Enter(Task& task, TaskPhase phase) {
  task.phase = phase;
  task.time = 0.0f;
  Actor& actor = world_.actor(task.actor);
  human::AnimationState& animation_state = actor.state.animation_state;
  const float seconds =
      human::SittingSeconds(actor.model->locomotion.body, animation_state.locomotion.style.cadence);
  if (phase == TaskPhase::kBackUp) {
    task.begin = StageFromActorPose(actor.state);
  } else if (phase == TaskPhase::kSit) {
    const Pose actor_from_seat = StageFromActorPose(actor.state).Inverse() * task.seat;
    human::SitDown(animation_state.sitting, actor_from_seat.position, seconds);
  } else if (phase == TaskPhase::kRise) {
    human::StandUp(animation_state.sitting, seconds);
    EndAction(task);  // Resumes the clip from before the action.
  }
}

void TaskSteps::Abandon(Task& task) {
  Actor& actor = world_.actor(task.actor);
  EndWalk(world_, actor);
  if (task.kind == TaskKind::kWalk || task.phase == TaskPhase::kApproach) {
    return;
  }
  Object* object = world_.objects.Find(task.object);
  if (object == nullptr) {
    return;
  }
  if (task.kind == TaskKind::kUse) {
    EndAction(task);
    if (object->use().actions[static_cast<size_t>(task.action)].seat) {
      human::Sitting& sitting = actor.state.animation_state.sitting;
      human::StandUp(sitting, sitting.seconds);
    }
  }
  for (const auto& [id, hands] :
       {std::pair(task.actor, task.hands), std::pair(task.partner, task.partner_hands)}) {
    Actor* who = world_.actors.Find(id);
    if (who != nullptr && object->state.holder != id) {
      LetGo(*who, hands);
    }
  }
  if (const Actor* holder = world_.actors.Find(object->state.holder)) {
    CarryAlong(*holder, *object, kCarrySeconds);
  }
}

void TaskSteps::EndAction(const Task& task) {
  Object& object = world_.object(task.object);
  object.state.action = -1;
  object.state.action_time = 0.0f;
  Actor& actor = world_.actor(task.actor);
  const ObjectAction& action = object.use().actions[static_cast<size_t>(task.action)];
  if (!action.clip.empty() || action.seat) {
    PlayClip(actor, task.clip_before);
  }
}

void TaskSteps::Step(Task& task, float seconds) {
  if (task.phase == TaskPhase::kApproach) {
    Actor& actor = world_.actor(task.actor);
    const WalkResult result = AdvanceWalk(world_, actor, seconds);
    if (result == WalkResult::kBlocked) {
      EndWalk(world_, actor);
      task.Fail("'" + actor.name + "' cannot get there: an actor or an object is in the way");
    } else if (result == WalkResult::kArrived) {
      Arrive(task);
    }
    if (task.kind == TaskKind::kGive && task.phase == TaskPhase::kApproach) {
      Actor& partner = world_.actor(task.partner);
      if (glm::distance(actor.place(), partner.place()) < kGreet && !queue_.Sits(task.partner)) {
        TurnTowards(partner, HeadingOf(actor.place() - partner.place()), seconds);
      }
    }
    return;
  }
  switch (task.kind) {
    case TaskKind::kWalk:
      return;
    case TaskKind::kUse:
      return StepAct(task, seconds);
    case TaskKind::kTake:
      return StepReach(task);
    case TaskKind::kPut:
      return StepPut(task);
    case TaskKind::kGive:
      return StepGive(task, seconds);
  }
}

void TaskSteps::Arrive(Task& task) {
  Actor& actor = world_.actor(task.actor);
  if (task.kind == TaskKind::kWalk) {
    task.Finish();
    return;
  }
  Object& object = world_.object(task.object);
  if (task.kind == TaskKind::kUse || task.kind == TaskKind::kTake) {
    if (task.kind == TaskKind::kUse &&
        object.use().actions[static_cast<size_t>(task.action)].seat) {
      task.clip_before = actor.state.animation_state.animation.clip;
      BeginSeat(task);
      return;
    }
    task.reach_seconds = ReachFor(actor, object, task.hands);
    Enter(task, TaskPhase::kReach);
    return;
  }
  if (!object.use().carry->holder_from_object) {
    ReachFor(actor, object, task.hands);  // The object hung; now the arm moves it.
  }
  object.held.rests = false;
  if (task.kind == TaskKind::kPut) {
    Enter(task, TaskPhase::kOver);
    Pose above = PutGoal(task);
    above.position.y += kAbove;
    MoveHeld(object, InHolderFrame(actor, above), kOverSeconds);
    return;
  }
  Enter(task, TaskPhase::kOffer);
  MoveHeld(object, InHolderFrame(actor, Between(actor, world_.actor(task.partner))), kOfferSeconds);
}

// ---- use ----

void TaskSteps::FollowPath(const Task& task, Object& object) {
  const ObjectAction& action = object.use().actions[static_cast<size_t>(task.action)];
  Actor& actor = world_.actor(task.actor);
  if (!action.held) {
    MoveHands(actor, object, task.hands,
              SamplePath(action.path, Pose(), action.duration, task.time));
    return;
  }
  if (action.path.empty()) {
    return;
  }
  // Like carry poses, paths are written for a person 1.7 m tall.
  const Pose rest = CarryPose(actor, object, object.state.hands);
  Pose unscaled = rest;
  const float scale = ScaledTo(actor, {{1.0f, 0.0f, 0.0f}}).position.x;
  unscaled.position /= scale;
  const Pose pose = ScaledTo(actor, SamplePath(action.path, unscaled, action.duration, task.time));
  object.held = {pose, pose, 0.0f, 0.0f, task.time >= action.duration, false};
}

// Computes where the actor will sit and where it stands to sit down.
void TaskSteps::BeginSeat(Task& task) {
  const Object& object = world_.object(task.object);
  const ObjectAction& action = object.use().actions[static_cast<size_t>(task.action)];
  const human::SittingModel& model = world_.actor(task.actor).model->sitting;
  const glm::vec2 direction = Direction(action.seat->heading);
  const glm::vec3& at = action.seat->position;
  float front = 0.0f;
  for (const glm::vec2& corner : object.use().footprint.outline) {
    front = std::max(front, glm::dot(corner - glm::vec2(at.x, at.z), direction));
  }
  const float forward = human::ForwardOnSeat(model, front);
  task.seat = object.state.stage_from_object *
              Pose{at, glm::angleAxis(action.seat->heading, glm::vec3(0.0f, 1.0f, 0.0f))} *
              Pose{{0.0f, 0.0f, -forward}};
  Enter(task, TaskPhase::kBackUp);
  const float height = task.seat.position.y - task.begin.position.y;
  task.stand =
      task.seat * Pose{{0.0f, 0.0f, -human::StandBeforeSeat(model, height, front - forward)}};
  task.stand.position.y = task.begin.position.y;
  const float way = glm::distance(task.stand.position, task.begin.position);
  task.reach_seconds = std::max(0.3f, 1.9f * way / kBackUpPace);
}

void TaskSteps::StepSeat(Task& task) {
  Object& object = world_.object(task.object);
  Actor& actor = world_.actor(task.actor);
  const ObjectAction& action = object.use().actions[static_cast<size_t>(task.action)];
  const human::AnimationState& animation_state = actor.state.animation_state;
  if (task.phase == TaskPhase::kBackUp) {
    const Pose pose = Mix(task.begin, task.stand, MinimumJerk(task.time / task.reach_seconds));
    actor.state.position = pose.position;
    actor.state.heading = HeadingOf(pose.rotation);
    const float stands = task.time - task.reach_seconds;
    if (stands > kFeetStand || (stands > 0.1f && !animation_state.locomotion.stepping)) {
      Enter(task, TaskPhase::kSit);
      PlayClip(actor,
               human::Animation::kNoClip);  // A clip of the whole body would hide the sitting pose.
      object.state.action = static_cast<int8_t>(task.action);
    }
    return;
  }
  if (task.phase == TaskPhase::kRise) {
    if (animation_state.sitting.amount <= 0.0f) {
      task.stage = TaskStage::kDone;
    }
    return;
  }
  if (animation_state.sitting.amount < 1.0f) {
    return;
  }
  if (action.to >= 0) {
    object.state.state = action.to;
  }
  object.state.action = -1;
  task.Finish();
  task.stage = TaskStage::kLingering;
}

// Returns an actor who stands where a part is about to move, or nullptr. An idle one is sent aside.
const Actor* TaskSteps::InTheWay(const Task& task) {
  const Object& object = world_.object(task.object);
  const ObjectAction& action = object.use().actions[static_cast<size_t>(task.action)];
  for (const ObjectAction::Move& move : action.moves) {
    if (task.phase == TaskPhase::kAct && task.time >= move.end) {
      continue;  // The move has finished.
    }
    for (const ActorId id : world_.actor_ids) {
      Actor& other = world_.actor(id);
      if (id == task.actor || !other.state.visible || !SweepsThrough(object, move, other)) {
        continue;
      }
      if (!queue_.IsBusy(id) && !queue_.Sits(id) && !other.led &&
          other.walk.phase == Walk::Phase::kNone) {
        if (const auto aside = FindAside(world_, id, other.place())) {
          (void)BeginWalk(world_, other, *aside, std::nullopt, kWalkSpeed).ok();
        }
      }
      return &other;
    }
  }
  return nullptr;
}

// Whether the parts may keep moving. They stop while an actor is in their way, with the hands on
// their grips. After kWaitForRoom the task fails.
bool TaskSteps::MayMove(Task& task, float seconds) {
  const Actor* other = InTheWay(task);
  if (other == nullptr) {
    return true;
  }
  task.held_up += seconds;
  if (task.held_up > kWaitForRoom) {
    const Object& object = world_.object(task.object);
    const ObjectAction& action = object.use().actions[static_cast<size_t>(task.action)];
    Actor& actor = world_.actor(task.actor);
    if (task.phase == TaskPhase::kAct) {
      EndAction(task);
    }
    LetGo(actor, action.held ? kNoHands : task.hands);
    task.Fail("'" + actor.name + "' cannot '" + action.name + "' '" + object.name + "': '" +
              other->name + "' stands in its way");
  }
  return false;
}

void TaskSteps::BeginAct(Task& task) {
  Object& object = world_.object(task.object);
  Actor& actor = world_.actor(task.actor);
  const ObjectAction& action = object.use().actions[static_cast<size_t>(task.action)];
  task.joints = object.state.joints;
  task.held_up = 0.0f;
  object.state.action = static_cast<int8_t>(task.action);
  if (action.held && !object.use().carry->holder_from_object && !action.path.empty()) {
    ReachFor(actor, object, task.hands);
    object.held.rests = false;
  }
  if (!action.clip.empty()) {
    task.clip_before = actor.state.animation_state.animation.clip;
    if (const int clip = FindClip(actor.human(), action.clip); clip >= 0) {
      PlayClip(actor, clip);
    }
  }
  Enter(task, TaskPhase::kAct);
}

void TaskSteps::StepAct(Task& task, float seconds) {
  if (task.phase == TaskPhase::kBackUp || task.phase == TaskPhase::kSit ||
      task.phase == TaskPhase::kRise) {
    StepSeat(task);
    return;
  }
  Object& object = world_.object(task.object);
  Actor& actor = world_.actor(task.actor);
  const ObjectAction& action = object.use().actions[static_cast<size_t>(task.action)];
  switch (task.phase) {
    case TaskPhase::kReach:
      MoveHands(actor, object, task.hands);
      if (task.time < task.reach_seconds) {
        return;
      }
      if ((action.from >> object.state.state & 1u) == 0) {  // Another actor was quicker.
        LetGo(actor, action.held ? kNoHands : task.hands);
        task.Fail("'" + actor.name + "' cannot '" + action.name + "' '" + object.name +
                  "' any more: it is '" +
                  object.use().states[static_cast<size_t>(object.state.state)] + "'");
        return;
      }
      if (MayMove(task, seconds)) {
        BeginAct(task);
      }
      return;
    case TaskPhase::kAct: {
      if (!MayMove(task, seconds)) {
        task.time -= seconds;  // Continues from here later.
        if (task.is_over) {
          return;
        }
      }
      object.state.action_time = task.time;
      MoveJoints(task, object);
      FollowPath(task, object);
      if (!action.held && task.time >= action.release && task.hands != kNoHands) {
        LetGo(actor, task.hands);
        task.hands = kNoHands;
      }
      if (task.time >= action.duration && action.to >= 0) {
        object.state.state = action.to;
      }
      if (task.time < std::max(action.duration, task.seconds)) {
        return;
      }
      EndAction(task);
      if (action.held) {
        CarryAlong(actor, object, kCarrySeconds);
      } else {
        LetGo(actor, task.hands);
      }
      Enter(task, TaskPhase::kLetGo);
      return;
    }
    default:
      if (task.time >= kLetGoSeconds || task.hands == kNoHands) {
        task.Finish();
      }
  }
}

// ---- take ----

void TaskSteps::StepReach(Task& task) {
  Object& object = world_.object(task.object);
  Actor& actor = world_.actor(task.actor);
  if (task.phase == TaskPhase::kReach) {
    MoveHands(actor, object, task.hands);
    if (task.time >= task.reach_seconds) {
      TakeHold(world_, task.actor, task.object, task.hands);
      CarryAlong(actor, object, kCarrySeconds);
      Enter(task, TaskPhase::kCarry);
    }
    return;
  }
  if (task.time >= kCarrySeconds) {
    task.Finish();
  }
}

// ---- put ----

// stage_from_object of the object that is put down. On a spot it keeps the heading at which it is
// carried.
Pose TaskSteps::PutGoal(const Task& task) const {
  const Actor& actor = world_.actor(task.actor);
  const float carried = actor.state.heading + CarriedTurn(world_.object(task.object).use());
  if (const Object* on = world_.objects.Find(task.target.object)) {
    const Pose spot = on->state.stage_from_object *
                      ObjectFromSpot(*on->model, on->state.joints, task.target.surface, task.spot);
    const float turn = TurnBetween(HeadingOf(spot.rotation), carried);
    return spot * Pose{glm::vec3(0.0f), glm::angleAxis(turn, glm::vec3(0.0f, 1.0f, 0.0f))};
  }
  return {{task.target.place.x, actor.state.position.y, task.target.place.y},
          glm::angleAxis(task.target.heading.value_or(carried), glm::vec3(0.0f, 1.0f, 0.0f))};
}

void TaskSteps::StepPut(Task& task) {
  Object& object = world_.object(task.object);
  Actor& actor = world_.actor(task.actor);
  const Pose goal = PutGoal(task);
  switch (task.phase) {
    case TaskPhase::kOver:
      if (task.time >= kOverSeconds) {
        MoveHeld(object, InHolderFrame(actor, goal), kLowerSeconds);
        Enter(task, TaskPhase::kLower);
      }
      return;
    case TaskPhase::kLower:
      object.held.comes_loose = task.time > 0.5f * kLowerSeconds;
      if (task.time < kLowerSeconds) {
        return;
      }
      PutAway(object);
      object.state.stage_from_object = goal;
      if (task.target.object) {
        object.state.support = {task.target.object, static_cast<int8_t>(task.target.surface),
                                static_cast<int8_t>(task.spot), 0.0f};
        const Object& on = world_.object(task.target.object);
        const Pose spot =
            on.state.stage_from_object *
            ObjectFromSpot(*on.model, on.state.joints, task.target.surface, task.spot);
        object.state.support.turn = TurnBetween(HeadingOf(spot.rotation), HeadingOf(goal.rotation));
      }
      LetGo(actor, task.hands);
      Enter(task, TaskPhase::kLetGo);
      return;
    default:
      if (task.time >= kLetGoSeconds) {
        task.Finish();
      }
  }
}

// ---- give ----

void TaskSteps::StepGive(Task& task, float seconds) {
  Object& object = world_.object(task.object);
  Actor& giver = world_.actor(task.actor);
  Actor& receiver = world_.actor(task.partner);
  if ((task.phase == TaskPhase::kOffer || task.phase == TaskPhase::kReach) &&
      !queue_.Sits(task.partner)) {
    TurnTowards(receiver, HeadingOf(giver.place() - receiver.place()), seconds);
  }
  switch (task.phase) {
    case TaskPhase::kOffer: {
      if (task.time < 0.6f * kOfferSeconds) {
        return;
      }
      const Pose offered = StageFromActorPose(giver.state) * object.held.to;
      const auto hands =
          ChooseReceivingHands(world_, task.partner, task.object, InHolderFrame(receiver, offered));
      if (!hands) {
        CarryAlong(giver, object, kCarrySeconds);
        task.Fail("'" + giver.name + "' cannot give '" + object.name + "' to '" + receiver.name +
                  "', whose hands are full");
        return;
      }
      task.partner_hands = *hands;
      task.reach_seconds = std::max(ReachFor(receiver, object, *hands), kOfferSeconds - task.time);
      Enter(task, TaskPhase::kReach);
      return;
    }
    case TaskPhase::kReach:
      MoveHands(receiver, object, task.partner_hands,
                BelowTheOther(task.hands, task.partner_hands));
      if (task.time >= task.reach_seconds) {
        Enter(task, TaskPhase::kBoth);
      }
      return;
    case TaskPhase::kBoth:
      MoveHands(receiver, object, task.partner_hands,
                BelowTheOther(task.hands, task.partner_hands));
      object.held.comes_loose = task.time > 0.5f * kBothSeconds;
      if (task.time >= kBothSeconds) {
        TakeHold(world_, task.partner, task.object, task.partner_hands);
        LetGo(giver, task.hands);
        if (BelowTheOther(task.hands, task.partner_hands) != Pose()) {
          ReachFor(receiver, object, task.partner_hands);
        }
        CarryAlong(receiver, object, kCarrySeconds);
        Enter(task, TaskPhase::kCarry);
      }
      return;
    default:
      if (task.time >= kCarrySeconds) {
        task.Finish();
      }
  }
}

}  // namespace lararium::stage
