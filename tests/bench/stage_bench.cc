// Costs of a tick of the stage and of building its floor.

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "shared/core/random.h"
#include "shared/stage/stage.h"
#include "tests/stage/test_human.h"
#include "tests/stage/test_props.h"

namespace lararium::stage {
namespace {

// Five people and twenty objects; each person always has a task.
class BusyStage {
 public:
  BusyStage() {
    for (int i = 0; i < 5; ++i) {
      actors_.push_back(*stage_.Add("a" + std::to_string(i), test::MakeTestHuman()));
      stage_.Place(actors_.back(), {static_cast<float>(i) - 2.0f, 0.0f, -3.0f}, 0.0f);
      stage_.Show(actors_.back(), true);
    }
    const auto add = [this](const std::string& name, stage::Prop prop, float x, float z) {
      return *stage_.AddObject(name, test::Model(std::move(prop)), {{x, 0.0f, z}});
    };
    table_ = add("table", test::MakeTable(), -2.0f, 0.0f);
    chest_ = add("chest", test::MakeChest(), 2.0f, 0.0f);
    for (int i = 0; i < 18; ++i) {
      cups_.push_back(add("cup" + std::to_string(i), test::MakeCup(),
                          0.4f * static_cast<float>(i) - 3.5f, 3.0f));
    }
    tasks_.resize(actors_.size());
  }

  void Tick() {
    for (size_t i = 0; i < actors_.size(); ++i) {
      if (stage_.tasks().report(tasks_[i]).over() || tasks_[i] == 0) {
        stage_.tasks().Forget(tasks_[i]);
        tasks_[i] = Demand(actors_[i]);
      }
    }
    stage_.Advance();
    stage_.Perform();
  }

 private:
  TaskId Demand(ActorId actor) {
    switch (random_.Below(4)) {
      case 0:
        return *stage_.tasks().Walk(actor, {random_.Uniform(-4, 4), random_.Uniform(-4, 4)}, {}, 0);
      case 1:
        return *stage_.tasks().Use(actor, table_, "wipe", 0.0f);
      case 2:
        return *stage_.tasks().Use(actor, chest_, random_.Below(2) == 0 ? "open" : "shut", 0.0f);
      default:
        return *stage_.tasks().Take(actor, cups_[random_.Below(18)]);
    }
  }

  Stage stage_;
  Random random_ = Random(1);
  std::vector<ActorId> actors_;
  std::vector<ObjectId> cups_;
  ObjectId table_;
  ObjectId chest_;
  std::vector<TaskId> tasks_;
};

// Five ticks, as in one frame at 25 Hz; the stage's share must stay far below 1 ms.
void BenchStageFrame(benchmark::State& state) {
  BusyStage stage;
  for (int tick = 0; tick < 1200; ++tick) {
    stage.Tick();
  }
  for (auto _ : state) {
    for (int tick = 0; tick < 5; ++tick) {
      stage.Tick();
    }
  }
}
BENCHMARK(BenchStageFrame)->Unit(benchmark::kMicrosecond);

// The default floor, 20 m by 20 m.
void BenchBuildNavigation(benchmark::State& state) {
  const BlockedArea area = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, false};
  for (auto _ : state) {
    benchmark::DoNotOptimize(Navigation::Create({}, {}, {&area, 1}));
  }
}
BENCHMARK(BenchBuildNavigation)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lararium::stage
