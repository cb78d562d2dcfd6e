// play_lines SECONDS
// Plays scenes of a drama at uneven times, as a page does whose pictures take longer at times: a
// spoken line of one second every 1.3 seconds, and ambience. Prints the clock's time at which the
// drama begins, seconds.

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <thread>
#include <vector>

#include "shared/core/random.h"
#include "tests/web/wav.h"
#include "web/page/page_sound.h"

namespace lararium::web {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kEvery = 1.3;  // Seconds from line to line.

Status PlayLines(double seconds) {
  LARARIUM_ASSIGN_OR_RETURN(const auto library,
                            audio::SoundLibrary::Load({test::Wav("line", 1, test::WavNoise(1.0)),
                                                       test::Wav("room", 1, test::WavNoise(0.7))}));
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<PageSound> sound, PageSound::Create(library));
  Random random(3);
  const Clock::time_point begin = Clock::now();
  std::printf("%.6f\n", std::chrono::duration<double>(begin.time_since_epoch()).count());
  double stall = 2.0;  // Time of the next long frame, seconds.
  while (true) {
    audio::SoundScene scene;
    scene.time = std::chrono::duration<double>(Clock::now() - begin).count();
    if (scene.time > seconds) {
      return Status();
    }
    audio::Voice room;
    room.source = 1;
    room.clip = library->Find("room");
    room.bus = audio::Bus::kAmbience;
    room.loops = true;
    room.head_locked = true;
    const double line = std::floor(scene.time / kEvery);
    audio::Voice voice;
    voice.source = 2;
    voice.clip = library->Find("line");
    voice.bus = audio::Bus::kSpeech;
    voice.began = line * kEvery;
    voice.position = {0.0f, 0.0f, -2.0f};
    scene.voices = {room, voice};
    sound->Show(scene);
    double wait = random.Uniform(0.02, 0.05);
    if (scene.time > stall) {
      stall += 2.0;
      wait = 0.25;
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(wait));
  }
}

}  // namespace
}  // namespace lararium::web

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: play_lines SECONDS\n");
    return 2;
  }
  const lararium::Status status = lararium::web::PlayLines(std::atof(argv[1]));
  if (!status.ok()) {
    std::fprintf(stderr, "%s\n", status.message().c_str());
    return 1;
  }
  return 0;
}
