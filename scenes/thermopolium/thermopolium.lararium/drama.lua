-- A morning in the thermopolium of Vetutius Placidus, in a loop of about four
-- minutes. Asellina serves, a labourer has his wine, an old patrician comes in for
-- his, and the keeper's daughter minds bread, brazier and whoever looks at her.

local keeper = actor("keeper")
local server = actor("server")
local patrician = actor("patrician")
local labourer = actor("labourer")
local girl = actor("girl")

local function begin()
  keeper:place{x = 0.60, z = -1.95, heading = 180}
  server:place{x = -0.25, z = -0.35, heading = 160}
  labourer:place{x = 0.62, z = 0.45, heading = -90}
  girl:place{x = -0.72, z = 0.10, heading = 200}
  keeper:gait{cadence = 0.95, step_width = 1.2, arm_spread = 8}
  patrician:gait{cadence = 0.82, stoop = 9}
  girl:gait{cadence = 1.1, lift = 1.15}
  labourer:gait{arm_swing = 1.15, arm_spread = 4}
end

-- What somebody was told to do may not be possible just then: life goes on. The author
-- hears of it from the editor's check.
local function try(task)
  local done, problem = pcall(task)
  if not done then
    wait(1.5)
  end
  return done, problem
end

-- Waits for something that others do, but not for ever.
local function wait_until(condition, patience)
  while not condition() and patience > 0 do
    wait(0.5)
    patience = patience - 0.5
  end
end

-- Behind the counter.
local function keep()
  object("cup"):set_state("empty")
  keeper:look_at("visitor")
  keeper:express("joy", 0.7, 0.5)
  keeper:say("salvete")
  keeper:express("neutral", 0, 1.0)
  keeper:look_at()
  try(function()
    keeper:take("ladle")
    keeper:walk_to{x = 0.25, z = -1.90, heading = 180}
    keeper:use("ladle", "stir")
    keeper:use("ladle", "stir")
    keeper:put("ladle", "counter", "back")
  end)
  try(function() keeper:use("counter", "wipe", {seconds = 7}) end)
  wait(12)
  try(function()
    keeper:take("jug")
    keeper:walk_to{x = 0.60, z = -1.93, heading = 180}
    keeper:use("jug", "pour")
    object("cup"):set_state("full")
    keeper:put("jug", "counter", "back")
  end)
  keeper:look_at(patrician)
  keeper:say("ecce_vinum")
  keeper:look_at()
  wait(25)
  try(function() keeper:use("chest", "open") end)
  wait(4)
  try(function() keeper:use("chest", "close") end)
  try(function() keeper:use("counter", "wipe", {seconds = 10}) end)
  wait(15)
  keeper:look_at(patrician)
  keeper:say("vale")
  keeper:look_at()
  try(function()
    keeper:take("ladle")
    keeper:walk_to{x = 0.25, z = -1.90, heading = 180}
    keeper:use("ladle", "serve")
    keeper:use("ladle", "stir")
    keeper:put("ladle", "counter", "back")
  end)
  keeper:walk_to{x = 0.60, z = -1.95, heading = 180}
end

-- Between counter and table.
local function serve()
  wait(3)
  server:look_at("visitor")
  server:express("joy", 0.5, 0.6)
  wait(2.5)
  server:look_at()
  server:express("neutral", 0, 1.5)
  try(function() server:use("door", "open") end)
  server:walk_to{x = -0.45, z = -0.30, heading = -90}
  -- Who is to be served sits by then.
  wait_until(function() return patrician:where().z > 0.9 end, 60)
  try(function() server:use("door", "shut") end)
  try(function() server:use("amphora", "smell") end)
  server:say("bene_olet")
  try(function()
    server:take("cup_of_guest")
    server:give("cup_of_guest", patrician)
  end)
  try(function()
    server:take("bowl")
    wait(1)
    server:put("bowl", "table", "top")
  end)
  server:look_at(labourer)
  wait(2)
  server:look_at()
  try(function() server:use("mortar", "grind") end)
  try(function() server:use("mortar", "grind") end)
  try(function()
    server:take("lamp")
    server:use("lamp", "blow_out")
    wait(3)
    server:use("lamp", "light")
    server:put("lamp", "lamp_stand")
  end)
  try(function() server:use("brazier", "warm_hands") end)
  server:look_at(girl)
  wait(3)
  server:look_at()
  try(function()
    server:take("bowl")
    server:put("bowl", "counter", "leg")
  end)
  try(function() server:use("storage_jar", "look_inside") end)
  -- Behind the guest who leaves.
  wait_until(function() return patrician:where().z < 0 and patrician:where().x < 0.5 end, 60)
  try(function() server:use("door", "open") end)
  server:walk_to{x = -0.45, z = -0.30, heading = -90}
  wait_until(function() return patrician:where().x > 3.7 end, 40)
  try(function() server:use("door", "shut") end)
  try(function()
    server:take("cup_of_guest")
    server:put("cup_of_guest", "counter", "top")
  end)
  try(function()
    server:take("coins")
    server:put("coins", "table", "top")
  end)
  server:walk_to{x = -0.25, z = -0.35, heading = 160}
end

-- Wine for a thirsty man.
local function rest()
  wait(7)
  try(function()
    labourer:take("beaker")
    labourer:use("beaker", "drink")
    wait(6)
    labourer:look_at("visitor")
    wait(2)
    labourer:look_at()
    labourer:use("beaker", "drink")
    labourer:put("beaker", "table", "top")
  end)
  labourer:look_at(server)
  labourer:say("laboro")
  labourer:express("sadness", 0.4, 0.8)
  wait(4)
  labourer:express("neutral", 0, 1.0)
  labourer:look_at()
  try(function()
    labourer:take("coins")
    labourer:put("coins", "counter", "top")
  end)
  wait(5)
  try(function()
    labourer:take("loaf")
    labourer:use("loaf", "smell")
    labourer:express("joy", 0.6, 0.6)
    labourer:say("calet")
    labourer:put("loaf", "counter", "top")
  end)
  labourer:express("neutral", 0, 1.0)
  try(function() labourer:use("counter", "lean") end)
  wait_until(function() return object("cup"):state() == "full" end, 30)
  try(function()
    labourer:take("cup")
    labourer:use("cup", "drink")
    labourer:put("cup", "counter", "top")
  end)
  wait(10)
  try(function()
    labourer:take("bucket")
    labourer:walk_to{x = -0.55, z = -0.10, heading = 90}
    labourer:use("bucket", "pour")
    labourer:put("bucket", {x = -1.0, z = 0.02, heading = 0})
  end)
  labourer:walk_to{x = 0.62, z = 0.45, heading = -90}
  wait(6)
  labourer:look_at(girl)
  wait(3)
  labourer:look_at()
end

-- Comes in by the door, drinks, and goes home.
local function visit()
  patrician:place{x = 4.10, z = -0.25, heading = 90}
  wait_until(function() return object("door"):state() == "open" end, 40)
  try(function() patrician:walk_to{x = 1.85, z = -0.25, heading = 90, speed = 0.8} end)
  patrician:look_at("visitor")
  wait(2)
  patrician:look_at()
  try(function() patrician:walk_to{x = 1.62, z = -0.50, heading = 0, speed = 0.8} end)
  patrician:look_at(keeper)
  patrician:say("vinum_volo")
  patrician:look_at()
  try(function() patrician:sit("stool") end)
  -- Served at the table.
  wait_until(function() return object("cup_of_guest"):holder() == patrician end, 60)
  try(function()
    patrician:use("cup_of_guest", "drink")
    wait(8)
    patrician:look_at(girl)
    patrician:say("quis_es")
    patrician:express("joy", 0.6, 0.8)
    wait(4)
    patrician:express("neutral", 0, 1.5)
    patrician:look_at()
    patrician:use("cup_of_guest", "drink")
    patrician:put("cup_of_guest", "table", "top")
  end)
  patrician:say("gratias")
  wait(12)
  try(function() patrician:stand() end)
  try(function()
    patrician:take("tablet")
    patrician:use("tablet", "read")
    patrician:put("tablet", "counter", "top")
  end)
  try(function() patrician:walk_to{x = 0.30, z = -0.15, heading = -90, speed = 0.8} end)
  -- Counter and table leave room for one.
  wait_until(function() return object("door"):state() == "open" and server:where().x < 0 end, 60)
  try(function() patrician:walk_to{x = 4.10, z = -0.25, heading = -90, speed = 0.8} end)
  patrician:hide()
end

-- Whoever looks at the girl is told whose daughter she is; who only stays is waited on by
-- the server; who goes by is looked after.
local function notice_visitor()
  girl:look_at("visitor")
  local what = first(visitor:looks_at(girl, {seconds = 1}), visitor:stays(4), timeout(5))
  if what == 1 then
    try(function() girl:face("visitor") end)
    girl:express("joy", 0.8, 0.4)
    girl:say("mater_mea")
    girl:express("neutral", 0, 1.5)
  elseif what == 2 then
    girl:look_at(server)
    server:look_at("visitor")
    server:express("joy", 0.6, 0.5)
    wait(2.5)
    server:express("neutral", 0, 1.5)
    server:look_at()
  end
end

-- Everything is new.
local function play()
  girl:look_at("visitor")
  girl:express("surprise", 0.5, 0.4)
  wait(3)
  girl:express("joy", 0.6, 0.6)
  wait(3)
  girl:express("neutral", 0, 1.5)
  girl:look_at()
  try(function() girl:use("brazier", "warm_hands") end)
  wait(4)
  try(function() girl:walk_to{x = 0.50, z = -0.10, heading = 190} end)
  notice_visitor()
  girl:look_at(patrician)
  wait(6)
  girl:look_at()
  try(function()
    girl:take("plate")
    girl:walk_to{x = -0.30, z = -0.35, heading = 0}
    wait(2)
    girl:put("plate", "table", "top")
  end)
  girl:look_at(patrician)
  girl:say("mater_mea")
  girl:look_at()
  wait(8)
  try(function()
    girl:take("basket")
    girl:walk_to{x = -0.50, z = -0.15, heading = 180}
    wait(3)
    girl:put("basket", {x = -0.95, z = 0.42, heading = 90})
  end)
  girl:look_at("visitor")
  girl:express("joy", 0.8, 0.5)
  wait(4)
  girl:express("neutral", 0, 1.5)
  girl:look_at()
  girl:walk_to{x = -0.72, z = 0.10, heading = 200}
end

function main()
  begin()
  while true do
    together(keep, serve, rest, visit, play)
    wait(5)
  end
end
