// Host functions that declare the timeline while the script loads.

#include <algorithm>
#include <cmath>
#include <string>

#include "shared/core/number_text.h"
#include "shared/drama/host_bindings.h"
#include "shared/drama/lua_binding.h"
#include "shared/drama/script_runtime.h"

namespace lararium::drama {
namespace {

constexpr size_t kMaxItems = 1'000'000;
constexpr double kMaxSeconds = 1e6;

glm::vec3 CheckPoint(lua_State* lua, int argument) {
  constexpr const char* kAxes[] = {"x", "y", "z"};
  luaL_checktype(lua, argument, LUA_TTABLE);
  glm::vec3 point;
  for (int axis = 0; axis < 3; ++axis) {
    lua_getfield(lua, argument, kAxes[axis]);
    point[axis] = static_cast<float>(CheckFinite(lua, -1, kAxes[axis]));
    lua_pop(lua, 1);
  }
  return point;
}

// ---- fields of the item on top of the stack ----

std::optional<double> NumberField(lua_State* lua, const char* key, double low, double high) {
  const int type = lua_getfield(lua, -1, key);
  const double value = type == LUA_TNUMBER ? lua_tonumber(lua, -1) : 0.0;
  lua_pop(lua, 1);
  if (type == LUA_TNIL) {
    return std::nullopt;
  }
  if (type != LUA_TNUMBER || !(value >= low && value <= high)) {
    luaL_error(lua, "%s must be a number from %f to %f", key, low, high);
  }
  return value;
}

std::string TextField(lua_State* lua, const char* key, const char* otherwise) {
  const int type = lua_getfield(lua, -1, key);
  std::string text = type == LUA_TSTRING ? lua_tostring(lua, -1) : "";
  lua_pop(lua, 1);
  if (type == LUA_TNIL && otherwise != nullptr) {
    return otherwise;
  }
  if (type != LUA_TSTRING) {
    luaL_error(lua, "%s must be a text", key);
  }
  return text;
}

bool BooleanField(lua_State* lua, const char* key) {
  lua_getfield(lua, -1, key);
  const bool value = lua_toboolean(lua, -1) != 0;
  lua_pop(lua, 1);
  return value;
}

double FieldOfPoint(lua_State* lua, const char* key, double otherwise) {
  return NumberField(lua, key, -kMaxSeconds, kMaxSeconds).value_or(otherwise);
}

std::vector<TrackSegment>& SegmentsOf(std::vector<Track>& tracks, stage::ActorId id) {
  const auto found = std::find_if(tracks.begin(), tracks.end(),
                                  [id](const Track& track) { return track.actor == id; });
  if (found != tracks.end()) {
    return found->segments;
  }
  tracks.push_back({id, {}});
  return tracks.back().segments;
}

// segment(actor, begin, length, clip, rate, fade, from, to, heading, ease)
int AddSegment(ScriptRuntime& run, lua_State* lua) {
  if (run.declaring() == nullptr) {
    return luaL_error(lua, "track: only while the script loads, not within main()");
  }
  stage::Actor& actor = CheckActor(run, lua);
  TrackSegment segment;
  segment.begin = CheckFinite(lua, 2, "at");
  segment.length = CheckFinite(lua, 3, "length");
  segment.clip = CheckClip(lua, actor, 4);
  segment.rate = CheckFinite(lua, 5, "rate");
  segment.fade = CheckFinite(lua, 6, "fade");
  segment.from = CheckPoint(lua, 7);
  segment.to = CheckPoint(lua, 8);
  segment.heading = static_cast<float>(CheckFinite(lua, 9, "heading"));
  segment.ease = CheckEase(lua, luaL_optstring(lua, 10, "linear"));
  std::vector<TrackSegment>& segments =
      SegmentsOf(run.declaring()->timeline.tracks, CheckActorId(lua, 1));
  if (segments.size() >= kMaxItems) {
    return luaL_error(lua, "track: too many clips");
  }
  if (!segments.empty() && segment.begin < segments.back().begin) {
    return luaL_error(lua, "track: '%s' has a track already, and this one begins before its end",
                      actor.name.c_str());
  }
  segments.push_back(segment);
  actor.led = true;
  return 0;
}

// The object named by field `key` of the item on top of the stack; zero: the field is missing.
stage::ObjectId CheckObjectNamed(ScriptRuntime& run, lua_State* lua, const char* key) {
  const std::string name = TextField(lua, key, "");
  const auto id = run.stage().FindObject(name);
  if (!name.empty() && !id) {
    luaL_error(lua, "there is no object '%s'", name.c_str());
  }
  return id.value_or(stage::ObjectId());
}

stage::Attention::Choice CheckGaze(ScriptRuntime& run, lua_State* lua) {
  using Target = stage::Attention::Target;
  stage::Attention::Choice choice;
  const int type = lua_getfield(lua, -1, "target");
  if (type == LUA_TTABLE) {
    choice.target = Target::kPoint;
    choice.point = {FieldOfPoint(lua, "x", 0.0), FieldOfPoint(lua, "y", 1.5),
                    FieldOfPoint(lua, "z", 0.0)};
  } else if (type == LUA_TSTRING) {
    const std::string name = lua_tostring(lua, -1);
    const auto actor = run.stage().Find(name);
    const auto object = run.stage().FindObject(name);
    choice.target = actor ? Target::kActor : object ? Target::kObject : Target::kVisitor;
    choice.actor = actor.value_or(stage::ActorId());
    choice.object = object.value_or(stage::ObjectId());
    if (!actor && !object && name != "visitor") {
      luaL_error(lua, "there is no actor or object called '%s' to look at", name.c_str());
    }
  } else if (type != LUA_TBOOLEAN || lua_toboolean(lua, -1) != 0) {
    luaL_error(lua, "target must be a name, \"visitor\", a point or false");
  }
  lua_pop(lua, 1);
  return choice;
}

// Fields: from = {x=, y=, z=, heading=}, to = {x=, z=, heading=}, hide = true.
void CheckMotion(lua_State* lua, Cue& cue) {
  if (lua_getfield(lua, -1, "from") == LUA_TTABLE) {
    cue.places = true;
    cue.from = {FieldOfPoint(lua, "x", 0.0), FieldOfPoint(lua, "y", 0.0),
                FieldOfPoint(lua, "z", 0.0)};
    cue.from_heading = static_cast<float>(FieldOfPoint(lua, "heading", 0.0) * M_PI / 180.0);
  }
  lua_pop(lua, 1);
  if (lua_getfield(lua, -1, "to") == LUA_TTABLE) {
    cue.act = Cue::Act::kWalk;
    cue.to = {FieldOfPoint(lua, "x", 0.0), 0.0, FieldOfPoint(lua, "z", 0.0)};
    if (const auto heading = NumberField(lua, "heading", -kMaxSeconds, kMaxSeconds)) {
      cue.heading = static_cast<float>(*heading * M_PI / 180.0);
    }
  }
  lua_pop(lua, 1);
  if (BooleanField(lua, "hide")) {
    cue.act = Cue::Act::kHide;
  }
  cue.value = static_cast<float>(NumberField(lua, "speed", 0.1, 10.0).value_or(0.0));
  if (cue.act == Cue::Act::kNone && !cue.places) {
    luaL_error(lua, "say where to go: to = {x = 1, z = -2}; or where to be: from = {...}");
  }
}

// Fields: object, action; for put: on, surface, or to; for give: partner.
void CheckUse(ScriptRuntime& run, lua_State* lua, Cue& cue) {
  const std::string action = TextField(lua, "action", "");
  cue.object = CheckObjectNamed(run, lua, "object");
  if (action == "stand") {
    cue.act = Cue::Act::kStand;
    return;
  }
  const stage::Object* object = run.stage().Find(cue.object);
  if (object == nullptr) {
    luaL_error(lua, "name an object");
    return;
  }
  if (action == "take") {
    cue.act = Cue::Act::kTake;
  } else if (action == "put") {
    cue.act = Cue::Act::kPut;
    cue.other = CheckObjectNamed(run, lua, "on");
    cue.name = TextField(lua, "surface", "");
    if (!cue.other) {
      CheckMotion(lua, cue);
      cue.act = Cue::Act::kPut;
    }
  } else if (action == "give") {
    cue.act = Cue::Act::kGive;
    const std::string partner = TextField(lua, "partner", nullptr);
    const auto id = run.stage().Find(partner);
    if (!id) {
      luaL_error(lua, "there is no '%s' in the cast", partner.c_str());
    }
    cue.partner = *id;
  } else {
    cue.act = Cue::Act::kUse;
    const auto& actions = object->use().actions;
    cue.name = action.empty() && !actions.empty() ? actions.front().name : action;
    const bool known = std::any_of(actions.begin(), actions.end(),
                                   [&](const auto& a) { return a.name == cue.name; });
    if (!known) {
      luaL_error(lua, "'%s' has no action '%s'", object->name.c_str(), cue.name.c_str());
    }
  }
}

// Reads the item on top of the stack.
Cue CheckCue(ScriptRuntime& run, lua_State* lua, const CueLane& lane) {
  Cue cue;
  const auto at = NumberField(lua, "at", 0.0, kMaxSeconds);
  if (!at) {
    luaL_error(lua, "has no `at`; add the time in seconds when it begins");
  }
  cue.at = *at;
  cue.length = NumberField(lua, "length", 0.0, kMaxSeconds).value_or(0.0);
  cue.id = TextField(lua, "id", "");
  cue.fade = static_cast<float>(NumberField(lua, "fade", 0.0, 100.0).value_or(0.4));
  cue.ease = CheckEase(lua, TextField(lua, "ease", "linear"));
  const stage::Actor* actor = run.stage().Find(lane.actor);
  switch (lane.kind) {
    case LaneKind::kGestures: {
      cue.name = TextField(lua, "clip", nullptr);
      cue.index = stage::FindClip(actor->human(), cue.name);
      if (cue.index < 0) {
        luaL_error(lua, "'%s' has no clip '%s'", actor->name.c_str(), cue.name.c_str());
      }
      constexpr const char* kParts[] = {"whole", "upper", "arms", "head"};
      const std::string part = TextField(lua, "part", "upper");
      const auto known = std::find(std::begin(kParts), std::end(kParts), part);
      if (known == std::end(kParts)) {
        luaL_error(lua, "the part must be upper, arms, head or whole");
      }
      cue.part = static_cast<human::BodyPart>(known - std::begin(kParts));
      break;
    }
    case LaneKind::kSpeech:
    case LaneKind::kCaptions: {
      cue.name = TextField(lua, "line", nullptr);
      const auto speech = run.stage().FindSpeech(cue.name);
      if (!speech) {
        luaL_error(lua, "there is no line '%s'", cue.name.c_str());
      }
      cue.index = *speech;
      if (lane.kind == LaneKind::kSpeech && cue.length > 0.0 &&
          run.stage().SpeechSeconds(cue.index) > cue.length + 0.05) {
        run.Report(
            {lane.where + ": track: the line '" + cue.name + "' takes " +
                 FormatNumber(std::round(100.0 * run.stage().SpeechSeconds(cue.index)) / 100.0) +
                 " s, longer than its slot",
             ""});
      }
      break;
    }
    case LaneKind::kWalks:
      CheckMotion(lua, cue);
      break;
    case LaneKind::kUses:
      CheckUse(run, lua, cue);
      break;
    case LaneKind::kGaze:
      cue.gaze = CheckGaze(run, lua);
      break;
    case LaneKind::kExpressions: {
      cue.name = TextField(lua, "expression", nullptr);
      const auto expression = human::ExpressionNamed(cue.name);
      if (!expression) {
        luaL_error(lua, "there is no expression '%s'", cue.name.c_str());
      }
      cue.index = static_cast<int>(*expression);
      cue.value = static_cast<float>(NumberField(lua, "intensity", 0.0, 1.0).value_or(1.0));
      break;
    }
    default:
      cue.name = TextField(lua, "name", nullptr);
  }
  return cue;
}

// Like CheckCue; errors name the item.
Cue CheckItem(ScriptRuntime& run, lua_State* lua, const CueLane& lane, int64_t index) {
  try {
    return CheckCue(run, lua, lane);
  } catch (...) {  // Lua raises its errors as exceptions.
    if (LimitsOf(lua).tripped() || lua_type(lua, -1) != LUA_TSTRING) {
      throw;
    }
    const std::string text = lua_tostring(lua, -1);
    const size_t colon = text.starts_with("std/") ? text.find(": ") : std::string::npos;
    const size_t place = colon == std::string::npos ? 0 : colon + 2;  // This prefix is kept.
    PushText(lua, text.substr(0, place) + "track: " + std::string(NameOf(lane.kind)) + "[" +
                      std::to_string(index) + "]: " + text.substr(place));
    throw;
  }
}

// lane(name, actor or nil, items)
int AddLane(ScriptRuntime& run, lua_State* lua) {
  if (run.declaring() == nullptr) {
    return luaL_error(lua, "track: only while the script loads, not within main()");
  }
  const std::string name(CheckText(lua, 1));
  const auto kind = LaneNamed(name);
  if (!kind) {
    return luaL_error(lua, "track: there is no lane '%s'", name.c_str());
  }
  CueLane lane;
  lane.kind = *kind;
  lane.where = PlaceOf(lua);
  if (IsOfActor(*kind)) {
    if (lua_isnil(lua, 2)) {
      return luaL_error(lua, "track: %s need an actor", name.c_str());
    }
    lane.actor = CheckActorId(lua, 2);
    if (SpecOf(*kind).moves_body) {
      CheckFreeActor(run, lua, 2);
    }
  }
  luaL_checktype(lua, 3, LUA_TTABLE);
  const auto count = static_cast<lua_Integer>(lua_rawlen(lua, 3));
  if (static_cast<size_t>(count) > kMaxItems) {
    return luaL_error(lua, "track: too many items");
  }
  lane.cues.reserve(static_cast<size_t>(count));
  for (lua_Integer i = 1; i <= count; ++i) {
    Charge(lua, 10);
    if (lua_rawgeti(lua, 3, i) != LUA_TTABLE) {
      return luaL_error(lua, "track: %s[%I]: write an item {at = 0, ...} here", name.c_str(), i);
    }
    lane.cues.push_back(CheckItem(run, lua, lane, i));
    lua_settop(lua, 3);
  }
  std::stable_sort(lane.cues.begin(), lane.cues.end(),
                   [](const Cue& a, const Cue& b) { return a.at < b.at; });
  run.declaring()->timeline.lanes.push_back(std::move(lane));
  return 0;
}

// lanes(): the names of the lanes that the host plays
int ListLanes(ScriptRuntime&, lua_State* lua) {
  lua_newtable(lua);
  for (const LaneSpec& lane : LaneSpecs()) {
    if (lane.by_host) {
      PushText(lua, lane.name);
      lua_rawseti(lua, -2, static_cast<lua_Integer>(lua_rawlen(lua, -2)) + 1);
    }
  }
  return 1;
}

}  // namespace

void AddTimelineBindings(HostTable& table) {
  table.AddRecorded<AddSegment>("segment");
  table.AddRecorded<AddLane>("lane");
  table.AddOwn<ListLanes>("lanes");
}

}  // namespace lararium::drama
