-- A drama for Lararium. Time runs in seconds, positions are metres on the stage
-- (x to the right, y up, -z forward), headings are degrees: 0 looks along -z,
-- 90 along -x, 180 back to whoever stands at the origin.

-- The members of the cast, by the names they have in the project.
local keeper = actor("keeper")

-- main() tells the story. It may wait, and it may go on for ever, as long as
-- every round of a loop waits for something.
function main()
  keeper:place{ x = -0.5, z = -1, heading = 180 }
  keeper:play("idle")
  wait(2)

  while true do
    -- Walks there in a straight line and goes on when the place is reached.
    keeper:walk_to{ x = 0.5, z = -1 }
    keeper:turn_to(180)
    wait(3)
    keeper:walk_to{ x = -0.5, z = -1 }
    keeper:turn_to(180)
    wait(3)
  end
end

-- Several things at once:
--   together(f, g)   runs both and goes on when both are done
--   race(f, g)       goes on when the first is done and stops the other
--   start(f)         runs f beside everything else
--
-- An actor can also be led by a track, which curators can seek in freely:
--   track{ actor = "keeper", clips = {
--     { at = 0, length = 4, clip = "idle", from = { x = 0, z = -1 }, heading = 180 },
--     { at = 4, length = 3, clip = "walk", to = { x = 1, z = -1 } },
--   } }
