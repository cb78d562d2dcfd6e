-- Actors: the people of the cast. Positions are metres on the stage (x to the
-- right, y up, -z forward); headings are degrees, 0 along -z, 90 along -x.

local host = ...

local Actor = {}
Actor.__index = Actor
Actor.__metatable = false
Actor.__tostring = function(self)
  return "actor '" .. self.name .. "'"
end

local TURN_SPEED = 180 -- degrees per second
local FADE = 0.3 -- seconds from one clip to the next
local ROUNDING = 1e-6 -- seconds: a motion that is over but for this is over

local known = {}

-- The actor of that name in the cast; it is hidden until it is placed or shown.
function actor(name)
  if type(name) ~= "string" then
    error("actor: give the name of a member of the cast", 2)
  end
  if not known[name] then
    local id = host.actor(name)
    if not id then
      error("actor: there is no '" .. name .. "' in the cast", 2)
    end
    known[name] = setmetatable({ name = name, id = id }, Actor)
  end
  return known[name]
end

-- The number in options[key], or default; level: whose mistake it would be.
local function number(options, key, default, what)
  local value = options[key]
  if value == nil then
    value = default
  end
  if type(value) ~= "number" or value ~= value or value < -1e6 or value > 1e6 then
    error(what .. ": " .. key .. " must be a number", 3)
  end
  return value
end

local function options_of(value, what)
  if value ~= nil and type(value) ~= "table" then
    error(what .. ": give a table like {x = 1}", 3)
  end
  return value or {}
end

local function check_clip(self, clip, what)
  if type(clip) ~= "string" or not host.clip(self.id, clip) then
    error(what .. ": " .. tostring(self) .. " has no clip '" .. tostring(clip) .. "'", 3)
  end
end

-- Puts the actor somewhere at once: {x=, y=, z=, heading=}; what is left out
-- stays. Shows it.
function Actor:place(target)
  target = options_of(target, "place")
  local x, y, z, heading = host.pose(self.id)
  host.place(self.id, number(target, "x", x, "place"), number(target, "y", y, "place"),
    number(target, "z", z, "place"), math.rad(number(target, "heading", math.deg(heading), "place")))
  host.show(self.id, true)
end

function Actor:show()
  host.show(self.id, true)
end

function Actor:hide()
  host.show(self.id, false)
end

-- Where the actor is: {x=, y=, z=, heading=}.
function Actor:where()
  local x, y, z, heading = host.pose(self.id)
  return { x = x, y = y, z = z, heading = math.deg(heading) }
end

-- Plays a clip of the actor from now on: {fade = seconds, rate = 1}.
function Actor:play(clip, options)
  options = options_of(options, "play")
  check_clip(self, clip, "play")
  local fade = number(options, "fade", FADE, "play")
  local rate = number(options, "rate", 1, "play")
  host.play(self.id, clip, fade, rate)
end

-- How long a clip of the actor lasts, in seconds.
function Actor:length(clip)
  check_clip(self, clip, "length")
  return (host.clip(self.id, clip))
end

-- Turns to a heading the shorter way: turn_to(90, {speed = degrees per second}).
function Actor:turn_to(degrees, options)
  options = options_of(options, "turn_to")
  local target = math.rad(number({ degrees = degrees }, "degrees", nil, "turn_to"))
  local speed = math.rad(number(options, "speed", TURN_SPEED, "turn_to"))
  if speed <= 0 then
    error("turn_to: speed must be more than 0", 2)
  end
  local _, _, _, from = host.pose(self.id)
  local turn = (target - from + math.pi) % (2 * math.pi) - math.pi
  local begin, duration = host.time(), math.abs(turn) / speed
  while host.time() - begin < duration - ROUNDING do
    local x, y, z = host.pose(self.id)
    host.place(self.id, x, y, z, from + turn * (host.time() - begin) / duration)
    host.wait(0)
  end
  local x, y, z = host.pose(self.id)
  host.place(self.id, x, y, z, target)
end

-- Plays what was played before, or "idle", when a walk ends, however it ends.
local function after_walk(self, before)
  if not before or before == "walk" then
    before = "idle"
  end
  return setmetatable({}, {
    __close = function()
      if host.clip(self.id, before) then
        host.play(self.id, before, FADE, 1)
      end
    end,
  })
end

-- Walks in a straight line: {x=, z=, speed = metres per second}. Without speed it
-- is that of the clip "walk"; with one the clip plays faster or slower, so that
-- the feet do not slide.
function Actor:move_to(target)
  target = options_of(target, "move_to")
  local x0, y0, z0, heading = host.pose(self.id)
  local x1, z1 = number(target, "x", x0, "move_to"), number(target, "z", z0, "move_to")
  local dx, dz = x1 - x0, z1 - z0
  local distance = math.sqrt(dx * dx + dz * dz)
  if distance == 0 then
    return
  end
  local duration, stride = host.clip(self.id, "walk")
  local natural = duration and duration > 0 and stride > 0 and stride / duration or nil
  local speed = number(target, "speed", natural or 1.2, "move_to")
  if speed <= 0 then
    error("move_to: speed must be more than 0", 2)
  end
  heading = math.atan(-dx, -dz)
  self:turn_to(math.deg(heading))
  local walk <close> = after_walk(self, host.playing(self.id))
  if duration then
    host.play(self.id, "walk", FADE, natural and speed / natural or 1)
  end
  local begin, walk_time = host.time(), distance / speed
  while host.time() - begin < walk_time - ROUNDING do
    local done = (host.time() - begin) / walk_time
    host.place(self.id, x0 + done * dx, y0, z0 + done * dz, heading)
    host.wait(0)
  end
  host.place(self.id, x1, y0, z1, heading)
end
