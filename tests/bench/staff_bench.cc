// What telling a staff page or a fleet costs the thread that draws, and what playing with a group
// costs the thread that stages.

#include <benchmark/benchmark.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "player/staff/staff_reporter.h"
#include "shared/core/log.h"
#include "shared/render/gl/graphics_context.h"
#include "shared/render/gl/render_target.h"
#include "shared/show/drama_group.h"
#include "shared/stage/stage.h"

namespace lararium::player {
namespace {

// Processor time of this thread, microseconds.
double ProcessorTime() {
  timespec time = {};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e6 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_nsec);
}

// One frame. The counter is the mean of those two in a second that send a state.
void BM_StaffReporterAfterFrame(benchmark::State& state) {
  const auto context = render::CreateOffscreenContext({});
  const auto picture = render::RenderTarget::Create(640, 360);
  int ends[2];
  if (!context.ok() || !picture.ok() || ::socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends) != 0) {
    state.SkipWithError("no graphics or no sockets");
    return;
  }
  std::jthread process([fleet = ends[1]] {
    std::array<char, kMostStaffMessage> buffer;
    while (::recv(fleet, buffer.data(), buffer.size(), 0) > 0) {
    }
  });
  const auto log = MakeSilentLog();
  double telling = 0.0;
  int told_states = 0;
  {
    StaffReporter reporter({.fleet = ends[0]}, *log);
    const show::StagedFrame staged;
    const auto fill = [&told_states](StaffState& told) {
      ++told_states;
      told.title = "The thermopolium of Vetutius Placidus";
      told.place = "thermopolium";
      told.languages = {"la", "it", "en"};
      told.caption_languages = {"it", "en", "de", "fr"};
    };
    for (auto _ : state) {
      const int before = told_states;
      const double begin = ProcessorTime();
      reporter.AfterFrame(staged, *picture, fill);
      telling += told_states > before ? ProcessorTime() - begin : 0.0;
    }
  }
  ::shutdown(ends[0], SHUT_RDWR);
  process.join();
  ::close(ends[0]);
  ::close(ends[1]);
  state.counters["telling_us"] = telling / std::max(told_states, 1);
}
BENCHMARK(BM_StaffReporterAfterFrame)->MinTime(5.0);

// What one frame of a show in a group of eight takes more than one of a show alone. News of two
// visitors come each eighth of a second.
void BM_GroupSeatNext(benchmark::State& state) {
  stage::Stage stage;
  const auto log = MakeSilentLog();
  const auto drama = drama::Drama::Create("", "drama.lua", stage, {}, *log);
  double now = 100.0;
  show::DramaGroup group([&now] { return now; });
  show::GroupSeat seat(group, **drama);
  const show::DramaGroup::Clock clock = {1, {now, 0.0, 1.0}, std::nullopt};
  group.Update(clock, std::nullopt);
  int64_t frame = 0;
  double longest = 0.0;
  for (auto _ : state) {
    now += 1.0 / 60.0;
    if (++frame % 8 == 0) {
      const auto tick = static_cast<int64_t>(120.0 * (now - 100.0)) + 30;
      std::vector<drama::GroupVisitor> visitors(8);
      visitors[0].position.x = static_cast<float>(now);
      drama::Visitor visitor;
      visitor.group = std::make_shared<const std::vector<drama::GroupVisitor>>(visitors);
      group.Update(clock, show::DramaGroup::Revision{tick, {{tick, visitor}}});
    }
    const double begin = ProcessorTime();
    const double wanted = seat.Next({.tracked = true, .keys = "a"}, false, now);
    const double taken = 1e-6 * (ProcessorTime() - begin);
    state.SetIterationTime(taken);
    longest = std::max(longest, taken);
    (void)group.TakeOwn();
    while ((*drama)->time() < wanted) {
      (*drama)->Tick();
    }
  }
  state.counters["longest_us"] = 1e6 * longest;
}
BENCHMARK(BM_GroupSeatNext)->UseManualTime()->Iterations(20'000);

// Statistics of a kiosk that has counted for 400 days.
VisitStatistics LongStatistics() {
  VisitDetails details;
  for (int i = 0; i < 100; ++i) {
    AddVisit({.seconds = 3.0 * i,
              .drama_seconds = 3.0 * i,
              .language = std::to_string(i % 3),
              .captions = std::to_string(i % 4),
              .lost = {{"thermopolium", i % 10, i / 10}}},
             details);
  }
  VisitStatistics statistics;
  for (int day = 0; day < 400; ++day) {
    statistics.Day(std::to_string(1000 + day) + "-01-01").details = VisitDetails(details);
  }
  return statistics;
}

// Measures the counting of one frame of a kiosk. A visit begins or ends each 300 frames.
void BM_VisitCounterCount(benchmark::State& state) {
  VisitStatistics statistics = LongStatistics();
  DayCounts& day = statistics.Day("1399-01-01");
  VisitCounter counter;
  VisitCounter::Moment moment = {.tracked = true, .place = "thermopolium", .language = "it"};
  int64_t frame = 0;
  for (auto _ : state) {
    moment.now += 1.0 / 60.0;
    moment.noticed = ++frame / 300 % 2 == 0;
    moment.last_sign = moment.now;
    counter.Count(moment, day);
  }
}
BENCHMARK(BM_VisitCounterCount);

// Measures the copy of all days that is made twice in the frame in which a visitor comes or leaves.
void BM_VisitStatisticsCopy(benchmark::State& state) {
  const VisitStatistics statistics = LongStatistics();
  for (auto _ : state) {
    VisitStatistics copy = statistics;
    benchmark::DoNotOptimize(copy);
  }
}
BENCHMARK(BM_VisitStatisticsCopy);

}  // namespace
}  // namespace lararium::player
