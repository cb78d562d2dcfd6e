#include "player/app/latency.h"

#include <chrono>
#include <cstdio>
#include <mutex>
#include <opencv2/core.hpp>
#include <thread>

#include "player/app/device_file.h"
#include "player/app/flash_test.h"
#include "player/app/screen.h"
#include "shared/capture/frame_source.h"
#include "shared/render/passes/flat_painter.h"

namespace lararium::player {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kSeconds = 20.0;
constexpr int kSide = 64;  // width and height of the picture, which has one colour

}  // namespace

Status MeasureLatency(const LatencyOptions& options) {
  Device device;
  if (!options.device.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(device, LoadDevice(options.device));
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<capture::FrameSource> source,
                            capture::OpenCamera(options.camera, device.capture));
  DisplayOptions window;
  window.monitor = options.monitor;
  LARARIUM_ASSIGN_OR_RETURN(Screen screen, Screen::Open(window, "Latency"));
  LARARIUM_ASSIGN_OR_RETURN(const render::RenderTarget target,
                            render::RenderTarget::Create(kSide, kSide));
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<render::FlatPainter> painter,
                            render::FlatPainter::Create({}));
  const Clock::time_point begin = Clock::now();
  const auto now = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  std::mutex mutex;
  FlashTest test;
  std::jthread camera([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      const auto frame = source->Next();
      if (!frame.ok() || !*frame) {
        return;
      }
      const double brightness = cv::mean((*frame)->grey)[0];
      const std::lock_guard lock(mutex);
      test.See(now(), brightness);
    }
  });
  while (now() < kSeconds && screen.KeepGoing()) {
    float shade = 0.0f;
    {
      const std::lock_guard lock(mutex);
      shade = test.Show(now()) ? 1.0f : 0.0f;
    }
    painter->Begin(target);
    painter->Rectangle({-1.0f, -1.0f}, {kSide + 1.0f, kSide + 1.0f}, 0.0f,
                       {shade, shade, shade, 1.0f});
    painter->End();
    screen.Present(target);
  }
  camera.request_stop();
  camera.join();
  const std::optional<FlashResult> result = test.Result();
  if (!result) {
    return Status::Error("latency", "the camera does not see the display flash",
                         "point the camera at the display, in a dim room");
  }
  std::printf("%.0f ms from drawing to the image's arrival (agreement %.2f)\n", result->latency_ms,
              result->agreement);
  return Status();
}

}  // namespace lararium::player
