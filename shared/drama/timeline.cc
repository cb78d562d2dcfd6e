#include "shared/drama/timeline.h"

#include <algorithm>
#include <utility>

namespace lararium::drama {
namespace {

constexpr double kNow = 1e-6;  // Seconds; tolerance for rounding when an item is due.

std::string_view NameOf(Cue::Act act) {
  constexpr std::string_view kNames[] = {"",     "walk_to", "hide", "use",
                                         "take", "put",     "give", "stand"};
  return kNames[static_cast<size_t>(act)];
}

std::string ActionOf(const LaneSpec& lane, const Cue& cue) {
  if (lane.duration == ItemDuration::kTask) {
    return cue.act == Cue::Act::kUse && !cue.name.empty() ? "use " + cue.name
                                                          : std::string(NameOf(cue.act));
  }
  const std::string action = lane.actions.empty() ? "" : std::string(lane.actions.front());
  return cue.name.empty() ? action : action + " " + cue.name;
}

}  // namespace

void TimelinePlayer::Advance(const Timeline& timeline,
                             double time,
                             TimelineState& state,
                             std::vector<std::string>& passed) {
  state.lanes.resize(timeline.lanes.size());
  for (size_t i = 0; i < timeline.lanes.size(); ++i) {
    const CueLane& lane = timeline.lanes[i];
    TimelineState::Lane& at = state.lanes[i];
    Follow(lane, time, at);
    if (at.ends && *at.ends <= time + kNow) {
      End(lane, at);
    }
    for (; at.next < lane.cues.size() && lane.cues[at.next].at <= time + kNow; ++at.next) {
      if (lane.kind == LaneKind::kMarkers) {
        passed.push_back(lane.cues[at.next].name);
      }
      Begin(lane, at.next, time, at);
    }
  }
}

TaskRecord TimelinePlayer::RecordOf(const CueLane& lane,
                                    const Cue& cue,
                                    double began,
                                    double ended) const {
  TaskRecord record;
  record.began = began;
  record.ended = ended;
  record.where = lane.where;
  const stage::Actor* actor = stage_.Find(lane.actor);
  record.actor = actor == nullptr ? "" : actor->name;
  record.action = ActionOf(SpecOf(lane.kind), cue);
  const stage::Object* object = stage_.Find(cue.object);
  record.object = object == nullptr ? "" : object->name;
  record.from_timeline = true;
  return record;
}

void TimelinePlayer::Fail(
    const CueLane& lane, const Cue& cue, double began, double time, std::string problem) {
  TaskRecord record = RecordOf(lane, cue, began, time);
  record.failed = true;
  record.message = problem;
  const std::string what =
      std::string(drama::NameOf(lane.kind)) + (cue.id.empty() ? "" : " '" + cue.id + "'");
  on_task_(std::move(record));
  on_problem_(lane.where + ": track: " + what + ": " + std::move(problem));
}

// Reports and forgets tasks that are over.
void TimelinePlayer::Follow(const CueLane& lane, double time, TimelineState::Lane& state) {
  std::erase_if(state.pending, [&](const TimelineState::Pending& pending) {
    const stage::TaskReport report = stage_.tasks().report(pending.task);
    if (!report.over() && report.state != stage::TaskReport::State::kUnknown) {
      return false;
    }
    const Cue& cue = lane.cues[pending.cue];
    if (report.state == stage::TaskReport::State::kDone) {
      TaskRecord record = RecordOf(lane, cue, pending.began, time);
      record.message = report.message;
      record.waited = static_cast<double>(report.waited);
      on_task_(std::move(record));
    } else {
      Fail(lane, cue, pending.began, time, std::string(report.message));
    }
    stage_.tasks().Forget(pending.task);
    return true;
  });
}

void TimelinePlayer::End(const CueLane& lane, TimelineState::Lane& state) {
  state.ends.reset();
  stage::Actor* actor = stage_.Find(lane.actor);
  if (actor == nullptr) {
    return;
  }
  if (lane.kind == LaneKind::kGaze) {
    actor->attention.told.reset();
    actor->attention.seconds_left = 0.0f;
  } else if (lane.kind == LaneKind::kExpressions) {
    human::SetExpression(actor->state.animation_state.face, human::Expression::kNeutral, 0.0f,
                         lane.cues[state.next - 1].fade, lane.cues[state.next - 1].ease);
  }
}

Result<stage::TaskId> TimelinePlayer::Put(const CueLane& lane, const Cue& cue) {
  stage::PutTarget target;
  if (const stage::Object* on = stage_.Find(cue.other)) {
    target.object = cue.other;
    const std::vector<stage::Surface>& surfaces = on->use().surfaces;
    for (size_t i = 0; i < surfaces.size(); ++i) {
      if (surfaces[i].name == cue.name) {
        target.surface = static_cast<int>(i);
      }
    }
  } else {
    target.place = {cue.to.x, cue.to.z};
    target.heading = cue.heading;
  }
  return stage_.tasks().Put(lane.actor, cue.object, target);
}

Result<stage::TaskId> TimelinePlayer::BeginTask(const CueLane& lane, const Cue& cue) {
  stage::Tasks& tasks = stage_.tasks();
  switch (cue.act) {
    case Cue::Act::kWalk:
      return tasks.Walk(lane.actor, {cue.to.x, cue.to.z}, cue.heading, cue.value);
    case Cue::Act::kUse:
      return tasks.Use(lane.actor, cue.object, cue.name, static_cast<float>(cue.length));
    case Cue::Act::kTake:
      return tasks.Take(lane.actor, cue.object);
    case Cue::Act::kPut:
      return Put(lane, cue);
    case Cue::Act::kGive:
      return tasks.Give(lane.actor, cue.object, cue.partner);
    default:
      return tasks.Stand(lane.actor);
  }
}

void TimelinePlayer::Begin(const CueLane& lane,
                           size_t index,
                           double time,
                           TimelineState::Lane& state) {
  const Cue& cue = lane.cues[index];
  stage::Actor* actor = stage_.Find(lane.actor);
  if (IsOfActor(lane.kind) && actor == nullptr) {
    return;
  }
  double length = cue.length;
  state.ends.reset();
  switch (lane.kind) {
    case LaneKind::kGestures:
      stage_.Gesture(lane.actor, cue.index, cue.part);
      length = actor->human().clips[static_cast<size_t>(cue.index)].duration;
      break;
    case LaneKind::kSpeech:
      stage_.Say(lane.actor, cue.index);
      length = stage_.SpeechSeconds(cue.index);
      break;
    case LaneKind::kGaze:
      actor->attention.told = cue.gaze;
      break;
    case LaneKind::kExpressions:
      human::SetExpression(actor->state.animation_state.face,
                           static_cast<human::Expression>(cue.index), cue.value, cue.fade,
                           cue.ease);
      break;
    case LaneKind::kCaptions:
      length = cue.length > 0.0 ? cue.length : stage_.SpeechSeconds(cue.index);
      stage_.Caption(cue.index, length);
      break;
    case LaneKind::kWalks:
    case LaneKind::kUses: {
      if (cue.places) {
        stage_.Place(lane.actor, cue.from, cue.from_heading);
        stage_.Show(lane.actor, true);
      }
      if (cue.act == Cue::Act::kHide) {
        stage_.Show(lane.actor, false);
      }
      if (cue.act == Cue::Act::kNone || cue.act == Cue::Act::kHide) {
        break;
      }
      const Result<stage::TaskId> task = BeginTask(lane, cue);
      if (task.ok()) {
        state.pending.push_back({*task, index, time});
      } else {
        Fail(lane, cue, time, time, task.message());
      }
      return;  // Follow() reports the task when it is over.
    }
    default:
      break;
  }
  const bool sets = lane.kind == LaneKind::kGaze || lane.kind == LaneKind::kExpressions;
  if (sets && cue.length > 0.0) {
    state.ends = cue.at + cue.length;
  }
  on_task_(RecordOf(lane, cue, time, time + length));
}

}  // namespace lararium::drama
