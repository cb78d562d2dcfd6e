-- Objects that actors use. Positions are metres on the stage, headings are degrees, as for actors.

local host = ...

local Object = {}
Object.__index = Object
Object.__metatable = false
Object.__tostring = function(self)
  return "object '" .. self.name .. "'"
end

local known = {}

-- Returns the object of this name on the stage.
function object(name)
  if type(name) ~= "string" then
    error("object: give the name of an object", 2)
  end
  if not known[name] then
    local id = host.object(name)
    if not id then
      error("object: there is no object '" .. name .. "'", 2)
    end
    known[name] = setmetatable({ name = name, id = id, is_object = true }, Object)
  end
  return known[name]
end

local function number(options, key, default)
  local value = options[key]
  if value == nil then
    value = default
  end
  if type(value) ~= "number" or value ~= value or value < -1e6 or value > 1e6 then
    error("place: " .. key .. " must be a number", 3)
  end
  return value
end

-- Places the object at once, also out of an actor's hands: {x=, y=, z=, heading=}, where missing
-- values do not change; or {on = other object, surface = name, spot = 1}.
function Object:place(target)
  if type(target) ~= "table" then
    error("place: give a table like {x = 1} or {on = object(\"table\")}", 2)
  end
  if target.on ~= nil then
    local on = target.on
    if type(on) == "string" then
      on = object(on)
    end
    if type(on) ~= "table" or not on.is_object then
      error("place: on must be an object", 2)
    end
    host.place_object_on(self.id, on.id, target.surface, target.spot)
    return
  end
  local x, y, z, heading = host.object_pose(self.id)
  host.place_object(self.id, number(target, "x", x), number(target, "y", y),
    number(target, "z", z), math.rad(number(target, "heading", math.deg(heading))))
end

-- Returns the position and heading of the object: {x=, y=, z=, heading=}.
function Object:where()
  local x, y, z, heading = host.object_pose(self.id)
  return { x = x, y = y, z = z, heading = math.deg(heading) }
end

function Object:show()
  host.show_object(self.id, true)
end

function Object:hide()
  host.show_object(self.id, false)
end

-- Returns the name of the object's state.
function Object:state()
  return (host.object_state(self.id))
end

-- Changes the state of the object at once, without an actor.
function Object:set_state(state)
  if type(state) ~= "string" then
    error("set_state: give the name of a state", 2)
  end
  host.set_object_state(self.id, state)
end

-- Returns the actor who holds the object, or nil.
function Object:holder()
  local name = host.holder(self.id)
  return name and actor(name)
end
