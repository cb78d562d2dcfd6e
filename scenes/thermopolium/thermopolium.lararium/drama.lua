-- A morning in the thermopolium of Vetutius Placidus, in a loop of about five
-- minutes. Asellina serves, a labourer has his wine, an old patrician comes in for
-- his, and the keeper's daughter minds bread, brazier and whoever looks at her.

local keeper = actor("keeper")
local server = actor("server")
local patrician = actor("patrician")
local labourer = actor("labourer")
local girl = actor("girl")

local function begin()
  keeper:place{x = 0.60, z = -1.95, heading = 180}
  server:place{x = -0.35, z = -0.30, heading = 160}
  labourer:place{x = 0.62, z = 0.45, heading = -90}
  girl:place{x = -0.30, z = 0.45, heading = 200}
  keeper:gait{cadence = 0.95, step_width = 1.2, arm_spread = 8}
  patrician:gait{cadence = 0.82, stoop = 9}
  girl:gait{cadence = 1.1, lift = 1.15}
  labourer:gait{arm_swing = 1.15, arm_spread = 4}
end

-- What somebody was told to do may not be possible just then: life goes on.
local function try(task)
  local done, problem = pcall(task)
  if not done then
    wait(1.5)
  end
  return done, problem
end

-- Behind the counter.
local function keep()
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
  wait(20)
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
  wait(35)
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
  wait(4)
  server:look_at("visitor")
  server:express("joy", 0.5, 0.6)
  wait(2.5)
  server:look_at()
  server:express("neutral", 0, 1.5)
  try(function()
    server:take("bowl")
    wait(1)
    server:put("bowl", "table", "top")
  end)
  server:look_at(labourer)
  wait(2)
  server:look_at()
  try(function() server:use("amphora", "smell") end)
  server:say("bene_olet")
  wait(12)
  try(function()
    server:take("cup_of_guest")
    server:give("cup_of_guest", patrician) -- who sits at the table by now
  end)
  wait(18)
  try(function() server:use("brazier", "warm_hands") end)
  wait(10)
  try(function() server:use("mortar", "grind") end)
  try(function() server:use("mortar", "grind") end)
  wait(8)
  try(function()
    server:take("bowl")
    server:put("bowl", "counter", "leg")
  end)
  server:look_at(girl)
  wait(3)
  server:look_at()
  try(function() server:use("storage_jar", "look_inside") end)
  server:walk_to{x = -0.35, z = -0.30, heading = 160}
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
  end)
  labourer:express("joy", 0.6, 0.6)
  labourer:say("calet")
  try(function() labourer:put("loaf", "counter", "top") end)
  labourer:express("neutral", 0, 1.0)
  wait(25)
  try(function() labourer:use("bucket", "pour") end)
  labourer:walk_to{x = 0.62, z = 0.45, heading = -90}
  wait(6)
  labourer:look_at(girl)
  wait(3)
  labourer:look_at()
end

-- Comes in by the door, drinks, and goes home.
local function visit()
  patrician:place{x = 3.75, z = -0.25, heading = 90}
  wait(9)
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
  local patience = 60
  while object("cup_of_guest"):holder() ~= "patrician" and patience > 0 do
    wait(1)
    patience = patience - 1
  end
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
  wait(3)
  try(function() patrician:stand() end)
  try(function() patrician:take("tablet") end)
  try(function()
    patrician:use("tablet", "read")
    patrician:put("tablet", "counter", "top")
  end)
  wait(20)
  try(function() patrician:walk_to{x = 3.75, z = -0.25, speed = 0.8} end)
  patrician:hide()
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
  try(function() girl:walk_to{x = 0.35, z = 0.75, heading = 190} end)
  girl:look_at("visitor")
  wait(5)
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
    girl:walk_to{x = -0.55, z = 0.95, heading = 180}
    wait(3)
    girl:put("basket", {x = -0.95, z = 0.42, heading = 90})
  end)
  girl:look_at("visitor")
  girl:express("joy", 0.8, 0.5)
  wait(4)
  girl:express("neutral", 0, 1.5)
  girl:look_at()
  girl:walk_to{x = -0.30, z = 0.45, heading = 200}
end

function main()
  begin()
  while true do
    together(keep, serve, rest, visit, play)
    wait(5)
  end
end
