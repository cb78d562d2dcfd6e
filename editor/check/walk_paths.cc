#include "editor/check/walk_paths.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "editor/text/text.h"

namespace lararium::editor {
namespace {

using drama::LaneKind;
using drama::TaskRecord;
using drama::TimelineItem;
using drama::TimelineText;

constexpr std::string_view kWalkAction = "walk_to";
constexpr float kArrived = 0.05f;  // metres

const Trail* TrailOf(const DramaRun& run, const std::string& actor) {
  const auto found = std::find_if(run.trails.begin(), run.trails.end(),
                                  [&](const Trail& trail) { return trail.actor == actor; });
  return found == run.trails.end() ? nullptr : &*found;
}

// The task that an item at this time started.
std::optional<uint32_t> TaskOf(const DramaRun& run, const std::string& actor, double at) {
  constexpr double kLate = 0.05;  // Seconds, because a task begins with a tick.
  auto task = std::lower_bound(run.tasks.begin(), run.tasks.end(), at - 1e-6,
                               [](const TaskRecord& t, double time) { return t.began < time; });
  for (; task != run.tasks.end() && task->began <= at + kLate; ++task) {
    if (task->from_timeline && task->actor == actor && task->action == kWalkAction) {
      return static_cast<uint32_t>(task - run.tasks.begin());
    }
  }
  return std::nullopt;
}

void TakeWalked(const DramaRun& run, uint32_t task, WalkPath& walk) {
  const TaskRecord& record = run.tasks[task];
  walk.task = task;
  walk.problem = record.message;
  if (const Trail* trail = TrailOf(run, walk.actor)) {
    walk.way = trail->Between(record.began, record.ended);
  }
}

// Says whether the walk of an earlier run still matches its item.
bool StillGoesThere(const WalkPath& walk) {
  const auto near = [](const TrailPoint& at, const WalkPoint& said) {
    return glm::distance(at.place, said.place) < kArrived;
  };
  return walk.to && !walk.way.empty() && near(walk.way.back(), *walk.to) &&
         (!walk.from || near(walk.way.front(), *walk.from));
}

// The corners of a path over the floor, including its begin and end.
std::vector<glm::vec2> BendsOf(const stage::Navigation& floor,
                               glm::vec2 from,
                               const stage::Navigation::Reached& reached) {
  constexpr size_t kMost = 256;
  constexpr float kThere = 1e-3f;  // metres
  std::vector<glm::vec2> bends = {from};
  glm::vec2 corner = reached.corner;
  while (bends.size() < kMost && glm::distance(bends.back(), reached.point) > kThere) {
    const bool nearer = glm::distance(bends.back(), corner) > kThere;
    bends.push_back(nearer ? corner : reached.point);
    const auto rest = floor.FindWay(corner, reached.point);
    corner = rest ? rest->corner : reached.point;
  }
  return bends;
}

std::optional<WalkPath> WalkOf(const TimelineText& text,
                               const TimelineItem& item,
                               const DramaRun* run,
                               bool run_is_current) {
  const drama::TimelineLane& lane = text.lanes()[item.lane];
  WalkPath walk;
  walk.actor = lane.actor;
  walk.item = item;
  walk.begins = lane.at[item.item];
  walk.from = WalkPointOf(text, item, kWalkFrom);
  walk.to = WalkPointOf(text, item, kWalkTo);
  if (!walk.from && !walk.to) {
    return std::nullopt;
  }
  if (!walk.to) {
    return walk;
  }
  const std::optional<uint32_t> task =
      run != nullptr ? TaskOf(*run, walk.actor, walk.begins) : std::nullopt;
  if (task) {
    TakeWalked(*run, *task, walk);
  }
  if (!task || !(run_is_current || StillGoesThere(walk))) {
    PlanWalk(run, walk.to->place, walk);
  }
  return walk;
}

template <typename Visit>
void ForEachWalk(const TimelineText& text, const Visit& visit) {
  for (size_t lane = 0; lane < text.lanes().size(); ++lane) {
    for (size_t i = 0; text.lanes()[lane].kind == LaneKind::kWalks && i < text.lanes()[lane].size();
         ++i) {
      visit(text.lanes()[lane], TimelineItem{lane, i});
    }
  }
}

}  // namespace

std::optional<WalkPoint> WalkPointOf(const TimelineText& text,
                                     const TimelineItem& item,
                                     const char* field) {
  const std::optional<Json> value = text.Field(item, field);
  if (!value || !value->is_object()) {
    return std::nullopt;
  }
  const auto number = [&](const char* key) -> std::optional<double> {
    const auto found = value->find(key);
    return found != value->end() && found->is_number() ? std::optional(found->get<double>())
                                                       : std::nullopt;
  };
  WalkPoint point{{number("x").value_or(0.0), number("z").value_or(0.0)}, std::nullopt};
  if (const auto heading = number("heading")) {
    point.heading = static_cast<float>(*heading * std::numbers::pi / 180.0);
  }
  return point;
}

std::vector<WalkPath> FindWalkPaths(const TimelineText* text,
                                    const DramaRun* run,
                                    bool run_is_current,
                                    const std::string& actor) {
  std::vector<WalkPath> walks;
  if (text != nullptr) {
    ForEachWalk(*text, [&](const drama::TimelineLane& lane, const TimelineItem& item) {
      std::optional<WalkPath> walk;
      if (lane.actor == actor && (walk = WalkOf(*text, item, run, run_is_current))) {
        walks.push_back(*std::move(walk));
      }
    });
  }
  for (uint32_t i = 0; run != nullptr && i < run->tasks.size(); ++i) {
    const TaskRecord& task = run->tasks[i];
    if (!task.from_timeline && task.actor == actor && task.action == kWalkAction) {
      WalkPath& walk = walks.emplace_back();
      walk.actor = actor;
      walk.begins = task.began;
      TakeWalked(*run, i, walk);
    }
  }
  return walks;
}

void PlanWalk(const DramaRun* run, glm::vec2 to, WalkPath& walk) {
  walk.task.reset();
  walk.way.clear();
  walk.problem.clear();
  std::optional<glm::vec2> begin;
  if (walk.from) {
    begin = walk.from->place;
  } else if (const Trail* trail = run != nullptr ? TrailOf(*run, walk.actor) : nullptr) {
    const std::optional<TrailPoint> point = trail->At(walk.begins);
    begin = point ? std::optional(point->place) : std::nullopt;
  }
  if (!begin || run == nullptr || run->floor == nullptr) {
    return;
  }
  const auto reached = run->floor->FindWay(*begin, to);
  if (!reached) {
    walk.problem = Text(Tr("%s stands where nobody can walk"), walk.actor.c_str());
    return;
  }
  std::vector<glm::vec2> bends = BendsOf(*run->floor, *begin, *reached);
  const bool arrives =
      reached->complete && glm::distance(reached->point, to) <= stage::Navigation::kStepOn;
  if (arrives) {
    bends.push_back(to);
  } else {
    walk.problem = Text(Tr("No way leads there: it ends %.1f m before"),
                        static_cast<double>(glm::distance(reached->point, to)));
  }
  for (const glm::vec2& bend : bends) {
    walk.way.push_back({walk.begins, bend, 0.0f, false});
  }
}

std::vector<glm::vec2> WalkMarks(const TimelineText& text, std::optional<TimelineItem> except) {
  std::vector<glm::vec2> marks;
  ForEachWalk(text, [&](const drama::TimelineLane&, const TimelineItem& item) {
    for (const char* field : {kWalkFrom, kWalkTo}) {
      const std::optional<WalkPoint> point = WalkPointOf(text, item, field);
      if (point && item != except) {
        marks.push_back(point->place);
      }
    }
  });
  return marks;
}

Status SetWalkPlace(TimelineText& text,
                    const TimelineItem& item,
                    const char* field,
                    glm::vec2 place) {
  if (item.lane >= text.lanes().size() || item.item >= text.lanes()[item.lane].size()) {
    return Status::Error(text.place(), "the walk no longer exists", "choose another one");
  }
  const std::optional<Json> before = text.Field(item, field);
  if (!before || !before->is_object()) {
    return Status::Error(text.place() + ":" + std::to_string(text.LineOf(item)),
                         "the walk has no '" + std::string(field) + "' that can be moved",
                         "write its x and z out as numbers");
  }
  constexpr double kMillimetres = 1000.0;
  const auto rounded = [](float metres) {
    // Avoids -0.
    return std::round(static_cast<double>(metres) * kMillimetres) / kMillimetres + 0.0;
  };
  Json after = *before;
  after["x"] = rounded(place.x);
  after["z"] = rounded(place.y);
  return text.Set(item, field, after).status();
}

glm::vec2 SnapOnFloor(glm::vec2 place,
                      float step,
                      const std::vector<glm::vec2>& marks,
                      float reach) {
  const auto nearer = [place](const glm::vec2& a, const glm::vec2& b) {
    return glm::distance(a, place) < glm::distance(b, place);
  };
  const auto nearest = std::min_element(marks.begin(), marks.end(), nearer);
  if (nearest != marks.end() && glm::distance(*nearest, place) <= reach) {
    return *nearest;
  }
  return step > 0.0f ? step * glm::round(place / step) : place;
}

}  // namespace lararium::editor
