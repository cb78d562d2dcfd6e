// Host functions for the time of day and for lamps.

#include <glm/geometric.hpp>

#include "shared/drama/host_bindings.h"
#include "shared/drama/lua_binding.h"
#include "shared/drama/script_runtime.h"
#include "shared/light/lamp.h"

namespace lararium::drama {
namespace {

// set_hour(hour, seconds)
int SetHour(ScriptRuntime& run, lua_State* lua) {
  run.stage().SetHour(CheckFinite(lua, 1, "hour"), CheckFinite(lua, 2, "seconds"));
  return 0;
}

// hour() -> hours, or nil if none was set
int PushHour(ScriptRuntime& run, lua_State* lua) {
  if (const std::optional<double> hour = run.stage().daylight().hour) {
    lua_pushnumber(lua, *hour);
  } else {
    lua_pushnil(lua);
  }
  return 1;
}

// has_light(object)
int PushHasLight(ScriptRuntime& run, lua_State* lua) {
  lua_pushboolean(lua, !CheckObject(run, lua).use().lights.empty());
  return 1;
}

// light_level(object) -> factor
int PushLightLevel(ScriptRuntime& run, lua_State* lua) {
  lua_pushnumber(lua, CheckObject(run, lua).state.light.level);
  return 1;
}

// set_light_level(object, factor, seconds, ease)
int SetLightLevel(ScriptRuntime& run, lua_State* lua) {
  const stage::ObjectId id = CheckObjectId(lua, 1);
  CheckObject(run, lua);
  run.stage().SetLightLevel(id, static_cast<float>(CheckFinite(lua, 2, "level")),
                            static_cast<float>(CheckFinite(lua, 3, "seconds")),
                            CheckEase(lua, CheckText(lua, 4)));
  return 0;
}

// set_light_colour(object, red, green, blue): linear, any brightness; all 0: the colour in the file
int SetLightColour(ScriptRuntime& run, lua_State* lua) {
  const stage::ObjectId id = CheckObjectId(lua, 1);
  CheckObject(run, lua);
  const glm::vec3 colour(CheckFinite(lua, 2, "red"), CheckFinite(lua, 3, "green"),
                         CheckFinite(lua, 4, "blue"));
  const float luminance = glm::dot(colour, glm::vec3(0.2126f, 0.7152f, 0.0722f));
  run.stage().SetLightColour(id, luminance > 0.0f ? colour / luminance : glm::vec3(0.0f));
  return 0;
}

// set_light_temperature(object, kelvin)
int SetLightTemperature(ScriptRuntime& run, lua_State* lua) {
  const stage::ObjectId id = CheckObjectId(lua, 1);
  CheckObject(run, lua);
  run.stage().SetLightColour(id, light::ColourOfTemperature(CheckFinite(lua, 2, "temperature")));
  return 0;
}

}  // namespace

void AddLightBindings(HostTable& table) {
  table.AddRecorded<SetHour>("set_hour");
  table.AddRecorded<PushHour>("hour");
  table.AddRecorded<PushHasLight>("has_light");
  table.AddRecorded<PushLightLevel>("light_level");
  table.AddRecorded<SetLightLevel>("set_light_level");
  table.AddRecorded<SetLightColour>("set_light_colour");
  table.AddRecorded<SetLightTemperature>("set_light_temperature");
}

}  // namespace lararium::drama
