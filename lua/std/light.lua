-- Light: the time of day, and the lamps that objects carry.

local host = ...

local Daylight = {}
Daylight.__index = Daylight
Daylight.__metatable = false
Daylight.__tostring = function()
  return "daylight"
end

-- The light of day on the stage.
daylight = setmetatable({}, Daylight)

-- Goes to a time of day, hours from 0 to 24, at once or over {seconds =}.
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

-- The time of day in hours; nil where none was set.
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

-- The lights of an object, or of the object of that name: embers, a flame.
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

-- {level =, seconds =, ease =, colour = {r, g, b}, temperature = kelvin}: level is a factor of
-- what the object's file says, 0 puts it out, reached in seconds; what is left out stays. A
-- light burns only in the states that its file names.
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

-- How bright it is: 1 as its file says.
function Light:level()
  return host.light_level(self.id)
end
