#include "editor/app/rendering.h"

#include <algorithm>
#include <utility>

#include "editor/app/staging.h"
#include "editor/app/training.h"
#include "shared/capture/frame_source.h"
#include "shared/capture/video_writer.h"
#include "shared/render/graphics_context.h"
#include "shared/show/frame_pipeline.h"
#include "shared/show/show_renderer.h"
#include "shared/vision/tracker.h"

namespace lararium::app {

Result<RenderReport> RenderVideo(RenderJob job, Progress& progress, Log& log) {
  LARARIUM_ASSIGN_OR_RETURN(const auto source, capture::OpenVideo(job.video));
  LARARIUM_ASSIGN_OR_RETURN(
      const geometry::CameraModel camera,
      job.intrinsics.empty()
          ? job.content.places.front().map->camera.ForImages(source->width(), source->height())
          : geometry::CameraModel::FromNumbers(job.intrinsics, source->width(), source->height()));
  LARARIUM_ASSIGN_OR_RETURN(const auto poses,
                            vision::CreateTracker(show::Maps(job.content.places), camera, {}));
  show::SetOccluders(job.content.places, *poses);
  LARARIUM_ASSIGN_OR_RETURN(const auto show, show::Show::Create(std::move(job.content), {}, log));

  LARARIUM_ASSIGN_OR_RETURN(const auto context, render::CreateOffscreenContext());
  LARARIUM_ASSIGN_OR_RETURN(const auto renderer, show::ShowRenderer::Create(show->content()));
  LARARIUM_ASSIGN_OR_RETURN(
      const auto target, render::RenderTarget::Create(source->width() & ~1, source->height() & ~1));
  LARARIUM_ASSIGN_OR_RETURN(const auto writer,
                            capture::VideoWriter::Create(job.out, target.width(), target.height(),
                                                         source->frames_per_second()));
  RenderReport report;
  show::ShowStatistics statistics;
  show::LockStep lock_step({*source, *poses, *show, statistics});
  show::StagedFrame staged;
  cv::Mat picture;
  const double frame_count = static_cast<double>(source->estimated_frame_count());
  while (true) {
    if (progress.Cancelled()) {
      return Status::Error(job.out.string(), "rendering was cancelled, nothing was written");
    }
    LARARIUM_ASSIGN_OR_RETURN(const bool more, lock_step.Next(staged));
    if (!more) {
      break;
    }
    LARARIUM_RETURN_IF_ERROR(renderer->Draw(staged, target));
    target.ReadPixels(picture);
    LARARIUM_RETURN_IF_ERROR(writer->Write(picture));
    ++report.frames;
    report.tracked += staged.camera_from_stage.has_value() ? 1 : 0;
    progress.Report("rendering", std::min(report.frames / std::max(frame_count, 1.0), 1.0));
  }
  LARARIUM_RETURN_IF_ERROR(writer->Finish());
  return report;
}

}  // namespace lararium::app
