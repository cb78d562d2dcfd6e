-- The visitor: the person who watches through the camera. Their actions can be triggers, and actors
-- can react to them.

local host = ...

local function fail(what, problem)
  error(what .. ": " .. problem, 4)
end

local function number(value, default, low, high, what, name)
  if value == nil then
    value = default
  end
  if type(value) ~= "number" or not (value >= low and value <= high) then
    fail(what, name .. " must be a number from " .. low .. " to " .. high)
  end
  return value
end

-- Converts an actor, an object, the name of one, or a point {x=, y=, z=} for the host.
local function target_of(value, what)
  if type(value) == "string" then
    local id = host.actor(value)
    if id then
      return { "actor", id }
    end
    id = host.object(value)
    if id then
      return { "object", id }
    end
    fail(what, "there is no actor or object called '" .. value .. "'")
  elseif type(value) == "table" and value.is_object then
    return { "object", value.id }
  elseif type(value) == "table" and value.is_actor then
    return { "actor", value.id }
  elseif type(value) == "table" and value.x and value.z then
    return { "point", number(value.x, nil, -1e6, 1e6, what, "x"),
      number(value.y, 1.5, -1e6, 1e6, what, "y"), number(value.z, nil, -1e6, 1e6, what, "z") }
  end
  fail(what, "give an actor, an object or a point {x = 1, z = -2}")
end

local Visitor = {}
Visitor.__index = Visitor
Visitor.__metatable = false
Visitor.__tostring = function()
  return "the visitor"
end

visitor = setmetatable({}, Visitor)

-- Returns the last known position of the visitor's eyes and the heading: {x=, y=, z=, heading=}.
function Visitor:where()
  local _, x, y, z, heading = host.visitor()
  return { x = x, y = y, z = z, heading = math.deg(heading) }
end

-- Returns whether the visitor's camera is tracked.
function Visitor:is_here()
  return (host.visitor())
end

-- Returns the distance on the floor to an actor, an object or a point in metres; nil if unknown.
function Visitor:distance(target)
  return host.distance(table.unpack(target_of(target, "distance")))
end

local function near(kind, target, metres, options)
  options = options or {}
  metres = number(metres, 1.5, 0.05, 1000, kind, "the distance")
  return host.make_trigger(kind, {
    target = target_of(target, kind),
    metres = metres,
    leave = number(options.leave, 1.2 * metres, metres, 10000, kind, "leave"),
  })
end

-- A trigger: the visitor comes within some metres (1.5) of an actor, an object or a point. Fires
-- again after the visitor was further away than {leave = metres} (20 % more).
function Visitor:near(target, metres, options)
  return near("near", target, metres, options)
end

-- A trigger: after having been within some metres (1.5), the visitor goes beyond {leave = metres}.
function Visitor:leaves(target, metres, options)
  return near("leaves", target, metres, options)
end

local function look(kind, target, options, seconds)
  options = options or {}
  return host.make_trigger(kind, {
    target = target_of(target, kind),
    angle = math.rad(number(options.angle, 8, 0.5, 90, kind, "angle")),
    seconds = number(options.seconds, seconds, 0, 3600, kind, "seconds"),
  })
end

-- A trigger: the visitor looks within {angle = degrees} (8) of an actor, an object or a point for
-- {seconds = 0.7}. Fires again after the visitor has looked elsewhere.
function Visitor:looks_at(target, options)
  return look("looks_at", target, options, 0.7)
end

-- A trigger: after having looked at the target, the visitor looks elsewhere for {seconds = 2}.
function Visitor:looks_away(target, options)
  return look("looks_away", target, options, 2)
end

-- A trigger: the visitor stays within {metres = 0.7} for some seconds (5), anywhere or {at =
-- target}.
function Visitor:stays(seconds, options)
  options = options or {}
  return host.make_trigger("stays", {
    seconds = number(seconds, 5, 0, 86400, "stays", "the time"),
    metres = number(options.metres, 0.7, 0.05, 1000, "stays", "metres"),
    target = options.at and target_of(options.at, "stays"),
  })
end

-- ---- actors who react to the visitor ----------------------------------------------

local Actor = host.actor_class

-- Returns the position x, z of a target for an actor to face.
local function place_of(actor, target, what)
  if target == "visitor" then
    local _, x, _, z = host.visitor(actor.id)
    return x, z
  end
  local kind, a, _, c = table.unpack(target_of(target, what))
  if kind == "point" then
    return a, c
  end
  local x, _, z = (kind == "actor" and host.pose or host.object_pose)(a)
  return x, z
end

-- Turns to an actor, an object, "visitor" or a point.
function Actor:face(target, options)
  local x, z = place_of(self, target, "face")
  local x0, _, z0 = host.pose(self.id)
  if x ~= x0 or z ~= z0 then
    self:turn_to(math.deg(math.atan(x0 - x, z0 - z)), options)
  end
end

-- Greets the visitor: turns to them, looks at them and smiles. {say = line, gesture = clip,
-- expression = "joy", turn = true}. Afterwards the actor chooses itself what to look at.
function Actor:greet(options)
  options = options or {}
  if type(options) ~= "table" then
    error("greet: give a table like {say = \"salvete\"}", 2)
  end
  self:look_at("visitor")
  self:express(options.expression or "joy", 0.6, 0.4)
  if options.turn ~= false then
    attempt(function()
      self:face("visitor")
    end)
  end
  together(function()
    if options.gesture then
      self:gesture(options.gesture)
    end
  end, function()
    if options.say then
      self:say(options.say)
    end
  end)
  self:express("neutral", 0, 1)
  self:look_at()
end

-- Says a line when the visitor looks at the actor within {patience = 10} seconds. Returns whether
-- the visitor did. {always = true}: says the line in any case.
function Actor:address(line, options)
  options = options or {}
  local patience = number(options.patience, 10, 0, 3600, "address", "patience")
  self:look_at("visitor")
  local looks = first(visitor:looks_at(self, { angle = 12 }), timeout(patience)) == 1
  if looks or options.always then
    self:say(line)
  end
  self:look_at()
  return looks
end

-- Steps aside when the visitor comes nearer than some metres (0.8), and returns when there is room
-- again. Stop it with the handle.
function Actor:keep_distance(metres)
  metres = number(metres, 0.8, 0.2, 5, "keep_distance", "the distance")
  return on(visitor:near(self, metres, { leave = 1.3 * metres }), function()
    local home = self:where()
    local x, z = host.aside(self.id, 1.4 * metres)
    if not x then
      return  -- No room is left.
    end
    self:look_at("visitor")
    attempt(function()
      self:walk_to{ x = x, z = z }
      self:face("visitor")
    end)
    while (visitor:distance(home) or metres) < 1.4 * metres do
      wait(0.5)
    end
    self:look_at()
    attempt(function()
      self:walk_to{ x = home.x, z = home.z, heading = home.heading }
    end)
  end)
end
