---@meta

-- Made by lua/library/make.py of lua/std; not run. For the Lua language server:
-- "workspace.library": ["lua/library"].

---The actor of that name in the cast; it is hidden until it is placed or shown.
---@param name string
---@return Actor
function actor(name) end

---@class Actor
local Actor = {}

---Puts the actor somewhere at once: {x=, y=, z=, heading=}; what is left out
---stays. Shows it.
---@param target Actor|Object|string|table|boolean
function Actor:place(target) end

function Actor:show() end

function Actor:hide() end

---Where the actor is: {x=, y=, z=, heading=}.
---@return table
function Actor:where() end

---Plays a clip of the actor from now on: {fade = seconds, rate = 1}; nothing: the body
---moves by itself.
---@param clip string
---@param options? table
function Actor:play(clip, options) end

---How long a clip of the actor lasts, in seconds.
---@param clip string
---@return number
function Actor:length(clip) end

---Turns to a heading the shorter way: turn_to(90, {speed = degrees per second}).
---@param degrees number
---@param options? table
function Actor:turn_to(degrees, options) end

---Walks to {x=, z=, heading=, speed = metres per second}, around what is in the way
---and past other people. Where it cannot get there it walks as near as it can, says so
---to the author and gives false.
---@param target Actor|Object|string|table|boolean
---@return boolean
function Actor:walk_to(target) end

---Does with an object what it is for: use("jar", "open"), {seconds = at least so long};
---without an action the first that it has.
---Walks there, waits for its turn, and goes on when it is done.
---@param thing Object|string
---@param action string
---@param options? table
function Actor:use(thing, action, options) end

---Takes an object into the hands and carries it from now on.
---@param thing Object|string
function Actor:take(thing) end

---Puts down what it carries: put("cup", "table"), put("cup", "table", "top"), or on
---the floor: put("jar", {x = 1, z = -2, heading = 0}).
---@param thing Object|string
---@param where Object|string|table
---@param surface? string
function Actor:put(thing, where, surface) end

---Hands what it carries to somebody else.
---@param thing Object|string
---@param to Actor|string
function Actor:give(thing, to) end

---Sits down on an object and stays until it has to go elsewhere, or stand(): what it
---holds it uses sitting, and takes and puts what is in reach.
---@param thing Object|string
---@param action string
function Actor:sit(thing, action) end

function Actor:stand() end

---Looks at an actor, an object, the name of one, "visitor" or a point {x=, y=, z=}; false:
---straight ahead; nothing: wherever it likes.
---@param target Actor|Object|string|table|boolean
function Actor:look_at(target) end

---Whether it looks about by itself where it was not told at what: attention(false).
---@param on? boolean
function Actor:attention(on) end

---joy, sadness, anger, fear, disgust, surprise or neutral, 0 to 1, over seconds; ease: linear,
---in, out or smooth.
---@param expression? string
---@param intensity? number
---@param fade? number
---@param ease? string
function Actor:express(expression, intensity, fade, ease) end

---Says a line of the project's table, in the language of the show. Waits until it is said.
---@param line string
function Actor:say(line) end

---Plays a clip once with a part of the body ("upper", "arms", "head", "whole"), over
---whatever the rest of it does, and goes on when it is over.
---@param clip string
---@param part? string
function Actor:gesture(clip, part) end

---How it walks; what a grown healthy person does is 1: {cadence=, step_width=,
---arm_swing=, sway=, lift=}, or 0: {stoop = degrees, arm_spread = degrees}. Or a style:
---gait("tired"); normal, child, stout, old, tired, proud, hurried.
---@param style? table|string
function Actor:gait(style) end

---@class Daylight
daylight = {}

---Goes to a time of day, hours from 0 to 24, at once or over {seconds =}.
---@param hours number
---@param options? table
function daylight:set_time(hours, options) end

---The time of day in hours; nil where none was set.
---@return number?
function daylight:time() end

---The lights of an object, or of the object of that name: embers, a flame.
---@param target Actor|Object|string|table|boolean
---@return Light
function light(target) end

---@class Light
local Light = {}

---{level =, seconds =, ease =, colour = {r, g, b}, temperature = kelvin}: level is a factor of
---what the object's file says, 0 puts it out, reached in seconds; what is left out stays. A
---light burns only in the states that its file names.
---@param options? table
function Light:set(options) end

---How bright it is: 1 as its file says.
---@return number
function Light:level() end

---The object of that name on the stage.
---@param name string
---@return Object
function object(name) end

---@class Object
local Object = {}

---Puts it somewhere at once, out of whosever hands: {x=, y=, z=, heading=}, what is
---left out stays; or {on = other object, surface = name, spot = 1}.
---@param target Actor|Object|string|table|boolean
function Object:place(target) end

---Where it is: {x=, y=, z=, heading=}.
---@return table
function Object:where() end

function Object:show() end

function Object:hide() end

---The name of the state that it is in.
---@return string
function Object:state() end

---Into another state at once, without anybody's doing.
---@param state string
function Object:set_state(state) end

---The actor who has it in its hands, or nil.
---@return Actor?
function Object:holder() end

---The sound of that name: audio/NAME.wav (.flac, .ogg, .opus) of the project, or one that
---is built in.
---@param name string
---@return Sound
function sound(name) end

---@class Sound
local Sound = {}

---Begins it now, once: play{at = {x=, y=, z=}} at a place, play{on = actor or object} there
---and wherever they go, play() all around the visitor. gain: decibels. loop = true: until
---it is stopped. fade: seconds in which it comes, with an ease. Does not wait for its end.
---@param options? table
function Sound:play(options) end

---Stops it wherever it is heard; fades out over seconds.
---@param fade? number
function Sound:stop(fade) end

---Seconds.
function Sound:length() end

---Describes what is to be seen to visitors who have chosen to hear that: a line whose speaker
---is "description". It is said in the next pause of people's speech; not at all where that
---takes longer than patience (5 s). Does not wait: the drama is the same for everybody.
---@param line string
---@param options? table
function describe(line, options) end

---Settles the drama as a whole, while the script loads: {when_lost = "hold"}, time stands
---still while tracking is lost for longer than {patience = seconds}; "go_on": it runs on.
---{length = seconds}: when its story is told; life may go on after that.
---@param settings table
function drama(settings) end

---Seconds since the drama began.
---@return number
function now() end

---Lets the calling task sleep.
---@param seconds? number
function wait(seconds) end

---Runs f beside everything else, with whatever else is given. Its handle has
---handle:stop() and handle:is_over(), and can be given to wait_for, at and after.
---@param f function
---@param ... any
---@return Handle
function start(f, ...) end

---@class Handle
local Handle = {}

---Ends the task wherever it is; one that has ended is left alone.
function Handle:stop() end

---Whether the task has ended.
---@return boolean
function Handle:is_over() end

---Runs all functions at once and goes on when the last of them is done: true, or false
---and why where one of them failed.
---@param ... any
---@return boolean, string?
function together(...) end

---Runs f, in which what people do may fail without anybody hearing of it: whether all
---of it was done, and if not why.
---@param f function
---@param ... any
---@return boolean, string?
function attempt(f, ...) end

---Runs all functions at once, goes on when the first is done and stops the others: which
---one it was, counted from 1.
---@param ... any
---@return integer
function race(...) end

---So many seconds from when it is waited for.
---@param seconds? number
---@return Trigger
function timeout(seconds) end

---"lost": the visitor's camera has not been tracked for so many seconds (0.5); "back": it
---is again.
---@param state string
---@param seconds? number
---@return Trigger
function tracking(state, seconds) end

---A key of the keyboard is pressed: "space", "a", "enter", ...
---@param name string
---@return Trigger
function key(name) end

---A message of another program comes in (Open Sound Control), whatever it says or with this
---first argument: osc("/door/open"), osc("/door/open", 1).
---@param address string
---@param value? number|string|boolean
---@return Trigger
function osc(address, value) end

---What the last message of an address said: its arguments; nothing where none has come.
---@param address string
---@return any ...
function heard(address) end

---It is that time of day where the visitor is: clock("9:30").
---@param time string
---@return Trigger
function clock(time) end

---The timeline passes a marker: track{markers = {{at = 10, name = "noon"}}}.
---@param name string
---@return Trigger
function marker(name) end

---Runs f each time that something happens; not again while it runs. Until the handle that
---it gives is stopped.
---@param trigger Trigger
---@param f function
---@return Handle
function on(trigger, f) end

---Waits for the first of several triggers: which one it was, counted from 1.
---@param ... any
---@return integer
function first(...) end

---Waits until a task that was started reaches a point of the first thing that is done in
---it: "start", "ready", "stroke_start", "stroke", "stroke_end", "relax", "end" (of the whole
---task; what is left out), or so many seconds later. Also before it, where gestures and
---speech say ahead when that will be. Or waits for a trigger.
---Gives true; or false and why, where the task has failed.
---@param what Handle|Trigger
---@param point? string
---@param seconds? number
---@return boolean, string?
function wait_for(what, point, seconds) end

---Runs f when a task reaches a point, or so many seconds later: at(line, "stroke", f),
---at(line, "stroke", 0.2, f). Not where the task fails before.
---@param handle Handle
---@param point? string
---@param seconds? number
---@param f function
---@return Handle
function at(handle, point, seconds, f) end

---Runs f when a task has ended well.
---@param handle Handle
---@param f function
---@return Handle
function after(handle, f) end

---Gestures and speech of several people whose points fall together:
---meet("stroke", {keeper, "gesture", "wave"}, {guest, "say", "salvete"}). Each may have
---another point of its own: {guest, "say", "salvete", point = "end"}. Waits for all.
---@param point? string
---@param ... any
---@return boolean, string?
function meet(point, ...) end

---track{ actor = "keeper", speech = {{at = 2, line = "salvete"}}, ... }
---Lanes of items. Each item has a time `at`, in seconds of the drama, and may have a
---length, an id and an ease. Of an actor: clips that lead its whole body, or gestures,
---speech, walks, uses, gaze, expressions; of the stage: lights, sounds, captions, descriptions,
---markers.
---@param spec table
function track(spec) end

---@class Visitor
visitor = {}

---Where their eyes are and where they look: {x=, y=, z=, heading=}, as last known.
---@return table
function visitor:where() end

---Whether they are known to be there: the camera is tracked.
---@return boolean
function visitor:is_here() end

---Metres on the floor from somebody or something; nil while nobody knows.
---@param target Actor|Object|string|table|boolean
---@return number?
function visitor:distance(target) end

---They come within so many metres (1.5) of somebody or something; again once they were
---further than {leave = metres} (a fifth more).
---@param target Actor|Object|string|table|boolean
---@param metres? number
---@param options? table
---@return Trigger
function visitor:near(target, metres, options) end

---They go away, having been within so many metres (1.5), further than {leave = metres}.
---@param target Actor|Object|string|table|boolean
---@param metres? number
---@param options? table
---@return Trigger
function visitor:leaves(target, metres, options) end

---They look within {angle = degrees} (8) of somebody or something for {seconds = 0.7};
---again once they looked elsewhere.
---@param target Actor|Object|string|table|boolean
---@param options? table
---@return Trigger
function visitor:looks_at(target, options) end

---Having looked at it they look elsewhere for {seconds = 2}.
---@param target Actor|Object|string|table|boolean
---@param options? table
---@return Trigger
function visitor:looks_away(target, options) end

---They stay for so many seconds where they are, or {at = target}, within {metres = 0.7}.
---@param seconds? number
---@param options? table
---@return Trigger
function visitor:stays(seconds, options) end

---Turns to somebody or something, "visitor" or a point.
---@param target Actor|Object|string|table|boolean
---@param options? table
function Actor:face(target, options) end

---Greets the visitor: turns to them, looks at them, smiles; {say = line, gesture = clip,
---expression = "joy", turn = true}. Then goes on looking wherever it likes.
---@param options? table
function Actor:greet(options) end

---Says a line to the visitor, once they look at it: whether they did, within {patience =
---10} seconds. {always = true}: says it in any case.
---@param line string
---@param options? table
---@return boolean
function Actor:address(line, options) end

---Steps aside whenever the visitor comes nearer than so many metres (0.8), and back to its
---place when there is room again. Until the handle that it gives is stopped.
---@param metres? number
---@return Handle
function Actor:keep_distance(metres) end
