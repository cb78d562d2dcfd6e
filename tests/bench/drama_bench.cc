// Costs of a script, of seeking, and of long timelines. Budget of a script: 0.5 ms per frame, which
// is four ticks at 30 frames a second.

#include <benchmark/benchmark.h>

#include <string>

#include "shared/core/random.h"
#include "shared/drama/drama.h"
#include "shared/drama/timeline_text.h"
#include "tests/stage/test_human.h"

namespace lararium::drama {
namespace {

constexpr int kItems = 100'000;

struct World {
  World() {
    for (int i = 0; i < 5; ++i) {
      CHECK(stage.Add("a" + std::to_string(i), test::MakeTestHuman()).ok());
    }
  }
  std::unique_ptr<Drama> Make(const std::string& script) {
    auto drama = Drama::Create(script, "bench.lua", stage, {.memory_limit = 256 << 20}, *log);
    CHECK(drama.ok());
    CHECK((*drama)->errors().empty());
    return *std::move(drama);
  }
  stage::Stage stage;
  std::shared_ptr<Log> log = MakeSilentLog();
};

constexpr char kPlaced[] = "for i = 0, 4 do actor('a' .. i):place{ x = i, z = -2 } end\n";

// Five actors whose coroutines wake in every tick and call the API: far more than a real drama
// does.
constexpr char kBusy[] = R"(
  for i = 0, 4 do
    local me, other = actor("a" .. i), actor("a" .. (i + 1) % 5)
    on(visitor:near(me, 1), function() me:look_at("visitor") end)
    start(function()
      while true do
        local here, there = me:where(), other:where()
        if (here.x - there.x) ^ 2 + (here.z - there.z) ^ 2 > 100 then me:look_at(other) end
        wait(0)
      end
    end)
  end
)";

// One frame of four ticks; the difference to an empty script is the script's cost.
void BenchFrame(benchmark::State& state, const std::string& script) {
  World world;
  const auto drama = world.Make(script);
  for (auto unused : state) {
    for (int i = 0; i < 4; ++i) {
      drama->Tick();
    }
  }
}
void BenchFrameWithoutScript(benchmark::State& state) { BenchFrame(state, kPlaced); }
void BenchFrameWithScript(benchmark::State& state) {
  BenchFrame(state, std::string(kPlaced) + kBusy);
}

std::string LongTimeline() {
  Random random(1);
  std::string text = "track{markers = {\n";
  double at = 0.0;
  for (int i = 0; i < kItems; ++i) {
    at += random.Uniform(0.0, 0.012);
    text += "  {id = \"i" + std::to_string(i) + "\", at = " + std::to_string(at) +
            ", length = " + std::to_string(random.Uniform(0.0, 3.0)) + ", name = \"m\"}, -- note\n";
  }
  return text + "}}\n";
}

void BenchOpenTimeline(benchmark::State& state) {
  const std::string text = LongTimeline();
  for (auto unused : state) {
    benchmark::DoNotOptimize(TimelineText::Read(text, "bench.lua")->lanes().data());
  }
}
void BenchQueryTimeline(benchmark::State& state) {
  const TimelineText timeline = *TimelineText::Read(LongTimeline(), "bench.lua");
  std::vector<uint32_t> found;
  double from = 0.0;
  for (auto unused : state) {
    found.clear();
    from = from > 500.0 ? 0.0 : from + 7.3;
    timeline.Query(0, from, from + 10.0, found);
    benchmark::DoNotOptimize(found.data());
  }
  state.counters["found"] = static_cast<double>(found.size());
}
// A drag: changes one number and computes what is drawn then.
void BenchEditTimeline(benchmark::State& state) {
  TimelineText timeline = *TimelineText::Read(LongTimeline(), "bench.lua");
  std::vector<uint32_t> found;
  double at = 1.0;
  for (auto unused : state) {
    CHECK(timeline.Set({0, 5000}, "at", at += 0.125).ok());
    found.clear();
    timeline.Query(0, at, at + 10.0, found);
  }
}
void BenchInsertIntoTimeline(benchmark::State& state) {
  TimelineText timeline = *TimelineText::Read(LongTimeline(), "bench.lua");
  for (auto unused : state) {
    CHECK(timeline.Insert(0, {{"at", 300.0}, {"name", "m"}}).ok());
  }
}

void BenchLoadLongDrama(benchmark::State& state) {
  World world;
  const std::string text = LongTimeline();
  for (auto unused : state) {
    world.Make(text);
  }
}

// Seeks to random times within ten minutes that were played. script: 0: only the timeline; 1: also
// coroutines that wake twice a second.
void BenchSeek(benchmark::State& state) {
  World world;
  const auto drama =
      world.Make(std::string(kPlaced) + LongTimeline() +
                 (state.range(0) == 0
                      ? ""
                      : "for i = 0, 4 do start(function() while true do actor('a' .. i):where() "
                        "wait(0.5) end end) end"));
  CHECK(drama->Seek(600.0).ok());
  Random random(2);
  for (auto unused : state) {
    CHECK(drama->Seek(random.Uniform(0.0, 600.0)).ok());
  }
}

BENCHMARK(BenchFrameWithoutScript)->Unit(benchmark::kMicrosecond);
BENCHMARK(BenchFrameWithScript)->Unit(benchmark::kMicrosecond);
BENCHMARK(BenchOpenTimeline)->Unit(benchmark::kMillisecond);
BENCHMARK(BenchQueryTimeline)->Unit(benchmark::kMicrosecond);
BENCHMARK(BenchEditTimeline)->Unit(benchmark::kMillisecond);
BENCHMARK(BenchInsertIntoTimeline)->Unit(benchmark::kMillisecond);
BENCHMARK(BenchLoadLongDrama)->Unit(benchmark::kMillisecond);
BENCHMARK(BenchSeek)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lararium::drama
