#include "editor/jobs/rendering.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "editor/jobs/training.h"
#include "shared/capture/frame_source.h"
#include "shared/capture/video_writer.h"
#include "shared/core/free_space.h"
#include "shared/render/gl/graphics_context.h"
#include "shared/show/frame_pipeline.h"
#include "shared/show/show_renderer.h"
#include "shared/show/sound_recording.h"
#include "shared/vision/foreground/foreground_mask.h"
#include "shared/vision/tracker.h"

namespace lararium::editor {

Result<RenderReport> RenderVideo(RenderJob job, Progress& progress, Log& log) {
  LARARIUM_RETURN_IF_ERROR(RequireSpace(job.out.parent_path()));
  LARARIUM_ASSIGN_OR_RETURN(const auto source, capture::OpenVideo(job.video));
  size_t told = 0;
  const auto tell = [&] {
    for (const std::vector<std::string> notes = source->Notes(); told < notes.size(); ++told) {
      log.Warn("{}", notes[told]);
    }
  };
  tell();
  LARARIUM_ASSIGN_OR_RETURN(
      const geometry::CameraModel camera,
      job.intrinsics.empty()
          ? job.content.places.front().map->camera.ForImages(source->width(), source->height())
          : geometry::CameraModel::FromNumbers(job.intrinsics, source->width(), source->height()));
  LARARIUM_ASSIGN_OR_RETURN(auto tracker,
                            vision::CreateTracker(show::Maps(job.content.places), camera, {}));
  const auto poses = vision::WithForeground(std::move(tracker), show::Maps(job.content.places));
  show::SetOccluders(job.content.places, *poses);
  LARARIUM_ASSIGN_OR_RETURN(const auto show, show::Show::Create(std::move(job.content), {}, log));

  LARARIUM_ASSIGN_OR_RETURN(const auto context, render::CreateOffscreenContext());
  std::optional<render::DrawingTurn> turn(std::in_place, context);
  LARARIUM_ASSIGN_OR_RETURN(const auto renderer, show::ShowRenderer::Create(show->content()));
  renderer->SetEvidence(job.evidence);
  LARARIUM_ASSIGN_OR_RETURN(
      const auto target, render::RenderTarget::Create(source->width() & ~1, source->height() & ~1));
  LARARIUM_ASSIGN_OR_RETURN(const auto writer,
                            capture::VideoWriter::Create(job.out, target.width(), target.height(),
                                                         source->frames_per_second(),
                                                         show::SoundRecording::Sounds(*show)));
  LARARIUM_ASSIGN_OR_RETURN(auto sound,
                            show::SoundRecording::Create(*show, true, writer.get(), job.sound));
  turn.reset();
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
    LARARIUM_RETURN_IF_ERROR(sound.Add(staged.sound));
    turn.emplace(context);
    LARARIUM_RETURN_IF_ERROR(renderer->Draw(staged, target));
    target.ReadPixels(picture);
    turn.reset();
    LARARIUM_RETURN_IF_ERROR(writer->Write(picture, staged.sound.frame_time));
    ++report.frames;
    report.tracked += staged.camera.camera_from_stage.has_value() ? 1 : 0;
    progress.Report("rendering", std::min(report.frames / std::max(frame_count, 1.0), 1.0));
  }
  LARARIUM_RETURN_IF_ERROR(sound.Finish(1.0 / source->frames_per_second()));
  LARARIUM_RETURN_IF_ERROR(writer->Finish());
  tell();
  return report;
}

}  // namespace lararium::editor
