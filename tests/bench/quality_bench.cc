// The cost of drawing a show at each quality, and the difference of its pictures from the best:
//   lararium_quality_bench SHOW.larshow VIDEO [FIRST_FRAME [FRAMES [WIDTH HEIGHT [FOLDER]]]]
// Measures CPU time of all threads, which includes software rendering. FOLDER receives the last
// picture of each quality.

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <string>
#include <vector>

#include "shared/bundle/bundle.h"
#include "shared/capture/frame_source.h"
#include "shared/core/log.h"
#include "shared/render/gl/graphics_context.h"
#include "shared/render/quality.h"
#include "shared/show/show_renderer.h"
#include "shared/vision/tracker.h"

namespace lararium {
namespace {

struct Setting {
  std::string name;
  render::Quality quality;
};

// Settings with one feature less each, then the quality levels.
std::vector<Setting> Settings() {
  std::vector<Setting> settings = {
      {"full", {}},
      {"samples 1", {.samples = 1}},
      {"full_size off", {.full_size = false}},
      {"layer_scale 0.7", {.layer_scale = 0.7f}},
      {"layer_scale 0.5", {.layer_scale = 0.5f}},
      {"shadow_cell 8", {.shadow_cell = 8}},
      {"sun_map 512", {.sun_map = 512}},
      {"sun_taps 4", {.sun_taps = 4}},
      {"pixel_light off", {.pixel_light = false}},
      {"reflections off", {.reflections = false}},
      {"camera_look off", {.camera_look = false}},
      {"detail_px 1", {.detail_px = 1.0f}},
      {"detail_px 2", {.detail_px = 2.0f}},
  };
  int step = 0;
  for (const render::Quality& quality : render::QualityLadder()) {
    settings.push_back({"ladder " + std::to_string(step++), quality});
  }
  return settings;
}

double ProcessorMilliseconds() {
  timespec time = {};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

struct Arguments {
  std::filesystem::path show, video, folder;
  int first = 100;
  int frames = 6;
  int width = 640, height = 480;
};

class Bench {
 public:
  Status Prepare(const Arguments& arguments);
  Status Measure(const Setting& setting, const std::filesystem::path& folder);

 private:
  std::shared_ptr<Log> log_ = MakeSilentLog();
  std::unique_ptr<show::Show> show_;
  std::optional<render::OffscreenContext> context_;
  std::unique_ptr<show::ShowRenderer> renderer_;
  std::optional<render::RenderTarget> target_;
  std::vector<vision::TrackedFrame> tracked_;
  std::vector<cv::Mat> best_;  // Each frame at full quality.
};

Status Bench::Prepare(const Arguments& arguments) {
  LARARIUM_ASSIGN_OR_RETURN(const bundle::Bundle bundle, bundle::Bundle::Open(arguments.show));
  LARARIUM_ASSIGN_OR_RETURN(show::ShowContent content, show::LoadShowContent(bundle));
  LARARIUM_ASSIGN_OR_RETURN(const auto source, capture::OpenVideo(arguments.video));
  LARARIUM_ASSIGN_OR_RETURN(
      const geometry::CameraModel camera,
      content.places.front().map->camera.ForImages(source->width(), source->height()));
  LARARIUM_ASSIGN_OR_RETURN(const auto poses,
                            vision::CreateTracker(show::Maps(content.places), camera, {}));
  LARARIUM_RETURN_IF_ERROR(source->Seek(arguments.first));
  for (int i = 0; i < arguments.frames + 1; ++i) {
    LARARIUM_ASSIGN_OR_RETURN(const std::optional<geometry::Frame> frame, source->Next());
    if (!frame) {
      break;
    }
    tracked_.push_back(poses->Track(*frame));
  }
  LARARIUM_ASSIGN_OR_RETURN(show_, show::Show::Create(std::move(content), {}, *log_));
  show_->detail().SetPictureSize(arguments.width, arguments.height);
  LARARIUM_ASSIGN_OR_RETURN(context_, render::CreateOffscreenContext());
  LARARIUM_ASSIGN_OR_RETURN(renderer_, show::ShowRenderer::Create(show_->content()));
  LARARIUM_ASSIGN_OR_RETURN(target_,
                            render::RenderTarget::Create(arguments.width, arguments.height));
  std::printf("%s, %dx%d, %zu frames from %d\n", render::GraphicsDeviceName().c_str(),
              arguments.width, arguments.height, tracked_.size() - 1, arguments.first);
  std::printf("%-18s %8s %8s %8s %8s\n", "", "stage ms", "draw ms", "PSNR dB", "worst");
  return Status();
}

Status Bench::Measure(const Setting& setting, const std::filesystem::path& folder) {
  show_->detail().SetQuality(setting.quality);
  renderer_->SetQuality(setting.quality);
  show::StagedFrame staged;
  cv::Mat picture;
  double staging = 0.0, drawing = 0.0, error = 0.0, worst = 0.0;
  // The first pass chooses levels of detail, compiles shaders and seeks.
  for (size_t i = 0; i < tracked_.size(); ++i) {
    const double before = ProcessorMilliseconds();
    show_->StageFrame(tracked_[i], tracked_[i].frame.capture_time, staged);
    const double between = ProcessorMilliseconds();
    LARARIUM_RETURN_IF_ERROR(renderer_->Draw(staged, *target_));
    glFinish();
    if (i == 0) {
      continue;
    }
    staging += between - before;
    drawing += ProcessorMilliseconds() - between;
    target_->ReadPixels(picture);
    if (best_.size() < i) {
      best_.push_back(picture.clone());
    }
    const double distance = cv::norm(picture, best_[i - 1], cv::NORM_L2);
    const double mean = distance * distance / static_cast<double>(picture.total() * 3);
    error += mean;
    worst = std::max(worst, mean);
  }
  const auto frames = static_cast<double>(tracked_.size() - 1);
  const auto psnr = [](double mean) { return 10.0 * std::log10(255.0 * 255.0 / mean); };
  std::printf("%-18s %8.2f %8.1f %8.1f %8.1f\n", setting.name.c_str(), staging / frames,
              drawing / frames, psnr(error / frames), psnr(worst));
  std::fflush(stdout);
  if (!folder.empty()) {
    std::string file = setting.name + ".png";
    std::replace(file.begin(), file.end(), ' ', '_');
    cv::imwrite((folder / file).string(), picture);
  }
  return Status();
}

Status Run(const Arguments& arguments) {
  Bench bench;
  LARARIUM_RETURN_IF_ERROR(bench.Prepare(arguments));
  for (const Setting& setting : Settings()) {
    LARARIUM_RETURN_IF_ERROR(bench.Measure(setting, arguments.folder));
  }
  return Status();
}

}  // namespace
}  // namespace lararium

int main(int count, char** values) {
  lararium::Arguments arguments;
  const auto number = [&](int index, int otherwise) {
    return count > index ? std::atoi(values[index]) : otherwise;
  };
  if (count < 3) {
    std::fprintf(stderr,
                 "usage: lararium_quality_bench SHOW.larshow VIDEO [FIRST_FRAME "
                 "[FRAMES [WIDTH HEIGHT [FOLDER]]]]\n");
    return 2;
  }
  arguments.show = values[1];
  arguments.video = values[2];
  arguments.first = number(3, arguments.first);
  arguments.frames = number(4, arguments.frames);
  arguments.width = number(5, arguments.width);
  arguments.height = number(6, arguments.height);
  arguments.folder = count > 7 ? values[7] : "";
  if (const lararium::Status status = lararium::Run(arguments); !status.ok()) {
    std::fprintf(stderr, "%s\n", status.message().c_str());
    return 1;
  }
  return 0;
}
