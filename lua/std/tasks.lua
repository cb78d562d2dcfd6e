-- Time and things that happen at once. Each function that is given to start,
-- together or race becomes a task of its own.

local host = ...

local function check_function(value, name)
  if type(value) ~= "function" then
    error(name .. ": give functions, not a " .. type(value), 3)
  end
end

-- Seconds since the drama began.
function now()
  return host.time()
end

-- Lets the calling task sleep.
function wait(seconds)
  if type(seconds) ~= "number" or not (seconds >= 0 and seconds <= 86400) then
    error("wait: give a number of seconds from 0 to 86400", 2)
  end
  host.wait(seconds)
end

-- Runs f beside everything else.
function start(f)
  check_function(f, "start")
  host.start(f)
end

-- Stops every task of a list when its owner ends or is stopped itself.
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

-- Runs all functions at once and goes on when the last of them is done.
function together(...)
  local tasks <close> = start_all("together", ...)
  host.join(tasks, false)
end

local fails_again = {
  __close = function(self)
    host.attempt(self.number)
  end,
}

-- Runs f, in which what people do may fail without anybody hearing of it: whether all
-- of it was done, and if not why.
function attempt(f)
  check_function(f, "attempt")
  local guard <close> = setmetatable({ number = host.attempt() }, fails_again)
  return pcall(f)
end

-- Runs all functions at once, goes on when the first is done and stops the others.
function race(...)
  local tasks <close> = start_all("race", ...)
  if #tasks > 0 then
    host.join(tasks, true)
  end
end
