-- A quiet moment at the counter: the keeper walks behind it and turns to the
-- visitor, while a guest waits in front.

local keeper = actor("keeper")
local guest = actor("guest")

local function serve()
  keeper:place{x = -0.75, z = -1.95, heading = -90}
  keeper:show()
  keeper:walk_to{x = 0.75, z = -1.95, speed = 1.0}
  keeper:play("idle", {fade = 0.3})
  keeper:turn_to(180)
end

local function wait_at_the_counter()
  guest:place{x = -0.45, z = -0.35, heading = 20}
  guest:show()
  guest:play("idle")
  wait(2.0)
  guest:turn_to(-30)
end

function main()
  together(serve, wait_at_the_counter)
end
