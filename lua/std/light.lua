-- Light: the time of day, and the lamps of objects.

local host = ...

local Daylight = {}
Daylight.__index = Daylight
Daylight.__metatable = false
Daylight.__tostring = function()
  return "daylight"
end

-- The daylight on the stage.
daylight = setmetatable({}, Daylight)

-- Changes the time of day to hours from 0 to 24, at once or within {seconds =}.
function Daylight:set_time(hours, options)
  if type(hours) ~= "number" or not (hours >= 0 and hours <= 24) then
    error("set_time: give the hours of the day, 0 to 24", 2)
  end
  if options ~= nil and type(options) ~= "table" then
    error("set_time: give a table like {seconds = 20}", 2)
  end
  local seconds = options and options.seconds or 0
  if type(seconds) ~= "number" or not (seconds >= 0 and seconds <= 1e6) then
    error("set_time: seconds must be a number", 2)
  end
  host.set_hour(hours, seconds)
end

-- Returns the time of day in hours, or nil if none was set.
function Daylight:time()
  return host.hour()
end

local Light = {}
Light.__index = Light
Light.__metatable = false
Light.__tostring = function(self)
  return "light of '" .. self.name .. "'"
end

local known = {}

-- Returns the lights of an object, such as embers or a flame. Takes the object or its name.
function light(target)
  if type(target) == "string" then
    target = object(target)
  end
  if type(target) ~= "table" or not target.is_object then
    error("light: give an object or its name", 2)
  end
  if not host.has_light(target.id) then
    error("light: '" .. target.name .. "' has no light in its object file", 2)
  end
  if not known[target.name] then
    known[target.name] = setmetatable({ name = target.name, id = target.id }, Light)
  end
  return known[target.name]
end

local function channel(colour, index)
  local value = type(colour) == "table" and colour[index]
  if type(value) ~= "number" or not (value >= 0 and value <= 1e6) then
    error("set: colour must be linear {red, green, blue} of at least 0", 3)
  end
  return value
end

local function number(options, key, default, least, most)
  local value = options[key]
  if value == nil then
    value = default
  end
  if type(value) ~= "number" or not (value >= least and value <= most) then
    error("set: " .. key .. " must be a number from " .. least .. " to " .. most, 3)
  end
  return value
end

-- Changes the lights: {level =, seconds =, ease =, colour = {r, g, b}, temperature = kelvin}. level
-- is a factor of the intensity in the object's file (0: off) and is reached within seconds. Missing
-- values do not change. A light burns only in the states that its file names.
function Light:set(options)
  if type(options) ~= "table" then
    error("set: give a table like {level = 0.5, seconds = 2}", 2)
  end
  if options.level ~= nil then
    host.set_light_level(self.id, number(options, "level", 1, 0, 1000),
      number(options, "seconds", 0, 0, 1e6), options.ease or "linear")
  end
  if options.colour ~= nil then
    host.set_light_colour(self.id, channel(options.colour, 1), channel(options.colour, 2),
      channel(options.colour, 3))
  end
  if options.temperature ~= nil then
    host.set_light_temperature(self.id, number(options, "temperature", 2000, 1667, 25000))
  end
end

-- Returns the present level; 1 is the intensity in the object's file.
function Light:level()
  return host.light_level(self.id)
end
