-- Time, tasks that run at the same time, and triggers. Each function given to start, together or
-- race becomes a task of its own.

local host = ...

local function check_function(value, name)
  if type(value) ~= "function" then
    error(name .. ": give functions, not a " .. type(value), 3)
  end
end

local function check_seconds(value, name)
  if type(value) ~= "number" or not (value >= -86400 and value <= 86400) then
    error(name .. ": give a number of seconds", 3)
  end
end

-- Sets options of the whole drama while the script loads. {when_lost = "hold"}: time stops while
-- tracking is lost for longer than {patience = seconds}; "go_on": time continues. {length =
-- seconds}: the end of the story; the drama may continue after it.
function drama(settings)
  if type(settings) ~= "table" then
    error("drama: give a table like {when_lost = \"hold\"}", 2)
  end
  local lost = settings.when_lost or "go_on"
  if lost ~= "hold" and lost ~= "go_on" then
    error("drama: when_lost is \"hold\" or \"go_on\"", 2)
  end
  local patience = settings.patience or 1
  check_seconds(patience, "drama")
  local length = settings.length or 0
  if type(length) ~= "number" or not (length >= 0 and length <= 86400) then
    error("drama: length is a number of seconds from 0 to 86400", 2)
  end
  host.configure(lost == "hold", patience, length)
end

-- Returns the seconds since the drama began.
function now()
  return host.time()
end

-- Suspends the calling task for a number of seconds.
function wait(seconds)
  if type(seconds) ~= "number" or not (seconds >= 0 and seconds <= 86400) then
    error("wait: give a number of seconds from 0 to 86400", 2)
  end
  host.wait(seconds)
end

-- The result of start: a running task, to wait for or to stop.
local Handle = {}
Handle.__index = Handle
Handle.__metatable = false
Handle.__tostring = function()
  return "task"
end

-- Runs f in a task of its own, with the further arguments. The handle has handle:stop() and
-- handle:is_over(), and can be given to wait_for, at and after.
function start(f, ...)
  check_function(f, "start")
  local run = f
  if select("#", ...) > 0 then
    local given = table.pack(...)
    run = function()
      f(table.unpack(given, 1, given.n)) -- No tail call: errors refer to this level.
    end
  end
  return setmetatable({ task = host.start(run) }, Handle)
end

-- Ends the task. No effect if it has already ended.
function Handle:stop()
  host.stop(self.task)
end

-- Returns whether the task has ended.
function Handle:is_over()
  return (host.outcome(self.task))
end

-- Stops every task of a list when its owner ends or is stopped.
local owned = {
  __close = function(tasks)
    for _, task in ipairs(tasks) do
      host.stop(task)
    end
  end,
}

local function start_all(name, ...)
  local tasks = setmetatable({}, owned)
  for i = 1, select("#", ...) do
    local f = select(i, ...)
    check_function(f, name)
    tasks[i] = host.start(f)
  end
  return tasks
end

-- Runs all functions at the same time and waits for all of them. Returns true, or false and the
-- error if one of them failed.
function together(...)
  local tasks <close> = start_all("together", ...)
  host.join(tasks, false)
  for _, task in ipairs(tasks) do
    local _, done, why = host.outcome(task)
    if not done then
      return false, why
    end
  end
  return true
end

local fails_again = {
  __close = function(self)
    host.attempt(self.number)
  end,
}

-- Runs f. Tasks of actors in it may fail without a message to the author. Returns true, or false
-- and the error.
function attempt(f, ...)
  check_function(f, "attempt")
  local guard <close> = setmetatable({ number = host.attempt() }, fails_again)
  return pcall(f, ...)
end

-- Runs all functions at the same time, waits for the first to end and stops the others. Returns the
-- number of that function, from 1.
function race(...)
  local tasks <close> = start_all("race", ...)
  if #tasks == 0 then
    return
  end
  host.join(tasks, true)
  for i, task in ipairs(tasks) do
    if host.outcome(task) then
      return i
    end
  end
end

-- ---- triggers ---------------------------------------------------------------

local Trigger = {}
Trigger.__index = Trigger
Trigger.__metatable = false
Trigger.__tostring = function(self)
  return "trigger '" .. self.kind .. "'"
end

-- For other files of lua/std: makes a trigger of a kind with its parameters.
function host.make_trigger(kind, spec)
  spec.kind = kind
  spec.is_trigger = true
  return setmetatable(spec, Trigger)
end

local drops = {
  __close = function(self)
    for _, id in ipairs(self) do
      host.drop_trigger(id)
    end
  end,
}

local function arm(trigger)
  local target = trigger.target or { "none" }
  return host.trigger(trigger.kind, trigger.metres or 0, trigger.leave or 0, trigger.angle or 0,
    trigger.seconds or 0, trigger.text or "", table.unpack(target))
end

-- A trigger: a number of seconds has passed since the wait for it began.
function timeout(seconds)
  check_seconds(seconds, "timeout")
  return host.make_trigger("timeout", { seconds = seconds })
end

-- A trigger. "lost": tracking of the visitor's camera has been lost for some seconds (0.5); "back":
-- tracking works again.
function tracking(state, seconds)
  if state ~= "lost" and state ~= "back" then
    error("tracking: give \"lost\" or \"back\"", 2)
  end
  seconds = seconds or 0.5
  check_seconds(seconds, "tracking")
  return host.make_trigger(state, { seconds = seconds })
end

-- A trigger: a key of the keyboard is pressed, such as "space", "a" or "enter".
function key(name)
  if type(name) ~= "string" then
    error("key: give the name of a key", 2)
  end
  return host.make_trigger("key", { text = name })
end

-- Encodes a number, true, false or a text as an argument of a message.
local function argument_of(value)
  if math.type(value) == "integer" then
    return string.format("%d", value)
  elseif type(value) == "number" then
    return string.format("%.9g", value)
  elseif type(value) == "boolean" then
    return value and "T" or "F"
  elseif type(value) == "string" then
    return "'" .. value:gsub("[^%w_.-]", function(c)
      return string.format("%%%02X", c:byte())
    end)
  end
  error("osc: give a number, a text, true or false", 3)
end

-- A trigger: a message of another program arrives (Open Sound Control), with any arguments or with
-- this first argument: osc("/door/open"), osc("/door/open", 1).
function osc(address, value)
  if type(address) ~= "string" or not address:match("^/[^%s,]+$") then
    error("osc: give an address like \"/door/open\"", 2)
  end
  local text = address
  if value ~= nil then
    text = text .. "," .. argument_of(value)
  end
  return host.make_trigger("message", { text = text })
end

-- Returns the arguments of the last message with this address; nothing if there was none.
function heard(address)
  return host.heard(address)
end

-- A trigger: the local time of day is reached: clock("9:30").
function clock(time)
  local hour, minute = tostring(time):match("^(%d%d?):(%d%d)$")
  hour, minute = tonumber(hour), tonumber(minute)
  if not hour or hour > 23 or minute > 59 then
    error("clock: give a time like \"9:30\"", 2)
  end
  return host.make_trigger("clock", { seconds = hour * 3600 + minute * 60 })
end

-- A trigger: the timeline passes a marker of track{markers = {{at = 10, name = "noon"}}}.
function marker(name)
  if type(name) ~= "string" then
    error("marker: give the name of a marker", 2)
  end
  return host.make_trigger("marker", { text = name })
end

-- Runs f each time that a trigger fires, but not while f is still running. Stop it with the handle.
function on(trigger, f)
  if type(trigger) ~= "table" or not trigger.is_trigger then
    error("on: give a trigger like visitor:near(\"keeper\", 2)", 2)
  end
  check_function(f, "on")
  local id = arm(trigger)
  return start(function()
    local guard <close> = setmetatable({ id }, drops)
    while true do
      host.await_fired({ id }, { host.fired(id) })
      local tasks <close> = start_all("on", f)
      host.join(tasks, false)
    end
  end)
end

-- Waits for the first of several triggers. Returns its number, from 1.
function first(...)
  local armed <close> = setmetatable({}, drops)
  local counts = {}
  for i = 1, select("#", ...) do
    local trigger = select(i, ...)
    if type(trigger) ~= "table" or not trigger.is_trigger then
      error("first: give triggers like visitor:near(\"keeper\", 2)", 2)
    end
    armed[i] = arm(trigger)
    counts[i] = 0
  end
  if #armed == 0 then
    return
  end
  host.await_fired(armed, counts)
  for i, id in ipairs(armed) do
    if host.fired(id) > 0 then
      return i
    end
  end
end

-- ---- points of a task ---------------------------------------------------------

-- Waits until a started task reaches a point of its first action: "start", "ready", "stroke_start",
-- "stroke", "stroke_end", "relax", or "end" (the default, the end of the whole task). seconds is
-- added to that time. It may be negative for gestures and speech, whose points are known in
-- advance. Also waits for a trigger. Returns true, or false and the error if the task has failed.
function wait_for(what, point, seconds)
  if type(what) == "table" and what.is_trigger then
    first(what)
    return true
  end
  if type(what) ~= "table" or not what.task then
    error("wait_for: give what start gave, or a trigger", 2)
  end
  seconds = seconds or 0
  check_seconds(seconds, "wait_for")
  host.await_point(what.task, point or "end", seconds)
  local over, done, why = host.outcome(what.task)
  if over and not done then
    return false, why
  end
  return true
end

-- Runs f when a task reaches a point, or some seconds later: at(line, "stroke", f), at(line,
-- "stroke", 0.2, f). Does not run it if the task fails before.
function at(handle, point, seconds, f)
  if f == nil then
    seconds, f = 0, seconds
  end
  check_function(f, "at")
  return start(function()
    if wait_for(handle, point, seconds) then
      f()
    end
  end)
end

-- Runs f when a task has ended without an error.
function after(handle, f)
  check_function(f, "after")
  return at(handle, "end", 0, f)
end

local points = {
  start = 1,
  ready = 2,
  stroke_start = 3,
  stroke = 4,
  stroke_end = 5,
  relax = 6,
  ["end"] = 7,
}

-- Runs gestures and speech of several actors so that their points coincide: meet("stroke", {keeper,
-- "gesture", "wave"}, {guest, "say", "salvete"}). Each may name another point: {guest, "say",
-- "salvete", point = "end"}. Waits for all of them.
function meet(point, ...)
  local delays, latest = {}, 0
  local acts = { ... }
  for i, act in ipairs(acts) do
    local who = type(act) == "table" and act[1]
    local index = type(act) == "table" and points[act.point or point]
    if type(who) ~= "table" or not index or (act[2] ~= "gesture" and act[2] ~= "say") then
      error("meet: give a point and things like {keeper, \"gesture\", \"wave\"}", 2)
    end
    if not who.is_actor then
      error("meet: give an actor", 2)
    end
    delays[i] = select(index, host.foretell(who.id, act[2], act[3]))
    latest = math.max(latest, delays[i])
  end
  local all = {}
  for i, act in ipairs(acts) do
    all[i] = function()
      host.wait(latest - delays[i])
      act[1][act[2]](act[1], act[3], act[4])
    end
  end
  return together(table.unpack(all))
end
