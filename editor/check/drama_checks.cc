#include "editor/check/drama_checks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <string_view>

#include "editor/document/check_sentences.h"
#include "editor/text/text.h"
#include "shared/core/utf8.h"
#include "shared/drama/lua_tokens.h"
#include "shared/drama/timeline_text.h"
#include "shared/geometry/glm_convert.h"

namespace lararium::editor {
namespace {

using drama::CueRecord;
using drama::LaneKind;
using drama::TaskRecord;

constexpr double kMoment = 0.1;  // Overlaps of fewer seconds are ignored.
constexpr double kTurn = 1.0;    // Seconds that a person may wait for an object.
constexpr float kCell = 0.5f;    // metres
constexpr float kLeap = 0.3f;    // Metres in a tick that no one can walk.
constexpr float kLow = 0.3f;     // Lower occluders are stepped over.
// Occluders that are farther from the origin, larger or smaller hide no person, metres.
constexpr double kFarOff = 100.0, kLargest = 10'000.0, kSmallest = 0.01;
constexpr float kHigh = 1.5f;                     // Higher occluders are passed under.
constexpr float kHeights[] = {0.4f, 0.9f, 1.3f};  // Heights at which paths are tested.
constexpr size_t kMostSteps = 50;
constexpr double kLook = 1.0;          // Seconds between two samples of the ground.
constexpr float kSole = 0.1f;          // Metres that a foot may be below the ground.
constexpr float kLift = 0.3f;          // Metres that a foot may be above the ground.
constexpr double kMostFloating = 0.5;  // Share of samples; some people wait out of view.

std::string Named(const TaskRecord& task) {
  return "'" + task.action + (task.object.empty() ? "" : " " + task.object) + "'";
}

// Says whether the task uses the whole body, so that two exclude each other.
bool IsBodily(const TaskRecord& task) {
  constexpr std::string_view kActions[] = {"walk_to", "turn_to", "take", "put",
                                           "give",    "sit",     "stand"};
  return task.action.starts_with("use") ||
         std::find(std::begin(kActions), std::end(kActions), task.action) != std::end(kActions);
}

// Sorted by begin, without tasks that may fail.
std::vector<const TaskRecord*> BodilyTasks(std::span<const TaskRecord> tasks) {
  std::vector<const TaskRecord*> sorted;
  for (const TaskRecord& task : tasks) {
    if (IsBodily(task) && !task.expected) {
      sorted.push_back(&task);
    }
  }
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const TaskRecord* a, const TaskRecord* b) { return a->began < b->began; });
  return sorted;
}

// ---- Names in the script ----

struct Word {
  std::string text;
  size_t line = 0;
};

// Cues that the script names literally.
struct WrittenCues {
  std::vector<Word> listened;  // marker("name")
  std::vector<Word> armed;     // The argument of on(...) and first(...).
  std::vector<Word> said;      // a:say("id"), describe("id")
};

WrittenCues FindCues(const std::string& script) {
  using Kind = drama::LuaToken::Kind;
  std::vector<drama::LuaToken> list;
  drama::LuaTokens tokens(script);
  for (drama::LuaToken token = tokens.Next(); token.kind != Kind::kEnd && token.kind != Kind::kBad;
       token = tokens.Next()) {
    list.push_back(token);
  }
  const auto text = [&](size_t i) {
    return i < list.size() ? script.substr(list[i].begin, list[i].end - list[i].begin) : "";
  };
  // The text argument at the begin of the call, with or without brackets.
  const auto argument = [&](size_t word) {
    const size_t i = word + (text(word + 1) == "(" ? 2 : 1);
    return i < list.size() && list[i].kind == Kind::kText ? drama::TextOf(text(i)) : std::nullopt;
  };
  WrittenCues found;
  for (size_t i = 0; i < list.size(); ++i) {
    if (list[i].kind != Kind::kName) {
      continue;
    }
    const std::string word = text(i), before = i > 0 ? text(i - 1) : "";
    const auto add = [&](std::vector<Word>& words, std::string what) {
      words.push_back({std::move(what), drama::PositionOf(script, list[i].begin).line});
    };
    if (before == ":" && word == "say") {
      if (auto id = argument(i)) {
        add(found.said, *std::move(id));
      }
    } else if (before == ":" || before == "." || before == "function") {
      continue;
    } else if (word == "describe") {
      if (auto id = argument(i)) {
        add(found.said, *std::move(id));
      }
    } else if (word == "marker") {
      if (auto name = argument(i)) {
        add(found.listened, *std::move(name));
      }
    } else if ((word == "on" || word == "first") && text(i + 1) == "(") {
      add(found.armed, word);
    }
  }
  return found;
}

struct WrittenMarker {
  std::string name;
  double at = 0.0;
  size_t line = 0;
};

std::vector<WrittenMarker> MarkersOf(const drama::TimelineText& timeline) {
  std::vector<WrittenMarker> markers;
  for (size_t l = 0; l < timeline.lanes().size(); ++l) {
    const drama::TimelineLane& lane = timeline.lanes()[l];
    for (size_t i = 0; lane.kind == LaneKind::kMarkers && i < lane.size(); ++i) {
      const std::optional<Json> name = timeline.Field({l, i}, "name");
      if (name && name->is_string()) {
        markers.push_back({name->get<std::string>(), lane.at[i], timeline.LineOf({l, i})});
      }
    }
  }
  return markers;
}

bool IsVisitors(std::string_view kind) { return kind != "marker" && kind != "timeout"; }

// The intersection of a segment with a triangle as a share of the segment (Moeller & Trumbore,
// Fast, Minimum Storage Ray/Triangle Intersection, 1997); nullopt if there is none.
std::optional<float> Meets(const glm::vec3& from,
                           const glm::vec3& way,
                           const std::array<glm::vec3, 3>& corners) {
  const glm::vec3 a = corners[1] - corners[0], b = corners[2] - corners[0];
  const glm::vec3 p = glm::cross(way, b);
  const float determinant = glm::dot(a, p);
  if (std::abs(determinant) < 1e-12f) {
    return std::nullopt;
  }
  const glm::vec3 s = from - corners[0];
  const float u = glm::dot(s, p) / determinant;
  const glm::vec3 q = glm::cross(s, a);
  const float v = glm::dot(way, q) / determinant;
  const float t = glm::dot(b, q) / determinant;
  if (u < 0.0f || v < 0.0f || u + v > 1.0f || t < 0.0f || t > 1.0f) {
    return std::nullopt;
  }
  return t;
}

// The triangle in the stage frame.
std::array<glm::vec3, 3> TriangleOf(const stage::Occluder& occluder, size_t first_index) {
  std::array<glm::vec3, 3> corners;
  for (size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d corner =
        geometry::ToEigen(occluder.mesh.positions[occluder.mesh.indices[first_index + i]]);
    corners[i] = geometry::ToGlm(Eigen::Vector3d(occluder.stage_from_mesh * corner));
  }
  return corners;
}

int CellOf(float metres) { return static_cast<int>(std::floor(metres / kCell)); }

}  // namespace

void PlaceItems(const std::string& script,
                const std::string& file,
                std::vector<TaskRecord>& tasks) {
  const Result<drama::TimelineText> timeline = drama::TimelineText::Read(script, file);
  if (!timeline.ok()) {
    return;
  }
  constexpr double kTick = 1.0 / drama::Drama::kTicksPerSecond;
  for (size_t l = 0; l < timeline->lanes().size(); ++l) {
    const drama::TimelineLane& lane = timeline->lanes()[l];
    for (size_t i = 0; i < lane.size(); ++i) {
      const std::string where = file + ":" + std::to_string(timeline->LineOf({l, i}));
      for (TaskRecord& task : tasks) {
        const bool is_then = task.began >= lane.at[i] - 1e-6 && task.began < lane.at[i] + kTick;
        if (task.from_timeline && is_then && task.actor == lane.actor &&
            drama::LaneOfTask(task.action) == lane.kind) {
          task.where = where;
        }
      }
    }
  }
}

std::optional<Sentence> CheckEncoding(const std::string& script, const std::string& file) {
  size_t line = 1;
  for (size_t begin = 0; begin < script.size(); ++line) {
    const size_t end = std::min(script.find('\n', begin), script.size());
    if (!IsUtf8(std::string_view(script).substr(begin, end - begin))) {
      return AtPlace(file + ":" + std::to_string(line),
                     Sentence("is not UTF-8; save the script as UTF-8"));
    }
    begin = end + 1;
  }
  return std::nullopt;
}

bool Names(const std::string& script, std::string_view name) {
  drama::LuaTokens tokens(script);
  using Kind = drama::LuaToken::Kind;
  for (drama::LuaToken token = tokens.Next(); token.kind != Kind::kEnd && token.kind != Kind::kBad;
       token = tokens.Next()) {
    if (token.kind == Kind::kName &&
        std::string_view(script).substr(token.begin, token.end - token.begin) == name) {
      return true;
    }
  }
  return false;
}

std::vector<Sentence> CheckTogether(std::span<const TaskRecord> tasks) {
  std::vector<Sentence> problems;
  // For each actor, the task that lasts longest so far.
  std::map<std::string, const TaskRecord*> doing;
  for (const TaskRecord* task : BodilyTasks(tasks)) {
    const TaskRecord*& before = doing[task->actor];
    if (before != nullptr && task->began < before->ended - kMoment) {
      problems.push_back(
          AtPlace(task->where,
                  Sentence("%s must be in two places at once: %s begins at %s, %s (%s) ends at %s",
                           {task->actor, Named(*task), SecondsText(task->began), Named(*before),
                            before->where, SecondsText(before->ended)})));
    }
    if (before == nullptr || task->ended > before->ended) {
      before = task;
    }
  }
  return problems;
}

std::vector<Sentence> CheckTurns(std::span<const TaskRecord> tasks) {
  std::vector<Sentence> problems;
  const std::vector<const TaskRecord*> sorted = BodilyTasks(tasks);
  for (const TaskRecord* task : sorted) {
    if (task->waited < kTurn || task->object.empty()) {
      continue;
    }
    const auto other = std::find_if(sorted.begin(), sorted.end(), [&](const TaskRecord* o) {
      return o->object == task->object && o->actor != task->actor &&
             o->began < task->began + task->waited && o->ended > task->began;
    });
    if (other != sorted.end()) {
      Sentence waits = Sentence("%s waits %s for '%s', which %s has: %s (%s)",
                                {task->actor, SecondsText(task->waited), task->object,
                                 (*other)->actor, Named(**other), (*other)->where});
      problems.push_back(AtPlace(task->where, AtTime(std::move(waits), task->began)));
    }
  }
  return problems;
}

std::vector<Sentence> CheckCues(const std::string& script,
                                const std::string& file,
                                const CuesSeen& seen) {
  std::vector<Sentence> problems;
  const auto tell = [&](size_t line, Sentence problem) {
    problems.push_back(AtPlace(file + ":" + std::to_string(line), std::move(problem)));
  };
  const WrittenCues written = FindCues(script);
  const Result<drama::TimelineText> timeline = drama::TimelineText::Read(script, file);
  const std::vector<WrittenMarker> markers =
      timeline.ok() ? MarkersOf(*timeline) : std::vector<WrittenMarker>();
  // A marker whose name is computed is recognised because a trigger for it was armed.
  for (const WrittenMarker& marker : markers) {
    const bool listened =
        std::any_of(written.listened.begin(), written.listened.end(),
                    [&](const Word& word) { return word.text == marker.name; }) ||
        std::any_of(seen.cues.begin(), seen.cues.end(), [&](const CueRecord& cue) {
          return cue.kind == "marker" && cue.name == marker.name;
        });
    if (!listened) {
      tell(marker.line, Sentence("nothing begins at the marker '%s'", {marker.name}));
    }
  }
  for (const Word& word : written.listened) {
    if (std::none_of(markers.begin(), markers.end(),
                     [&](const WrittenMarker& marker) { return marker.name == word.text; })) {
      tell(word.line, Sentence("no track has a marker '%s'", {word.text}));
    }
  }
  const std::string seconds = std::to_string(std::lround(seen.seconds));
  std::map<std::string, std::vector<const CueRecord*>> by_place;
  for (const CueRecord& cue : seen.cues) {
    const bool judged = seen.visited || !IsVisitors(cue.kind);
    const bool is_told = cue.kind == "marker" &&
                         std::none_of(markers.begin(), markers.end(),
                                      [&](const WrittenMarker& m) { return m.name == cue.name; });
    if (!cue.fired && judged && !is_told) {
      const std::string trigger = cue.kind + (cue.name.empty() ? "" : " " + cue.name);
      problems.push_back(AtPlace(
          cue.where, Sentence("no run reaches the trigger '%s' (in %s s)", {trigger, seconds})));
    }
    by_place[cue.where].push_back(&cue);
  }
  for (const Word& word : written.armed) {
    if (!by_place.contains(file + ":" + std::to_string(word.line))) {
      tell(word.line, Sentence("no run reaches this '%s' (in %s s)", {word.text, seconds}));
    }
  }
  for (const Word& word : written.said) {
    if (!seen.lines.contains(word.text)) {
      tell(word.line, Sentence("no run says the line '%s' (in %s s)", {word.text, seconds}));
    }
  }
  return problems;
}

// ---- Steps ----

StepListener::StepListener(const stage::Stage& stage, std::span<const stage::Place> places)
    : stage_(stage) {
  size_t count = 0;
  for (const stage::Place& place : places) {
    count += place.occluders.size();
  }
  names_.reserve(count);  // Triangles keep pointers to them.
  for (const stage::Place& place : places) {
    for (const stage::Occluder& occluder : place.occluders) {
      if (occluder.blocks_walking) {
        const std::string name = "'" + occluder.name + "'";
        AddOccluder(occluder,
                    places.size() > 1 ? Sentence("%s of %s", {name, place.name}) : Sentence(name));
      }
    }
  }
}

void StepListener::AddOccluder(const stage::Occluder& occluder, Sentence name) {
  names_.push_back(std::move(name));
  const geometry::TriangleMesh& mesh = occluder.mesh;
  for (size_t first = 0; first + 2 < mesh.indices.size(); first += 3) {
    Triangle triangle;
    triangle.occluder = &names_.back();
    triangle.corners = TriangleOf(occluder, first);
    glm::vec3 lower(1e9f), upper(-1e9f);
    for (const glm::vec3& corner : triangle.corners) {
      lower = glm::min(lower, corner);
      upper = glm::max(upper, corner);
    }
    if (upper.y < kLow || lower.y > kHigh) {
      continue;
    }
    const auto index = static_cast<uint32_t>(triangles_.size());
    triangles_.push_back(triangle);
    for (int x = CellOf(lower.x); x <= CellOf(upper.x); ++x) {
      for (int z = CellOf(lower.z); z <= CellOf(upper.z); ++z) {
        cells_[{x, z}].push_back(index);
      }
    }
  }
}

const Sentence* StepListener::Crossed(const glm::vec3& from, const glm::vec3& to) const {
  const glm::vec3 way = to - from;
  for (int x = CellOf(std::min(from.x, to.x)); x <= CellOf(std::max(from.x, to.x)); ++x) {
    for (int z = CellOf(std::min(from.z, to.z)); z <= CellOf(std::max(from.z, to.z)); ++z) {
      const auto cell = cells_.find({x, z});
      if (cell == cells_.end()) {
        continue;
      }
      for (const uint32_t index : cell->second) {
        for (const float height : kHeights) {
          const glm::vec3 up(0.0f, height, 0.0f);
          if (Meets(from + up, way, triangles_[index].corners)) {
            return triangles_[index].occluder;
          }
        }
      }
    }
  }
  return nullptr;
}

// A point is inside an occluder if a ray to the right crosses its surface an odd number of
// times.
const Sentence* StepListener::Around(const glm::vec3& point) const {
  constexpr float kFar = 1000.0f;
  std::map<const Sentence*, int> met;
  for (const Triangle& triangle : triangles_) {
    const glm::vec3 from = point + glm::vec3(0.0f, kHeights[0] + 0.013f, 0.007f);
    met[triangle.occluder] +=
        Meets(from, glm::vec3(kFar, 0.0f, 0.0f), triangle.corners).has_value() ? 1 : 0;
  }
  for (const auto& [occluder, count] : met) {
    if (count % 2 == 1) {
      return occluder;
    }
  }
  return nullptr;
}

void StepListener::Tell(Sentence what, const std::string& actor, double time) {
  if (steps_.size() < kMostSteps) {
    steps_.push_back({actor, time, std::move(what)});
  }
}

void StepListener::Listen(double time) {
  stage_.Capture(snapshot_);
  for (const auto& [id, state] : snapshot_.actors) {
    const std::string& name = stage_.Find(id)->name;
    const auto before = last_.find(name);
    if (!state.visible) {
      if (before != last_.end()) {
        last_.erase(before);
      }
      continue;
    }
    if (before == last_.end()) {
      if (const Sentence* inside = Around(state.position)) {
        Tell(Sentence("%s stands in %s", {name, *inside}), name, time);
      }
      last_[name] = state.position;
      continue;
    }
    const glm::vec3 from = std::exchange(before->second, state.position);
    if (from == state.position) {
      continue;
    }
    if (glm::distance(from, state.position) > kLeap) {
      Tell(Sentence("%s jumps while visible", {name}), name, time);
    } else if (const Sentence* crossed = Crossed(from, state.position)) {
      Tell(Sentence("%s walks through %s", {name, *crossed}), name, time);
    }
  }
}

std::vector<Sentence> StepListener::Problems(const std::string& script,
                                             const std::string& file,
                                             std::span<const TaskRecord> tasks) const {
  const Result<drama::TimelineText> timeline = drama::TimelineText::Read(script, file);
  // The location of the last instruction before the step.
  const auto where = [&](const Step& step) {
    std::string place = file;
    double latest = -1.0;
    for (const TaskRecord& task : tasks) {
      if (task.actor == step.actor && task.began <= step.time && task.began > latest &&
          !task.where.empty() && (IsBodily(task) || task.action == "place")) {
        place = task.where;
        latest = task.began;
      }
    }
    for (size_t l = 0; timeline.ok() && l < timeline->lanes().size(); ++l) {
      const drama::TimelineLane& lane = timeline->lanes()[l];
      for (size_t i = 0; drama::SpecOf(lane.kind).leads_body && i < lane.size(); ++i) {
        if (lane.actor == step.actor && lane.at[i] <= step.time && lane.at[i] > latest) {
          place = file + ":" + std::to_string(timeline->LineOf({l, i}));
          latest = lane.at[i];
        }
      }
    }
    return place;
  };
  std::vector<Sentence> problems;
  for (const Step& step : steps_) {
    problems.push_back(AtPlace(where(step), AtTime(step.what, step.time)));
  }
  return problems;
}

// ---- Occluders ----

std::vector<Sentence> CheckOccluders(std::span<const stage::Place> places) {
  std::vector<Sentence> problems;
  for (const stage::Place& place : places) {
    for (const stage::Occluder& occluder : place.occluders) {
      Eigen::AlignedBox3d box;
      for (const glm::vec3& position : occluder.mesh.positions) {
        const Eigen::Vector3d corner = geometry::ToEigen(position).cast<double>();
        box.extend(occluder.stage_from_mesh * corner);
      }
      const double away = box.exteriorDistance(Eigen::Vector3d::Zero().eval());
      const double size = box.diagonal().norm();
      if (box.isEmpty()) {
        continue;
      }
      if (size > kLargest || size < kSmallest) {
        problems.push_back(
            AtPlace(place.name,
                    Sentence("occluder '%s' is %s m long; if its unit is not the metre, scale it",
                             {occluder.name, Text("%.3g", size)})));
      } else if (away > kFarOff) {
        problems.push_back(AtPlace(
            place.name,
            Sentence("occluder '%s' lies %s m from the stage; place it with model points or --at",
                     {occluder.name, std::to_string(std::lround(away))})));
      }
    }
  }
  return problems;
}

// ---- Ground ----

GroundListener::GroundListener(const stage::Stage& stage, std::span<const stage::Place> places)
    : stage_(stage) {
  for (const stage::Place& place : places) {
    Ground& ground = grounds_.emplace_back();
    ground.place = place.name;
    for (const stage::Occluder& occluder : place.occluders) {
      for (size_t first = 0; occluder.receives_shadow && first + 2 < occluder.mesh.indices.size();
           first += 3) {
        ground.triangles.push_back(TriangleOf(occluder, first));
      }
    }
  }
}

void GroundListener::Listen(double time) {
  if (time < next_) {
    return;
  }
  next_ = time + kLook;
  stage_.Capture(snapshot_);
  for (const auto& [id, state] : snapshot_.actors) {
    if (!state.visible) {
      continue;
    }
    const glm::vec3 from = state.position + glm::vec3(0.0f, kSole, 0.0f);
    const glm::vec3 way(0.0f, -(kSole + kLift), 0.0f);
    for (Ground& ground : grounds_) {
      ++ground.looked;
      if (std::ranges::any_of(ground.triangles, [&](const Triangle& triangle) {
            return Meets(from, way, triangle).has_value();
          })) {
        continue;
      }
      if (ground.missing++ == 0) {
        ground.first_actor = stage_.Find(id)->name;
        ground.first_time = time;
      }
    }
  }
}

std::vector<Sentence> GroundListener::Problems() const {
  std::vector<Sentence> problems;
  for (const Ground& ground : grounds_) {
    if (ground.missing > kMostFloating * ground.looked) {
      Sentence floats = Sentence(
          "people seem to float: nothing below %s catches a shadow; add an occluder of the shape "
          "'floor', or let an existing one receive shadow",
          {ground.first_actor});
      problems.push_back(AtPlace(ground.place, AtTime(std::move(floats), ground.first_time)));
    }
  }
  return problems;
}

}  // namespace lararium::editor
