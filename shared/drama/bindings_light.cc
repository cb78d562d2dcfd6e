// Host functions for the time of day and for lamps.

#include <glm/geometric.hpp>

#include "shared/drama/lua_binding.h"
#include "shared/drama/run.h"
#include "shared/light/lamp.h"

namespace lararium::drama {

// set_hour(hour, seconds)
int Run::SetHour(lua_State* lua) {
  stage_.SetHour(CheckFinite(lua, 1, "hour"), CheckFinite(lua, 2, "seconds"));
  return 0;
}

// hour() -> hours, or nil if none was set
int Run::PushHour(lua_State* lua) {
  if (const std::optional<double> hour = stage_.daylight().hour) {
    lua_pushnumber(lua, *hour);
  } else {
    lua_pushnil(lua);
  }
  return 1;
}

// has_light(object)
int Run::PushHasLight(lua_State* lua) {
  lua_pushboolean(lua, !CheckObject(lua).use().lights.empty());
  return 1;
}

// light_level(object) -> factor
int Run::PushLightLevel(lua_State* lua) {
  lua_pushnumber(lua, CheckObject(lua).state.light.level);
  return 1;
}

// set_light_level(object, factor, seconds, ease)
int Run::SetLightLevel(lua_State* lua) {
  const stage::ObjectId id = CheckObjectId(lua, 1);
  CheckObject(lua);
  stage_.SetLightLevel(id, static_cast<float>(CheckFinite(lua, 2, "level")),
                       static_cast<float>(CheckFinite(lua, 3, "seconds")),
                       CheckEase(lua, CheckText(lua, 4)));
  return 0;
}

// set_light_colour(object, red, green, blue): linear, any brightness; all 0: the colour in the file
int Run::SetLightColour(lua_State* lua) {
  const stage::ObjectId id = CheckObjectId(lua, 1);
  CheckObject(lua);
  const glm::vec3 colour(CheckFinite(lua, 2, "red"), CheckFinite(lua, 3, "green"),
                         CheckFinite(lua, 4, "blue"));
  const float luminance = glm::dot(colour, glm::vec3(0.2126f, 0.7152f, 0.0722f));
  stage_.SetLightColour(id, luminance > 0.0f ? colour / luminance : glm::vec3(0.0f));
  return 0;
}

// set_light_temperature(object, kelvin)
int Run::SetLightTemperature(lua_State* lua) {
  const stage::ObjectId id = CheckObjectId(lua, 1);
  CheckObject(lua);
  stage_.SetLightColour(id, light::ColourOfTemperature(CheckFinite(lua, 2, "temperature")));
  return 0;
}

}  // namespace lararium::drama
