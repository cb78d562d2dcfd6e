// Host functions for the visitor and for triggers.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "shared/drama/lua_binding.h"
#include "shared/drama/run.h"

namespace lararium::drama {
namespace {

constexpr size_t kMaxTriggers = 1000;
constexpr size_t kMaxName = 100;  // Bytes; limit for keys and markers.

void PushArgument(lua_State* lua, std::string_view argument) {
  double number = 0.0;
  const char* end = argument.data() + argument.size();
  if (argument == "T" || argument == "F") {
    lua_pushboolean(lua, argument == "T" ? 1 : 0);
  } else if (const std::optional<std::string> text = ReadMessageText(argument)) {
    lua_pushlstring(lua, text->data(), text->size());
  } else if (const auto read = std::from_chars(argument.data(), end, number);
             read.ec == std::errc() && read.ptr == end && std::isfinite(number)) {
    lua_pushnumber(lua, number);
  } else {
    lua_pushnil(lua);
  }
}

}  // namespace

const Trigger* Run::FindTrigger(int64_t id) const {
  const auto found = std::find_if(state_.triggers.begin(), state_.triggers.end(),
                                  [id](const Trigger& trigger) { return trigger.id == id; });
  return found == state_.triggers.end() ? nullptr : &*found;
}

// Arguments from `argument` on: "none", or "actor", id, or "object", id, or "point", x, y, z.
TriggerSpec Run::CheckTrigger(lua_State* lua, int argument) {
  TriggerSpec spec;
  constexpr const char* kTargets[] = {"none", "actor", "object", "point", nullptr};
  spec.target =
      static_cast<TriggerSpec::Target>(luaL_checkoption(lua, argument, nullptr, kTargets));
  switch (spec.target) {
    case TriggerSpec::Target::kActor:
      CheckActor(lua, argument + 1);
      spec.actor = CheckActorId(lua, argument + 1);
      break;
    case TriggerSpec::Target::kObject:
      CheckObject(lua, argument + 1);
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
int Run::AddTrigger(lua_State* lua) {
  constexpr const char* kKinds[] = {"near",    "leaves",  "looks_at", "looks_away", "stays",
                                    "timeout", "lost",    "back",     "key",        "clock",
                                    "marker",  "message", nullptr};
  static_assert(std::size(kKinds) == TriggerSpec::kKinds + 1);
  const auto kind = static_cast<TriggerSpec::Kind>(luaL_checkoption(lua, 1, nullptr, kKinds));
  Trigger trigger;
  trigger.spec = CheckTrigger(lua, 7);
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
  if (state_.triggers.size() >= kMaxTriggers || trigger.spec.text.size() > kMaxName) {
    return luaL_error(lua, "there are more than %d triggers at once, or a name is too long",
                      static_cast<int>(kMaxTriggers));
  }
  trigger.id = ++state_.last_trigger;
  trigger.from = state_.visitor.position;
  trigger.cue = cues_.Find({PlaceNow(lua), kKinds[static_cast<size_t>(kind)], trigger.spec.text});
  state_.triggers.push_back(std::move(trigger));
  lua_pushinteger(lua, state_.last_trigger);
  return 1;
}

// drop_trigger(number); ignores unknown numbers
int Run::DropTrigger(lua_State* lua) {
  const int64_t id = luaL_checkinteger(lua, 1);
  std::erase_if(state_.triggers, [id](const Trigger& trigger) { return trigger.id == id; });
  return 0;
}

// fired(number) -> how often it fired
int Run::PushFired(lua_State* lua) {
  const Trigger* trigger = FindTrigger(luaL_checkinteger(lua, 1));
  lua_pushinteger(lua, trigger == nullptr ? 0 : trigger->fired);
  return 1;
}

// heard(address) -> arguments of its last message: numbers, texts, true, false, nil
int Run::PushHeard(lua_State* lua) {
  constexpr int kMaxArguments = 16;
  const auto found = state_.heard.find(CheckText(lua, 1));
  if (found == state_.heard.end()) {
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
int Run::AwaitFired(lua_State* lua) {
  luaL_checktype(lua, 1, LUA_TTABLE);
  luaL_checktype(lua, 2, LUA_TTABLE);
  std::vector<std::pair<int64_t, int64_t>> awaited;
  for (lua_Integer i = 1; lua_rawgeti(lua, 1, i) == LUA_TNUMBER; ++i) {
    lua_rawgeti(lua, 2, i);
    awaited.emplace_back(lua_tointeger(lua, -2), lua_tointeger(lua, -1));
    lua_pop(lua, 2);
  }
  return scheduler_.WaitUntil(lua, "wait_for", [this, awaited = std::move(awaited)] {
    return std::any_of(awaited.begin(), awaited.end(), [this](const auto& one) {
      const Trigger* trigger = FindTrigger(one.first);
      return trigger != nullptr && trigger->fired > one.second;
    });
  });
}

// visitor() -> tracked, x, y, z, heading; the last known pose if not tracked
int Run::PushVisitor(lua_State* lua) {
  const Visitor& visitor = state_.visitor;
  lua_pushboolean(lua, visitor.tracked ? 1 : 0);
  for (const float value : {visitor.position.x, visitor.position.y, visitor.position.z}) {
    lua_pushnumber(lua, value);
  }
  lua_pushnumber(lua, stage::HeadingOf({visitor.direction.x, visitor.direction.z}));
  return 5;
}

// distance(target...) -> metres between visitor and target on the floor; nil: unknown
int Run::PushDistance(lua_State* lua) {
  const TriggerSpec spec = CheckTrigger(lua, 1);
  const auto distance = DistanceTo(stage_, spec, state_.visitor.position);
  if (distance && state_.visitor.tracked) {
    lua_pushnumber(lua, *distance);
  } else {
    lua_pushnil(lua);
  }
  return 1;
}

// aside(actor, metres) -> x, z of a nearby place at this distance from the visitor; or nil
int Run::PushAside(lua_State* lua) {
  CheckFreeActor(lua);
  const auto metres = static_cast<float>(CheckFinite(lua, 2, "the distance"));
  const glm::vec3& visitor = state_.visitor.position;
  const auto place = stage_.FindAway(CheckActorId(lua, 1), {visitor.x, visitor.z}, metres);
  if (!place) {
    lua_pushnil(lua);
    return 1;
  }
  lua_pushnumber(lua, place->x);
  lua_pushnumber(lua, place->y);
  return 2;
}

}  // namespace lararium::drama
