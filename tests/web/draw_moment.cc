// draw_moment BUNDLE SECONDS FILE [KEYFRAME]
// Draws three frames of a show from that moment of its drama on, in OpenGL ES 3.0 or WebGL 2, and
// writes the last picture's pixels (BGR). KEYFRAME: people and things only, without captions, as
// this keyframe of the map saw them. It is compiled for both systems.

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>

#include "shared/core/file.h"
#include "shared/core/log.h"
#include "shared/render/gl/graphics_context.h"
#include "shared/render/gl/render_target.h"
#include "shared/show/show_renderer.h"
#include "tests/web/moment.h"

namespace lararium::show {
namespace {

ShowContent WithoutFont(ShowContent content) {
  content.caption_font.reset();
  return content;
}

Status DrawMoment(const std::filesystem::path& file,
                  double seconds,
                  const std::filesystem::path& out,
                  std::optional<size_t> keyframe) {
  LARARIUM_ASSIGN_OR_RETURN(const render::OffscreenContext context,
                            render::CreateOffscreenContext(render::GraphicsApi::kOpenGlEs30));
  const std::shared_ptr<Log> log = MakeSilentLog();
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<Show> show, OpenAt(file, seconds, *log));
  LARARIUM_ASSIGN_OR_RETURN(
      const std::unique_ptr<ShowRenderer> renderer,
      ShowRenderer::Create(keyframe ? WithoutFont(show->content()) : show->content()));
  LARARIUM_ASSIGN_OR_RETURN(const render::RenderTarget target,
                            render::RenderTarget::Create(kMomentWidth, kMomentHeight));
  StagedFrame staged;
  for (int i = 0; i < 3; ++i) {
    const vision::TrackedFrame tracked = ViewOf(*show, i, keyframe);
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
  if (argc != 4 && argc != 5) {
    std::fprintf(stderr, "usage: draw_moment BUNDLE SECONDS FILE [KEYFRAME]\n");
    return 2;
  }
  const std::optional<size_t> keyframe =
      argc == 5 ? std::optional<size_t>(std::strtoul(argv[4], nullptr, 10)) : std::nullopt;
  const lararium::Status status =
      lararium::show::DrawMoment(argv[1], std::atof(argv[2]), argv[3], keyframe);
  if (!status.ok()) {
    std::fprintf(stderr, "%s\n", status.message().c_str());
    return 1;
  }
  return 0;
}
