-- Tracks: the declarative part of a drama, with fixed times. The editor's timeline shows and edits
-- it.

local host = ...

local FADE = 0.3 -- Seconds.

local function fail(where, problem)
  error("track: " .. where .. ": " .. problem, 3)
end

local function number(entry, where, key, default, least)
  local value = entry[key]
  if value == nil then
    value = default
  end
  if type(value) ~= "number" or not (value >= least and value <= 1e6) then
    fail(where, key .. " must be a number of at least " .. least)
  end
  return value
end

-- Reads a point {x=, y=, z=}; missing values are those of `default`.
local function point(value, where, key, default)
  if value == nil then
    return default
  end
  if type(value) ~= "table" then
    fail(where, key .. " must be a point like {x = 1, z = -2}")
  end
  return {
    x = number(value, where, "x", default.x, -1e6),
    y = number(value, where, "y", default.y, -1e6),
    z = number(value, where, "z", default.z, -1e6),
  }
end

-- Adds the clips that lead an actor with this name and id.
local function lead(clips, name, id)
  local position, heading, time = { x = 0, y = 0, z = 0 }, 0, 0
  for index, entry in ipairs(clips) do
    local where = "clips[" .. index .. "]"
    if type(entry) ~= "table" then
      fail(where, "must be a table like {at = 0, length = 4, clip = \"idle\"}")
    end
    local at = number(entry, where, "at", nil, 0)
    local length = number(entry, where, "length", nil, 0)
    local fade = number(entry, where, "fade", FADE, 0)
    if at < time then
      fail(where, "begins before the entry before it has ended")
    end
    if at > time and index > 1 and host.clip(id, "idle") then
      host.segment(id, time, 0, "idle", 1, FADE, position, position, heading)
    end
    local duration, stride = host.clip(id, entry.clip)
    if not duration then
      fail(where, "the actor '" .. name .. "' has no clip '" .. tostring(entry.clip) .. "'")
    end
    local from = point(entry.from, where, "from", position)
    local to = point(entry.to, where, "to", from)
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
      heading = math.rad(number(entry, where, "heading", nil, -1e6))
    end
    host.segment(id, at, length, entry.clip, rate, fade, from, to, heading, entry.ease)
    position, time = to, at + length
  end
  if time > 0 and host.clip(id, "idle") then
    host.segment(id, time, 0, "idle", 1, FADE, position, position, heading)
  end
end

-- Lanes that lua/std plays: the functions that start and end an item.
local by_words = {}

-- Registers the functions for a lane: begin(item) at its time, stop(item) at its end.
function host.play_lane(name, begin, stop)
  by_words[name] = { begin = begin, stop = stop }
end

local function by_time(a, b)
  return a.at < b.at
end

-- Plays the items of a lane in the order of their times.
local function play(name, items)
  local lane = by_words[name]
  local sorted = {}
  for index, item in ipairs(items) do
    local where = name .. "[" .. index .. "]"
    if type(item) ~= "table" then
      fail(where, "write an item {at = 0, ...} here")
    end
    number(item, where, "at", nil, 0)
    number(item, where, "length", 0, 0)
    sorted[index] = item
  end
  table.sort(sorted, by_time)
  start(function()
    for _, item in ipairs(sorted) do
      host.wait_until(item.at)
      start(function()
        lane.begin(item)
        if lane.stop and item.length then
          host.wait(item.length)
          lane.stop(item)
        end
      end)
    end
  end)
end

host.play_lane("lights", function(item)
  light(item.light):set(item)
end, function(item)
  light(item.light):set{ level = 1, seconds = item.seconds, ease = item.ease }
end)

-- Options of an item's sound: on an actor or an object, at a point, or all around.
local function source(item)
  local on = item.actor and actor(item.actor) or item.object and object(item.object) or nil
  return { on = on, at = item.from, gain = item.gain, loop = item.loop, fade = item.fade,
    ease = item.ease }
end

host.play_lane("sounds", function(item)
  sound(item.sound):play(source(item))
end, function(item)
  sound(item.sound):stop(item.fade)
end)

host.play_lane("descriptions", function(item)
  describe(item.line, item)
end)

-- Lanes that the host plays, in this order.
local by_host = host.lanes()

local known = { actor = true, clips = true }
for _, name in ipairs(by_host) do
  known[name] = true
end

-- Declares lanes of items: track{actor = "keeper", speech = {{at = 2, line = "salvete"}}, ...}.
-- Each item has a time `at`, in seconds of the drama, and may have a length, an id and an ease.
-- Lanes of an actor are clips, which lead its whole body, or gestures, speech, walks, uses, gaze
-- and expressions. Lanes of the stage are lights, sounds, captions, descriptions and markers.
function track(spec)
  if type(spec) ~= "table" then
    error("track: give {actor = name, speech = {...}}", 2)
  end
  for key, items in pairs(spec) do
    if not known[key] and not by_words[key] then
      error("track: there is no lane '" .. tostring(key) .. "'", 2)
    elseif key ~= "actor" and type(items) ~= "table" then
      error("track: " .. key .. " must be a list of items {at = 0, ...}", 2)
    end
  end
  local name = type(spec.actor) == "table" and spec.actor.name or spec.actor
  local id = type(name) == "string" and host.actor(name)
  if spec.actor ~= nil and not id then
    error("track: there is no '" .. tostring(name) .. "' in the cast", 2)
  end
  if spec.clips then
    if not id then
      error("track: clips need an actor", 2)
    end
    lead(spec.clips, name, id)
  end
  for _, lane in ipairs(by_host) do
    if spec[lane] then
      host.lane(lane, id or nil, spec[lane])
    end
  end
  for lane in pairs(by_words) do
    if spec[lane] then
      play(lane, spec[lane])
    end
  end
end
