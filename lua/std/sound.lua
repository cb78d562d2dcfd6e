-- Sounds that the drama plays. The sounds of people and objects follow from their actions.

local host = ...

local Sound = {}
Sound.__index = Sound
Sound.__metatable = false
Sound.__tostring = function(self)
  return "sound '" .. self.name .. "'"
end

local known = {}

-- Returns the sound of this name: audio/NAME.wav (.flac, .ogg, .opus) of the project, or a built-in
-- one.
function sound(name)
  if type(name) ~= "string" then
    error("sound: give the name of a sound", 2)
  end
  if not known[name] then
    local id, seconds = host.sound(name)
    if not id then
      error("sound: there is no sound '" .. name .. "'; add audio/" .. name ..
        ".wav to the project", 2)
    end
    known[name] = setmetatable({ name = name, id = id, seconds = seconds, is_sound = true }, Sound)
  end
  return known[name]
end

local function number(options, key, default, least, most, word)
  local value = options[key]
  if value == nil then
    value = default
  end
  if type(value) ~= "number" or not (value >= least and value <= most) then
    error((word or "play") .. ": " .. key .. " must be a number from " .. least .. " to " .. most, 3)
  end
  return value
end

-- Starts the sound: play{at = {x=, y=, z=}} at a place, play{on = actor or object} with an actor or
-- object, play() all around the visitor. gain: decibels. loop = true: until it is stopped. fade:
-- fade-in in seconds, with an ease. Does not wait for the end of the sound.
function Sound:play(options)
  options = options or {}
  if type(options) ~= "table" then
    error("play: give a table like {at = {x = 1, z = -2}}", 2)
  end
  local gain = number(options, "gain", 0, -60, 12)
  local fade, ease = number(options, "fade", 0, 0, 1e4), options.ease or "linear"
  local loop = options.loop == true
  local on, at = options.on, options.at
  local started
  if type(on) == "table" and on.is_object then
    started = host.play_sound(self.id, loop, gain, fade, ease, "object", on.id)
  elseif type(on) == "table" and on.is_actor then
    started = host.play_sound(self.id, loop, gain, fade, ease, "actor", on.id)
  elseif on ~= nil then
    error("play: on must be an actor or an object", 2)
  elseif type(at) == "table" then
    started = host.play_sound(self.id, loop, gain, fade, ease, "point", number(at, "x", 0, -1e6, 1e6),
      number(at, "y", 1.5, -1e6, 1e6), number(at, "z", 0, -1e6, 1e6))
  elseif at ~= nil then
    error("play: at must be a point like {x = 1, z = -2}", 2)
  else
    started = host.play_sound(self.id, loop, gain, fade, ease, "listener")
  end
  if not started then
    host.warn("play: too many sounds are heard at once")
  end
end

-- Stops all playbacks of the sound, with a fade-out in seconds.
function Sound:stop(fade)
  host.stop_sound(self.id, number({ fade = fade }, "fade", 0, 0, 1e4))
end

-- Returns the length of the sound in seconds.
function Sound:length()
  return self.seconds
end

-- Plays a line of the audio description for visitors who have switched it on. The speaker of the
-- line must be "description". It is said in the next pause of the speech, or not at all if that
-- takes longer than patience (5 s). Does not wait: the drama is the same for all visitors.
function describe(line, options)
  options = options or {}
  if type(line) ~= "string" or type(options) ~= "table" then
    error("describe: give the id of a line, as in describe(\"counter\", {patience = 5})", 2)
  end
  if not host.describe(line, number(options, "patience", 5, 0, 1e4, "describe")) then
    error("describe: there is no line '" .. line .. "'; add it to lines.csv", 2)
  end
end
