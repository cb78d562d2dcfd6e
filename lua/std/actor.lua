-- Actors: the people of the cast. Positions are metres on the stage (x to the right, y up, -z
-- forward). Headings are degrees: 0 looks along -z, 90 along -x.

local host = ...

local Actor = {}
Actor.__index = Actor
Actor.__metatable = false
Actor.__tostring = function(self)
  return "actor '" .. self.name .. "'"
end

host.actor_class = Actor -- Used by visitor.lua.

local FADE = 0.3 -- Crossfade between clips, seconds.

local known = {}

-- Returns the actor of this name in the cast. It is hidden until it is placed or shown.
function actor(name)
  if type(name) ~= "string" then
    error("actor: give the name of a member of the cast", 2)
  end
  if not known[name] then
    local id = host.actor(name)
    if not id then
      error("actor: there is no '" .. name .. "' in the cast", 2)
    end
    known[name] = setmetatable({ name = name, id = id, is_actor = true }, Actor)
  end
  return known[name]
end

-- Returns the number in options[key], or the default. Errors blame the caller of the caller.
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
  if value and value[1] ~= nil then
    error(what .. ": " .. tostring(value[1]) .. " has no name; decimals have a point, as in {x = 0.5}", 3)
  end
  return value or {}
end

local function check_clip(self, clip, what)
  if type(clip) ~= "string" or not host.clip(self.id, clip) then
    error(what .. ": " .. tostring(self) .. " has no clip '" .. tostring(clip) .. "'", 3)
  end
end

-- Places the actor at once and shows it: {x=, y=, z=, heading=}. Missing values do not change.
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

-- Returns the position and heading of the actor: {x=, y=, z=, heading=}.
function Actor:where()
  local x, y, z, heading = host.pose(self.id)
  return { x = x, y = y, z = z, heading = math.deg(heading) }
end

-- Plays a clip of the actor from now on: {fade = seconds, rate = 1}. Without a clip the body moves
-- by itself.
function Actor:play(clip, options)
  options = options_of(options, "play")
  if clip ~= nil then
    check_clip(self, clip, "play")
  end
  local fade = number(options, "fade", FADE, "play")
  local rate = number(options, "rate", 1, "play")
  host.play(self.id, clip, fade, rate)
end

-- Returns the duration of a clip of the actor in seconds.
function Actor:length(clip)
  check_clip(self, clip, "length")
  return (host.clip(self.id, clip))
end

-- Returns the id of an object, given the object or its name.
local function object_id(value, what)
  if type(value) == "string" then
    local id = host.object(value)
    if not id then
      error(what .. ": there is no object '" .. value .. "'", 3)
    end
    return id
  end
  if type(value) ~= "table" or not value.is_object then
    error(what .. ": give an object", 3)
  end
  return value.id
end

-- Returns the id of an actor, given the actor or its name.
local function actor_id(value, what)
  if type(value) == "string" then
    local id = host.actor(value)
    if not id then
      error(what .. ": there is no '" .. value .. "' in the cast", 3)
    end
    return id
  end
  if type(value) ~= "table" or not value.is_actor then
    error(what .. ": give an actor", 3)
  end
  return value.id
end

local stops = {
  __close = function(self)
    host.stop_task(self.task)
  end,
}

-- Describes a task of an actor: its name and, if there is one, its object.
local function doing(self, what, thing, action)
  local name = type(thing) == "table" and thing.name or thing
  return { id = self.id, what = what, name = name, action = action and what .. " " .. action or what,
    began = host.time() }
end

-- Waits until a task is over. Returns how the result differs from the request, or "". If the wait
-- is stopped, the task is stopped too. Errors blame the caller of the caller.
local function await(does, task, problem)
  if not task then
    host.note_task(does.id, does.action, does.name, does.began, true, problem)
    error(does.what .. ": " .. problem, 3)
  end
  local guard <close> = setmetatable({ task = task }, stops)
  host.await(task)
  local state, message, waited = host.task(task)
  host.note_task(does.id, does.action, does.name, does.began, state ~= "done", message, waited)
  if state ~= "done" then
    error(does.what .. ": " .. message, 3)
  end
  return message
end

-- Turns to a heading in degrees, the shorter way: turn_to(90, {speed = degrees per second}).
function Actor:turn_to(degrees, options)
  options = options_of(options, "turn_to")
  local heading = math.rad(number({ degrees = degrees }, "degrees", nil, "turn_to"))
  local speed = number(options, "speed", 0, "turn_to")
  if speed < 0 then
    error("turn_to: speed must be more than 0", 2)
  end
  await(doing(self, "turn_to"), host.turn(self.id, heading, math.rad(speed)))
end

-- Walks to {x=, z=, heading=, speed = metres per second}, around obstacles and other people. If the
-- place cannot be reached, the actor walks to the nearest place, the author gets a message, and the
-- result is false.
function Actor:walk_to(target)
  target = options_of(target, "walk_to")
  local x0, _, z0 = host.pose(self.id)
  local x, z = number(target, "x", x0, "walk_to"), number(target, "z", z0, "walk_to")
  local speed = number(target, "speed", 0, "walk_to")
  if target.speed ~= nil and speed <= 0 then
    error("walk_to: speed must be more than 0", 2)
  end
  local heading = nil
  if target.heading ~= nil then
    heading = math.rad(number(target, "heading", 0, "walk_to"))
  end
  local message = await(doing(self, "walk_to"), host.walk(self.id, x, z, heading, speed))
  if message ~= "" then
    host.warn("walk_to: " .. message)
    return false
  end
  return true
end

-- Does an action with an object: use("jar", "open", {seconds = minimum duration}). Without an
-- action, the first one of the object. The actor walks there and waits for its turn. The function
-- returns when the action is done.
function Actor:use(thing, action, options)
  options = options_of(options, "use")
  local id = object_id(thing, "use")
  if action ~= nil and type(action) ~= "string" then
    error("use: give the name of an action", 2)
  end
  await(doing(self, "use", thing, action), host.use(self.id, id, action, number(options, "seconds", 0, "use")))
end

-- Takes an object and carries it from now on.
function Actor:take(thing)
  await(doing(self, "take", thing), host.take(self.id, object_id(thing, "take")))
end

-- Puts down an object that the actor carries: put("cup", "table"), put("cup", "table", "top"), or
-- on the floor: put("jar", {x = 1, z = -2, heading = 0}).
function Actor:put(thing, where, surface)
  local id = object_id(thing, "put")
  if type(where) == "table" and not where.is_object then
    local x, z = number(where, "x", nil, "put"), number(where, "z", nil, "put")
    local heading = nil
    if where.heading ~= nil then
      heading = math.rad(number(where, "heading", 0, "put"))
    end
    await(doing(self, "put", thing), host.put(self.id, id, nil, x, z, heading))
  else
    await(doing(self, "put", thing), host.put(self.id, id, object_id(where, "put"), surface))
  end
end

-- Gives an object that the actor carries to another actor.
function Actor:give(thing, to)
  await(doing(self, "give", thing), host.give(self.id, object_id(thing, "give"), actor_id(to, "give")))
end

-- Sits down on an object and stays until stand() or until the actor has to leave. While it sits, it
-- can use what it holds, and take and put what is in reach.
function Actor:sit(thing, action)
  await(doing(self, "sit", thing), host.use(self.id, object_id(thing, "sit"), action or "sit", 0))
end

function Actor:stand()
  await(doing(self, "stand"), host.stand_up(self.id))
end

-- Looks at an actor, an object, the name of one, "visitor" or a point {x=, y=, z=}. With false, the
-- actor looks straight ahead; without a target, it chooses one itself.
function Actor:look_at(target)
  local actor_named = type(target) == "string" and host.actor(target)
  local object_named = type(target) == "string" and host.object(target)
  if actor_named then
    host.look(self.id, "actor", actor_named)
  elseif object_named then
    host.look(self.id, "object", object_named)
  elseif target == nil then
    host.look(self.id, "self")
  elseif target == false then
    host.look(self.id, "nothing")
  elseif target == "visitor" then
    host.look(self.id, "visitor")
  elseif type(target) == "table" and target.is_object then
    host.look(self.id, "object", target.id)
  elseif type(target) == "table" and target.is_actor then
    host.look(self.id, "actor", target.id)
  elseif type(target) == "table" then
    host.look(self.id, "point", number(target, "x", nil, "look_at"),
      number(target, "y", 1.5, "look_at"), number(target, "z", nil, "look_at"))
  else
    error("look_at: give an actor, an object, \"visitor\", a point, false or nothing", 2)
  end
end

-- Sets whether the actor chooses what to look at when look_at() has not set a target:
-- attention(false).
function Actor:attention(on)
  host.attend(self.id, on ~= false)
end

-- Shows an expression: joy, sadness, anger, fear, disgust, surprise or neutral. The intensity is 0
-- to 1, fade is in seconds, and ease is linear, in, out or smooth.
function Actor:express(expression, intensity, fade, ease)
  local options = { intensity = intensity, fade = fade }
  if type(expression) ~= "string" then
    error("express: give the name of an expression", 2)
  end
  local strength = number(options, "intensity", 1, "express")
  if strength < 0 or strength > 1 then
    error("express: the intensity must lie between 0 and 1", 2)
  end
  host.express(self.id, expression, strength, number(options, "fade", 0.4, "express"),
    ease or "linear")
end

local falls_silent = {
  __close = function(self)
    host.say(self.id, nil)
  end,
}

-- Says a line of the project in the language of the show. Waits until the line has ended.
function Actor:say(line)
  if type(line) ~= "string" then
    error("say: give the id of a line", 2)
  end
  local duration = host.say(self.id, line)
  if not duration then
    error("say: there is no line '" .. line .. "'; add it to lines.csv", 2)
  end
  local guard <close> = setmetatable({ id = self.id }, falls_silent)
  host.wait(duration)
end

local parts = { whole = true, upper = true, arms = true, head = true }

-- Plays a clip once on a part of the body ("upper", "arms", "head", "whole") while the rest
-- continues. Waits until the clip has ended.
function Actor:gesture(clip, part)
  check_clip(self, clip, "gesture")
  part = part or "upper"
  if not parts[part] then
    error("gesture: the part must be upper, arms, head or whole", 2)
  end
  host.wait(host.gesture(self.id, clip, part))
end

local gaits = { "cadence", "step_width", "stoop", "arm_swing", "arm_spread", "sway", "lift" }

-- Sets how the actor walks, with factors of a healthy adult's walk (1): {cadence=, step_width=,
-- arm_swing=, sway=, lift=}, and with angles (0 by default): {stoop = degrees, arm_spread =
-- degrees}. Or by a style: gait("tired"). Styles are normal, child, stout, old, tired, proud,
-- hurried.
function Actor:gait(style)
  if type(style) == "string" then
    if not host.gait(self.id, style) then
      error("gait: there is no '" .. style ..
        "'; use normal, child, stout, old, tired, proud or hurried", 2)
    end
    return
  end
  style = options_of(style, "gait")
  for _, name in ipairs(gaits) do
    if style[name] ~= nil then
      local value = number(style, name, 1, "gait")
      local is_angle = name == "stoop" or name == "arm_spread"
      if value < 0 or value > (is_angle and 60 or 3) then
        error("gait: " .. name .. " is out of range", 2)
      end
      host.gait(self.id, name, is_angle and math.rad(value) or value)
    end
  end
end
