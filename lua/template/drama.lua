-- A drama for Lararium. Time runs in seconds, positions are metres on the stage
-- (x to the right, y up, -z forward), headings are degrees: 0 looks along -z,
-- 90 along -x, 180 towards a visitor at the origin.

-- The members of the cast, by their names in the project.
local keeper = actor("keeper")

-- main() tells the story. It may wait, and it may run for ever if every round of
-- a loop waits for something.
function main()
  keeper:place{ x = -0.5, z = -1, heading = 180 }
  keeper:play("idle")
  wait(2)

  while true do
    -- Walks there and continues when the place is reached.
    keeper:walk_to{ x = 0.5, z = -1 }
    keeper:turn_to(180)
    wait(3)
    keeper:walk_to{ x = -0.5, z = -1 }
    keeper:turn_to(180)
    wait(3)
  end
end

-- Functions that run at the same time:
--   together(f, g)   runs both and continues when both are done
--   race(f, g)       continues when the first is done and stops the other
--   start(f)         runs f in the background
--
-- A track can also lead an actor. Its items have fixed times:
--   track{ actor = "keeper", clips = {
--     { at = 0, length = 4, clip = "idle", from = { x = 0, z = -1 }, heading = 180 },
--     { at = 4, length = 3, clip = "walk", to = { x = 1, z = -1 } },
--   } }
