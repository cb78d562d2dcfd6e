-- Tracks: what an actor does, written down against the drama's time, so that a
-- curator can jump to any moment of it.

local host = ...

local FADE = 0.3 -- seconds

local function fail(index, problem)
  error("track: clips[" .. index .. "]: " .. problem, 3)
end

local function number(entry, index, key, default, least)
  local value = entry[key]
  if value == nil then
    value = default
  end
  if type(value) ~= "number" or not (value >= least and value <= 1e6) then
    fail(index, key .. " must be a number of at least " .. least)
  end
  return value
end

-- A point {x=, y=, z=}; what is left out is as in `default`.
local function point(value, index, key, default)
  if value == nil then
    return default
  end
  if type(value) ~= "table" then
    fail(index, key .. " must be a point like {x = 1, z = -2}")
  end
  return {
    x = number(value, index, "x", default.x, -1e6),
    y = number(value, index, "y", default.y, -1e6),
    z = number(value, index, "z", default.z, -1e6),
  }
end

-- track{ actor = "keeper", clips = {
--   { at = 0, length = 4, clip = "idle", from = {x = 0, z = -2}, heading = 180 },
--   { at = 4, length = 6, clip = "walk", to = {x = 3, z = -2} },
-- } }
-- Each entry begins at a time and lasts length seconds, over which the actor
-- moves from one point to the other; then it plays "idle" until the next begins.
-- Before the first entry it is hidden. A clip that walks keeps step with the
-- motion. Left out: from is where the entry before ended, heading is that of the
-- motion, or else of the entry before; fade is 0.3 s.
function track(spec)
  if type(spec) ~= "table" or type(spec.clips) ~= "table" then
    error("track: give {actor = name, clips = {...}}", 2)
  end
  local name = type(spec.actor) == "table" and spec.actor.name or spec.actor
  local id = type(name) == "string" and host.actor(name)
  if not id then
    error("track: there is no '" .. tostring(name) .. "' in the cast", 2)
  end
  local position, heading, time = { x = 0, y = 0, z = 0 }, 0, 0
  for index, entry in ipairs(spec.clips) do
    if type(entry) ~= "table" then
      fail(index, "must be a table like {at = 0, length = 4, clip = \"idle\"}")
    end
    local at = number(entry, index, "at", nil, 0)
    local length = number(entry, index, "length", nil, 0)
    local fade = number(entry, index, "fade", FADE, 0)
    if at < time then
      fail(index, "begins before the entry before it has ended")
    end
    if at > time and index > 1 and host.clip(id, "idle") then
      host.segment(id, time, 0, "idle", 1, FADE, position, position, heading)
    end
    local duration, stride = host.clip(id, entry.clip)
    if not duration then
      fail(index, "the actor '" .. name .. "' has no clip '" .. tostring(entry.clip) .. "'")
    end
    local from = point(entry.from, index, "from", position)
    local to = point(entry.to, index, "to", from)
    local dx, dz = to.x - from.x, to.z - from.z
    local distance = math.sqrt(dx * dx + dz * dz)
    local rate = 1
    if distance > 0 then
      heading = math.atan(-dx, -dz)
      if stride > 0 and length > 0 and duration > 0 then
        rate = distance / length / (stride / duration)
      end
    end
    if entry.heading ~= nil then
      heading = math.rad(number(entry, index, "heading", nil, -1e6))
    end
    host.segment(id, at, length, entry.clip, rate, fade, from, to, heading)
    position, time = to, at + length
  end
  if time > 0 and host.clip(id, "idle") then
    host.segment(id, time, 0, "idle", 1, FADE, position, position, heading)
  end
end
