-- A morning at the thermopolium of Vetutius Placidus: about four minutes, five people.
--
--   0:00  dawn: the lamp is lit, the bread is fresh, the labourer has his first wine
--   0:30  a patrician comes in, asks what it costs and orders the dearest
--   1:25  the keeper speaks to the visitor. A visitor who looks at him or stays near is served;
--         otherwise two guests quarrel about whom to vote for
--   2:35  the patrician pays and leaves, water is carried
--   3:20  the daughter prays before the painted shrine, the keeper says farewell
--   4:00  life goes on
--
-- Actions with fixed times are in tracks, which the timeline shows. Actions that depend on
-- other actors or on the visitor are in the script.

drama{when_lost = "hold", patience = 2, length = 235}

local keeper = actor("keeper") -- Placidus
local server = actor("server") -- Ascula, who lives with him
local patrician = actor("patrician")
local labourer = actor("labourer") -- Felix
local girl = actor("girl") -- Vetutia, their daughter

-- ---- the stage -----------------------------------------------------------------------

track{
  captions = {{id = "title", at = 0.5, length = 5, line = "titulus"}},
  -- For visitors who do not see well. The script adds others where it knows of a pause.
  descriptions = {
    {at = 0, line = "d_bar"},
    {at = 9.6, line = "d_people"},
    {at = 195.5, line = "d_shrine", patience = 2},
  },
  lights = {
    -- Embers of the night before, fanned, then left alone.
    -- By day they are only a faint warm light on people beside them.
    {id = "embers", at = 0, length = 44, light = "brazier", level = 0.1},
    {id = "fanned", at = 44, length = 8, light = "brazier", level = 0.4, seconds = 6, ease = "smooth"},
    {id = "ashes", at = 52, length = 600, light = "brazier", level = 0.1, seconds = 8, ease = "smooth"},
    {id = "lamp burns up", at = 22.6, length = 6, light = "lamp", level = 1.4, seconds = 2, ease = "out"},
    {id = "lamp of the prayer", at = 198, length = 20, light = "lamp", level = 1.6, seconds = 3, ease = "smooth"},
  },
  sounds = {
    -- The street through the open door.
    {id = "the door is open", at = 8, length = 46, sound = "street", gain = -6, loop = true, from = {x = 3.4, y = 1.2, z = -0.25}},
    {id = "the street wakes", at = 160, length = 40, sound = "street", gain = -3, loop = true, from = {x = 3.4, y = 1.2, z = -0.25}},
  },
  markers = {
    {at = 50, name = "order"},
    {at = 200, name = "prayer"},
    {at = 228, name = "farewell"},
  },
}

-- ---- the beginning, with fixed times -------------------------------------------------

track{actor = "keeper",
  walks = {
    {at = 0, from = {x = 0.60, z = -1.95, heading = 180}},
    {id = "to the guest", at = 31, to = {x = 1.30, z = -1.93, heading = 180}},
  },
  uses = {
    {at = 10, object = "ladle", action = "take"},
    {at = 13.2, object = "ladle", action = "stir"},
    {at = 20, object = "ladle", action = "put", on = "counter", surface = "back"},
    {at = 23, length = 6, object = "counter", action = "wipe"},
  },
  gaze = {
    {at = 31.5, length = 18, target = "patrician"},
  },
  expressions = {
    {at = 34, length = 15, expression = "joy", intensity = 0.4, fade = 0.8, ease = "smooth"},
  },
  gestures = {{id = "the prices", at = 41, clip = "explain"}},
  speech = {
    {id = "the prices", at = 40.2, length = 7, line = "assibus"},
  },
}

track{actor = "server",
  walks = {{at = 0, from = {x = 1.45, z = -0.40, heading = 100}}},
  uses = {
    {at = 2, object = "door", action = "open"},
    {at = 9, object = "lamp", action = "take"},
    {at = 19, object = "lamp", action = "light"},
    {at = 22.6, object = "lamp", action = "put", on = "lamp_stand"},
  },
  gaze = {{at = 27, length = 6, target = "labourer"}},
  expressions = {{at = 28, length = 6, expression = "joy", intensity = 0.6, fade = 0.5}},
  gestures = {{at = 29.6, clip = "nod", part = "head"}},
  speech = {
    {at = 16, line = "lucerna"},
    {at = 23.5, line = "affer"},
    {at = 29.5, line = "non_ruent"},
  },
}

track{actor = "girl",
  walks = {{at = 0, from = {x = -0.72, z = 0.10, heading = 200}}},
  uses = {
    {at = 1, object = "brazier", action = "warm_hands"},
    {at = 11, object = "loaf", action = "take"},
    {at = 16.5, object = "loaf", action = "smell"},
    {at = 23.5, object = "loaf", action = "put", on = "counter", surface = "leg"},
  },
  gaze = {
    {at = 20, length = 5, target = "server"},
    {at = 36, length = 8, target = "patrician"},
  },
  expressions = {
    {at = 15.5, length = 8, expression = "joy", intensity = 0.7, fade = 0.5},
    {at = 36, length = 3, expression = "surprise", intensity = 0.4, fade = 0.5},
  },
  speech = {{at = 20, length = 3.2, line = "calet"}},
}

track{actor = "labourer",
  walks = {
    {at = 0, from = {x = -0.25, z = -0.44, heading = -40}},
    {id = "turns round", at = 31, to = {x = -0.45, z = -0.40, heading = -140}},
  },
  uses = {
    {at = 4, object = "beaker", action = "take"},
    {at = 9, object = "beaker", action = "drink"},
    {at = 15.5, object = "beaker", action = "drink"},
    {at = 21, object = "beaker", action = "put", on = "counter", surface = "top"},
  },
  gaze = {{at = 24.5, length = 9, target = "server"}},
  expressions = {{at = 25, length = 5, expression = "sadness", intensity = 0.4, fade = 0.8}},
  gestures = {{at = 26, clip = "shrug"}},
  speech = {{at = 25.5, length = 6, line = "laboro"}},
}

track{actor = "patrician",
  walks = {
    {at = 0, from = {x = 4.10, z = -0.25, heading = 90}},
    {id = "comes in", at = 27, to = {x = 1.62, z = -0.48, heading = 0}, speed = 0.7},
  },
  gaze = {{at = 34, length = 16, target = "keeper"}},
  gestures = {{id = "the dearest", at = 47.6, clip = "point"}},
  speech = {
    {at = 34, length = 5.5, line = "quanti"},
    {at = 47.5, line = "falernum"},
  },
}

-- ---- functions of this drama ---------------------------------------------------------

-- Only one actor speaks at a time.
local floor = {taken = false}
local leave = {__close = function() floor.taken = false end}

-- Says a line whose stroke coincides with the stroke of a gesture.
local function speak(who, line, gesture)
  while floor.taken do
    wait(0.1)
  end
  floor.taken = true
  local guard <close> = setmetatable({}, leave)
  if gesture then
    meet("stroke", {who, "gesture", gesture}, {who, "say", line})
  else
    who:say(line)
  end
  wait(0.4)
end

-- A task may be impossible at the moment: the drama continues. The editor's check reports it to
-- the author.
local function try(task, ...)
  local done, problem = pcall(task, ...)
  if not done then
    wait(1.5)
  end
  return done, problem
end

-- Waits until the visitor looks at an actor again, at most `patience` seconds.
local function attended(who, patience)
  who:look_at("visitor")
  race(function()
    wait_for(visitor:looks_at(who, {angle = 20, seconds = 0.2}))
  end, function()
    wait(patience)
  end)
end

local function smile(who, intensity, seconds)
  who:express("joy", intensity, 0.5)
  wait(seconds)
  who:express("neutral", 0, 1.2)
end

-- ---- the order, from marker to cup ---------------------------------------------------

-- The keeper fills a cup that stands in front of him.
local function pour(cup, x)
  keeper:take("jug")
  keeper:walk_to{x = x, z = -1.93, heading = 180}
  keeper:use("jug", "pour")
  object(cup):set_state("full")
  keeper:put("jug", "counter", "back")
end

-- The cup changes hands when he reaches for it; he thanks her when he has it.
local function hand_over()
  try(server.take, server, "cup_of_guest")
  describe("d_cup")
  server:look_at(patrician)
  local reaches = start(function()
    wait_for(timeout(2.5))
    patrician:look_at(server)
    patrician:gesture("nod", "head")
  end)
  wait_for(reaches, "stroke")
  local gives = start(function() try(server.give, server, "cup_of_guest", patrician) end)
  wait_for(gives, "ready")
  speak(server, "ecce")
  wait_for(gives, "stroke")
  speak(patrician, "gratias")
  wait_for(gives)
  server:look_at()
end

local function serve_the_patrician()
  keeper:look_at(patrician)
  speak(keeper, "statim", "offer")
  describe("d_order")
  keeper:look_at()
  together(function()
    pour("cup_of_guest", 1.55)
    keeper:walk_to{x = 0.60, z = -1.95, heading = 180}
  end, function()
    patrician:sit("stool")
  end, function()
    wait_for(timeout(9))
    hand_over()
  end)
  start(function()
    try(patrician.use, patrician, "cup_of_guest", "drink")
  end)
end

-- ---- the visitor is served -----------------------------------------------------------

local function curious_child()
  try(girl.face, girl, "visitor")
  girl:look_at("visitor")
  speak(girl, "unde", "point")
  try(server.face, server, girl)
  server:look_at(girl)
  speak(server, "tace", "refuse")
  girl:express("sadness", 0.4, 0.5)
  girl:look_at(server)
  wait(2)
  girl:express("neutral", 0, 1)
  girl:look_at()
  server:look_at("visitor")
  smile(server, 0.5, 2)
  server:look_at()
end

local function serve_the_visitor()
  keeper:express("joy", 0.6, 0.5)
  attended(keeper, 4)
  speak(keeper, "pompeianum", "explain")
  keeper:express("neutral", 0, 1)
  keeper:look_at()
  try(pour, "cup", 0.60)
  attended(keeper, 4)
  speak(keeper, "aquam_addo")
  keeper:look_at()
  try(keeper.take, keeper, "cup")
  describe("d_for_you")
  attended(keeper, 6)
  try(keeper.put, keeper, "cup", "counter", "top")
  speak(keeper, "tibi_est", "offer")
  smile(keeper, 0.7, 2)
  keeper:look_at()
end

-- ---- or two guests quarrel -----------------------------------------------------------

local function quarrel()
  labourer:look_at(patrician)
  patrician:look_at(labourer)
  speak(labourer, "quem_facis", "explain")
  girl:look_at(labourer)
  speak(patrician, "pansam")
  labourer:express("anger", 0.3, 0.4)
  speak(labourer, "polybium", "point")
  patrician:express("disgust", 0.5, 0.4)
  speak(patrician, "emit")
  labourer:express("anger", 0.7, 0.3)
  server:look_at(labourer)
  keeper:look_at(labourer)
  speak(labourer, "edere", "shrug")
  keeper:express("anger", 0.4, 0.3)
  -- He points to the door while they look up at him.
  local orders = start(speak, keeper, "ite_foras", "point")
  wait_for(orders, "stroke")
  labourer:look_at(keeper)
  patrician:look_at(keeper)
  wait_for(orders)
  labourer:express("neutral", 0, 1)
  speak(labourer, "bibamus", "shrug")
  describe("d_after_quarrel")
  patrician:express("neutral", 0, 1)
  together(function()
    smile(keeper, 0.6, 2)
  end, function()
    try(function()
      labourer:take("beaker")
      labourer:use("beaker", "drink")
      labourer:put("beaker", "counter", "top")
    end)
  end)
  for _, who in ipairs{keeper, server, patrician, labourer, girl} do
    who:look_at()
  end
end

-- ---- meanwhile -----------------------------------------------------------------------

local function household()
  wait(2)
  try(function() server:use("amphora", "smell") end)
  try(function()
    server:take("bowl")
    wait(1)
    server:put("bowl", "table", "top")
  end)
  try(function() server:use("mortar", "grind") end)
  try(function() server:use("mortar", "grind") end)
  try(function() server:use("storage_jar", "look_inside") end)
end

local function errands()
  wait(4)
  try(function()
    girl:take("plate")
    wait(0.5)
    girl:put("plate", "counter", "leg")
  end)
  wait(20)
  try(function()
    girl:take("basket")
    girl:walk_to{x = -0.50, z = -0.15, heading = 180}
    wait(3)
    girl:put("basket", {x = -0.95, z = 0.42, heading = 90})
  end)
end

-- ---- the guests go -------------------------------------------------------------------

local function patrician_leaves()
  try(function()
    patrician:use("cup_of_guest", "drink")
    patrician:put("cup_of_guest", "table", "top")
    patrician:stand()
    patrician:take("tablet")
    patrician:use("tablet", "read")
    patrician:put("tablet", "counter", "top")
  end)
  patrician:look_at(keeper)
  speak(patrician, "quattuor")
  keeper:look_at(patrician)
  local leaves = start(function()
    patrician:look_at()
    try(patrician.walk_to, patrician, {x = 4.10, z = -0.25, heading = -90, speed = 0.8})
    patrician:hide()
  end)
  speak(keeper, "redi_cras", "salute")
  describe("d_leaves")
  keeper:look_at()
  try(function() keeper:use("chest", "open") end)
  wait(2)
  try(function() keeper:use("chest", "close") end)
  try(keeper.walk_to, keeper, {x = 0.60, z = -1.95, heading = 180})
  wait_for(leaves)
end

local function clear_the_table()
  wait(14)
  try(function()
    server:take("cup_of_guest")
    server:put("cup_of_guest", "counter", "top")
  end)
  try(function()
    server:take("coins")
    server:put("coins", "counter", "top")
  end)
end

local function carry_water()
  wait(3)
  labourer:look_at(server)
  speak(labourer, "aquam_porto")
  describe("d_water")
  labourer:look_at()
  try(function()
    labourer:take("bucket")
    labourer:walk_to{x = -0.55, z = -0.10, heading = 90}
    labourer:use("bucket", "pour")
    labourer:put("bucket", {x = -1.0, z = 0.02, heading = 0})
  end)
  try(function() labourer:use("counter", "lean") end)
end

-- The child makes room at the counter and watches the patrician leave.
local function make_room()
  try(girl.walk_to, girl, {x = 0.05, z = -0.45, heading = 0})
  girl:look_at(patrician)
  wait(8)
  girl:look_at()
end

-- ---- the prayer ----------------------------------------------------------------------

local function pray()
  try(girl.walk_to, girl, {x = 0.05, z = -0.45, heading = 0})
  -- The painted shrine is on the wall behind the counter.
  girl:look_at{x = 0.6, y = 1.7, z = -2.58}
  server:look_at(girl)
  local prayer = start(speak, girl, "lar", "pray")
  wait_for(prayer, "stroke")
  keeper:look_at(girl)
  wait_for(prayer)
  smile(server, 0.6, 1)
  speak(server, "bene", "nod")
  girl:look_at()
  server:look_at()
  keeper:look_at()
end

local function farewell()
  keeper:look_at("visitor")
  keeper:express("joy", 0.6, 0.5)
  speak(keeper, "valete", "salute")
  describe("d_end")
  keeper:express("neutral", 0, 1.5)
  keeper:look_at()
end

-- After the end of the story.
local function life_goes_on()
  together(function()
    while true do
      try(function() keeper:use("counter", "wipe", {seconds = 8}) end)
      wait(20)
      try(function()
        keeper:take("ladle")
        keeper:use("ladle", "serve")
        keeper:put("ladle", "counter", "back")
      end)
      wait(15)
    end
  end, function()
    while true do
      try(function() server:use("mortar", "grind") end)
      wait(17)
      try(function() server:use("storage_jar", "look_inside") end)
      wait(12)
    end
  end, function()
    while true do
      wait(9)
      try(function() girl:use("brazier", "warm_hands") end)
      wait(14)
    end
  end, function()
    while true do
      try(function() labourer:use("counter", "lean") end)
      wait(25)
    end
  end)
end

-- ---- reactions to the visitor --------------------------------------------------------

-- Actors notice a visitor who comes near, and step aside from one who comes too near.
local function notice()
  on(visitor:near("counter", 3, {leave = 4}), function()
    server:look_at("visitor")
    server:gesture("nod", "head")
    smile(server, 0.5, 2)
    server:look_at()
  end)
  for _, who in ipairs{server, labourer, girl} do
    who:keep_distance(0.8)
  end
  on(tracking("back"), function()
    girl:look_at("visitor")
    girl:express("surprise", 0.5, 0.3)
    wait(2)
    girl:express("neutral", 0, 1)
    girl:look_at()
  end)
  local told = false
  on(visitor:looks_at(girl, {seconds = 1.5}), function()
    girl:look_at("visitor")
    if not told and now() > 60 then
      told = true
      girl:express("joy", 0.8, 0.4)
      speak(girl, "mater_mea")
    end
    smile(girl, 0.7, 2)
    girl:look_at()
  end)
end

function main()
  object("cup"):set_state("empty")
  object("cup_of_guest"):set_state("empty")
  object("lamp"):set_state("out")
  keeper:gait{cadence = 0.95, step_width = 1.2, arm_spread = 8}
  patrician:gait{cadence = 0.82, stoop = 9}
  girl:gait{cadence = 1.1, lift = 1.15}
  labourer:gait{arm_swing = 1.15, arm_spread = 4}
  notice()

  wait(5)
  keeper:greet{say = "salvete", gesture = "salute"}

  wait_for(marker("order"))
  serve_the_patrician()

  wait(2)
  keeper:look_at("visitor")
  speak(keeper, "accede", "offer")
  local which = first(visitor:looks_at(keeper, {angle = 10, seconds = 1.2}),
    visitor:stays(4, {at = "counter", metres = 2.8}), timeout(8))
  keeper:look_at()
  if which < 3 then
    together(serve_the_visitor, function()
      wait(9)
      curious_child()
      together(household, errands)
    end)
  else
    together(quarrel, household, errands)
  end

  together(patrician_leaves, clear_the_table, carry_water, make_room)
  if now() < 200 then
    wait_for(marker("prayer"))
  end
  pray()
  if now() < 228 then
    wait_for(marker("farewell"))
  end
  farewell()
  life_goes_on()
end
