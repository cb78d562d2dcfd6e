// What telling a staff page or a fleet costs the thread that draws.

#include <benchmark/benchmark.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <thread>

#include "player/staff/staff_reporter.h"
#include "shared/core/log.h"
#include "shared/render/gl/graphics_context.h"
#include "shared/render/gl/render_target.h"

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

}  // namespace
}  // namespace lararium::player
