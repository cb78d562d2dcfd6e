---@meta

-- Made by lua/library/make.py of lua/std; not run. For the Lua language server:
-- "workspace.library": ["lua/library"].

---Returns the actor of this name in the cast. It is hidden until it is placed or shown.
---@param name string
---@return Actor
function actor(name) end

---@class Actor
local Actor = {}

---Places the actor at once and shows it: {x=, y=, z=, heading=}. Missing values do not change.
---@param target Actor|Object|string|table|boolean
function Actor:place(target) end

function Actor:show() end

function Actor:hide() end

---Returns the position and heading of the actor: {x=, y=, z=, heading=}.
---@return table
function Actor:where() end

---Plays a clip of the actor from now on: {fade = seconds, rate = 1}. Without a clip the body moves
---by itself.
---@param clip string
---@param options? table
function Actor:play(clip, options) end

---Returns the duration of a clip of the actor in seconds.
---@param clip string
---@return number
function Actor:length(clip) end

---Turns to a heading in degrees, the shorter way: turn_to(90, {speed = degrees per second}).
---@param degrees number
---@param options? table
function Actor:turn_to(degrees, options) end

---Walks to {x=, z=, heading=, speed = metres per second}, around obstacles and other people. If the
---place cannot be reached, the actor walks to the nearest place, the author gets a message, and the
---result is false.
---@param target Actor|Object|string|table|boolean
---@return boolean
function Actor:walk_to(target) end

---Does an action with an object: use("jar", "open", {seconds = minimum duration}). Without an
---action, the first one of the object. The actor walks there and waits for its turn. The function
---returns when the action is done.
---@param thing Object|string
---@param action string
---@param options? table
function Actor:use(thing, action, options) end

---Takes an object and carries it from now on.
---@param thing Object|string
function Actor:take(thing) end

---Puts down an object that the actor carries: put("cup", "table"), put("cup", "table", "top"), or
---on the floor: put("jar", {x = 1, z = -2, heading = 0}).
---@param thing Object|string
---@param where Object|string|table
---@param surface? string
function Actor:put(thing, where, surface) end

---Gives an object that the actor carries to another actor.
---@param thing Object|string
---@param to Actor|string
function Actor:give(thing, to) end

---Sits down on an object and stays until stand() or until the actor has to leave. While it sits, it
---can use what it holds, and take and put what is in reach.
---@param thing Object|string
---@param action string
function Actor:sit(thing, action) end

function Actor:stand() end

---Looks at an actor, an object, the name of one, "visitor" or a point {x=, y=, z=}. With false, the
---actor looks straight ahead; without a target, it chooses one itself.
---@param target Actor|Object|string|table|boolean
function Actor:look_at(target) end

---Sets whether the actor chooses what to look at when look_at() has not set a target:
---attention(false).
---@param on? boolean
function Actor:attention(on) end

---Shows an expression: joy, sadness, anger, fear, disgust, surprise or neutral. The intensity is 0
---to 1, fade is in seconds, and ease is linear, in, out or smooth.
---@param expression? string
---@param intensity? number
---@param fade? number
---@param ease? string
function Actor:express(expression, intensity, fade, ease) end

---Says a line of the project in the language of the show. Waits until the line has ended.
---@param line string
function Actor:say(line) end

---Plays a clip once on a part of the body ("upper", "arms", "head", "whole") while the rest
---continues. Waits until the clip has ended.
---@param clip string
---@param part? string
function Actor:gesture(clip, part) end

---Sets how the actor walks, with factors of a healthy adult's walk (1): {cadence=, step_width=,
---arm_swing=, sway=, lift=}, and with angles (0 by default): {stoop = degrees, arm_spread =
---degrees}. Or by a style: gait("tired"). Styles are normal, child, stout, old, tired, proud,
---hurried.
---@param style? table|string
function Actor:gait(style) end

---@class Daylight
daylight = {}

---Changes the time of day to hours from 0 to 24, at once or within {seconds =}.
---@param hours number
---@param options? table
function daylight:set_time(hours, options) end

---Returns the time of day in hours, or nil if none was set.
---@return number?
function daylight:time() end

---Returns the lights of an object, such as embers or a flame. Takes the object or its name.
---@param target Actor|Object|string|table|boolean
---@return Light
function light(target) end

---@class Light
local Light = {}

---Changes the lights: {level =, seconds =, ease =, colour = {r, g, b}, temperature = kelvin}. level
---is a factor of the intensity in the object's file (0: off) and is reached within seconds. Missing
---values do not change. A light burns only in the states that its file names.
---@param options? table
function Light:set(options) end

---Returns the present level; 1 is the intensity in the object's file.
---@return number
function Light:level() end

---Returns the object of this name on the stage.
---@param name string
---@return Object
function object(name) end

---@class Object
local Object = {}

---Places the object at once, also out of an actor's hands: {x=, y=, z=, heading=}, where missing
---values do not change; or {on = other object, surface = name, spot = 1}.
---@param target Actor|Object|string|table|boolean
function Object:place(target) end

---Returns the position and heading of the object: {x=, y=, z=, heading=}.
---@return table
function Object:where() end

function Object:show() end

function Object:hide() end

---Returns the name of the object's state.
---@return string
function Object:state() end

---Changes the state of the object at once, without an actor.
---@param state string
function Object:set_state(state) end

---Returns the actor who holds the object, or nil.
---@return Actor?
function Object:holder() end

---Returns the sound of this name: audio/NAME.wav (.flac, .ogg, .opus) of the project, or a built-in
---one.
---@param name string
---@return Sound
function sound(name) end

---@class Sound
local Sound = {}

---Starts the sound: play{at = {x=, y=, z=}} at a place, play{on = actor or object} with an actor or
---object, play() all around the visitor. gain: decibels. loop = true: until it is stopped. fade:
---fade-in in seconds, with an ease. Does not wait for the end of the sound.
---@param options? table
function Sound:play(options) end

---Stops all playbacks of the sound, with a fade-out in seconds.
---@param fade? number
function Sound:stop(fade) end

---Returns the length of the sound in seconds.
function Sound:length() end

---Plays a line of the audio description for visitors who have switched it on. The speaker of the
---line must be "description". It is said in the next pause of the speech, or not at all if that
---takes longer than patience (5 s). Does not wait: the drama is the same for all visitors.
---@param line string
---@param options? table
function describe(line, options) end

---Sets options of the whole drama while the script loads. {when_lost = "hold"}: time stops while
---tracking is lost for longer than {patience = seconds}; "go_on": time continues. {length =
---seconds}: the end of the story; the drama may continue after it.
---@param settings table
function drama(settings) end

---Returns the seconds since the drama began.
---@return number
function now() end

---Suspends the calling task for a number of seconds.
---@param seconds? number
function wait(seconds) end

---Runs f in a task of its own, with the further arguments. The handle has handle:stop() and
---handle:is_over(), and can be given to wait_for, at and after.
---@param f function
---@param ... any
---@return Handle
function start(f, ...) end

---@class Handle
local Handle = {}

---Ends the task. No effect if it has already ended.
function Handle:stop() end

---Returns whether the task has ended.
---@return boolean
function Handle:is_over() end

---Runs all functions at the same time and waits for all of them. Returns true, or false and the
---error if one of them failed.
---@param ... any
---@return boolean, string?
function together(...) end

---Runs f. Tasks of actors in it may fail without a message to the author. Returns true, or false
---and the error.
---@param f function
---@param ... any
---@return boolean, string?
function attempt(f, ...) end

---Runs all functions at the same time, waits for the first to end and stops the others. Returns the
---number of that function, from 1.
---@param ... any
---@return integer
function race(...) end

---A trigger: a number of seconds has passed since the wait for it began.
---@param seconds? number
---@return Trigger
function timeout(seconds) end

---A trigger. "lost": tracking of the visitor's camera has been lost for some seconds (0.5); "back":
---tracking works again.
---@param state string
---@param seconds? number
---@return Trigger
function tracking(state, seconds) end

---A trigger: a key of the keyboard is pressed, such as "space", "a" or "enter".
---@param name string
---@return Trigger
function key(name) end

---A trigger: a message of another program arrives (Open Sound Control), with any arguments or with
---this first argument: osc("/door/open"), osc("/door/open", 1).
---@param address string
---@param value? number|string|boolean
---@return Trigger
function osc(address, value) end

---Returns the arguments of the last message with this address; nothing if there was none.
---@param address string
---@return any ...
function heard(address) end

---A trigger: the local time of day is reached: clock("9:30").
---@param time string
---@return Trigger
function clock(time) end

---A trigger: the timeline passes a marker of track{markers = {{at = 10, name = "noon"}}}.
---@param name string
---@return Trigger
function marker(name) end

---Runs f each time that a trigger fires, but not while f is still running. Stop it with the handle.
---@param trigger Trigger
---@param f function
---@return Handle
function on(trigger, f) end

---Waits for the first of several triggers. Returns its number, from 1.
---@param ... any
---@return integer
function first(...) end

---Waits until a started task reaches a point of its first action: "start", "ready", "stroke_start",
---"stroke", "stroke_end", "relax", or "end" (the default, the end of the whole task). seconds is
---added to that time. It may be negative for gestures and speech, whose points are known in
---advance. Also waits for a trigger. Returns true, or false and the error if the task has failed.
---@param what Handle|Trigger
---@param point? string
---@param seconds? number
---@return boolean, string?
function wait_for(what, point, seconds) end

---Runs f when a task reaches a point, or some seconds later: at(line, "stroke", f), at(line,
---"stroke", 0.2, f). Does not run it if the task fails before.
---@param handle Handle
---@param point? string
---@param seconds? number
---@param f function
---@return Handle
function at(handle, point, seconds, f) end

---Runs f when a task has ended without an error.
---@param handle Handle
---@param f function
---@return Handle
function after(handle, f) end

---Runs gestures and speech of several actors so that their points coincide: meet("stroke", {keeper,
---"gesture", "wave"}, {guest, "say", "salvete"}). Each may name another point: {guest, "say",
---"salvete", point = "end"}. Waits for all of them.
---@param point? string
---@param ... any
---@return boolean, string?
function meet(point, ...) end

---Declares lanes of items: track{actor = "keeper", speech = {{at = 2, line = "salvete"}}, ...}.
---Each item has a time `at`, in seconds of the drama, and may have a length, an id and an ease.
---Lanes of an actor are clips, which lead its whole body, or gestures, speech, walks, uses, gaze
---and expressions. Lanes of the stage are lights, sounds, captions, descriptions and markers.
---@param spec table
function track(spec) end

---@class Visitor
visitor = {}

---Returns the last known position of the visitor's eyes and the heading: {x=, y=, z=, heading=}.
---@return table
function visitor:where() end

---Returns whether the visitor's camera is tracked.
---@return boolean
function visitor:is_here() end

---Returns the distance on the floor to an actor, an object or a point in metres; nil if unknown.
---@param target Actor|Object|string|table|boolean
---@return number?
function visitor:distance(target) end

---A trigger: the visitor comes within some metres (1.5) of an actor, an object or a point. Fires
---again after the visitor was further away than {leave = metres} (20 % more).
---@param target Actor|Object|string|table|boolean
---@param metres? number
---@param options? table
---@return Trigger
function visitor:near(target, metres, options) end

---A trigger: after having been within some metres (1.5), the visitor goes beyond {leave = metres}.
---@param target Actor|Object|string|table|boolean
---@param metres? number
---@param options? table
---@return Trigger
function visitor:leaves(target, metres, options) end

---A trigger: the visitor looks within {angle = degrees} (8) of an actor, an object or a point for
---{seconds = 0.7}. Fires again after the visitor has looked elsewhere.
---@param target Actor|Object|string|table|boolean
---@param options? table
---@return Trigger
function visitor:looks_at(target, options) end

---A trigger: after having looked at the target, the visitor looks elsewhere for {seconds = 2}.
---@param target Actor|Object|string|table|boolean
---@param options? table
---@return Trigger
function visitor:looks_away(target, options) end

---A trigger: the visitor stays within {metres = 0.7} for some seconds (5), anywhere or {at =
---target}.
---@param seconds? number
---@param options? table
---@return Trigger
function visitor:stays(seconds, options) end

---Turns to an actor, an object, "visitor" or a point.
---@param target Actor|Object|string|table|boolean
---@param options? table
function Actor:face(target, options) end

---Greets the visitor: turns to them, looks at them and smiles. {say = line, gesture = clip,
---expression = "joy", turn = true}. Afterwards the actor chooses itself what to look at.
---@param options? table
function Actor:greet(options) end

---Says a line when the visitor looks at the actor within {patience = 10} seconds. Returns whether
---the visitor did. {always = true}: says the line in any case.
---@param line string
---@param options? table
---@return boolean
function Actor:address(line, options) end

---Steps aside when the visitor comes nearer than some metres (0.8), and returns when there is room
---again. Stop it with the handle.
---@param metres? number
---@return Handle
function Actor:keep_distance(metres) end
