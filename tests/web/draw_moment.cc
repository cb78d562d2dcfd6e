// draw_moment BUNDLE SECONDS FILE
// Draws three frames of a show from that moment of its drama on, in OpenGL ES 3.0 or WebGL 2, and
// writes the last picture's pixels (BGR). It is compiled for both systems.

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include "shared/core/file.h"
#include "shared/core/log.h"
#include "shared/render/gl/graphics_context.h"
#include "shared/render/gl/render_target.h"
#include "shared/show/show_renderer.h"
#include "tests/web/moment.h"

namespace lararium::show {
namespace {

Status DrawMoment(const std::filesystem::path& file,
                  double seconds,
                  const std::filesystem::path& out) {
  LARARIUM_ASSIGN_OR_RETURN(const render::OffscreenContext context,
                            render::CreateOffscreenContext(render::GraphicsApi::kOpenGlEs30));
  const std::shared_ptr<Log> log = MakeSilentLog();
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<Show> show, OpenAt(file, seconds, *log));
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<ShowRenderer> renderer,
                            ShowRenderer::Create(show->content()));
  LARARIUM_ASSIGN_OR_RETURN(const render::RenderTarget target,
                            render::RenderTarget::Create(kMomentWidth, kMomentHeight));
  StagedFrame staged;
  for (int i = 0; i < 3; ++i) {
    const vision::TrackedFrame tracked = ViewOf(*show, i);
    show->StageFrame(tracked, tracked.frame.capture_time, staged);
    LARARIUM_RETURN_IF_ERROR(renderer->Draw(staged, target));
    render::RenderTarget::Finish();
  }
  cv::Mat bgr;
  target.ReadPixels(bgr);
  return WriteFileAtomically(
      out, std::string(reinterpret_cast<const char*>(bgr.data), bgr.total() * bgr.elemSize()));
}

}  // namespace
}  // namespace lararium::show

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: draw_moment BUNDLE SECONDS FILE\n");
    return 2;
  }
  const lararium::Status status = lararium::show::DrawMoment(argv[1], std::atof(argv[2]), argv[3]);
  if (!status.ok()) {
    std::fprintf(stderr, "%s\n", status.message().c_str());
    return 1;
  }
  return 0;
}
