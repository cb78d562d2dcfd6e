-- A seed: lanes in many ways of writing.
track{ actor = "keeper", -- the actor
  speech = { {id = "a", at = 2, length = 1.5, line = "salvete"}; {at = 0x10, line = [[vale]]} },
  gaze = {
    {at = 3, target = {x = -1, y = 2, z = .5}, ["with head"] = true}, --[[ later ]]
  },
}
track({ markers = {{at = 1, name = 'no\u{6f}n', ease = "in"}} })
