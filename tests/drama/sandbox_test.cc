// Attacks on the sandbox. Each script either is harmless, or ends with an error
// that its own pcall, coroutines and handlers cannot keep from the host.

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdio>

#include "shared/core/statistics.h"
#include "tests/drama/drama_fixture.h"

namespace lararium::drama {
namespace {

using ::testing::HasSubstr;

struct Attack {
  const char* name;
  const char* script;  // The body of main().
  const char* error;   // Part of the expected message; "": no error may occur.
};

class SandboxTest : public DramaTest, public ::testing::WithParamInterface<Attack> {
 protected:
  // Processor time of the longest frame of all attacks. The limit is 50 ms; the time is printed and
  // not asserted, because machines differ.
  static void TearDownTestSuite() {
    std::printf("worst frame under attack: %.1f ms\n", worst_frame_ms_);
  }
  static inline double worst_frame_ms_ = 0.0;
};

constexpr char kTooLong[] = "ran too long without waiting";
constexpr char kTooMuch[] = "needs more memory";
constexpr char kText[] = "made a text longer";

TEST_P(SandboxTest, Holds) {
  DramaOptions options;
  options.memory_limit = 16 << 20;
  const auto drama = Make(std::string("function main()\n") + GetParam().script +
                              "\nend\n"
                              "start(function() wait(0.1) actor('guest'):place{ x = 5 } end)",
                          options);
  // Frames of four ticks, as at 30 frames a second.
  for (int frame = 0; frame < 8; ++frame) {
    const double begin = ThreadCpuMilliseconds();
    for (int tick = 0; tick < 4; ++tick) {
      drama->Tick();
    }
    worst_frame_ms_ = std::max(worst_frame_ms_, ThreadCpuMilliseconds() - begin);
  }
  if (*GetParam().error == '\0') {
    EXPECT_EQ(FirstError(*drama), "");
  } else {
    ASSERT_GE(drama->errors().size(), 1u);
    EXPECT_THAT(FirstError(*drama), HasSubstr(GetParam().error));
  }
  EXPECT_EQ(State("guest").position.x, 5.0f) << "the rest of the drama must live on";
}

const Attack kAttacks[] = {
    // Endless loops.
    {"Loop", "while true do end", kTooLong},
    {"LoopInPcall", "pcall(function() while true do end end)", kTooLong},
    {"LoopAroundPcall", "while true do pcall(function() while true do end end) end", kTooLong},
    {"NestedPcalls", "local function f() while true do pcall(f) end end while true do pcall(f) end",
     "stack overflow"},
    {"PcallOfPcall", "while true do pcall(pcall, pcall, error) end", kTooLong},
    {"LoopInCoroutine",
     "while true do coroutine.resume(coroutine.create(function() while true do end end)) end",
     kTooLong},
    {"LoopInWrap", "while true do pcall(coroutine.wrap(function() while true do end end)) end",
     kTooLong},
    {"ShortCoroutines", "while true do coroutine.wrap(function() for i = 1, 300 do end end)() end",
     kTooLong},
    {"YieldingPcall",
     "local co = coroutine.wrap(function() while true do pcall(coroutine.yield) end end)\n"
     "while true do co() end",
     kTooLong},
    {"LoopInClose",
     "while true do pcall(function()\n"
     "  local x <close> = setmetatable({}, {__close = function() while true do end end})\n"
     "end) end",
     kTooLong},
    {"CloseCoroutineWithLoop",
     "local co = coroutine.create(function()\n"
     "  local x <close> = setmetatable({}, {__close = function() while true do end end})\n"
     "  coroutine.yield()\n"
     "end)\n"
     "coroutine.resume(co)\n"
     "while true do coroutine.close(co) end",
     kTooLong},
    {"LoopInIndex",
     "local t = setmetatable({}, {__index = function() while true do end end})\n"
     "while true do pcall(function() return t.x end) end",
     kTooLong},
    {"LoopInLess",
     "local m = {__lt = function() while true do end end}\n"
     "local a, b = setmetatable({}, m), setmetatable({}, m)\n"
     "while true do pcall(function() return a < b end) end",
     kTooLong},
    {"LoopInToString",
     "local t = setmetatable({}, {__tostring = function() while true do end end})\n"
     "while true do pcall(tostring, t) end",
     kTooLong},
    {"LoopInPairs",
     "local t = setmetatable({}, {__pairs = function() while true do end end})\n"
     "while true do pcall(pairs, t) end",
     kTooLong},
    {"ErrorObjectWithLoop",
     "error(setmetatable({}, {__tostring = function() while true do end end}))",
     "error object is a table"},
    {"StartsForEver", "local function f() start(f) end f() wait(1)", "more than 1024 tasks"},
    {"TooManyTasks", "for i = 1, 5000 do start(function() wait(9) end) end",
     "more than 1024 tasks"},
    {"JoinsNothing", "for i = 1, 20 do together() end", ""},
    {"BareYield", "for i = 1, 20 do coroutine.yield() end", ""},

    // Work inside one call.
    {"PatternBomb",
     "local s = ('a'):rep(2000) while true do pcall(string.find, s, ('a*'):rep(20) .. 'b') end",
     kTooLong},
    {"MatchBomb", "string.match(('a'):rep(60000), ('.-'):rep(10) .. 'b')", kTooLong},
    {"GsubBomb", "string.gsub(('a'):rep(60000), ('a-'):rep(10) .. 'b', '')", kTooLong},
    {"GmatchBomb", "for _ in string.gmatch(('a'):rep(60000), ('a*'):rep(10) .. 'b') do end",
     kTooLong},
    {"FindBomb", "local s = ('a'):rep(60000) while true do s:find('b', 1, true) end", kTooLong},
    {"UpperBomb", "local s = ('a'):rep(60000) while true do s:upper() end", kTooLong},
    {"SortBomb", "table.sort(setmetatable({}, {__len = function() return 1 << 40 end}))", kTooLong},
    {"SortWithBadOrder",
     "local t = {} for i = 1, 500 do t[i] = i % 7 end\n"
     "table.sort(t, function() return true end)\n"
     "table.sort(t, function(a, b) return math.random() < 0.5 end) assert(#t == 500)",
     ""},
    {"ConcatRange", "pcall(table.concat, setmetatable({}, {__index = tostring}), '', 1, 1 << 60)",
     kTooLong},
    {"ConcatLength",
     "local n = 0\n"
     "table.concat(setmetatable({}, {__index = tostring,\n"
     "  __len = function() n = n + 1 return n == 1 and 1 or 1 << 60 end}), '')",
     ""},
    {"MoveRange", "pcall(table.move, {}, 1, 1 << 60, 2)", kTooLong},
    {"MoveFromLowest", "pcall(table.move, {}, math.mininteger, -2, 1)", kTooLong},
    {"InsertLength",
     "table.insert(setmetatable({}, {__len = function() return 1 << 40 end}), 1, 'x')", kTooLong},
    {"RemoveLength", "table.remove(setmetatable({}, {__len = function() return 1 << 40 end}), 1)",
     kTooLong},
    {"UnpackHuge", "table.unpack({}, 1, 1e8)", "too many results"},
    {"UnpackOverflow", "table.unpack({}, math.mininteger, math.maxinteger)", "too many results"},
    {"ByteHuge", "string.byte(('a'):rep(60000), 1, -1)", "more than 255 results"},
    {"CodepointHuge", "utf8.codepoint(('a'):rep(60000), 1, -1)", "more than 255 results"},
    {"RepBomb", "string.rep('x', 1 << 40)", "text is too long"},
    {"RepOverflow", "string.rep('xy', math.maxinteger, 'abc')", "text is too long"},
    {"RepOfNothing", "assert(string.rep('', math.maxinteger) == '')", ""},
    {"FormatWidth", "string.format('%99999d', 1)", "invalid conversion"},
    {"FormatPrecision", "string.format('%.99999f', 1)", "invalid conversion"},
    {"NextOfHugeTable", "local t = {} for i = 1, 20000 do t[i] = i end while true do next(t) end",
     kTooLong},
    {"PackBomb", "while true do pcall(string.pack, 'c100000000', 'a') end", "the script"},

    // Memory.
    {"Table", "local t = {} for i = 1, 1e9 do t[i] = {i} if i % 1000 == 0 then wait(0) end end",
     ""},
    {"TextDoubling", "local s = 'x' while true do s = s .. s end", kText},
    {"TextDoublingInPcall",
     "while true do pcall(function() local s = 'x' while true do s = s .. s end end) end", kText},
    {"ConcatBomb", "local t = {} for i = 1, 3 do t[i] = ('x'):rep(60000) end table.concat(t)",
     kText},
    {"GsubGrows", "local s = ('x'):rep(1000) while true do s = s:gsub('x', 'xx') end", "too long"},
    {"DeepRecursion", "local function f() return 1 + f() end f()", "the script"},
    {"DeepRecursionInPcall",
     "local function f() return 1 + f() end\n"
     "for i = 1, 3 do assert(not pcall(f)) end",
     "the script"},
    {"CoroutineRecursion", "local function f() coroutine.wrap(f)() end f()", kTooLong},
    {"GsubRecursion", "local function f() return (('x'):gsub('x', f)) end f()", "C stack overflow"},

    // Triggers and yields.
    {"TriggerBomb", "for i = 1, 5000 do start(function() first(timeout(99)) end) end", "more than"},
    {"OnBomb", "while true do on(timeout(0), function() wait(9) end) end", "more than"},
    {"OnItself", "on(timeout(0), function() local f f = function() on(timeout(0), f) end f() end)",
     ""},
    {"WaitsForItself",
     "local h h = start(function() wait(0.01) wait_for(h) end) wait(0.02) assert(not h:is_over())",
     ""},
    {"AtBomb",
     "local h = start(function() wait(9) end) while true do at(h, 'start', f or wait) end",
     "more than 1024 tasks"},
    {"HugeOffset", "wait_for(start(function() wait(1) end), 'end', 1e300)", "give a number"},
    {"MeetNobody", "meet('stroke', {{id = 1 << 40, is_actor = true}, 'gesture', 'bow'})",
     "left the stage"},
    {"ForgedHandle", "wait_for({task = 1 << 62}) wait_for({task = -1})", ""},
    {"ForgedTrigger", "first({is_trigger = true, kind = 'near', metres = 0/0})", "finite number"},
    {"ForgedActor", "first(visitor:near({id = 1 << 50, is_actor = true}, 1))", "left the stage"},
    {"TrackWhilePlaying", "track{markers = {{at = 1, name = 'x'}}}", "only while the script loads"},
    {"HandlesAreLocked", "setmetatable(start(function() end), {})", "protected metatable"},
    {"VisitorIsLocked", "setmetatable(visitor, {})", "protected metatable"},

    // Ways out of the sandbox.
    {"NoLoaders", "assert(load == nil and loadstring == nil and loadfile == nil and dofile == nil)",
     ""},
    {"NoSystem",
     "assert(io == nil and os == nil and debug == nil and package == nil and require == nil)", ""},
    {"NoRaw",
     "assert(rawget == nil and rawset == nil and rawequal == nil and rawlen == nil and _G == nil)",
     ""},
    {"NoMetatables", "assert(getmetatable == nil and collectgarbage == nil and xpcall == nil)", ""},
    {"NoDump", "assert(string.dump == nil and ('').dump == nil)", ""},
    {"NoSeed", "assert(math.randomseed == nil)", ""},
    {"NoHost", "assert(host == nil)", ""},
    {"NoFinalisers", "setmetatable({}, {__gc = function() end})", "may not have __gc"},
    {"NoLateFinalisers",
     "local m = {} local t = setmetatable({}, m) m.__gc = function() end setmetatable(t, m)",
     "may not have __gc"},
    {"HiddenFinaliser", "setmetatable({}, setmetatable({}, {__index = {__gc = function() end}}))",
     ""},
    {"LockedMetatable", "setmetatable(setmetatable({}, {__metatable = false}), {})",
     "protected metatable"},
    {"ActorsAreLocked", "setmetatable(actor('keeper'), {})", "protected metatable"},
    {"TextsAreLocked", "setmetatable('', {})", "table expected"},
    {"NoAddresses",
     "for _, v in ipairs{ {}, print or type, coroutine.create(type) } do\n"
     "  assert(tostring(v) == type(v)) assert(('%s'):format(v) == type(v))\n"
     "end",
     ""},
    {"NoPointers", "string.format('%p', {})", "not available"},
    {"NoPointersWithFlags", "string.format('%-20p', {})", "not available"},

    // Hidden loops.
    {"Goto", "::again:: goto again", kTooLong},
    {"GotoInPcall", "while true do pcall(function() ::a:: goto a end) end", kTooLong},
    {"RepeatUntil", "repeat until false", kTooLong},
    {"FloatLoop", "for i = 0, 1, 1e-300 do end", kTooLong},
    {"LyingLength",
     "local t = setmetatable({}, {__len = function() return 1 << 62 end}) for i = 1, #t do end",
     kTooLong},
    {"LoopInEq",
     "local m = {__eq = function() while true do end end}\n"
     "local a, b = setmetatable({}, m), setmetatable({}, m)\n"
     "while true do pcall(function() return a == b end) end",
     kTooLong},
    {"LoopInReplacement",
     "('x'):rep(60000):gsub('x', setmetatable({}, {__index = function() while true do end end}))",
     kTooLong},
    {"SelectOfManyForEver",
     "local t = {} for i = 1, 200 do t[i] = i end\n"
     "while true do select('#', table.unpack(t)) end",
     kTooLong},
    {"SelectBeyondTheFirst", "select(-1 << 62, 1)", "index out of range"},
    {"ReverseBomb", "local s = ('a'):rep(60000) while true do s:reverse() end", kTooLong},
    {"LenOfUtf8Bomb", "local s = ('a'):rep(60000) while true do utf8.len(s) end", kTooLong},
    {"CodesOfGarbage", "for _ in utf8.codes('\\xff') do end", "invalid UTF-8 code"},
    {"TooManyCaptures", "string.find('a', ('('):rep(300) .. 'a' .. (')'):rep(300))",
     "more than 32 captures"},
    {"MalformedPattern", "string.find('a', '[a')", "malformed pattern"},
    {"FormatGrows", "local s = ('x'):rep(60000) string.format('%s%s', s, s)", kText},
    {"FormatWithoutArguments", "string.format(('%s'):rep(30000), 1)", "no value"},
    {"UnpackFarBehind", "string.unpack('<i8', 'x', 1 << 62)", "out of string"},

    // Metatables, errors and coroutines against the host.
    {"IndexOfItself", "local t = {} setmetatable(t, {__index = t}) return t.x", "loop"},
    {"NewIndexOfItself", "local t = {} setmetatable(t, {__newindex = t}) t.x = 1", "loop"},
    {"ConcatOfItself",
     "local m = {} m.__concat = function(a, b) return a .. b end\n"
     "local t = setmetatable({}, m) return t .. t",
     "stack overflow"},
    {"CallOfItself", "local t = {} setmetatable(t, {__call = t}) t()", "stack overflow"},
    {"CallOfItselfAgain",
     "local t = {} setmetatable(t, {__call = t}) for i = 1, 1e9 do pcall(t) end", "stack overflow"},
    {"ErrorWhileClosing",
     "local x <close> = setmetatable({}, {__close = function() error('second') end})\n"
     "error('first')",
     "first"},
    {"ErrorWhoseTextFails", "error(setmetatable({}, {__tostring = function() error('again') end}))",
     "error object is a table"},
    {"ErrorOfNothing", "error()", "error object is a nil"},
    {"ResumesItself",
     "local co co = coroutine.create(function() return coroutine.resume(co) end)\n"
     "assert(coroutine.resume(co))",
     ""},
    {"NobodyElsesCoroutine", "assert(coroutine.running == nil)", ""},
    {"WaitsInAnotherCoroutine",
     "local co = coroutine.create(function() wait(0.01) end)\n"
     "for i = 1, 5 do coroutine.resume(co) end",
     ""},
    {"YieldsOutOfASort", "table.sort({3, 2, 1}, function(a, b) coroutine.yield() return a < b end)",
     "yield"},
    {"YieldsOutOfAReplacement", "('x'):gsub('x', function() wait(1) end)",
     "cannot wait within a function"},

    // Floods of calls.
    {"MillionLines", "local k = actor('keeper') for i = 1, 1e6 do pcall(k.say, k, 'nothing') end",
     kTooLong},
    {"MillionGestures",
     "local k = actor('keeper') for i = 1, 1e6 do start(function() k:gesture('bow') end) end",
     "more than 1024 tasks"},
    {"MillionWalks",
     "local k = actor('keeper')\n"
     "for i = 1, 1e6 do start(function() k:walk_to{x = i % 5} end) end",
     "more than"},
    {"MillionPlaces", "while true do actor('keeper'):place{x = 1} end", kTooLong},
    {"MillionLooks", "while true do actor('keeper'):look_at('visitor') end", kTooLong},
    {"TreeOfTimers",
     "local function f() for i = 1, 3 do start(function() wait(0) f() end) end end f()",
     "more than 1024 tasks"},
    {"ManyNamesOfCues",
     "for i = 1, 1e6 do\n"
     "  race(function() first(key('k' .. i)) end, function() end)\n"
     "end",
     kTooLong},
    {"PlaceNowhere", "actor('keeper'):place{x = 0/0}", "must be a number"},
    {"WaitForEver", "pcall(wait, 1/0) pcall(wait, 0/0) pcall(wait, -1)", ""},

    // Changed library functions.
    {"GlobalsAreTheirOwn",
     "setmetatable, table, string.match, pcall, error = nil, nil, nil, nil, nil wait(0.01)", ""},
    {"StolenMetatable",
     "local real, stolen = setmetatable, nil\n"
     "setmetatable = function(t, m) stolen = m or stolen return real(t, m) end\n"
     "local keeper = actor('keeper') keeper:place{x = 0} keeper:turn_to(90)\n"
     "if stolen and stolen.__close then stolen.__close({task = 1 << 62}) end",
     ""},
    {"NoFieldsOfTexts", "local s = 'x' s.y = 1", "attempt to index"},
    {"OwnEnvironment", "local _ENV = {} wait(1)", "global 'wait'"},

    // Order does not depend on addresses or hashes.
    {"PairsInOrder",
     "local t = {b = 1, a = 2, [3] = 3, [1.5] = 4, [-1] = 5, [true] = 6, [1] = 7, aa = 8}\n"
     "local s = ''\n"
     "for k, v in pairs(t) do s = s .. tostring(k) .. ' ' end\n"
     "assert(s == '-1 1 1.5 3 a aa b true ', s)\n"
     "local n = '' local k = next(t) while k ~= nil do n = n .. tostring(k) .. ' ' k = next(t, k) "
     "end\n"
     "assert(n == s, n)",
     ""},
    {"PairsOfTableKeys", "pairs({[{}] = 1})", "with a table as a key"},
    {"PairsWhileRemoving",
     "local t = {a = 1, b = 2, c = 3} local s = ''\n"
     "for k in pairs(t) do s = s .. k t.b = nil t[k] = nil end assert(s == 'ac' and next(t) == "
     "nil)",
     ""},
    {"SortIsStable",
     "local t = {} for i = 1, 300 do t[i] = {k = i % 3, i = i} end\n"
     "table.sort(t, function(a, b) return a.k < b.k end)\n"
     "for i = 2, 300 do\n"
     "  assert(t[i-1].k < t[i].k or t[i-1].k == t[i].k and t[i-1].i < t[i].i)\n"
     "end",
     ""},

    // The library still works.
    {"Pcall",
     "local ok, e = pcall(error, 'x') assert(not ok and e == 'x')\n"
     "assert(select('#', pcall(function() return 1, nil end)) == 3)\n"
     "local ok, a, b = pcall(function() wait(0.01) return 1, 2 end) assert(ok and a == 1 and b == "
     "2)",
     ""},
    {"Coroutines",
     "local co = coroutine.create(function(a) local b = coroutine.yield(a + 1) error('end' .. b) "
     "end)\n"
     "local ok, x = coroutine.resume(co, 1) assert(ok and x == 2)\n"
     "local ok, e = coroutine.resume(co, 5) assert(not ok and e:find('end5'))\n"
     "assert(coroutine.status(co) == 'dead' and not coroutine.resume(co))\n"
     "local s = 0 for v in coroutine.wrap(function() for i = 1, 3 do coroutine.yield(i) end end) "
     "do\n"
     "  s = s + v end assert(s == 6)\n"
     "assert(not pcall(coroutine.wrap(function() error('x') end)))\n"
     "assert(coroutine.close(coroutine.create(type)))",
     ""},
    {"Strings",
     "assert(('hello'):find('l') == 3 and ('hello'):find('xyz') == nil)\n"
     "assert(('a,b,,c'):gsub(',', ';') == 'a;b;;c')\n"
     "assert(('hello world'):gsub('o', '0', 1) == 'hell0 world')\n"
     "assert(('abc'):gsub('', '-') == '-a-b-c-')\n"
     "assert(('abc'):gsub('%w', '%0%0') == 'aabbcc')\n"
     "assert(('$x $y'):gsub('%$(%w)', {x = 1, y = false}) == '1 $y')\n"
     "assert(('abc'):gsub('b', function(c) return c:upper() end) == 'aBc')\n"
     "assert(('abc'):gsub('^a', '') == 'bc' and ('aaa'):gsub('^a', 'b') == 'baa')\n"
     "local w = {} for k, v in ('a=1, b=2'):gmatch('(%w)=(%w)') do w[#w+1] = k .. v end\n"
     "assert(table.concat(w, '+') == 'a1+b2')\n"
     "local n = 0 for _ in ('abc'):gmatch('') do n = n + 1 end assert(n == 4)\n"
     "assert(('x'):rep(3, ',') == 'x,x,x' and ('abc'):find('b', -2) == 2)\n"
     "assert(('key = 5'):match('^(%w+)%s*=%s*(%d+)$') == 'key')\n"
     "assert(('%d %5.1f %q %s %%'):format(1, 2.5, 'a', nil) == '1   2.5 \"a\" nil %')",
     ""},
    {"Tables",
     "local t = {1, 2, 3} table.insert(t, 4) table.insert(t, 1, 0)\n"
     "assert(table.concat(t, ',') == '0,1,2,3,4' and table.remove(t) == 4)\n"
     "assert(table.remove(t, 1) == 0 and #t == 3 and table.remove({}) == nil)\n"
     "table.sort(t, function(a, b) return a > b end) assert(table.concat(t) == '321')\n"
     "assert(select('#', table.unpack({1, nil, 3}, 1, 3)) == 3)\n"
     "assert(table.concat(table.move({1, 2}, 1, 2, 2)) == '112')\n"
     "assert(utf8.len('aé') == 2 and table.pack(1, 2).n == 2)",
     ""},
    {"Numbers",
     "assert(tonumber('0x10') == 16 and tonumber('z', 36) == 35 and tonumber('x') == nil)\n"
     "for i = 1, 200 do\n"
     "  local r = math.random(3, 5) assert(r >= 3 and r <= 5 and math.type(r) == 'integer')\n"
     "  local u = math.random() assert(u >= 0 and u < 1)\n"
     "  math.random(math.mininteger, math.maxinteger)\n"
     "end\n"
     "assert(not pcall(math.random, 2, 1))",
     ""},
};

INSTANTIATE_TEST_SUITE_P(Attacks, SandboxTest, ::testing::ValuesIn(kAttacks), [](const auto& info) {
  return info.param.name;
});

TEST_F(DramaTest, EndlessAllocationEndsWithAnErrorAndTheShowGoesOn) {
  DramaOptions options;
  options.memory_limit = 4 << 20;
  for (const char* script :
       {"local t = {} while true do for i = 1, 1000 do t[#t + 1] = {i} end wait(0) end",
        "local t = {} while true do pcall(function() for i = 1, 1000 do t[#t + 1] = {i} end end)"
        " wait(0) end"}) {
    const auto drama = Make(std::string("function main() ") + script + " end", options);
    PlayTo(*drama, 2.0);
    ASSERT_EQ(drama->errors().size(), 1u);
    EXPECT_THAT(FirstError(*drama), HasSubstr(kTooMuch));
    EXPECT_THAT(FirstError(*drama), HasSubstr("drama.lua:1"));
  }
}

TEST_F(DramaTest, LimitsHoldWhileTheScriptLoads) {
  for (const char* script : {"while true do end", "local s = 'x' while true do s = s .. s end"}) {
    const auto drama = Make(script);
    EXPECT_THAT(FirstError(*drama), HasSubstr("the script"));
  }
}

TEST_F(DramaTest, TextsThatAreNoScriptsAreRefusedWithTheirPlace) {
  const std::string brackets(100'000, '(');
  const std::string braces(100'000, '{');
  for (const std::string& script :
       {std::string("\x1bLua\x54\x00\x19\x93", 8), "x = " + brackets, "x = " + braces,
        "x = '" + std::string(100'000, 'x') + "'", std::string("\0\0\0", 3)}) {
    const auto drama = Drama::Create(script, "drama.lua", stage_, {}, *log_);
    ASSERT_FALSE(drama.ok()) << script.substr(0, 20);
    EXPECT_THAT(drama.message(), HasSubstr("drama"));
  }
}

}  // namespace
}  // namespace lararium::drama
