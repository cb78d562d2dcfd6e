// Host functions for the visitor and for triggers.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "shared/core/number_text.h"
#include "shared/drama/host_bindings.h"
#include "shared/drama/lua_binding.h"
#include "shared/drama/script_runtime.h"

namespace lararium::drama {
namespace {

constexpr size_t kMaxTriggers = 1000;
constexpr size_t kMaxName = 100;  // Bytes; limit for keys and markers.

void PushArgument(lua_State* lua, std::string_view argument) {
  double number = 0.0;
  std::string_view rest = argument;
  if (argument == "T" || argument == "F") {
    lua_pushboolean(lua, argument == "T" ? 1 : 0);
  } else if (const std::optional<std::string> text = ReadMessageText(argument)) {
    lua_pushlstring(lua, text->data(), text->size());
  } else if (TakeNumber(rest, number) && rest.empty() && std::isfinite(number)) {
    lua_pushnumber(lua, number);
  } else {
    lua_pushnil(lua);
  }
}

const Trigger* FindTrigger(const ScriptRuntime& run, int64_t id) {
  const auto found = std::find_if(run.state().triggers.begin(), run.state().triggers.end(),
                                  [id](const Trigger& trigger) { return trigger.id == id; });
  return found == run.state().triggers.end() ? nullptr : &*found;
}

// Arguments from `argument` on: "none", or "actor", id, or "object", id, or "point", x, y, z.
TriggerSpec CheckTrigger(ScriptRuntime& run, lua_State* lua, int argument) {
  TriggerSpec spec;
  constexpr const char* kTargets[] = {"none", "actor", "object", "point", nullptr};
  spec.target =
      static_cast<TriggerSpec::Target>(luaL_checkoption(lua, argument, nullptr, kTargets));
  switch (spec.target) {
    case TriggerSpec::Target::kActor:
      CheckActor(run, lua, argument + 1);
      spec.actor = CheckActorId(lua, argument + 1);
      break;
    case TriggerSpec::Target::kObject:
      CheckObject(run, lua, argument + 1);
      spec.object = CheckObjectId(lua, argument + 1);
      break;
    case TriggerSpec::Target::kPoint:
      spec.point = {CheckFinite(lua, argument + 1, "x"), CheckFinite(lua, argument + 2, "y"),
                    CheckFinite(lua, argument + 3, "z")};
      break;
    default:
      break;
  }
  return spec;
}

// trigger(kind, metres, leave, angle, seconds, text, target...) -> number of the trigger
int AddTrigger(ScriptRuntime& run, lua_State* lua) {
  constexpr const char* kKinds[] = {"near",    "leaves",  "looks_at", "looks_away", "stays",
                                    "timeout", "lost",    "back",     "key",        "clock",
                                    "marker",  "message", nullptr};
  static_assert(std::size(kKinds) == TriggerSpec::kKinds + 1);
  const auto kind = static_cast<TriggerSpec::Kind>(luaL_checkoption(lua, 1, nullptr, kKinds));
  Trigger trigger;
  trigger.spec = CheckTrigger(run, lua, 7);
  trigger.spec.kind = kind;
  trigger.spec.metres = static_cast<float>(CheckFinite(lua, 2, "the distance"));
  trigger.spec.leave =
      std::max(static_cast<float>(CheckFinite(lua, 3, "the distance")), trigger.spec.metres);
  trigger.spec.angle = static_cast<float>(CheckFinite(lua, 4, "the angle"));
  trigger.spec.seconds = static_cast<float>(CheckFinite(lua, 5, "the time"));
  trigger.spec.text = CheckText(lua, 6);
  if (const Status status = trigger.spec.Validate(); !status.ok()) {
    return luaL_error(lua, "%s", status.message().c_str());
  }
  if (run.state().triggers.size() >= kMaxTriggers || trigger.spec.text.size() > kMaxName) {
    return luaL_error(lua, "there are more than %d triggers at once, or a name is too long",
                      static_cast<int>(kMaxTriggers));
  }
  trigger.id = ++run.state().last_trigger;
  const Visitor& visitor = run.state().visitor;
  if (kind == TriggerSpec::Kind::kStays && visitor.group == nullptr) {
    trigger.stays.push_back({0, visitor.position});
  } else if (kind == TriggerSpec::Kind::kStays) {
    for (const GroupVisitor& one : *visitor.group) {
      trigger.stays.push_back({one.number, one.position});
    }
  }
  trigger.cue =
      run.cues().Find({run.PlaceNow(lua), kKinds[static_cast<size_t>(kind)], trigger.spec.text});
  run.state().triggers.push_back(std::move(trigger));
  lua_pushinteger(lua, run.state().last_trigger);
  return 1;
}

// drop_trigger(number); ignores unknown numbers
int DropTrigger(ScriptRuntime& run, lua_State* lua) {
  const int64_t id = luaL_checkinteger(lua, 1);
  std::erase_if(run.state().triggers, [id](const Trigger& trigger) { return trigger.id == id; });
  return 0;
}

// fired(number) -> how often it fired
int PushFired(ScriptRuntime& run, lua_State* lua) {
  const Trigger* trigger = FindTrigger(run, luaL_checkinteger(lua, 1));
  lua_pushinteger(lua, trigger == nullptr ? 0 : trigger->fired);
  return 1;
}

// heard(address) -> arguments of its last message: numbers, texts, true, false, nil
int PushHeard(ScriptRuntime& run, lua_State* lua) {
  constexpr int kMaxArguments = 16;
  const auto found = run.state().heard.find(CheckText(lua, 1));
  if (found == run.state().heard.end()) {
    return 0;
  }
  luaL_checkstack(lua, kMaxArguments, "a message");
  std::string_view rest = found->second;
  int count = 0;
  while (rest.starts_with(',') && count < kMaxArguments) {
    rest.remove_prefix(1);
    PushArgument(lua, rest.substr(0, rest.find(',')));
    rest.remove_prefix(std::min(rest.find(','), rest.size()));
    ++count;
  }
  return count;
}

// await_fired(numbers, counts): waits until a trigger has fired more often than its count
int AwaitFired(ScriptRuntime& run, lua_State* lua) {
  luaL_checktype(lua, 1, LUA_TTABLE);
  luaL_checktype(lua, 2, LUA_TTABLE);
  std::vector<std::pair<int64_t, int64_t>> awaited;
  for (lua_Integer i = 1; lua_rawgeti(lua, 1, i) == LUA_TNUMBER; ++i) {
    lua_rawgeti(lua, 2, i);
    awaited.emplace_back(lua_tointeger(lua, -2), lua_tointeger(lua, -1));
    lua_pop(lua, 2);
  }
  return run.scheduler().WaitUntil(lua, "wait_for", [&run, awaited = std::move(awaited)] {
    return std::any_of(awaited.begin(), awaited.end(), [&run](const auto& one) {
      const Trigger* trigger = FindTrigger(run, one.first);
      return trigger != nullptr && trigger->fired > one.second;
    });
  });
}

// visitor(), or visitor(actor) -> tracked, x, y, z, heading; the last known pose if not tracked. Of
// several visitors the one whom the actor, or else the first one, may look at now
int PushVisitor(ScriptRuntime& run, lua_State* lua) {
  const Visitor& visitor = run.state().visitor;
  glm::vec3 position = visitor.position;
  if (lua_isinteger(lua, 1) != 0) {
    CheckActor(run, lua, 1);
    position = run.stage().VisitorFor(CheckActorId(lua, 1)).value_or(position);
  }
  lua_pushboolean(lua, visitor.tracked ? 1 : 0);
  for (const float value : {position.x, position.y, position.z}) {
    lua_pushnumber(lua, value);
  }
  lua_pushnumber(lua, stage::HeadingOf({visitor.direction.x, visitor.direction.z}));
  return 5;
}

// distance(target...) -> metres between the nearest visitor and target on the floor; nil: unknown
int PushDistance(ScriptRuntime& run, lua_State* lua) {
  const TriggerSpec spec = CheckTrigger(run, lua, 1);
  const auto distance = DistanceTo(run.stage(), spec, run.state().visitor);
  if (distance) {
    lua_pushnumber(lua, *distance);
  } else {
    lua_pushnil(lua);
  }
  return 1;
}

// aside(actor, metres) -> x, z of a nearby place at this distance from the nearest visitor; or nil
int PushAside(ScriptRuntime& run, lua_State* lua) {
  CheckFreeActor(run, lua);
  const auto metres = static_cast<float>(CheckFinite(lua, 2, "the distance"));
  const stage::ActorId actor = CheckActorId(lua, 1);
  const glm::vec3& from = run.stage().Find(actor)->state.position;
  glm::vec3 visitor = run.state().visitor.position;
  float nearest = std::numeric_limits<float>::max();
  ForEachTracked(run.state().visitor, [&](const GroupVisitor& one) {
    const float away = std::hypot(one.position.x - from.x, one.position.z - from.z);
    if (away < nearest) {
      nearest = away;
      visitor = one.position;
    }
  });
  const auto place = run.stage().FindAway(actor, {visitor.x, visitor.z}, metres);
  if (!place) {
    lua_pushnil(lua);
    return 1;
  }
  lua_pushnumber(lua, place->x);
  lua_pushnumber(lua, place->y);
  return 2;
}

}  // namespace

void AddVisitorBindings(HostTable& table) {
  table.AddOwn<AwaitFired>("await_fired");
  table.AddRecorded<AddTrigger>("trigger");
  table.AddRecorded<DropTrigger>("drop_trigger");
  table.AddRecorded<PushFired>("fired");
  table.AddRecorded<PushHeard>("heard");
  table.AddRecorded<PushVisitor>("visitor");
  table.AddRecorded<PushDistance>("distance");
  table.AddRecorded<PushAside>("aside");
}

}  // namespace lararium::drama
