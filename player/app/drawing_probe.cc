#include "player/app/drawing_probe.h"

#include <algorithm>
#include <chrono>
#include <opencv2/imgproc.hpp>
#include <span>

#include "shared/geometry/glm_convert.h"
#include "shared/render/gl/graphics_context.h"
#include "shared/render/gl/render_target.h"
#include "shared/render/quality.h"
#include "shared/show/show.h"
#include "shared/show/show_renderer.h"
#include "shared/stage/place.h"

namespace lararium::player {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr double kBegun = 20.0;      // seconds of drama, after which people are on the stage
constexpr double kDramaStep = 0.25;  // seconds of drama, step of the simulation until then
constexpr double kLooked = 0.5;      // seconds of measurement for each level
constexpr int kMostPictures = 30;
// Number of pictures before the measurement, in which shaders are compiled and levels of detail
// settle.
constexpr int kFirstPictures = 6;

double SecondsSince(SteadyClock::time_point begin) {
  return std::chrono::duration<double>(SteadyClock::now() - begin).count();
}

// The result that the tracker would give for the image of a keyframe.
vision::TrackedFrame SeenFrom(const vision::SceneDatabase& map, const vision::Keyframe& keyframe) {
  vision::TrackedFrame tracked;
  tracked.camera = map.camera;
  if (keyframe.grey.empty()) {
    tracked.frame.bgr = cv::Mat(map.camera.height, map.camera.width, CV_8UC3, cv::Scalar::all(128));
  } else {
    cv::cvtColor(keyframe.grey, tracked.frame.bgr, cv::COLOR_GRAY2BGR);
  }
  tracked.camera_from_map = keyframe.camera_from_map;
  tracked.state = vision::TrackState::kTracking;
  tracked.followed = true;
  tracked.confidence = 1.0f;
  return tracked;
}

// The number of people whose middle is inside the camera's picture.
int CountPeople(const show::ShowPlace& place,
                const vision::Keyframe& keyframe,
                const show::StagedFrame& staged) {
  const geometry::Rigid3 camera_from_stage =
      stage::CameraFromStage(place.stage, keyframe.camera_from_map);
  const geometry::CameraModel& camera = place.map->camera;
  int count = 0;
  for (const show::StagedActor& actor : staged.people.actors) {
    const glm::vec3 middle = glm::vec3(actor.stage_from_actor[3]) + glm::vec3(0.0f, 1.0f, 0.0f);
    const std::optional<Eigen::Vector2d> pixel =
        camera.Project(camera_from_stage * geometry::ToEigen(middle));
    count += pixel && camera.Contains(*pixel) ? 1 : 0;
  }
  return count;
}

class Stopwatch {
 public:
  Stopwatch(show::Show& show,
            show::ShowRenderer& renderer,
            const render::RenderTarget& target,
            double wanted)
      : show_(show), renderer_(renderer), target_(target), wanted_(wanted) {
    LookFrom(place().map->keyframes.front());
  }

  // Runs the drama for a while and chooses the keyframe that shows most people.
  void Begin() {
    while (time_ < kBegun) {
      Stage(kDramaStep);
    }
    LookFrom(*std::ranges::max_element(place().map->keyframes, {}, [&](const auto& keyframe) {
      return CountPeople(place(), keyframe, staged_);
    }));
  }

  // Measures pictures per second at a level of quality.
  Result<double> Measure(const render::Quality& quality) {
    show_.detail().SetQuality(quality);
    renderer_.SetQuality(quality);
    for (int i = 0; i < kFirstPictures; ++i) {
      LARARIUM_RETURN_IF_ERROR(Draw().status());
    }
    const SteadyClock::time_point begin = SteadyClock::now();
    double work = 0.0;
    int pictures = 0;
    while (pictures < kMostPictures && (pictures < 2 || SecondsSince(begin) < kLooked)) {
      LARARIUM_ASSIGN_OR_RETURN(const double seconds, Draw());
      work += seconds;
      ++pictures;
    }
    return pictures / std::max(work, 1e-6);
  }

 private:
  const show::ShowPlace& place() const { return show_.content().places.front(); }

  void LookFrom(const vision::Keyframe& keyframe) { tracked_ = SeenFrom(*place().map, keyframe); }

  double Stage(double step) {
    time_ += step;
    tracked_.frame.index = ++index_;
    tracked_.frame.capture_time = time_;
    const SteadyClock::time_point begin = SteadyClock::now();
    show_.StageFrame(tracked_, time_, staged_);
    return SecondsSince(begin);
  }

  // Returns the seconds for one picture. Staging and drawing run in parallel, so the longer time
  // counts.
  Result<double> Draw() {
    const double staging = Stage(1.0 / wanted_);
    const SteadyClock::time_point begin = SteadyClock::now();
    LARARIUM_RETURN_IF_ERROR(renderer_.Draw(staged_, target_));
    target_.Finish();
    return std::max(staging, SecondsSince(begin));
  }

  show::Show& show_;
  show::ShowRenderer& renderer_;
  const render::RenderTarget& target_;
  vision::TrackedFrame tracked_;
  double wanted_;
  double time_ = 0.0;
  int64_t index_ = 0;
  show::StagedFrame staged_;
};

Status Measure(const show::ShowContent& content,
               render::GraphicsChoice graphics,
               double wanted,
               Log& log,
               DrawingProbe& probe) {
  if (const show::ShowPlace& place = content.places.front(); place.map->keyframes.empty()) {
    return Status::Error(place.stage.name, "has no keyframes to draw a view from",
                         "train the place again");
  }
  const std::span<const render::Quality> fader = render::QualityLadder();
  LARARIUM_ASSIGN_OR_RETURN(const auto show, show::Show::Create(content, {}, log));
  show->detail().SetPictureSize(probe.size.width, probe.size.height);
  LARARIUM_ASSIGN_OR_RETURN(const auto context, render::CreateOffscreenContext(graphics));
  LARARIUM_ASSIGN_OR_RETURN(const auto renderer,
                            show::ShowRenderer::Create(show->content(), fader.back()));
  LARARIUM_ASSIGN_OR_RETURN(const auto target,
                            render::RenderTarget::Create(probe.size.width, probe.size.height));
  Stopwatch stopwatch(*show, *renderer, target, wanted);
  stopwatch.Begin();
  probe.rates.assign(fader.size(), 0.0);
  for (size_t level = fader.size(); level-- > 0;) {
    LARARIUM_ASSIGN_OR_RETURN(probe.rates[level], stopwatch.Measure(fader[level]));
    if (probe.rates[level] < 0.5 * wanted) {
      break;
    }
  }
  return Status();
}

}  // namespace

DrawingProbe ProbeDrawing(const show::ShowContent& content,
                          std::optional<PictureSize> size,
                          render::GraphicsChoice graphics,
                          double wanted,
                          Log& log) {
  DrawingProbe probe;
  const geometry::CameraModel& camera = content.places.front().map->camera;
  probe.size = size.value_or(PictureSize{camera.width & ~1, camera.height & ~1});
  probe.problem = Measure(content, graphics, wanted, log, probe);
  return probe;
}

}  // namespace lararium::player
